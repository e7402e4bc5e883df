//! Traction laws: −μ F u⃗ / √(u² + v_s²) of an element that slides at u⃗ (equations 8 and 9, regularised).
//!
//! To add one: a file with its equation here, a variant below, a variant of `scene::Friction`.

mod coulomb;
mod curve;
mod film;
mod stribeck;

use crate::contact::dual::Dual;
use crate::contact::laws::film::FilmNow;
use crate::scene::Friction;
use crate::simd::Number;
use coulomb::Coulomb;
use curve::TractionCurve;
use film::FilmTraction;
use stribeck::Stribeck;

/// Quantities of an element that a traction law can read.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Sliding<T> {
    /// Square of the slip speed u \[m²/s²\].
    pub squared: T,
    /// Contact point from the ball's centre along the ring's radius \[m\].
    pub arm: T,
    /// How the surfaces roll there.
    pub rolling: Rolling<T>,
    /// Elastic force per length \[N/m\].
    pub load: T,
    /// Penetration \[m\].
    pub depth: T,
    /// Approach speed v_n \[m/s\].
    pub approach: T,
    /// Radii of ball and groove \[m\].
    pub radii: [T; 2],
    /// Friction coefficient of a film at large slip, and half of the slip speed at which traction bends \[m/s\]; 0 without.
    pub friction: T,
    pub bend: T,
}

/// Speeds of ball's and ring's surface along the race, in a frame that goes round with the ball's centre: each is
/// linear in the arm.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::contact) struct Rolling<T> {
    /// θ̇_b − ω_n and θ̇_r − ω_n, where ω_n is how fast the ball's centre goes round the ring's \[rad/s\].
    pub turns: [T; 2],
    /// Distance of both centres in the plane \[m\].
    pub d: T,
}

impl<T: Number> Rolling<T> {
    /// Rolling from the distance of both centres, the velocity of the ball's against the ring's along ẑ × n, and both angular
    /// speeds.
    #[inline(always)]
    pub fn new(d: T, across: T, [ball, ring]: [T; 2]) -> Self {
        let orbit = across / d;
        Self {
            turns: [ball - orbit, ring - orbit],
            d,
        }
    }

    /// Surfaces that do not move.
    #[inline(always)]
    pub fn resting(d: T) -> Self {
        Self {
            turns: [d.same(0.0); 2],
            d,
        }
    }
}

impl<T: Number> Sliding<T> {
    /// Surface speeds of ball and ring along the race \[m/s\]: their difference is the slip along it, their mean the
    /// entrainment speed.
    // Part of what a law may read, whether or not one of those here does.
    #[allow(dead_code)]
    #[inline(always)]
    pub fn surfaces(&self) -> [T; 2] {
        let Rolling { turns, d } = self.rolling;
        [turns[0] * self.arm, turns[1] * (self.arm + d)]
    }
}

/// A traction law.
///
/// ```
/// use ballrace::{contact::Traction, scene::Friction};
/// let law = Traction::new(&Friction::Coulomb { coefficient: 0.1, slip_speed: 3.0 }).unwrap();
/// // At u = 4, v_s = 3: 0.1 / √(16 + 9).
/// assert!((law.at(4.0) - 0.02).abs() < 1e-17);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Traction {
    /// A constant coefficient.
    Coulomb(Coulomb),
    /// Friction that falls from rest to sliding.
    Stribeck(Stribeck),
    /// A measured curve of a lubricated contact.
    TractionCurve(TractionCurve),
    /// Traction of an oil film.
    Film(FilmTraction),
}

impl Traction {
    /// The law of a scene; none without friction.
    pub fn new(friction: &Friction) -> Option<Self> {
        match *friction {
            Friction::None => None,
            Friction::Coulomb {
                coefficient,
                slip_speed,
            } => Some(Self::Coulomb(Coulomb {
                coefficient,
                slip_speed,
            })),
            Friction::Stribeck {
                static_coefficient,
                kinetic_coefficient,
                stribeck_speed,
                slip_speed,
            } => Some(Self::Stribeck(Stribeck {
                static_coefficient,
                kinetic_coefficient,
                decay_speed: stribeck_speed,
                slip_speed,
            })),
            Friction::Traction {
                a,
                b,
                c,
                d,
                slip_speed,
            } => Some(Self::TractionCurve(TractionCurve {
                a,
                b,
                c,
                d,
                slip_speed,
            })),
        }
    }

