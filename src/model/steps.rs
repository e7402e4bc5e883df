//! How finely a model is integrated: tolerance and cap, as its scene says or as the band of a record asks for.

use super::{Model, RowModel};
use crate::scene::{Method, RelativeTolerance, Row};

/// Highest band of a record that needs no more than [`Fineness::IN_BAND`] \[Hz\]: that of 51.2 kHz.
const BAND: f64 = 20.5e3;
/// Slip speed below which friction fades so fast that it needs the exact tolerance \[m/s\]: at 0.01 and 0.001 a wheel bearing errs
/// in the band by 2.1 and 9.4 %.
const FADES: f64 = 0.05;

/// Tolerance and step cap of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fineness {
    /// Relative tolerance.
    pub rtol: f64,
    /// Step cap over that for accelerations at all frequencies.
    pub cap_factor: f64,
    /// Whether the record's band chose them.
    pub by_band: bool,
}

impl Fineness {
    /// What accelerations filtered to [`BAND`] need: nine scenes err by at most 0.9 % in the median of 1 ms from ten developed
    /// states (by 1.4 % with a cap of 1.4), 40 of 42 spalled bearings by chance by at most 1 %, the others by 1.04 and 1.20 %; of the
    /// statistics of 0.3 s from eight starts one line of a pair is apart.
    const IN_BAND: Self = Self {
        rtol: 1e-4,
        cap_factor: 1.2,
        by_band: true,
    };

    /// What a scene says, for accelerations at all frequencies.
    pub fn of(rtol: RelativeTolerance) -> Self {
        Self {
            rtol: rtol.or_exact(),
            cap_factor: 1.0,
            by_band: false,
        }
    }
}

impl Model {
    /// The model as a record needs it whose signals are filtered to a band \[Hz\]; not filtered ones need the exact tolerance.
    pub(crate) fn recorded_to(mut self, band: Option<f64>) -> Self {
        let is_open = self.scene.solver.rtol == RelativeTolerance::Band;
        if is_open && band.is_some_and(|band| band <= BAND) && self.bears_coarse_steps() {
            self.fineness = Fineness::IN_BAND;
        }
        self
    }

    /// Whether errors of coarse steps stay beyond the band: not where nothing damps contacts, and not without friction or with one
    /// that fades within the speeds that the tolerance leaves open.
    fn bears_coarse_steps(&self) -> bool {
        let is_damped = |row: &RowModel| row.pairs.iter().any(|pair| pair.law.damping.rate() > 0.0);
        let fades_slowly = |(row, of): (&RowModel, &Row)| {
            let slip_speed = self.scene.friction_of(of).slip_speed();
            let has_films = row.pairs.iter().all(|pair| pair.law.film.is_some());
            has_films || slip_speed.is_some_and(|speed| speed >= FADES)
        };
        self.scene.solver.method == Method::Adams
            && self.rows.iter().all(is_damped)
            && self.rows.iter().zip(&self.scene.rows).all(fades_slowly)
    }
}
