//! Fault frequencies of a row as it runs: at the contact angles under its load, with the slip of its cage.
//!
//! Where balls roll, the load alone moves the frequencies from the nominal ones: thrust opens the contact angle, which raises BPFO and
//! lowers BPFI. Slip makes the cage slower than rolling would. At high speed the contact angles of both races differ and balls spin about an
//! axis of their own. Of a scene, speeds are those at which friction at both races, the oil's drag and gyroscopic moments balance; of a
//! run they are measured.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::base::error::{Error, Result};
use crate::scene::{Drive, RowGeometry, Scene, Spin};
use crate::signals::Signals;
use crate::signals::kinematics::{RowKinematics, rolling};
use crate::statics::{RaceControl, compile};

/// Frequencies of a row of balls at the speeds of its rings.
///
/// All are rates, from 0 up, whichever way rings, cage and balls turn: lines of a spectrum have no sign.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct FaultFrequencies {
    /// Relative turns of the rings, those of the shaft where the outer ring stands \[Hz\].
    pub shaft: f64,
    /// Cage in space \[Hz\].
    pub ftf: f64,
    /// Ball passes on the outer race \[Hz\].
    pub bpfo: f64,
    /// Ball passes on the inner race \[Hz\].
    pub bpfi: f64,
    /// Spin of a ball in the cage \[Hz\]; a defect on a ball meets the races at twice that.
    pub bsf: f64,
    /// Contact angle under load at rest, the mean of both races \[rad\].
    pub contact_angle: f64,
    /// Turns of the inner ring in space \[Hz\].
    pub inner: f64,
    /// Turns of the outer ring in space \[Hz\].
    pub outer: f64,
    /// How much slower the cage is than by rolling at this angle, as a share of that; negative where it is faster, absent where it was
    /// not measured.
    pub slip: Option<f64>,
}

impl FaultFrequencies {
    /// The frequencies of balls that roll at a row's contact angle, at speeds of outer and inner ring with their signs \[Hz\].
    pub fn rolling(row: &RowGeometry, [outer, inner]: [f64; 2]) -> Self {
        let (orders, shaft) = (row.orders(), inner - outer);
        Self::of(
            outer + orders.ftf * shaft,
            orders.bsf * shaft,
            row.ball_count,
            [outer, inner],
            row.contact_angle,
        )
    }

    /// The rates of a cage and of balls in it, with their signs as they turn in space and in the cage \[Hz\].
    ///
    /// f_c = f_o + ½ (1 − γ)(f_i − f_o), f_BPFO = Z |f_c − f_o|, f_BPFI = Z |f_i − f_c| where balls roll (Harris & Kotzalas, Essential
    /// Concepts of Bearing Technology, both rings turning).
    fn of(cage: f64, spin: f64, balls: f64, [outer, inner]: [f64; 2], angle: f64) -> Self {
        Self {
            shaft: (inner - outer).abs(),
            ftf: cage.abs(),
            bpfo: balls * (cage - outer).abs(),
            bpfi: balls * (inner - cage).abs(),
            bsf: spin.abs(),
            contact_angle: angle,
            inner: inner.abs(),
            outer: outer.abs(),
            slip: None,
        }
    }

    /// The same with what a run measured, scaled to some speeds of the rings; of balls that spin about z only BSF is that of rolling.
    fn measured(
        self,
        did: &RowKinematics,
        balls: f64,
        free: bool,
        [outer, inner]: [f64; 2],
    ) -> Self {
        let scale = (inner - outer) / (did.inner - did.outer);
        let cage = outer + scale * (did.cage - did.outer);
        let spin = did.spin.filter(|_| free).map(|spin| scale.abs() * spin);
        // Seen from the outer ring, over what it would be by rolling; both go the way of the inner ring.
        let advance = balls * (cage - outer) / self.bpfo.copysign(inner - outer);
        Self {
            slip: Some(1.0 - advance),
            ..Self::of(
                cage,
                spin.unwrap_or(self.bsf),
                balls,
                [outer, inner],
                self.contact_angle,
            )
        }
    }
}

