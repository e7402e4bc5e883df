//! How fast forces change a motion, for the largest stable step of a method.

use crate::model::{Dof, Model};

/// Rate at which contact damping ends the motion of a ball between its races \[1/s\], under the load of the heaviest ball
/// ([`crate::model::Scales::load`]): Hunt and Crossley's 3/2 α_d N on either side.
pub(crate) fn damping(model: &Model) -> f64 {
    let rates = model.rows.iter().map(|row| {
        let rate: f64 = row.pairs.iter().map(|pair| pair.law.damping.rate()).sum();
        model.scales.load * rate / model.bodies[row.first_body()].mass[Dof::X]
    });
    rates.fold(0.0, f64::max)
}
