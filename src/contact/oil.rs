//! The effect of an oil film on a whole contact, and rolling resistance, which acts in addition to its nodes
//! ([*Film*](crate::equations#film)).

use super::laws::film::{FilmEffect, Oiled};
use super::slip::Moves;
use super::{V2, turned};
use crate::simd::Number;

/// Rolling resistance of a contact: of its pressure ahead and behind, so that force and moment are conserved (12.27).
#[derive(Debug, Clone, Copy)]
pub(crate) struct RollingResistance<T> {
    /// Force on the ball along t = ẑ × n \[N\].
    pub force: T,
    /// Moment on the ball about its centre \[N m\]; the ring gets what is left of the force's about its own.
    pub moment: T,
    /// Entrainment speed u \[m/s\].
    pub entrainment: T,
}

impl<T: Number> RollingResistance<T> {
    /// The oil's force on a ball at a distance d \[m\] from its ring's centre, with a lever R cos α' \[m\].
    #[inline(always)]
    pub fn new(rolling: T, moves: &Moves<T>, sigma: T, d: T, lever: T) -> Self {
        // (12.13) with r_p = d + σ R cos α', ω_n − θ̇_r = σ slide/d and θ̇_b − θ̇_r = σ spin.
        let orbit = moves.slide / d;
        let ball = (moves.spin - orbit) * lever;
        let ring = -(orbit * (lever + d * sigma));
        let entrainment = (ball + ring) * 0.5;
        let resistance = rolling * entrainment;
        Self {
            force: resistance * (lever * (sigma * 2.0) + d) / d,
            moment: -(resistance * lever * sigma),
            entrainment,
        }
    }
}

/// Force of the oil in a contact, as a sink receives it.
#[derive(Debug, Clone, Copy)]
pub struct OilForce {
    pub(crate) oil: FilmEffect<f64>,
    /// Cube root of the contact's load over the reference load.
    pub load_measure: f64,
    /// Thickness of the film \[m\].
    pub film: f64,
    /// The same over the roughness.
    pub lambda: f64,
    /// Power that rolling resistance takes out in the film and in the steel \[W\].
    pub power: [f64; 2],
    /// Force on the ball in the plane \[N\], and its moment about the ball's centre \[N m\].
    pub(crate) force: V2,
    pub(crate) moment: f64,
    /// Vector from the ring's centre to the ball's, and R cos α' \[m\].
    pub(crate) apart: V2,
    pub(crate) lever: f64,
}

impl OilForce {
    pub(in crate::contact) fn new(
        oiled: &Oiled,
        r: f64,
        moves: &Moves<f64>,
        sigma: f64,
        apart: V2,
        lever: f64,
    ) -> Self {
        let d = apart.norm();
        let resistance = RollingResistance::new(moves.oil.rolling, moves, sigma, d, lever);
        let squared = 2.0 * resistance.entrainment * resistance.entrainment;
        Self {
            oil: moves.oil,
            load_measure: r,
            film: oiled.now.thickness(),
            lambda: oiled.now.lambda(),
            power: oiled.now.rolling_parts(r).map(|part| part * squared),
            force: turned(apart / d) * resistance.force,
            moment: resistance.moment,
            apart,
            lever,
        }
    }
}
