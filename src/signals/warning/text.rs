//! Texts of warnings: what was found, and what to do.

use std::fmt::{Display, Formatter, Result};

use super::Warning;
use crate::model::Placed;
use crate::signals::Accuracy;
use crate::signals::kinematics::RowKinematics;
use crate::simd::Distrust;

impl Display for Warning {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Accelerations {
                residual,
                stiff_share,
                rtol,
            } => accelerations(f, *residual, *stiff_share, *rtol),
            Self::AccuracyMissed(of) => accuracy_missed(f, of),
            Self::Shoulders { contacts, steps } => shoulders(f, *contacts, *steps),
            Self::Instructions(distrust) => instructions(f, distrust),
            Self::SamplingRate { fs, defect, line } => sampling_rate(f, *fs, defect, *line),
            Self::Doubtful(doubt) => doubt.fmt(f),
            Self::Untouched {
                defect,
                passes,
                axial_offset,
                contact_offset,
                placed,
            } => match contact_offset {
                Some(place) => beside(f, defect, *passes, [*place, *axial_offset], *placed),
                None => unloaded(f, defect, *passes),
            },
            Self::Unpassed { defect, duration } => unpassed(f, defect, *duration),
            Self::FreeOrbit { slowed } => free_orbit(f, *slowed),
            Self::Kinematics(row) => kinematics(f, row),
        }
    }
}

fn accelerations(f: &mut Formatter<'_>, residual: f64, stiff_share: f64, rtol: f64) -> Result {
    write!(
        f,
        "accelerations are uncertain by about {:.0} %: they differ that much from the derivative of the \
         velocities; {:.0} % of the steps stood at the stability limit (rtol = {rtol:e}). Use a smaller \
         rtol, keep solver.frequency_cap on, or raise friction's slip_speed",
        100.0 * residual,
        100.0 * stiff_share
    )
}

fn accuracy_missed(f: &mut Formatter<'_>, of: &Accuracy) -> Result {
    write!(
        f,
        "accuracy = {} was asked for, but pilot runs still differ by {:.2} % at rtol = {:.0e}",
        of.requested,
        100.0 * of.integration_error,
        of.rtol
    )?;
    if let Some(error) = of.node_error {
        let nodes = of.nodes[0].max(of.nodes[1]);
        write!(f, " and by {:.2} % at {nodes} nodes", 100.0 * error)?;
    }
    let why = if of.integration_error > of.requested {
        "this motion is chaotic: it amplifies the least difference, so that no step size makes its samples reproducible"
    } else {
        "contacts that an edge cuts need more nodes, or this motion is chaotic and amplifies the error that is left"
    };
    write!(
        f,
        ": {why}. Compare features, with their standard errors, not samples"
    )
}

fn shoulders(f: &mut Formatter<'_>, contacts: usize, steps: usize) -> Result {
    write!(
        f,
        "contacts rode over a shoulder or past the pole of ball and groove {contacts} times in {steps} steps: the part \
         beyond it carries nothing, and the pressure at the edge is not modelled. Lower the load, raise shoulders where \
         there are any, or look at the truncated contacts"
    )
}

fn instructions(f: &mut Formatter<'_>, distrust: &Distrust) -> Result {
    let Distrust {
        instructions,
        primitive,
        used,
    } = distrust;
    write!(
        f,
        "this processor offers the instruction set {instructions}, but its `{primitive}` gives wrong \
         results; the run used {used}. Please report it, with the processor's name"
    )
}

fn sampling_rate(f: &mut Formatter<'_>, fs: f64, defect: &str, line: f64) -> Result {
    write!(
        f,
        "fs = {fs} Hz shows nothing of defects.{defect}: its line, at {line:.1} Hz, lies above fs/2. Use an \
         fs well above {:.0} Hz",
        2.0 * line
    )
}

/// A defect that lies where no contact runs: the axial places of contacts and of its middle \[m\].
fn beside(
    f: &mut Formatter<'_>,
    defect: &str,
    passes: usize,
    places: [f64; 2],
    placed: Placed,
) -> Result {
    let [contact, middle] = places.map(|place| 1e3 * place);
    write!(
        f,
        "defect {defect:?} was never touched: balls passed it {passes} times, but contacts ran at \
         {contact:.3} mm and its middle lies at {middle:.3} mm "
    )?;
    match placed {
        Placed::Given => write!(
            f,
            "(axial_offset); give \"contact\" to place it where they run at equilibrium, or a greater length"
        ),
        Placed::Contact => write!(
            f,
            "(axial_offset = \"contact\": where they run at equilibrium, from which this run differs); give axial_offset \
             in metres, {:.2e}, or a greater length",
            1e-3 * contact
        ),
        Placed::Nominal => write!(
            f,
            "(axial_offset = \"contact\": by the nominal contact angle, since no contact is loaded at \
             equilibrium); give axial_offset in metres, {:.2e}, or a greater length",
            1e-3 * contact
        ),
    }
}

/// A defect that balls passed without load.
fn unloaded(f: &mut Formatter<'_>, defect: &str, passes: usize) -> Result {
    write!(
        f,
        "defect {defect:?} was never touched: balls passed it {passes} times, but none was loaded there; \
         move it by its angle, or change the loads"
    )
}

fn unpassed(f: &mut Formatter<'_>, defect: &str, duration: f64) -> Result {
    write!(
        f,
        "no ball passed defect {defect:?} in {duration} s: the signals show nothing of it; simulate for \
         longer, or move it by its angle"
    )
}

fn free_orbit(f: &mut Formatter<'_>, slowed: f64) -> Result {
    write!(
        f,
        "nothing drives the balls along their orbit, since contacts have no friction: they lost {:.1} % of its rate, \
         and fault frequencies moved with them. Give the scene a friction",
        100.0 * slowed
    )
}

fn kinematics(f: &mut Formatter<'_>, of: &RowKinematics) -> Result {
    let ahead = of.ahead().unwrap_or(0.0);
    write!(
        f,
        "row {}: its balls orbited at {:.3} Hz, {:.1} % {} than the {:.3} Hz predicted from the scene at rest, and fault \
         frequencies moved with them: balls slip, run fast under combined loads, or fall behind where they are unloaded. Take \
         fault_frequencies of the signals, as features do, not of the scene",
        of.row,
        of.cage,
        100.0 * ahead.abs(),
        if ahead > 0.0 { "faster" } else { "slower" },
        of.rolling.unwrap_or(f64::NAN)
    )
}
