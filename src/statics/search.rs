//! Line search: how far to go along a direction.

/// Trials before the best place so far has to do.
const TRIALS: usize = 40;

/// Goes along a direction until the force along it has come down without turning round, or by the whole
/// step. `force` is its value at the start, above 0; `at(t)` gives it at a share t of the step with what was
/// computed there, nothing where nothing can be computed.
///
/// Forces of contacts derive from a potential, so this goes downhill however far the gap before the contact
/// and however stiff the contact behind it; a test on the residual's size does neither.
pub(super) fn search<T>(force: f64, mut at: impl FnMut(f64) -> Option<(f64, T)>) -> Option<T> {
    let (mut low, mut high) = ((0.0, force), (1.0, f64::NEG_INFINITY));
    let mut t = 1.0;
    let mut found = None;
    for _ in 0..TRIALS {
        let now = at(t);
        let value = now.as_ref().map_or(f64::NEG_INFINITY, |(value, _)| *value);
        if value >= -0.5 * force {
            found = now.map(|(_, what)| what);
            if value <= 0.5 * force || t == 1.0 {
                break;
            }
            low = (t, value);
        } else {
            high = (t, value);
        }
        // Regula falsi kept inside the middle four fifths, so that it cannot creep.
        let share = if high.1.is_finite() {
            low.1 / (low.1 - high.1)
        } else {
            0.5
        };
        t = low.0 + (high.0 - low.0) * share.clamp(0.1, 0.9);
    }
    found
}
