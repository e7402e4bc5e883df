//! What every module uses: errors, numbers in messages, memory that is checked beforehand, stopping from outside, words that runs remember.

pub(crate) mod error;
pub(crate) mod interrupt;
pub(crate) mod memory;
pub(crate) mod quantities;
pub(crate) mod words;
