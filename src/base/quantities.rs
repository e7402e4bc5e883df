//! Numbers for messages, in units of their magnitude: 61 µm rather than 6.1e-5 m.

use std::ops::Range;

/// Units by their size, the largest first.
type Units = [(f64, &'static str)];

/// Units of memory in messages \[bytes\].
pub(crate) const GIB: f64 = (1u64 << 30) as f64;

const LENGTHS: &Units = &[(1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm")];
const FORCES: &Units = &[(1e6, "MN"), (1e3, "kN"), (1.0, "N")];
const TIMES: &Units = &[
    (1.0, "s"),
    (1e-3, "ms"),
    (1e-6, "µs"),
    (1e-9, "ns"),
    (1e-12, "ps"),
];

/// Four digits, without trailing zeros.
pub(crate) fn number(x: f64) -> String {
    rounded(x, 3, 1e-4..1e6)
}

/// A number as it was given: 0.1 + 0.2 as 0.3, and 1e300 not as a row of zeros.
pub(crate) fn given(x: f64) -> String {
    rounded(x, 14, 1e-5..1e16)
}

/// A length \[m\].
pub(crate) fn length(x: f64) -> String {
    in_units(x, LENGTHS, "m")
}

/// A force \[N\].
pub(crate) fn force(x: f64) -> String {
    in_units(x, FORCES, "N")
}

/// A duration \[s\], as for a limit.
pub(crate) fn duration(x: f64) -> String {
    in_units(x, TIMES, "s")
}

/// A point in time \[s\], to the sixth decimal of its unit.
#[allow(clippy::trivially_copy_pass_by_ref)] // as it is handed over for a message
pub(crate) fn time(seconds: &f64) -> String {
    let Some((scale, unit)) = unit_of(*seconds, TIMES) else {
        return format!("{} s", number(*seconds));
    };
    let value = format!("{:.6}", seconds / scale);
    let value = value.trim_end_matches('0').trim_end_matches('.');
    format!("{value} {unit}")
}

fn in_units(x: f64, units: &Units, base: &str) -> String {
    match unit_of(x, units) {
        Some((scale, unit)) => format!("{} {unit}", number(x / scale)),
        None => format!("{} {base}", number(x)),
    }
}

fn unit_of(x: f64, units: &Units) -> Option<(f64, &'static str)> {
    units.iter().find(|(scale, _)| x.abs() >= *scale).copied()
}

/// A number with so many digits after the first, those that are zeros at the end left out; with an exponent for sizes that are not
/// written plainly.
fn rounded(x: f64, digits: usize, plain: Range<f64>) -> String {
    let short: f64 = format!("{x:.digits$e}").parse().unwrap_or(x);
    let size = short.abs();
    if short != 0.0 && size.is_finite() && !plain.contains(&size) {
        return format!("{short:e}");
    }
    format!("{short}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_matter() {
        let found = [0.0, 0.1 + 0.2, 1234.56, -6.1e-5, 1e300, 20e6, f64::INFINITY].map(number);
        let expected = ["0", "0.3", "1235", "-6.1e-5", "1e300", "2e7", "inf"];
        assert_eq!(found, expected);
        let found = [0.1 + 0.2, 0.012_345_678_901_234_5, 1e300, 2.5e-300].map(given);
        assert_eq!(found, ["0.3", "0.0123456789012345", "1e300", "2.5e-300"]);
    }

    #[test]
    fn quantities_have_units_of_their_size() {
        let found = [6.1e-5, -0.0123, 1.5, 0.0, 1e-15].map(length);
        assert_eq!(found, ["61 µm", "-12.3 mm", "1.5 m", "0 m", "1e-15 m"]);
        assert_eq!([7e3, 12.0, 0.5].map(force), ["7 kN", "12 N", "0.5 N"]);
        assert_eq!([1.25e-7, 3.0].map(duration), ["125 ns", "3 s"]);
    }

    #[test]
    fn times_have_units_of_their_size() {
        let found = [0.0, 1.5, 100.0, 0.012_345_678_9, 3.41e-8, 1e-3, 2.5e-16].map(|t| time(&t));
        let expected = [
            "0 s",
            "1.5 s",
            "100 s",
            "12.345679 ms",
            "34.1 ns",
            "1 ms",
            "2.5e-16 s",
        ];
        assert_eq!(found, expected);
    }
}
