//! The functions of FMI 3.0 in C.
//!
//! Pointers are checked for null and otherwise trusted, as in any library for C. A panic ends in `fmi3Fatal` and does not cross the border.
//! Names are the standard's.
#![allow(unsafe_code, non_snake_case)]

use std::any::Any;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::{fs, ptr, slice};

use ballrace::scene::Scene;

use crate::description::description;
use crate::instance::{FmuResult, Instance, State};
use crate::variables::Table;

/// `fmi3Status`.
pub type Status = c_int;
const OK: Status = 0;
const WARNING: Status = 1;
const ERROR: Status = 3;
const FATAL: Status = 4;

/// `fmi3LogMessageCallback`.
type LogMessage = unsafe extern "C" fn(*mut c_void, Status, *const c_char, *const c_char);

/// Handle to which an `fmi3Instance` points.
pub struct Handle {
    instance: Instance,
    log: Log,
}

/// Log to which messages go.
struct Log {
    message: Option<LogMessage>,
    environment: *mut c_void,
}

impl Log {
    fn write(&self, status: Status, text: &str) {
        let category = if status == WARNING {
            c"logStatusWarning"
        } else {
            c"logStatusError"
        };
        let text = CString::new(text.replace('\0', " ")).unwrap_or_default();
        if let Some(message) = self.message {
            // SAFETY: the importer gave the function for this environment, and both texts outlive the call.
            unsafe { message(self.environment, status, category.as_ptr(), text.as_ptr()) };
        }
    }
}

/// Works and returns the status of what came of it; a message goes to the log.
fn status(log: &Log, work: impl FnOnce() -> FmuResult<()>) -> Status {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => OK,
        Ok(Err(message)) => {
            log.write(ERROR, &message);
            ERROR
        }
        Err(panic) => {
            log.write(FATAL, &format!("a defect of ballrace: {}", words(&*panic)));
            FATAL
        }
    }
}

/// Words of a panic.
fn words(panic: &(dyn Any + Send)) -> &str {
    let owned = panic.downcast_ref::<String>().map(String::as_str);
    owned
        .or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("a panic")
}

/// Works with an instance.
pub unsafe fn with(
    handle: *mut Handle,
    work: impl FnOnce(&mut Instance) -> FmuResult<()>,
) -> Status {
    // SAFETY: null, or what `fmi3InstantiateCoSimulation` has returned and nobody else uses meanwhile.
    let Some(Handle { instance, log }) = (unsafe { handle.as_mut() }) else {
        return ERROR;
    };
    status(log, || work(instance))
}

/// A list from C.
unsafe fn list<'a, T>(first: *const T, count: usize) -> &'a [T] {
    if first.is_null() || count == 0 {
        return &[];
    }
    // SAFETY: the caller's: so many from there.
    unsafe { slice::from_raw_parts(first, count) }
}

unsafe fn list_mut<'a, T>(first: *mut T, count: usize) -> &'a mut [T] {
    if first.is_null() || count == 0 {
        return &mut [];
    }
    // SAFETY: as above.
    unsafe { slice::from_raw_parts_mut(first, count) }
}

/// A text from C.
unsafe fn text(from: *const c_char) -> String {
    if from.is_null() {
        return String::new();
    }
    // SAFETY: the caller's: it ends with 0.
    unsafe { CStr::from_ptr(from) }
        .to_string_lossy()
        .into_owned()
}

unsafe fn write<T>(to: *mut T, value: T) {
    if !to.is_null() {
        // SAFETY: not null, and the caller's.
        unsafe { to.write(value) };
    }
}

