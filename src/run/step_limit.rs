//! The largest step of each method in a scene, by its stability and its accuracy.
//!
//! The contacts' highest frequency ω bounds ωh. In an oscillation a method makes an error of phase or amplitude of c (ωh)^p in each
//! radian, which adds up as long as the contacts vibrate: for the few milliseconds over which anything can be predicted, or until
//! damping has ended it. So undamped scenes need smaller steps. Where friction and damping are faster than a step, the error
//! estimate shortens it.

use crate::forces::{damping, squeeze};
use crate::model::Model;
use crate::scene::Method;

/// Bounds of the steps that a method bears.
struct MethodBounds {
    /// Largest ωh.
    oscillation: f64,
    /// c and p: an undamped oscillation is wrong by c (ωh)^p a radian.
    lag: (f64, f64),
    /// Number of times over which it adds up, of the time in which damping ends it.
    rings: f64,
    /// Largest γh of a decay at a rate γ that no matrix takes: of squeeze films.
    decay: f64,
}

/// Error of the fastest oscillation when it has ended \[rad\]; those that matter are slower by a half and more.
const LAG: f64 = 0.09;
/// Longest vibration that is considered \[s\]: beyond it a trajectory cannot be predicted.
const HORIZON: f64 = 3e-3;
/// How much longer the vibration of the least loaded relevant ball lasts than that of the most loaded one.
const LIGHTEST: f64 = 60.0;

/// Measured over 3 ms against Dormand–Prince at rtol 1e-10 with a tenth of its step, on the presets and random scenes
/// (`tests/accuracy/method_defaults.rs`).
fn bounds(method: Method) -> MethodBounds {
    match method {
        // Dormand–Prince is stable to 1 on the imaginary axis and further when damped. On the defective wheel bearing,
        // 6 ms with an impact, the outer ring's acceleration is wrong by 0.06 to 0.3 % at 1 for any rtol from 1e-3 to
        // 1e-6; without the cap by 6 % at rtol 1e-3.
        Method::DormandPrince | Method::Verner => MethodBounds {
            oscillation: 1.0,
            lag: (0.0, 1.0),
            rings: LIGHTEST,
            decay: 2.0,
        },
        // With contact stiffness in its matrix stable to 0.88 with half a percent of damping, to 1.5 with five. Undamped an
        // oscillation grows by 5.3e-3 (ωh)⁴ a radian, which any damping of note takes away; at 0.9 by 5.5e-3, half as much again
        // (`benches/stability_region.py`).
        Method::Adams => MethodBounds {
            oscillation: 0.9,
            lag: (5.3e-3, 4.0),
            rings: 10.0,
            // Films of 15 to 310 N s/m (6205, 608): accelerations waver by 0.3 % at 0.34 and by 20 to 30 % at 0.5.
            decay: 0.35,
        },
    }
}

/// The largest step \[s\] by which a method is stable and accurate to a few percent, or as accurate as the record's band asks for.
pub(crate) fn largest(method: Method, model: &Model) -> f64 {
    // Eight steps at least on the width of a contact, over which its texture is averaged, or of a pit.
    of_contacts(method, model).min(model.shortest_pass())
}

/// The same of the contacts' frequency and their films alone, where nothing is recorded that passes them.
pub(crate) fn of_contacts(method: Method, model: &Model) -> f64 {
    let frequency = model.scales.frequency;
    let cap = model.fineness.cap_factor * at_damping(method, frequency, damping(model));
    cap.min(bounds(method).decay / squeeze::fastest(model))
}

/// The cap on steps that a scene asks for \[s\]: infinite where it has none.
pub(crate) fn cap(model: &Model) -> f64 {
    let solver = &model.scene.solver;
    if solver.frequency_cap {
        largest(solver.method, model)
    } else {
        f64::INFINITY
    }
}

fn at_damping(method: Method, frequency: f64, damping: f64) -> f64 {
    let MethodBounds {
        oscillation,
        lag: (factor, power),
        rings,
        decay: _,
    } = bounds(method);
    let rings = HORIZON.min(rings / damping) * frequency;
    let accurate = (LAG / (factor * rings)).powf(1.0 / power);
    oscillation.min(accurate) / frequency
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile;
    use crate::scene::{SqueezeFilm, presets};

    fn share(method: Method, damping: f64) -> f64 {
        3e5 * at_damping(method, 3e5, damping)
    }

    #[test]
    fn pairs_of_high_order_follow_the_frequency_alone() {
        for method in [Method::DormandPrince, Method::Verner] {
            assert_eq!(share(method, 0.0), 1.0);
        }
    }

    /// Truth: a flooded film ends a ball's motion faster than steps by the contacts' frequency follow; a starved one does not.
    #[test]
    fn fast_films_shorten_steps() {
        let with = |damping: f64| {
            let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
            scene.contact.squeeze = Some(SqueezeFilm {
                damping,
                ..SqueezeFilm::default()
            });
            compile(&scene).unwrap()
        };
        let cap = |damping: f64| of_contacts(Method::Adams, &with(damping));
        assert_eq!(cap(15.0), cap(0.0));
        let flooded = with(310.0);
        let share = cap(310.0) * squeeze::fastest(&flooded);
        assert!((share - 0.35).abs() < 1e-12, "{share}");
        assert!(cap(310.0) < 0.6 * cap(0.0));
    }

    #[test]
    fn others_need_less_where_nothing_is_damped() {
        let of = |damping| share(Method::Adams, damping);
        assert!((of(0.3 * 3e5) - 0.8448).abs() < 1e-3);
        assert!((of(0.0) - 0.3706).abs() < 1e-3);
    }
}
