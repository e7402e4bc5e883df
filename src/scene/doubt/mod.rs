//! Doubts: numbers that are allowed in a scene but probably not meant, such as one in another unit or a column that is constant.
//!
//! Validation refuses what cannot be computed; a pitch diameter of 39 m can. So every number is compared with the range of
//! real bearings, from miniature ones to those with a bore of one metre (`tests/reliability/doubts.rs`). What lies outside
//! causes a warning and is not refused, since research may need it.

mod geometry;
mod idle;
mod lubricant;
mod motion;
mod probes;
mod speed;
mod texture;
mod tilt;
mod units;

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{Profile, Scene, TimeFunction};
use crate::base::quantities::number;
pub(crate) use lubricant::FilmJudged;
pub(crate) use speed::AtSpeed;

/// Largest Hertz pressure of a contact of hardened steel at the static load rating of a ball bearing \[Pa\]: it leaves a
/// dent of a ten-thousandth of the ball diameter. ISO 76 gives it for the *centre* of the most heavily loaded contact,
/// so it is the largest pressure there, not the mean, which is two thirds of it.
pub const STATIC_PRESSURE: f64 = 4.2e9;

/// A value that no bearing is likely to have.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Doubt {
    /// Path of the field, such as `rows[0].ball_diameter`, or what follows from the scene, such as `contact pressure`.
    pub path: String,
    /// Value in a common unit.
    pub value: String,
    /// Usual values, and what may have gone wrong.
    pub usual: String,
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}: {}", self.path, self.value, self.usual)
    }
}

impl Doubt {
    fn new(path: impl Into<String>, value: impl Into<String>, usual: impl Into<String>) -> Self {
        Self {
            path: path.into(),
            value: value.into(),
            usual: usual.into(),
        }
    }

    /// Doubt about a largest Hertz pressure \[Pa\] that a contact has, where it exceeds the static rating.
    pub(crate) fn pressure(largest: f64) -> Option<Self> {
        (largest > STATIC_PRESSURE).then(|| {
            Self::new(
                "contact pressure",
                format!("{:.2} GPa", 1e-9 * largest),
                format!(
                    "the static load rating of ball bearings (ISO 76) stands for {:.1} GPa at the centre of the most \
                     heavily loaded contact, where steel keeps a dent of a ten-thousandth of the ball; loads are in \
                     newtons, lengths in metres",
                    1e-9 * STATIC_PRESSURE
                ),
            )
        })
    }
}

impl Scene {
    /// Improbable numbers of the scene, fields without effect, and probes of what cannot change; empty for an ordinary
    /// bearing, and for a scene that [`Scene::validate`] refuses.
    ///
    /// ```
    /// use ballrace::scene::presets;
    /// let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
    /// assert!(scene.doubts().is_empty());
    /// scene.rows[0].start_angle = -90.0;
    /// let text = scene.doubts()[0].to_string();
    /// assert!(text.starts_with("rows[0].start_angle = -90 rad: more than a turn"));
    /// ```
    pub fn doubts(&self) -> Vec<Doubt> {
        let mut found = Vec::new();
        if self.validate().is_err() {
            return found;
        }
        geometry::look(self, &mut found);
        lubricant::look(self, &mut found);
        motion::look(self, &mut found);
        texture::look(self, &mut found);
        tilt::look(self, &mut found);
        units::look(self, &mut found);
        idle::look(self, &mut found);
        probes::look(self, &mut found);
        found
    }
}

fn millimetres(x: f64) -> String {
    format!("{} mm", number(1e3 * x))
}

/// A length \[m\] beyond the most that is usual.
fn length(path: String, value: f64, most: f64, found: &mut Vec<Doubt>) {
    if value.abs() > most {
        let usual = format!(
            "bearings have at most {}; lengths are in metres",
            millimetres(most)
        );
        found.push(Doubt::new(path, millimetres(value), usual));
    }
}

/// An angle beyond a turn.
fn angle(path: String, value: f64, found: &mut Vec<Doubt>) {
    // Half a degree of rounding.
    if value.abs() > std::f64::consts::TAU + 0.01 {
        let usual = "more than a turn; angles are in radians";
        found.push(Doubt::new(path, format!("{} rad", number(value)), usual));
    }
}

/// The phase of a value in time.
fn phase(path: &str, value: &TimeFunction, found: &mut Vec<Doubt>) {
    if let TimeFunction::Profile(Profile::Sine { phase, .. }) = value {
        angle(format!("{path}.sine.phase"), *phase, found);
    }
}