/// The version of the interface.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// Debug log that there is not: what is refused or fails is logged in any case.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetDebugLogging(
    _: *mut Handle,
    _on: bool,
    _count: usize,
    _categories: *const *const c_char,
) -> Status {
    OK
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    _name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    _logging_on: bool,
    _event_mode_used: bool,
    _early_return_allowed: bool,
    _intermediate_variables: *const u32,
    _intermediate_count: usize,
    environment: *mut c_void,
    message: Option<LogMessage>,
    _intermediate_update: *const c_void,
) -> *mut Handle {
    let log = Log {
        message,
        environment,
    };
    // SAFETY: texts of the caller.
    let (token, resources) = unsafe { (text(token), text(resources)) };
    let mut made = None;
    let _ = status(&log, || {
        let path = Path::new(&resources).join("scene.toml");
        let scene = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        made = Some(Instance::new(&scene, &token)?);
        Ok(())
    });
    made.map_or(ptr::null_mut(), |instance| {
        Box::into_raw(Box::new(Handle { instance, log }))
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(handle: *mut Handle) {
    if !handle.is_null() {
        // SAFETY: from `fmi3InstantiateCoSimulation`, and not used again.
        drop(unsafe { Box::from_raw(handle) });
    }
}

/// The tolerance is the parameter `solver.rtol`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    handle: *mut Handle,
    _tolerance_defined: bool,
    _tolerance: f64,
    start: f64,
    _stop_defined: bool,
    _stop: f64,
) -> Status {
    unsafe { with(handle, |instance| instance.enter_initialization(start)) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitInitializationMode(handle: *mut Handle) -> Status {
    let mut doubts = Vec::new();
    let done = unsafe {
        with(handle, |instance| {
            doubts = instance.exit_initialization()?;
            Ok(())
        })
    };
    // SAFETY: as in `with`.
    if let Some(handle) = unsafe { handle.as_ref() } {
        for doubt in doubts {
            handle.log.write(WARNING, &doubt);
        }
    }
    done
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Terminate(handle: *mut Handle) -> Status {
    unsafe { with(handle, Instance::terminate) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Reset(handle: *mut Handle) -> Status {
    unsafe {
        with(handle, |instance| {
            instance.reset();
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat64(
    handle: *mut Handle,
    references: *const u32,
    count: usize,
    values: *mut f64,
    value_count: usize,
) -> Status {
    let (references, values) = unsafe { (list(references, count), list_mut(values, value_count)) };
    unsafe {
        with(handle, |instance| {
            let mut found = Vec::with_capacity(values.len());
            for reference in references {
                instance.get(*reference, &mut found)?;
            }
            check_count(found.len(), values.len())?;
            values.copy_from_slice(&found);
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat64(
    handle: *mut Handle,
    references: *const u32,
    count: usize,
    values: *const f64,
    value_count: usize,
) -> Status {
    let (references, values) = unsafe { (list(references, count), list(values, value_count)) };
    unsafe {
        with(handle, |instance| {
            // All that can be set are single numbers.
            check_count(references.len(), values.len())?;
            for (reference, value) in references.iter().zip(values) {
                instance.set(*reference, *value)?;
            }
            Ok(())
        })
    }
}

fn check_count(needed: usize, given: usize) -> FmuResult<()> {
    if needed == given {
        return Ok(());
    }
    Err(format!(
        "room for {given} values: the variables have {needed}"
    ))
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(handle: *mut Handle, state: *mut *mut State) -> Status {
    unsafe {
        with(handle, |instance| {
            let taken = instance.state();
            // SAFETY: null, or where the caller has a state or null.
            match state.as_mut() {
                None => return Err("no place for the state".to_owned()),
                Some(place) => match place.as_mut() {
                    Some(before) => *before = taken,
                    None => *place = Box::into_raw(Box::new(taken)),
                },
            }
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(handle: *mut Handle, state: *const State) -> Status {
    unsafe {
        with(handle, |instance| {
            let state = state.as_ref().ok_or("no state")?;
            instance.set_state(state)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(handle: *mut Handle, state: *mut *mut State) -> Status {
    unsafe {
        with(handle, |_| {
            if let Some(place) = state.as_mut()
                && !place.is_null()
            {
                drop(Box::from_raw(*place));
                *place = ptr::null_mut();
            }
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    handle: *mut Handle,
    state: *const State,
    size: *mut usize,
) -> Status {
    unsafe {
        with(handle, |_| {
            let bytes = state.as_ref().ok_or("no state")?.to_bytes()?;
            write(size, bytes.len());
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    handle: *mut Handle,
    state: *const State,
    place: *mut u8,
    size: usize,
) -> Status {
    let place = unsafe { list_mut(place, size) };
    unsafe {
        with(handle, |_| {
            let bytes = state.as_ref().ok_or("no state")?.to_bytes()?;
            check_count(bytes.len(), place.len())?;
            place.copy_from_slice(&bytes);
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    handle: *mut Handle,
    bytes: *const u8,
    size: usize,
    state: *mut *mut State,
) -> Status {
    let bytes = unsafe { list(bytes, size) };
    unsafe {
        with(handle, |_| {
            let state = state.as_mut().ok_or("no place for the state")?;
            *state = Box::into_raw(Box::new(State::from_bytes(bytes)?));
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterStepMode(handle: *mut Handle) -> Status {
    unsafe { with(handle, |instance| instance.enter_step_mode()) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    handle: *mut Handle,
    from: f64,
    step: f64,
    _no_set_state_before: bool,
    event_needed: *mut bool,
    terminate: *mut bool,
    early_return: *mut bool,
    reached: *mut f64,
) -> Status {
    unsafe {
        write(event_needed, false);
        write(terminate, false);
        write(early_return, false);
        with(handle, |instance| {
            let done = instance.do_step(from, step);
            write(reached, instance.time());
            done
        })
    }
}

/// The description of an FMU with a scene, in TOML: calls `answer` once, with true and `modelDescription.xml`, or with false and what is
/// wrong. No function of FMI: `ballrace fmu` asks for it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ballrace_fmu_describe(
    scene: *const c_char,
    answer: unsafe extern "C" fn(bool, *const c_char),
) {
    // SAFETY: a text of the caller.
    let scene = unsafe { text(scene) };
    let described = catch_unwind(|| {
        let table = Scene::from_toml(&scene).and_then(Table::of);
        table
            .map(|table| description(&table))
            .map_err(|e| e.to_string())
    });
    let described = described.unwrap_or_else(|panic| Err(words(&*panic).to_owned()));
    let (is_well, content) = match described {
        Ok(xml) => (true, xml),
        Err(content) => (false, content),
    };
    let content = CString::new(content.replace('\0', " ")).unwrap_or_default();
    // SAFETY: the caller's function; the text outlives the call.
    unsafe { answer(is_well, content.as_ptr()) };
}