    /// The traction of a film.
    pub(crate) fn of_film(now: &FilmNow) -> Self {
        Self::Film(FilmTraction {
            coefficient: now.friction(),
            bend: now.bend(1.0),
        })
    }

    /// Whether the law asks how the surfaces roll: only then it is found out.
    pub(in crate::contact) fn reads_rolling(&self) -> bool {
        match self {
            Self::Coulomb(_) | Self::Stribeck(_) | Self::TractionCurve(_) | Self::Film(_) => false,
        }
    }

    /// Slip speed below which friction bends \[m/s\]: 1/√(u² + width²) is what is steep in it.
    pub(in crate::contact) fn width(&self) -> f64 {
        match self {
            Self::Coulomb(law) => law.slip_speed,
            Self::Stribeck(law) => law.slip_speed,
            Self::TractionCurve(law) => law.slip_speed,
            Self::Film(law) => law.bend,
        }
    }

    /// Friction coefficient of a film at large slip; 0 of other laws, which have their own.
    fn limit(&self) -> f64 {
        match self {
            Self::Film(law) => law.coefficient,
            Self::Coulomb(_) | Self::Stribeck(_) | Self::TractionCurve(_) => 0.0,
        }
    }

    /// Whether the traction is that of an oil film, which has a width of its own in every contact.
    pub(in crate::contact) fn is_film(&self) -> bool {
        matches!(self, Self::Film(_))
    }

    /// Friction over normal force and slip velocity, φ = μ(u)/√(u² + v_s²) \[s/m\].
    #[inline(always)]
    pub(in crate::contact) fn factor<T: Number>(&self, element: &Sliding<T>) -> T {
        match self {
            Self::Coulomb(law) => law.factor(element),
            Self::Stribeck(law) => apart(element, |element| law.factor(element)),
            Self::TractionCurve(law) => apart(element, |element| law.factor(element)),
            Self::Film(_) => FilmTraction::factor(element),
        }
    }

    /// φ, and φ'(u)/u: the part of its slope that −φ u⃗ has along u⃗ u⃗ᵀ. All but the slip counts as constant.
    #[inline(always)]
    pub(in crate::contact) fn factor_and_bend<T: Number>(&self, element: &Sliding<T>) -> (T, T) {
        match self {
            Self::Coulomb(law) => law.factor_and_bend(element),
            Self::Film(_) => FilmTraction::factor_and_bend(element),
            Self::Stribeck(_) | Self::TractionCurve(_) => {
                let apart = *element;
                self.differentiated(&apart)
            }
        }
    }

    /// The same from the law itself, by the square of the slip.
    #[inline(never)]
    fn differentiated<T: Number>(&self, element: &Sliding<T>) -> (T, T) {
        let of = Dual::constant;
        let Rolling { turns, d } = element.rolling;
        let factor = self.factor(&Sliding::<Dual<T, 1>> {
            squared: Dual::variable(element.squared, 0),
            rolling: Rolling {
                turns: [of(turns[0]), of(turns[1])],
                d: of(d),
            },
            arm: of(element.arm),
            load: of(element.load),
            depth: of(element.depth),
            approach: of(element.approach),
            radii: [of(element.radii[0]), of(element.radii[1])],
            friction: of(element.friction),
            bend: of(element.bend),
        });
        // By u over u is twice that by u².
        (factor.value, factor.slopes[0] * 2.0)
    }

    /// φ at a slip speed u \[m/s\] of surfaces that do not roll \[s/m\].
    pub fn at(&self, slip: f64) -> f64 {
        self.factor(&Sliding {
            squared: slip * slip,
            arm: 0.0,
            rolling: Rolling::resting(1.0),
            load: 0.0,
            depth: 0.0,
            approach: 0.0,
            radii: [1.0; 2],
            friction: self.limit(),
            bend: self.width(),
        })
    }
}

