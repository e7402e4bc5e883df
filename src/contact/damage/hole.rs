//! Pits smaller than their contact: elliptic holes over which surfaces bulge, and share load ([*Defects*](crate::equations#defects)).
//!
//! The surfaces bulge into a hole that has lost the pressure p_h by u, a crack's opening, and the contact's elastic energy falls by
//! half of p_h u. With the Hertz contact of the race as it was without the hole,
//!
//! ```text
//! V(δ, x₀, y₀) = Γ ∫ √(1 − ξ²) (δ − q x² − κ y²)₊ dA over ξ < 1,   Γ = c_m p²/(δ E* Ê),   U = U₀ e^{−V/U₀}
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | c_x, c_y, c_m | half-axes across the race and along rolling, the smaller of them | m |
//! | x₀, y₀ | middle of the pit from that of the contact | m |
//! | q, κ | δ/a², δ/b² of Hertz's ellipse, the same under all loads | 1/m |
//! | p²/δ | of its largest pressure, likewise | Pa²/m |
//! | E* | 1/Σ((1 − ν²)/E) of both materials | Pa |
//! | Ê | complete elliptic integral E of 1 − (c_m/c_max)²; π/2 of a circle | |
//!
//! V is a sum over strips across the race, closed along them; its derivatives are those of the sum itself, so that energy is kept whatever
//! its error. Source: I. N. Sneddon's penny-shaped crack; a solver by boundary elements agrees within 10 % of the lost load at the pit's middle up to
//! c = 0.84 a and V/U₀ = 1.8.

use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, PI};

use crate::contact::elliptic;
use crate::contact::hertz::Hertz;

/// Strips.
const STRIPS: usize = 8;
/// Nodes and weights of Gauss and Legendre for the positive half of −1 … 1.
pub(super) const HALF: [(f64, f64); STRIPS / 2] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Hertz's contact as a pit needs it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct PittedContact {
    /// K \[N/m^{3/2}\].
    pub stiffness: f64,
    /// q and κ \[1/m\].
    pub curvatures: [f64; 2],
    /// p²/(δ E*) \[Pa/m\].
    pub pressure: f64,
    /// E* \[Pa\].
    pub modulus: f64,
}

impl PittedContact {
    /// The pitted contact of Hertz's contact; E* by the approach of an ellipse of known axes.
    pub fn of(hertz: &Hertz) -> Self {
        let (a, b) = (hertz.half_length, hertz.half_width);
        let (integral, _) = elliptic::complete(1.0 - (b / a).powi(2));
        let root = hertz.stiffness.powf(2.0 / 3.0);
        let modulus = 3.0 * integral * root / (2.0 * PI * a);
        let pressure = hertz.pressure(1.0);
        Self {
            stiffness: hertz.stiffness,
            curvatures: [a, b].map(|half| 1.0 / (root * half * half)),
            pressure: pressure * pressure * root / modulus,
            modulus,
        }
    }
}

/// An energy of a contact and its derivatives by δ, x₀ and y₀ \[J\], \[N\].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(in crate::contact) struct EnergyAt {
    pub energy: f64,
    pub by_depth: f64,
    pub by_x: f64,
    pub by_y: f64,
}

/// Effect of a damage on the energy of a contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(in crate::contact) struct Released {
    /// V.
    pub lost: EnergyAt,
    /// R, of what stands above the surface.
    pub gained: EnergyAt,
}

/// Scale of a contact's elastic forces by damages smaller than it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::contact) struct Unloading {
    /// Share of the forces, g and what is gained.
    pub share: f64,
    /// Share of the energy, e^{−X} and what is gained.
    pub energy: f64,
    /// e^{−X}.
    pub left: f64,
    /// X.
    pub exponent: f64,
}

impl Default for Unloading {
    fn default() -> Self {
        Self {
            share: 1.0,
            energy: 1.0,
            left: 1.0,
            exponent: 0.0,
        }
    }
}

impl PittedContact {
    /// Approach at which Hertz's contact has so much energy \[J\], and its force there.
    pub(in crate::contact) fn pressed(&self, energy: f64) -> (f64, f64) {
        let depth = (2.5 * energy / self.stiffness).powf(0.4);
        (depth, 2.5 * energy / depth)
    }
}

