//! What the literature tests share.

/// Shows a number beside the published one and holds it to a relative tolerance. `tests/validation.py` reads
/// the line into the validation page.
pub fn meets(case: &str, published: f64, ours: f64, tolerance: f64) {
    let deviation = ours / published - 1.0;
    println!(
        "| {case} | {published} | {ours:.6} | {:+.3} % | {} % |",
        100.0 * deviation,
        100.0 * tolerance
    );
    assert!(
        deviation.abs() <= tolerance,
        "{case}: published {published}, ours {ours}, more than {tolerance} apart"
    );
}
