//! The functions of FMI 3.0 for what the description says that there is not. Importers load them all.
#![allow(unsafe_code, non_snake_case)]

use std::ptr;

use crate::abi::{Handle, Status, with};

/// Functions for other interface types: there is no instance of these.
macro_rules! no_instance {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        pub extern "C" fn $name() -> *mut Handle {
            ptr::null_mut()
        }
    )*};
}

no_instance! { fmi3InstantiateModelExchange fmi3InstantiateScheduledExecution }

/// Functions for variables of other types than `fmi3Float64`, of which there are none: nothing of nothing is well. What else they are
/// given is left where C puts it, as of a function with fewer parameters.
macro_rules! no_variables {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(handle: *mut Handle, _: *const u32, count: usize) -> Status {
            unsafe {
                with(handle, |_| {
                    if count == 0 {
                        return Ok(());
                    }
                    Err(format!("{}: all variables are fmi3Float64", stringify!($name)))
                })
            }
        }
    )*};
}

no_variables! {
    fmi3GetFloat32 fmi3GetInt8 fmi3GetUInt8 fmi3GetInt16 fmi3GetUInt16 fmi3GetInt32 fmi3GetUInt32 fmi3GetInt64 fmi3GetUInt64
    fmi3GetBoolean fmi3GetString fmi3GetBinary fmi3GetClock
    fmi3SetFloat32 fmi3SetInt8 fmi3SetUInt8 fmi3SetInt16 fmi3SetUInt16 fmi3SetInt32 fmi3SetUInt32 fmi3SetInt64 fmi3SetUInt64
    fmi3SetBoolean fmi3SetString fmi3SetBinary fmi3SetClock
    fmi3GetIntervalDecimal fmi3GetIntervalFraction fmi3GetShiftDecimal fmi3GetShiftFraction
    fmi3SetIntervalDecimal fmi3SetIntervalFraction fmi3SetShiftDecimal fmi3SetShiftFraction
    fmi3GetOutputDerivatives
}

/// Functions of what the description says that there is not.
macro_rules! absent {
    ($($name:ident)*) => {$(
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(handle: *mut Handle) -> Status {
            unsafe { with(handle, |_| Err(format!("{} is not offered", stringify!($name)))) }
        }
    )*};
}

absent! {
    fmi3EnterEventMode fmi3EnterConfigurationMode fmi3ExitConfigurationMode fmi3EvaluateDiscreteStates fmi3UpdateDiscreteStates
    fmi3GetNumberOfVariableDependencies fmi3GetVariableDependencies fmi3GetDirectionalDerivative fmi3GetAdjointDerivative
    fmi3EnterContinuousTimeMode fmi3CompletedIntegratorStep fmi3SetTime fmi3SetContinuousStates fmi3GetContinuousStates
    fmi3GetContinuousStateDerivatives fmi3GetEventIndicators fmi3GetNominalsOfContinuousStates
    fmi3GetNumberOfEventIndicators fmi3GetNumberOfContinuousStates fmi3ActivateModelPartition
}