impl Unloading {
    /// The scale of a contact that has so much energy without its pits, and what these release (15.4).
    pub fn of(contact: &PittedContact, energy: f64, all: &[Released]) -> Self {
        let (_, force) = contact.pressed(energy);
        let sum = |of: fn(&Released) -> f64| all.iter().map(of).sum::<f64>();
        let exponent = sum(|of| of.lost.energy) / energy;
        let lost = sum(|of| of.lost.by_depth) / force;
        let left = (-exponent).exp();
        Self {
            share: left * (1.0 + exponent - lost) + sum(|of| of.gained.by_depth) / force,
            energy: left + sum(|of| of.gained.energy) / energy,
            left,
            exponent,
        }
    }
}

/// Half-axes c_x and c_y \[m\] and c_m/Ê of an elliptic hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::contact) struct Hole {
    half: [f64; 2],
    opening: f64,
}

/// Ends of a strip's integral: θ, sin θ and cos θ of both.
struct StripEnds([(f64, f64, f64); 2]);

impl StripEnds {
    fn rise(&self, of: impl Fn(f64, f64, f64) -> f64) -> f64 {
        let [low, high] = self.0;
        of(high.0, high.1, high.2) - of(low.0, low.1, low.2)
    }
}

impl Hole {
    /// A hole with half-axes across the race and along rolling.
    pub fn new(half: [f64; 2]) -> Self {
        let (least, most) = (half[0].min(half[1]), half[0].max(half[1]));
        let (_, integral) = elliptic::complete(1.0 - (least / most).powi(2));
        let opening = least / integral;
        Self { half, opening }
    }

    /// Energy that closes the hole if it is so deep in its middle, half an ellipsoid \[m\]: the surfaces bulge down to its floor and no further.
    pub fn filled(&self, of: &PittedContact, depth: f64) -> f64 {
        let area = 2.0 * PI / 3.0 * self.half[0] * self.half[1];
        area * depth * depth * of.modulus / (4.0 * self.opening)
    }

    /// Pressure under which the surfaces bulge so far into it \[Pa\].
    pub fn pressure(&self, of: &PittedContact, depth: f64) -> f64 {
        depth * of.modulus / (2.0 * self.opening)
    }

    /// c_x.
    pub fn across(&self) -> f64 {
        self.half[0]
    }

    /// V at an approach and a place.
    pub fn released(&self, of: &PittedContact, depth: f64, [x0, y0]: [f64; 2]) -> EnergyAt {
        let [c_x, c_y] = self.half;
        let reach = (depth / of.curvatures[0]).sqrt();
        let (low, high) = ((x0 - c_x).max(-reach), (x0 + c_x).min(reach));
        // Not so for a depth that is no number, either.
        if low.partial_cmp(&high) != Some(Ordering::Less) {
            return EnergyAt::default();
        }
        // How the ends move with δ and with x₀.
        let grows = 0.5 * reach / depth;
        let low_by = if low == -reach {
            [-grows, 0.0]
        } else {
            [0.0, 1.0]
        };
        let high_by = if high == reach {
            [grows, 0.0]
        } else {
            [0.0, 1.0]
        };
        let (middle, half) = (f64::midpoint(low, high), 0.5 * (high - low));
        let mut sum = EnergyAt::default();
        for (node, weight) in HALF.into_iter().flat_map(|(x, w)| [(-x, w), (x, w)]) {
            let (sin, cos) = (FRAC_PI_2 * node).sin_cos();
            let weight = FRAC_PI_2 * weight * cos;
            let strip = self.strip(of, depth, [middle + half * sin, x0], y0);
            let [by_depth, by_x] = [0, 1].map(|i| {
                let (ends, width) = (
                    0.5 * (low_by[i] + high_by[i]),
                    0.5 * (high_by[i] - low_by[i]),
                );
                half * strip.by_place * (ends + sin * width) + strip.value * width
            });
            sum.energy += weight * half * strip.value;
            sum.by_depth += weight * (half * strip.by_depth + by_depth);
            sum.by_x += weight * (half * strip.by_middle + by_x);
            sum.by_y += weight * half * strip.by_y;
        }
        let scale = self.opening * of.pressure * c_y;
        EnergyAt {
            energy: scale * sum.energy,
            by_depth: scale * sum.by_depth,
            by_x: scale * sum.by_x,
            by_y: scale * sum.by_y,
        }
    }

