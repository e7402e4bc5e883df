//! What every module uses: errors, numbers in messages, memory that is checked beforehand, stopping from outside.

pub(crate) mod error;
pub(crate) mod interrupt;
pub(crate) mod memory;
pub(crate) mod quantities;
