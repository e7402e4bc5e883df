//! The largest step of each method in a scene, by its stability and its accuracy.
//!
//! *Oscillation.* The contacts' highest frequency ω bounds ωh. A method of low order turns or shrinks an oscillation by
//! c (ωh)^p a radian too much, which adds up as long as the contacts ring: for the few milliseconds over which anything
//! can be predicted, or until damping has ended it. So undamped scenes need smaller steps.
//!
//! *Decay.* Friction and damping make motions decay at a rate λ. An error estimate keeps adaptive methods within what
//! they bear of λh; fixed steps have none, and are kept there by λ under the scene's own loads ([`Rates::fastest`]).

use crate::forces::Rates;
use crate::model::Model;
use crate::scene::Method;

/// What a method bears.
struct Bounds {
    /// Largest ωh.
    oscillation: f64,
    /// c and p: an undamped oscillation is wrong by c (ωh)^p a radian.
    lag: (f64, f64),
    /// Over how many times the time in which damping ends it that adds up.
    rings: f64,
    /// Largest λh.
    decay: f64,
}

/// Error of the fastest oscillation when it has rung out \[rad\]; those that matter are slower by a half and more.
/// With 0.13 Verlet is off by up to 5.8 % in three of 133 scenes of `tests/accuracy/method_defaults.rs`.
const LAG: f64 = 0.09;
/// Longest vibration that is considered \[s\]: beyond it a trajectory cannot be predicted.
const HORIZON: f64 = 3e-3;
/// How much longer the vibration of the least loaded relevant ball lasts than that of the most loaded one.
const LIGHTEST: f64 = 60.0;

/// Measured over 3 ms against Dormand–Prince at rtol 1e-10 with a tenth of its step, on the presets and random scenes
/// (`tests/accuracy/method_defaults.rs`).
fn bounds(method: Method) -> Bounds {
    let pair = Bounds {
        oscillation: 1.0,
        lag: (0.0, 1.0),
        rings: LIGHTEST,
        decay: f64::INFINITY,
    };
    match method {
        // Dormand–Prince is stable to 1 on the imaginary axis and further when damped. On the faulted wheel bearing,
        // 6 ms with an impact, the outer ring's acceleration is wrong by 0.06 to 0.3 % at 1 for any rtol from 1e-3 to
        // 1e-6; without the cap by 6 % at rtol 1e-3.
        Method::DormandPrince | Method::Tsitouras | Method::Verner | Method::Auto => pair,
        // |R(iz)| = 1 − z⁴/24.
        Method::BogackiShampine => Bounds {
            lag: (1.0 / 24.0, 3.0),
            ..pair
        },
        // With contact stiffness in its matrix stable to 0.88 with half a percent of damping, to 1.5 with five. Undamped an oscillation
        // grows by 5.3e-3 (ωh)⁴ a radian, which any damping of note takes away.
        Method::Adams => Bounds {
            oscillation: 0.9,
            lag: (5.3e-3, 4.0),
            rings: 10.0,
            ..pair
        },
        // Of fourth order like the classical method, and as exact.
        Method::ImplicitFriction => Bounds {
            lag: (1.0 / 120.0, 4.0),
            ..pair
        },
        // arg R(iz) = z − z⁵/120; stable to 2.83 and 2.78, here with room for loads above those estimated.
        Method::RungeKutta4 => Bounds {
            oscillation: 0.5,
            lag: (1.0 / 120.0, 4.0),
            decay: 2.0,
            ..pair
        },
        // Frequency ω(1 + z²/24); stable to 2, but with predicted velocities to 1 only where they decay.
        Method::VelocityVerlet => Bounds {
            oscillation: 0.25,
            lag: (1.0 / 24.0, 2.0),
            decay: 0.8,
            ..pair
        },
    }
}

/// The largest step \[s\] by which a method is stable and accurate to a few percent.
pub(crate) fn largest(method: Method, model: &Model) -> f64 {
    at_rates(method, model.scales.frequency, &Rates::of(model))
}

fn at_rates(method: Method, frequency: f64, rates: &Rates) -> f64 {
    let Bounds {
        oscillation,
        lag: (factor, power),
        rings,
        decay,
    } = bounds(method);
    let rings = HORIZON.min(rings / rates.damping) * frequency;
    let accurate = (LAG / (factor * rings)).powf(1.0 / power);
    (oscillation.min(accurate) / frequency).min(decay / rates.fastest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn largest(method: Method, damping: f64, fastest: f64) -> f64 {
        at_rates(method, 3e5, &Rates { damping, fastest })
    }

    #[test]
    fn pairs_of_high_order_follow_the_frequency_alone() {
        for method in [Method::DormandPrince, Method::Tsitouras, Method::Verner] {
            assert_eq!(largest(method, 0.0, 1e9), 1.0 / 3e5);
        }
    }

    #[test]
    fn low_orders_want_less_where_nothing_is_damped() {
        for (method, damped, undamped) in [
            (Method::BogackiShampine, 0.2210, 0.1339),
            (Method::ImplicitFriction, 0.4821, 0.3310),
            (Method::RungeKutta4, 0.4821, 0.3310),
            (Method::VelocityVerlet, 0.1039, 0.0490),
        ] {
            let share = |damping| 3e5 * largest(method, damping, 0.0);
            assert!((share(0.3 * 3e5) - damped).abs() < 1e-3, "{method:?}");
            assert!((share(0.0) - undamped).abs() < 1e-3, "{method:?}");
        }
    }

    #[test]
    fn fixed_steps_follow_friction() {
        let most = |method, rate| largest(method, 1e5, rate);
        assert_eq!(most(Method::RungeKutta4, 1e7), 2e-7);
        assert_eq!(most(Method::VelocityVerlet, 1e7), 0.8e-7);
        let adaptive = Method::BogackiShampine;
        assert_eq!(most(adaptive, 1e7), most(adaptive, 0.0));
    }
}
