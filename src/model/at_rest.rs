//! The bearing at rest, as a model needs it: the compiler of scenes asks, statics answer.

use super::{Model, Race};
use crate::base::error::Result;
use crate::contact::SurfaceDefect;
use crate::contact::hertz::Hertz;
use crate::scene::{Defect, Scene, Surface};

/// Loads of contacts by row and race \[N\].
pub(crate) type RaceLoads = Vec<[f64; 2]>;

/// Answers from the static equilibrium.
pub(crate) trait AtRest {
    /// ΣQ²/ΣQ over the contacts of every row and race (12.7) of a model without oil and waves.
    ///
    /// # Errors
    /// [`crate::Error::Equilibrium`] where there is none.
    fn loads(&self, model: &Model) -> Result<RaceLoads>;

    /// The most loaded of the contacts that meet a defect of a scene over a turn of the balls, while the bearing is healthy; none
    /// without equilibrium or load.
    ///
    /// # Errors
    /// [`crate::Error::Scene`] for a scene that is not usable.
    fn heaviest(&self, scene: &Scene, defect: &Defect) -> Result<Option<HeaviestContact>>;
}

/// The most loaded contact that meets a defect.
pub(crate) struct HeaviestContact {
    /// The healthy bearing.
    pub model: Model,
    /// Load \[N\].
    pub load: f64,
    pub race: Race,
    /// Place at which the contact runs, from the row's plane or the ball's centre \[m\].
    pub place: f64,
}

impl HeaviestContact {
    /// Half-width along rolling \[m\].
    pub fn half_width(&self, row: usize) -> f64 {
        self.model.rows[row].hertz[self.race].half_width * self.load.cbrt()
    }

    /// Whether a defect that should be smaller than it is too large.
    pub fn is_outgrown(&self, defect: &Defect) -> bool {
        let (race, hertz) = self.met(defect.row);
        self.beneath(defect).outgrows(race, hertz, self.load)
    }

    /// Load \[N\] that a defect smaller than the contact takes of it, and the share of its energy that it releases.
    pub fn loses(&self, defect: &Defect) -> Option<(f64, f64)> {
        let (race, hertz) = self.met(defect.row);
        self.beneath(defect).takes(race, hertz, self.load)
    }

    /// The race, outer 0 and inner 1, and Hertz's contact with it.
    fn met(&self, row: usize) -> (usize, &Hertz) {
        let race = usize::from(self.race == Race::Inner);
        (race, &self.model.rows[row].hertz[self.race])
    }

    /// A defect beneath it, compiled.
    fn beneath(&self, defect: &Defect) -> SurfaceDefect {
        let row = &self.model.rows[defect.row];
        let geometry = &self.model.scene().rows[defect.row];
        if defect.on == Surface::Ball {
            SurfaceDefect::of_ball(defect, geometry.ball_diameter / 2.0, &row.hertz)
        } else {
            let (pair, hertz) = (&row.pairs[self.race], &row.hertz[self.race]);
            SurfaceDefect::of_race(defect, geometry, hertz, |z, length| pair.radii(z, length))
        }
    }
}
