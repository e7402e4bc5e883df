//! Doubts about balls at speed: their axis, too little load, gyroscopic moments, contact angles that part.

use super::Doubt;
use crate::base::quantities::number;

/// Thrust a ball, or the load of the most loaded ball of a row under radial load, over a ball's centrifugal force, below which balls
/// slide as a whole: F. Hirano, *ASLE Transactions* 8 (1965) 425, measured it on angular contact ball bearings under thrust.
const LOAD: f64 = 10.0;
/// Gyroscopic moments of a row over the moments that friction can hold, above which balls begin to turn about the contacts' line.
const GYROSCOPIC: f64 = 0.9;
/// Contact angle of the inner over that of the outer race \[rad\].
const APART: f64 = 15.0 * std::f64::consts::PI / 180.0;

/// Numbers by which the balls of a row are judged at speed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct AtSpeed {
    /// Row, from 0.
    pub row: usize,
    /// Whether thrust is more than radial load.
    pub thrust: bool,
    /// Thrust a ball, else the largest load of a ball \[N\].
    pub load: f64,
    /// Centrifugal force of a ball \[N\].
    pub centrifugal: f64,
    /// Gyroscopic moments of loaded balls over those that friction at both races can hold; 0 without friction.
    pub gyroscopic: f64,
    /// Largest α_i − α_o of a loaded ball \[rad\].
    pub apart: f64,
}

impl Doubt {
    /// Doubts about the balls of a row at speed.
    pub(crate) fn at_speed(of: &AtSpeed) -> Vec<Self> {
        let mut found = Vec::new();
        let mut add = |what: &str, value: String, usual: String| {
            found.push(Self::new(format!("row {}, {what}", of.row), value, usual));
        };
        let share = of.load / of.centrifugal;
        if share < LOAD {
            let what = if of.thrust {
                "thrust a ball"
            } else {
                "load of the most loaded ball"
            };
            let value = format!("{} N", number(of.load));
            let usual = format!(
                "{} times a ball's centrifugal force of {} N, where balls slide as a whole below {LOAD} (Hirano 1965); makers ask \
                 for a least load of about a hundredth of the dynamic rating: more load, a preload, or fewer and lighter balls",
                number(share),
                number(of.centrifugal)
            );
            add(what, value, usual);
        }
        if of.gyroscopic > GYROSCOPIC {
            let usual = format!(
                "of what friction at both races can hold: above {GYROSCOPIC} balls turn about the line of their contacts and slide (Jones \
                 1959); more load or less speed"
            );
            add("gyroscopic moment", number(of.gyroscopic), usual);
        }
        if of.apart > APART {
            let usual = "by so much is the contact angle of the inner race above that of the outer: usual is less than 15°; balls pivot and heat, \
                         at less load than their speed wants"
                .to_owned();
            add(
                "contact angles",
                format!("{}°", number(of.apart.to_degrees())),
                usual,
            );
        }
        found
    }

    /// Doubt about balls whose axis is held where that changes their orbit and loads by these shares.
    pub(crate) fn axis(orbit: f64, load: f64) -> Self {
        let usual = format!(
            "holds the balls' axis along the bearing's: at rest they go round {} % {} and contacts carry up to {} % of the largest load \
             more or less than with spin = \"free\", as fault frequencies and loads do",
            number(100.0 * orbit.abs()),
            if orbit < 0.0 { "slower" } else { "faster" },
            number(100.0 * load)
        );
        Self::new("spin", "axial", usual)
    }
}