    /// The integral along the strip at x, over c_y.
    fn strip(&self, of: &PittedContact, depth: f64, [x, x0]: [f64; 2], y0: f64) -> Strip {
        let ([c_x, c_y], [q, kappa]) = (self.half, of.curvatures);
        let t = (x - x0) / c_x;
        let rho2 = (1.0 - t * t).max(0.0);
        let a = c_y * rho2.sqrt();
        let s = depth - q * x * x;
        if s <= 0.0 || a <= 0.0 {
            return Strip::default();
        }
        let y = (s / kappa).sqrt();
        let ends = StripEnds([-y, y].map(|end| {
            let sin = ((end - y0) / a).clamp(-1.0, 1.0);
            (sin.asin(), sin, (1.0 - sin * sin).sqrt())
        }));
        let i_0 = ends.rise(|angle, sin, cos| 0.5 * (angle + sin * cos));
        let i_1 = ends.rise(|_, _, cos| -cos.powi(3) / 3.0);
        let i_2 =
            ends.rise(|angle, sin, cos| 0.125 * (angle - sin * cos * (1.0 - 2.0 * sin * sin)));
        let height = s - kappa * y0 * y0;
        let b = height * i_0 - 2.0 * kappa * y0 * a * i_1 - kappa * a * a * i_2;
        let p = height * ends.rise(|angle, _, _| angle)
            + 2.0 * kappa * y0 * a * ends.rise(|_, _, cos| cos)
            - 0.5 * kappa * a * a * ends.rise(|angle, sin, cos| angle - sin * cos);
        Strip {
            value: rho2 * b,
            by_depth: rho2 * i_0,
            by_place: -2.0 * q * x * rho2 * i_0 - p * t / c_x,
            by_middle: p * t / c_x,
            by_y: -2.0 * kappa * rho2 * (y0 * i_0 + a * i_1),
        }
    }
}

/// A strip's part of V and its derivatives by δ, by its place x, by x₀ and by y₀.
#[derive(Debug, Clone, Copy, Default)]
struct Strip {
    value: f64,
    by_depth: f64,
    by_place: f64,
    by_middle: f64,
    by_y: f64,
}

