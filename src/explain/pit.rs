//! Loads that pits and dents take of the most loaded contacts that meet them.

use std::fmt;

use serde::Serialize;

use crate::base::error::Result;
use crate::base::quantities::number;
use crate::model::HeaviestContact;
use crate::scene::{Defect, Scene, Surface};
use crate::statics::DefectPasses;

/// A pit or a dent beneath the most loaded contact that meets it at the static equilibrium of the healthy bearing.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PitExplanation {
    /// Name of the defect.
    pub name: String,
    /// `pit` or `dent`.
    pub shape: &'static str,
    /// Surface on which the pit lies.
    pub on: Surface,
    /// Sizes along rolling and across the race \[m\].
    pub size: [f64; 2],
    /// Load of the contact \[N\].
    pub load: f64,
    /// Width of the contact along rolling and its length across, 2b and 2a of Hertz's ellipse \[m\].
    pub contact: [f64; 2],
    /// Load that the pit takes at its middle, at one and the same approach \[N\]; below 0 where a rim adds more.
    pub lost: f64,
    /// How much less race would take as much \[m\].
    pub depth: f64,
    /// Share X of the contact's elastic energy that it releases.
    pub released: f64,
    /// How long a pass lasts where balls roll at the drive's largest speed \[s\].
    pub duration: f64,
}

/// The explanations of all pits that a loaded contact meets.
pub(super) fn of(scene: &Scene) -> Result<Vec<PitExplanation>> {
    let mut explanations = Vec::new();
    for (name, defect) in scene
        .defects
        .iter()
        .filter(|(_, defect)| defect.damage.is_small())
    {
        if let Some(meeting) = DefectPasses::of(scene, defect)? {
            let heaviest = meeting.heaviest(defect);
            explanations.extend(heaviest.and_then(|contact| beneath(name, defect, &contact)));
        }
    }
    Ok(explanations)
}

fn beneath(name: &str, defect: &Defect, of: &HeaviestContact) -> Option<PitExplanation> {
    let (load, hertz) = (of.load, &of.model.rows[defect.row].hertz[of.race]);
    let (lost, released) = of.loses(defect)?;
    let contact = [hertz.half_width, hertz.half_length].map(|half| 2.0 * half * load.cbrt());
    let size = [defect.damage.width(), defect.damage.extent()];
    Some(PitExplanation {
        name: name.to_owned(),
        shape: defect.damage.word(),
        on: defect.on,
        size,
        load,
        contact,
        lost,
        // F = K δ^{3/2}.
        depth: lost * hertz.approach(load) / (1.5 * load),
        released,
        duration: (size[0] + contact[0]) / of.model.rolling_speed(defect.row),
    })
}

impl fmt::Display for PitExplanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let surface = match self.on {
            Surface::OuterRace => "the outer race",
            Surface::InnerRace => "the inner race",
            Surface::Ball => "a ball",
        };
        let [[along, across], [width, length]] =
            [self.size, self.contact].map(|of| of.map(|x| 1e3 * x));
        let size = if along == across {
            number(along)
        } else {
            format!("{} × {}", number(along), number(across))
        };
        write!(
            f,
            "{}: {} on {surface}, {size} mm: under {:.0} N its contact is {width:.2} × {length:.2} mm; takes {:.1} N of it ({:.2} µm of \
             race) for {:.2} ms a pass; X {:.2}",
            self.name,
            self.shape,
            self.load,
            self.lost,
            1e6 * self.depth,
            1e3 * self.duration,
            self.released
        )
    }
}
