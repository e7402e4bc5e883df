//! Words that a document may have in place of a number, each read and written as itself. Another word is refused by the enum that tries it,
//! in the terms of all that it takes.

/// Makes the module by which serde reads and writes a variant as one word.
macro_rules! words {
    ($($word:ident),*) => {$(
        pub(super) mod $word {
            use serde::de::{Deserialize, Deserializer, Error};
            use serde::Serializer;

            pub fn serialize<S: Serializer>(to: S) -> Result<S::Ok, S::Error> {
                to.serialize_str(stringify!($word))
            }

            pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<(), D::Error> {
                match String::deserialize(from)?.as_str() {
                    stringify!($word) => Ok(()),
                    other => Err(D::Error::custom(other)),
                }
            }
        }
    )*};
}

words!(band, contact, flooded);