/// A law with exponentials, which have no vector instructions: apart, so that they do not spoil the loop of the others.
#[inline(always)]
fn apart<T: Number>(element: &Sliding<T>, law: impl Fn(&Sliding<T>) -> T) -> T {
    #[inline(never)]
    fn call<T>(element: &Sliding<T>, law: impl Fn(&Sliding<T>) -> T) -> T {
        law(element)
    }
    // A copy, so that the element itself need not be in memory where Coulomb's law reads it.
    let copy = *element;
    call(&copy, law)
}

/// 1/√(u² + v_s²): what makes friction smooth at rest.
#[inline(always)]
fn smoothed<T: Number>(squared: T, slip_speed: f64) -> T {
    (squared.same(1.0) / (squared + slip_speed * slip_speed)).sqrt()
}

#[cfg(test)]
pub(in crate::contact) mod tests {
    use super::*;

    /// Truth: the kinematics of a ball that rolls between a ring at rest and its own centre going round: with ω_b and ω_r
    /// seen from the turning line of centres, both surfaces run alike, and none of them slips.
    #[test]
    fn surfaces_of_a_rolling_ball_run_alike() {
        // A ball of 5 mm on an outer race of 40 mm: θ̇_b = −ω (R_race − R)/R at an orbit of ω.
        let (d, arm, orbit) = (35e-3, 5e-3, 100.0);
        let spin = -orbit * d / arm;
        let rolling = Rolling::new(d, orbit * d, [spin, 0.0]);
        let sliding = Sliding {
            squared: 0.0,
            arm,
            rolling,
            load: 0.0,
            depth: 0.0,
            approach: 0.0,
            radii: [arm, 5.2e-3],
            friction: 0.0,
            bend: 0.0,
        };
        let [ball, ring] = sliding.surfaces();
        assert!((ball - ring).abs() < 1e-12, "{ball} {ring}");
        assert!((ring + orbit * (d + arm)).abs() < 1e-12, "{ring}");
    }

    /// A traction of every law.
    pub(in crate::contact) fn laws() -> Vec<Traction> {
        let frictions = [
            Friction::Coulomb {
                coefficient: 0.1,
                slip_speed: 0.1,
            },
            Friction::Stribeck {
                static_coefficient: 0.12,
                kinetic_coefficient: 0.05,
                stribeck_speed: 0.3,
                slip_speed: 0.05,
            },
            Friction::Traction {
                a: -0.02,
                b: 0.1,
                c: 1.5,
                d: 0.03,
                slip_speed: 0.02,
            },
        ];
        let film = FilmTraction {
            coefficient: 0.05,
            bend: 2e-3,
        };
        let dry = frictions.iter().filter_map(Traction::new);
        dry.chain([Traction::Film(film)]).collect()
    }

    /// Analytic: the slope of every law, φ'(u)/u, against central differences.
    #[test]
    fn laws_differentiate_themselves() {
        for law in laws() {
            for u in [0.02, 0.3, 2.0] {
                let sliding = Sliding {
                    squared: u * u,
                    arm: 0.0,
                    rolling: Rolling::resting(1.0),
                    load: 0.0,
                    depth: 0.0,
                    approach: 0.0,
                    radii: [1.0; 2],
                    friction: law.limit(),
                    bend: law.width(),
                };
                let (factor, bend) = law.factor_and_bend(&sliding);
                let (same, also) = law.differentiated(&sliding);
                assert!((factor / same - 1.0).abs() < 1e-15 && (bend / also - 1.0).abs() < 1e-14);
                let step = 1e-5 * u;
                let slope = (law.at(u + step) - law.at(u - step)) / (2.0 * step);
                assert_eq!(factor, law.at(u));
                let off = (bend * u - slope).abs() / (factor / u);
                assert!(off < 1e-8, "{law:?} at {u}: {off:e}");
            }
        }
    }
}
