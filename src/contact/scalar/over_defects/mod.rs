//! Contacts over defects, one by one: which surfaces a slice meets, how they press, and what the gradient of their energy adds.

#[cfg(test)]
mod cap_tests;
mod circles;
mod depth;
mod elements;
mod gradient;
mod pits;
mod pressing;
mod within;

pub(crate) use within::Sighted;