/// The fault frequencies of a row of a scene under its load, at the constant speeds of its rings.
///
/// Speeds of cage and balls are those at which friction at both races, the oil's drag and gyroscopic moments balance; without friction,
/// those of balls that roll at the contact angles of both races. A row that nothing loads rolls at its nominal angle. Defects do not count.
/// Orders alone, without a load, are [`RowGeometry::orders`].
///
/// ```
/// use ballrace::{fault_frequencies, scene::presets};
/// let radial = fault_frequencies(&presets::deep_groove_6205(500.0, 0.0, 1797.0), 0)?;
/// let thrust = fault_frequencies(&presets::deep_groove_6205(500.0, 500.0, 1797.0), 0)?;
/// assert!(thrust.bpfo > radial.bpfo && thrust.bpfi < radial.bpfi && thrust.contact_angle > 0.1);
/// # Ok::<(), ballrace::Error>(())
/// ```
///
/// # Errors
/// [`Error::Scene`] for a scene that is not usable, or where a ring's speed is not given, changes, or is that of the other ring;
/// [`Error::Argument`] for a row that it has not; [`Error::Equilibrium`] where the load cannot be carried.
pub fn fault_frequencies(scene: &Scene, row: usize) -> Result<FaultFrequencies> {
    check_row(scene, row)?;
    let speeds = steady_speeds(scene)?;
    frequencies_at(scene, row, speeds, RaceControl::Friction, None)
}

/// The fault frequencies of a row of a run: mean speeds that it measured over a turn and more, and the slip of its cage; of a shorter
/// run, those of its scene.
///
/// # Errors
/// As [`fault_frequencies()`].
pub fn run_fault_frequencies(signals: &Signals, row: usize) -> Result<FaultFrequencies> {
    check_row(&signals.scene, row)?;
    let did = signals.provenance.kinematics.iter();
    let did = did.clone().find(|did| did.row == row);
    let speeds = match did {
        Some(did) => [did.outer, did.inner],
        None => steady_speeds(&signals.scene)?,
    };
    frequencies_at(&signals.scene, row, speeds, RaceControl::Friction, did)
}

/// The frequencies of a row under its load at speeds of outer and inner ring with their signs \[Hz\], with what a run measured.
///
/// # Errors
/// As [`fault_frequencies()`].
pub fn frequencies_at(
    scene: &Scene,
    row: usize,
    [outer, inner]: [f64; 2],
    control: RaceControl,
    did: Option<&RowKinematics>,
) -> Result<FaultFrequencies> {
    let mut driven = scene.clone();
    driven.drive = Drive::Speed((TAU * inner).into());
    let stands = scene.outer_speed.is_none() && outer == 0.0;
    driven.outer_speed = (!stands).then(|| (TAU * outer).into());
    let geometry = scene.rows[row].geometry();
    let is_free = scene.spin == Some(Spin::Free);
    let rolling = rolling(&compile(&driven)?, control)?;
    let found = match rolling[row] {
        None => FaultFrequencies::rolling(&geometry, [outer, inner]),
        Some(rolls) => {
            let own = if is_free { 1.0 } else { rolls.angle.cos() };
            FaultFrequencies::of(
                rolls.cage,
                own * rolls.spin,
                geometry.ball_count,
                [outer, inner],
                rolls.angle,
            )
        }
    };
    Ok(did.map_or(found, |did| {
        found.measured(did, geometry.ball_count, is_free, [outer, inner])
    }))
}

fn check_row(scene: &Scene, row: usize) -> Result<()> {
    if row < scene.rows.len() {
        return Ok(());
    }
    let allowed = format!("below {}, the number of rows", scene.rows.len());
    Err(Error::argument("row", row, allowed))
}

/// Speeds of outer and inner ring that keep them \[Hz\].
fn steady_speeds(scene: &Scene) -> Result<[f64; 2]> {
    let refuse = |found: &str| {
        let allowed = "constant speeds of the rings, which are not the same";
        Err(Error::scene("drive", found, allowed))
    };
    if !scene.turns_steadily() {
        return refuse("no constant speed");
    }
    let speeds = scene.ring_speeds(0.0).map(|speed| speed / TAU);
    if speeds[0] == speeds[1] {
        return refuse("no speed of the inner ring against the outer");
    }
    Ok(speeds)
}
