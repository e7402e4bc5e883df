//! Foundations of every module: errors, numbers in messages, memory that is checked beforehand, stopping from outside, threads, wall time, words that
//! runs remember, complete lists of variants, numbers that are none.

pub(crate) mod clock;
pub(crate) mod error;
pub(crate) mod every;
pub(crate) mod interrupt;
pub(crate) mod memory;
pub(crate) mod nulls;
pub(crate) mod pool;
pub(crate) mod quantities;
pub(crate) mod words;
