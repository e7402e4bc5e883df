//! Constants of the film between a row's balls and one race.

use super::conjunction::{Conjunction, Groups, LubricatedRace};
use super::damping::{DampingNow, FilmDamping};
use super::now::FilmNow;
use super::oil::Oil;
use super::rolling::{FilmRolling, RollingNow};
use super::speed::SpeedPowers;
use super::thickness::Thickness;
use super::traction::TractionNow;

/// Reference for which a film is computed; it stays during a run (12.7).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference {
    /// Load of a contact Q_ref, above 0 \[N\].
    pub load: f64,
    /// Speed of the rings against each other Ω_ref, not 0 \[rad/s\].
    pub speed: f64,
    /// half_ref: half-length of the zone at that load by the scene's own law \[m\].
    pub half_length: f64,
    /// δ_ref: approach at that load by the scene's own law \[m\].
    pub approach: f64,
}

/// Effects of oil, each of which may be left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
// Four effects that are there or not, each by itself.
#[allow(clippy::struct_excessive_bools)]
pub struct Effects {
    /// The film separates the surfaces.
    pub film: bool,
    /// The film damps the approach.
    pub damping: bool,
    /// The film limits and softens friction.
    pub traction: bool,
    /// Rolling is resisted.
    pub rolling: bool,
}

impl Effects {
    /// All effects.
    pub const ALL: Self = Self {
        film: true,
        damping: true,
        traction: true,
        rolling: true,
    };
}

/// The numbers by which the validity of the formulas is judged (12.15).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// 1/ε = a/b; formulas were fitted from 1 to 12.
    pub ellipticity: f64,
    /// Moes' L; film damping was fitted from 2 to 20.
    pub moes: f64,
    /// Pressure p_0 at the reference load, usual up to 3 GPa \[Pa\].
    pub pressure: f64,
}

/// Constants of the film between a row's balls and one race.
///
/// ```
/// use ballrace::contact::film::{Effects, Film, LubricatedRace, Oil, Reference};
/// use ballrace::scene::Lubricant;
/// let oil = Oil::new(&Lubricant::named("vg68", 328.15))?;
/// // The outer race of a 6205 under 250 N a ball, at 1797 1/min.
/// let race = LubricatedRace {
///     sigma: 1.0, ball_diameter: 7.94e-3, pitch_diameter: 39.04e-3, groove_radius: 0.525 * 7.94e-3,
///     contact_angle: 0.0, reduced_modulus: 206e9 / 0.91,
/// };
/// let at = Reference { load: 250.0, speed: 188.18, half_length: 7.367e-4, approach: 4.655e-6 };
/// let film = Film::new(&oil, &race, at, Effects::ALL);
/// assert!((film.at(1.0).thickness() - 0.2308e-6).abs() < 1e-10);
/// # Ok::<(), ballrace::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    oil: Oil,
    pub(super) reference: Reference,
    effects: Effects,
    pub(super) conjunction: Conjunction,
    pub(super) groups: Groups,
    thickness: Thickness,
    pub(super) damping: FilmDamping,
    rolling: FilmRolling,
}

impl Film {
    /// The film of an oil on a race, computed for a reference, with the effects that are asked for.
    pub fn new(oil: &Oil, race: &LubricatedRace, reference: Reference, effects: Effects) -> Self {
        let conjunction = Conjunction::new(race, reference.load, reference.speed);
        let groups = conjunction.groups(oil);
        let thickness = Thickness::new(&conjunction, &groups, oil.layer);
        let whole = SpeedPowers::new(1.0).two_thirds;
        let film = thickness.starved(thickness.flooded(whole));
        Self {
            oil: *oil,
            reference,
            effects,
            conjunction,
            groups,
            thickness,
            damping: FilmDamping::new(
                &conjunction,
                &groups,
                reference.approach,
                film,
                oil.damping_frequency,
            ),
            rolling: FilmRolling::new(&conjunction, &groups, oil.hysteresis),
        }
    }

    /// The film at the rings' speed against each other over the reference speed, w = (θ̇_i − θ̇_o)/Ω_ref.
    pub fn at(&self, w: f64) -> FilmNow {
        let powers = SpeedPowers::new(w);
        let entrainment = powers.ratio * self.conjunction.entrainment;
        let flooded = self.thickness.flooded(powers.two_thirds);
        let film = self.thickness.starved(flooded);
        let gap = film / self.reference.approach;
        let supply = self.oil.layer.map(|layer| layer / (0.8 * flooded));
        let Effects {
            damping, rolling, ..
        } = self.effects;
        FilmNow {
            film,
            layer: if self.effects.film { film } else { 0.0 },
            roughness: self.oil.roughness,
            entrainment,
            traction: TractionNow::new(&self.oil, &self.conjunction, entrainment, film),
            damping: if damping {
                self.damping.at(self.reference.load, powers.ratio, gap)
            } else {
                DampingNow::NONE
            },
            rolling: if rolling {
                self.rolling.at(&powers, entrainment, gap, supply)
            } else {
                RollingNow::NONE
            },
        }
    }

    /// The reference for which the film was computed.
    pub fn reference(&self) -> Reference {
        self.reference
    }

    /// The effects of the oil.
    pub fn effects(&self) -> Effects {
        self.effects
    }

    /// Limits by which the validity of the formulas is judged.
    pub fn limits(&self) -> Limits {
        Limits {
            ellipticity: 1.0 / self.conjunction.axis_ratio,
            moes: self.groups.moes(),
            pressure: self.conjunction.pressure,
        }
    }
}
