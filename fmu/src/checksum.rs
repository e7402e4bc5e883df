//! A checksum of bytes, for instantiation tokens and states.

/// FNV-1a of 64 bits (<http://www.isthe.com/chongo/tech/comp/fnv>). Each byte changes it by a one-to-one map, so that two texts of the same
/// length that differ in a single byte never have the same.
pub fn checksum(bytes: impl IntoIterator<Item = u8>) -> u64 {
    let add = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, add)
}
