//! Lists of all variants of an enum.

/// A list of the variants of an enum, those with a value once for each value wanted, that the compiler keeps complete: what it lacks is a
/// match that does not cover all.
macro_rules! every {
    (@any $value:expr) => { _ };
    ($of:ident: $($variant:ident $(($value:expr))?),+ $(,)?) => {{
        #[allow(unreachable_patterns, clippy::unnested_or_patterns)]
        const fn _covers(of: $of) {
            match of {
                $($of::$variant $((every!(@any $value)))?)|+ => {}
            }
        }
        [$($of::$variant $(($value))?),+]
    }};
}

pub(crate) use every;
