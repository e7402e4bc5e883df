//! Elastic laws: load per length of an element by its penetration.
//!
//! To add one: a file with its equation here, a variant below, a variant of `scene::NormalLaw`.

pub mod elliptic;
pub mod hertz;
pub mod iso16281;
mod power;

use super::Cut;
use crate::scene::NormalLaw;
use crate::simd::Number;
use hertz::Hertz;
use iso16281::Iso16281;

/// An elastic law as loops over elements are compiled for it, so that no choice of a law stands in them.
pub(in crate::contact) trait ElasticLaw: Copy {
    /// Whether elements lie on the common tangent and press along the common normal ([`Cut::CommonTangent`]); else they
    /// are slices of the ball's surface.
    const FLAT: bool;

    /// Load per length \[N/m\] at a penetration ≥ 0 \[m\], with a strength of this law.
    fn load<T: Number, const FMA: bool>(strength: T, depth: T) -> T;
}

/// Something that is compiled for every elastic law.
pub(in crate::contact) trait ForLaw {
    /// Runs the task by a law. Wants `#[inline(always)]`.
    fn run<L: ElasticLaw>(self);
}

/// An elastic law.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Elastic {
    /// The paper's law.
    Iso16281(Iso16281),
    /// Hertz's law.
    Hertz(Hertz),
}

impl Elastic {
    /// The law of a scene for balls of a diameter \[m\], and Hertz's for their contact with the race.
    pub(crate) fn new(law: &NormalLaw, ball_diameter: f64, hertz: Hertz) -> Self {
        match *law {
            NormalLaw::Iso16281 {
                constant,
                length_ratio,
            } => Self::Iso16281(Iso16281::new(constant, length_ratio, ball_diameter)),
            NormalLaw::Hertz => Self::Hertz(hertz),
        }
    }

    /// Power of the penetration that the force goes with.
    pub fn exponent(&self) -> f64 {
        match self {
            Self::Iso16281(_) => iso16281::EXPONENT,
            Self::Hertz(_) => hertz::EXPONENT,
        }
    }

    /// The law's own constant, which balls of one row may have in different sizes; its unit is the law's.
    pub(crate) fn strength(&self) -> f64 {
        match self {
            Self::Iso16281(law) => law.density(),
            Self::Hertz(law) => law.slope,
        }
    }

    /// The cut that the law wants of the ball.
    pub fn cut(&self) -> Cut {
        match self {
            Self::Iso16281(_) => Cut::BallSurface,
            Self::Hertz(law) => Cut::CommonTangent {
                curvature: law.curvature,
            },
        }
    }

    /// Approach of ball and race under a load ≥ 0 \[N\], where the law has it in closed form \[m\].
    pub(crate) fn approach(&self, load: f64) -> Option<f64> {
        match self {
            Self::Iso16281(_) => None,
            Self::Hertz(law) => Some(law.approach(load)),
        }
    }

    /// The law's name.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Iso16281(_) => "ISO law",
            Self::Hertz(_) => "Hertz law",
        }
    }

    /// Runs the task, which is compiled for every law, by this one.
    #[inline(always)]
    pub(in crate::contact) fn choose(&self, task: impl ForLaw) {
        match self {
            Self::Iso16281(_) => task.run::<Iso16281>(),
            Self::Hertz(_) => task.run::<Hertz>(),
        }
    }

    /// Load per length of this law \[N/m\] at a penetration ≥ 0 \[m\].
    fn load(&self, depth: f64) -> f64 {
        match self {
            Self::Iso16281(law) => Iso16281::load::<f64, false>(law.density(), depth),
            Self::Hertz(law) => Hertz::load::<f64, false>(law.slope, depth),
        }
    }

    /// Force of an element \[N\] at a penetration and for a length \[m\]; 0 where it is clear.
    #[inline]
    pub fn force(&self, depth: f64, length: f64) -> f64 {
        // Most elements of a defect are clear of the ball: no power is taken for them.
        if depth <= 0.0 {
            return 0.0;
        }
        self.load(depth) * length
    }

    /// Elastic energy of an element \[J\]; its derivative is the force.
    pub fn energy(&self, depth: f64, length: f64) -> f64 {
        if depth <= 0.0 {
            return 0.0;
        }
        let per_length = match self {
            Self::Iso16281(law) => law.energy(depth),
            Self::Hertz(law) => law.energy(depth),
        };
        per_length * length
    }
}

#[cfg(test)]
pub(in crate::contact) mod tests {
    use super::*;
    use crate::scene::Material;

    /// Every law, for balls of a diameter on the inner (σ = −1) or the outer race (σ = 1) of 60 mm \[m\].
    pub(in crate::contact) fn laws(sigma: f64, diameter: f64) -> Vec<Elastic> {
        let steel = Material::default();
        let hertz = Hertz::new(sigma, diameter, 60e-3, 0.52, 0.3, &steel, &steel);
        let laws = NormalLaw::all();
        laws.iter()
            .map(|law| Elastic::new(law, diameter, hertz))
            .collect()
    }

    /// Truth: what loops are compiled for. A scene, its contacts and their loops say the same of where elements lie.
    #[test]
    fn elements_lie_where_a_law_says() {
        struct Flat<'a>(&'a mut bool);
        impl ForLaw for Flat<'_> {
            fn run<L: ElasticLaw>(self) {
                *self.0 = L::FLAT;
            }
        }
        for (law, elastic) in NormalLaw::all().iter().zip(laws(1.0, 12e-3)) {
            let mut flat = !law.is_flat();
            elastic.choose(Flat(&mut flat));
            let by_cut = matches!(elastic.cut(), Cut::CommonTangent { .. });
            assert_eq!([law.is_flat(), by_cut], [flat; 2], "{law:?}");
        }
    }

    /// Truth: the law's energy, differentiated numerically, and its exponent, by the force at twice the penetration.
    #[test]
    fn a_law_agrees_with_itself() {
        for elastic in laws(-1.0, 12e-3) {
            let (depth, step, length) = (8e-6, 1e-10, 1e-3);
            let energy = |s: f64| elastic.energy(s, length);
            let slope = (energy(depth + step) - energy(depth - step)) / (2.0 * step);
            let force = elastic.force(depth, length);
            assert!(
                (slope / force - 1.0).abs() < 1e-6,
                "{}: energy",
                elastic.name()
            );
            let doubled = elastic.force(2.0 * depth, length) / force;
            let power = elastic.exponent();
            let is_as_said = (doubled.log2() / power - 1.0).abs() < 1e-9;
            assert!(
                is_as_said,
                "{}: {} for {power}",
                elastic.name(),
                doubled.log2()
            );
        }
    }
}