/// The truth is [*Defects*](crate::equations#defects), and differences of V.
#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Material;

    fn race(sigma: f64) -> PittedContact {
        let steel = Material::default();
        let conformity = if sigma > 0.0 { 0.525 } else { 0.515 };
        let hertz = Hertz::new(sigma, 7.94e-3, 39.04e-3, conformity, 0.0, &steel, &steel);
        PittedContact::of(&hertz)
    }

    fn lost(lost: EnergyAt) -> Released {
        Released {
            lost,
            ..Released::default()
        }
    }

    /// Force of a pitted contact at an approach \[N\], and X.
    fn pressed(of: &PittedContact, hole: &Hole, depth: f64, at: [f64; 2]) -> (f64, f64) {
        let found = Unloading::of(
            of,
            0.4 * of.stiffness * depth.powf(2.5),
            &[lost(hole.released(of, depth, at))],
        );
        (of.stiffness * depth.powf(1.5) * found.share, found.exponent)
    }

    #[test]
    fn numbers_are_those_of_the_model() {
        let of = race(1.0);
        let near = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 1e-5;
        let depth = (250.0 / of.stiffness).powf(2.0 / 3.0);
        let round = Hole::new([0.0889e-3; 2]);
        let found = round.released(&of, depth, [0.0; 2]);
        assert!(
            near(found.energy, 1.427_697e-5) && near(found.by_depth, 3.489_553),
            "{found:?}"
        );
        let (force, x) = pressed(&of, &round, depth, [0.0; 2]);
        assert!(
            near(force, 246.500_642) && near(x, 0.030_670_3),
            "{force} {x}"
        );
        let (long, at) = (Hole::new([0.2e-3, 0.12e-3]), [0.3e-3, 0.08e-3]);
        let found = long.released(&of, 3e-6, at);
        assert!(
            near(found.energy, 1.292_262e-5) && near(found.by_depth, 8.570_962),
            "{found:?}"
        );
        assert!(
            near(found.by_x, -0.042_293_44) && near(found.by_y, -0.205_473_4),
            "{found:?}"
        );
        let (force, x) = pressed(&of, &long, 3e-6, at);
        assert!(
            near(force, 121.033_420) && near(x, 0.083_257_6),
            "{force} {x}"
        );
    }

    /// [*Defects*](crate::equations#defects): loss \[N\] at fixed approach, printed to four digits; on the outer race beside 3.53, 25.29,
    /// 55.5, 89.1 and 149.5 N of a solver by boundary elements.
    #[test]
    fn losses_are_those_of_the_table() {
        for (sigma, load, c, y, loss) in [
            (1.0, 250.0, 0.0889, 0.0, 3.499),
            (1.0, 250.0, 0.0889, 0.1, 2.186),
            (1.0, 250.0, 0.1778, 0.0, 22.83),
            (1.0, 250.0, 0.1778, 0.2, 4.68),
            (1.0, 250.0, 0.2667, 0.1, 45.5),
            (1.0, 250.0, 0.3556, 0.2, 63.0),
            (1.0, 250.0, 0.508, 0.0, 147.0),
            (1.0, 136.0, 0.508, 0.0, 98.3),
            (1.0, 88.0, 0.1778, 0.0, 16.62),
            (1.0, 20.0, 0.2667, 0.0, 14.39),
            (1.0, 5.0, 0.1778, 0.0, 3.767),
            (1.0, 707.0, 0.2667, 0.0, 73.5),
            (-1.0, 250.0, 0.0889, 0.05, 3.444),
            (-1.0, 136.0, 0.3556, 0.0, 63.8),
            (-1.0, 20.0, 0.1778, 0.0, 8.66),
        ] {
            let of = race(sigma);
            let depth = f64::powf(load / of.stiffness, 2.0 / 3.0);
            let (force, _) = pressed(&of, &Hole::new([1e-3 * c; 2]), depth, [0.0, 1e-3 * y]);
            let off = (load - force) / loss - 1.0;
            assert!(off.abs() < 0.01, "{sigma} {load} {c} {y}: {}", load - force);
        }
    }

    /// Analytic: ∝ c³ wherever a small circle lies within.
    #[test]
    fn small_pits_lose_by_their_volume() {
        let of = race(1.0);
        let depth = (250.0 / of.stiffness).powf(2.0 / 3.0);
        let lost = |c: f64, at| Hole::new([c; 2]).released(&of, depth, at).by_depth;
        for at in [[0.0, 0.0], [0.4e-3, 0.05e-3]] {
            let ratio = lost(20e-6, at) / lost(10e-6, at);
            assert!((ratio - 8.0).abs() < 1e-6, "{ratio}");
        }
        assert_eq!(
            Hole::new([0.1e-3; 2]).released(&of, depth, [0.9e-3, 0.0]),
            EnergyAt::default()
        );
    }

    /// Analytic: the force has no jump along a pass, and as the contact is pressed none but where its chord's end passes the pit's: 2e-3 of
    /// itself there ([*Defects*](crate::equations#defects)).
    #[test]
    fn forces_do_not_jump() {
        let of = race(1.0);
        let (hole, depth) = (
            Hole::new([0.1778e-3; 2]),
            (20.0 / of.stiffness).powf(2.0 / 3.0),
        );
        let largest = |count: u32| {
            let force = |i: u32| {
                let y = 1e-3 * (f64::from(i) / f64::from(count) - 0.5);
                pressed(&of, &hole, depth, [0.1e-3, y]).0
            };
            (0..count)
                .map(|i| (force(i + 1) - force(i)).abs())
                .fold(0.0, f64::max)
        };
        let ratio = largest(8000) / largest(4000);
        assert!((ratio - 0.5).abs() < 0.02, "{ratio}");
        let mut worst: f64 = 0.0;
        let mut depth = 0.1e-6;
        while depth < 8e-6 {
            let next = depth * (1.0 + 1e-4);
            let [before, after] = [depth, next].map(|at| pressed(&of, &hole, at, [0.4e-3, 0.0]).0);
            let smooth = 1.5e-4 * before;
            worst = worst.max(((after - before).abs() - smooth) / before);
            depth = next;
        }
        assert!(worst < 2e-3, "{worst}");
    }
}
