//! Friction of a slice: −μ(u) F u⃗ / √(u² + v_s²) (equations 8 and 9, regularised).

use crate::scene;
use crate::simd::Lanes;

/// Coefficient of friction over slip speed, and the speed below which it fades.
///
/// ```
/// use ballrace::{contact::Friction, scene};
/// let law = Friction::new(&scene::Friction::Coulomb { coefficient: 0.1, slip_speed: 3.0 }).unwrap();
/// // At u = 4, v_s = 3: 0.1 / √(16 + 9).
/// assert!((law.factor(4.0) - 0.02).abs() < 1e-17);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    coefficient: Coefficient,
    slip_speed: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Coefficient {
    Constant(f64),
    Stribeck { fixed: f64, moving: f64, speed: f64 },
    Traction { a: f64, b: f64, c: f64, d: f64 },
}

impl Friction {
    /// The law of a scene; none without friction.
    pub fn new(friction: &scene::Friction) -> Option<Self> {
        let (coefficient, slip_speed) = match *friction {
            scene::Friction::None => return None,
            scene::Friction::Coulomb {
                coefficient,
                slip_speed,
            } => (Coefficient::Constant(coefficient), slip_speed),
            scene::Friction::Stribeck {
                static_coefficient: fixed,
                kinetic_coefficient: moving,
                stribeck_speed: speed,
                slip_speed,
            } => (
                Coefficient::Stribeck {
                    fixed,
                    moving,
                    speed,
                },
                slip_speed,
            ),
            scene::Friction::Traction {
                a,
                b,
                c,
                d,
                slip_speed,
            } => (Coefficient::Traction { a, b, c, d }, slip_speed),
        };
        Some(Self {
            coefficient,
            slip_speed,
        })
    }

    /// μ(u) / √(u² + v_s²) at a slip speed u \[m/s\]: friction over normal force and slip velocity \[s/m\].
    #[inline]
    pub fn factor(&self, slip: f64) -> f64 {
        let mu = match self.coefficient {
            Coefficient::Constant(mu) => mu,
            Coefficient::Stribeck {
                fixed,
                moving,
                speed,
            } => moving + (fixed - moving) * (-(slip / speed).powi(2)).exp(),
            Coefficient::Traction { a, b, c, d } => (a + b * slip) * (-c * slip).exp() + d,
        };
        mu / (slip * slip + self.slip_speed * self.slip_speed).sqrt()
    }

    /// The same of eight squares of slip speeds.
    // Into the vector loop that uses it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    pub(super) fn factors(&self, squares: Lanes) -> Lanes {
        if let Coefficient::Constant(mu) = self.coefficient {
            return Lanes::all(mu) / (squares + self.slip_speed * self.slip_speed).sqrt();
        }
        self.one_by_one(squares)
    }

    /// Exponentials have no vector instructions; apart, so that they do not spoil the loop of the others.
    #[inline(never)]
    fn one_by_one(&self, squares: Lanes) -> Lanes {
        squares.map(|square| self.factor(square.sqrt()))
    }

    /// φ = [`Friction::factor`] and φ'(u)/u, the part of its slope that −φ u⃗ has along u⃗ u⃗ᵀ, at the square of a
    /// slip speed.
    #[inline]
    pub fn factor_and_bend(&self, square: f64) -> (f64, f64) {
        let root = 1.0 / (square + self.slip_speed * self.slip_speed).sqrt();
        // μ and μ'(u)/u.
        let (mu, bend) = match self.coefficient {
            Coefficient::Constant(mu) => (mu, 0.0),
            Coefficient::Stribeck {
                fixed,
                moving,
                speed,
            } => {
                let excess = (fixed - moving) * (-square / (speed * speed)).exp();
                (moving + excess, -2.0 * excess / (speed * speed))
            }
            Coefficient::Traction { a, b, c, d } => {
                let slip = square.sqrt();
                let (line, fade) = (a + b * slip, (-c * slip).exp());
                // A corner at rest, where u⃗ u⃗ᵀ vanishes faster.
                let bend = if slip > 0.0 {
                    (b - c * line) * fade / slip
                } else {
                    0.0
                };
                (line * fade + d, bend)
            }
        };
        (mu * root, (bend - mu * root * root) * root)
    }

    /// The same of eight squares of slip speeds.
    // Into the vector loop that uses it.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    pub(super) fn factors_and_bends(&self, squares: Lanes) -> (Lanes, Lanes) {
        if let Coefficient::Constant(mu) = self.coefficient {
            let square = Lanes::all(1.0) / (squares + self.slip_speed * self.slip_speed);
            let factor = square.sqrt() * mu;
            return (factor, -(factor * square));
        }
        self.both_one_by_one(squares)
    }

    /// As [`Friction::one_by_one`].
    #[inline(never)]
    fn both_one_by_one(&self, squares: Lanes) -> (Lanes, Lanes) {
        let mut bends = Lanes::ZERO;
        let factors = Lanes::from_fn(|lane| {
            let (factor, bend) = self.factor_and_bend(squares[lane]);
            bends[lane] = bend;
            factor
        });
        (factors, bends)
    }
}
