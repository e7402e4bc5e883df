//! When a run has left reality: a body far outside the bearing, or faster than any solid body can be.
//!
//! A step that is too long for the contacts lets a motion grow without bound, and numbers stay finite for a long while.

use crate::dynamics::Dynamics;
use crate::scene::{Drive, Row};
use crate::told::{length, number};

/// Speed of a body or of a turning surface beyond which nothing holds together \[m/s\]: that of sound in steel.
const FASTEST: f64 = 5000.0;

/// The bounds of a run's states.
pub(crate) struct Bounds {
    /// Place of each state, 0 for speeds and angles.
    centre: Vec<f64>,
    /// How far it may be from there.
    reach: Vec<f64>,
    /// Body and direction of each of the first half of them.
    degrees: Vec<(usize, usize)>,
}

impl Bounds {
    /// For runs that start from the state `y0` of all bodies: a pitch diameter around the start of a ring, around the
    /// pitch circle for a ball.
    pub fn new(dynamics: &Dynamics<'_>, y0: &[f64]) -> Self {
        let model = dynamics.model();
        let degrees = dynamics.degrees();
        let scene = model.scene();
        let driven = match &scene.drive {
            Drive::Speed(speed) => speed.peak(),
            Drive::Torque { initial_speed, .. } => initial_speed.abs(),
        };
        let pitch = |row: &Row| row.pitch_diameter;
        let pitch = scene.rows.iter().map(pitch).fold(0.0, f64::max);
        let fastest = FASTEST.max(driven * pitch);
        let place = |&(body, i): &(usize, usize)| match (body, i) {
            (_, 3) => (0.0, f64::MAX),
            (2.., 0 | 1) => (0.0, 1.5 * pitch),
            _ => (y0[4 * body + i], pitch),
        };
        let speed = |&(body, i): &(usize, usize)| match i {
            3 => (0.0, fastest / model.radius(body)),
            _ => (0.0, fastest),
        };
        let places = degrees.iter().map(place);
        let (centre, reach) = places.chain(degrees.iter().map(speed)).unzip();
        Self {
            centre,
            reach,
            degrees,
        }
    }

    /// The body that has left them in a state of the run, if any, and what it does.
    pub fn left(&self, y: &[f64]) -> Option<(usize, String)> {
        let within = |i: usize| (y[i] - self.centre[i]).abs() <= self.reach[i];
        // Numbers that are none are not within.
        if (0..y.len()).all(within) {
            return None;
        }
        let half = self.degrees.len();
        // A bearing that nothing holds may travel as a whole.
        let carried = |i: usize| {
            let ring = self
                .degrees
                .iter()
                .position(|d| *d == (0, self.degrees[i].1));
            ring.map_or(0.0, |ring| y[ring] - self.centre[ring])
        };
        let stays = |i: usize| {
            if i < half {
                (y[i] - self.centre[i] - carried(i)).abs() <= self.reach[i]
            } else {
                within(i)
            }
        };
        let i = (0..y.len()).find(|&i| !stays(i))?;
        let (body, direction) = self.degrees[i % half];
        let does = match (i < half, direction) {
            (true, 3) => format!("has turned by {} rad", number(y[i])),
            (true, _) => format!(
                "is {} from its place",
                length((y[i] - self.centre[i]).abs())
            ),
            (false, 3) => format!("spins at {} rad/s", number(y[i])),
            (false, _) => format!("moves at {} m/s", number(y[i].abs())),
        };
        Some((body, does))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;
    use crate::{Model, Start, start};

    /// What is said of the start with some of its states changed: (is it a speed, body, direction, what is added).
    fn said(changes: &[(bool, usize, usize, f64)]) -> Option<(usize, String)> {
        let model = Model::new(&presets::deep_groove_6205(500.0, 0.0, 1800.0)).unwrap();
        let mut y = start(&model, &Start::Equilibrium).unwrap();
        let dynamics = Dynamics::new(&model);
        let bounds = Bounds::new(&dynamics, &y);
        let half = y.len() / 2;
        for (speed, body, direction, added) in changes {
            y[4 * body + direction + if *speed { half } else { 0 }] += added;
        }
        bounds.left(&y)
    }

    #[test]
    fn a_bearing_in_its_place_is_fine() {
        assert_eq!(said(&[]), None);
        assert_eq!(said(&[(false, 1, 3, 1e6), (true, 1, 3, 1e4)]), None);
    }

    #[test]
    fn what_leaves_is_named() {
        let far = said(&[(false, 4, 1, -0.1)]).unwrap();
        assert!(far.0 == 4 && far.1.contains(" from its place"), "{far:?}");
        let fast = said(&[(true, 1, 0, -6e3)]).unwrap();
        assert_eq!(fast, (1, "moves at 6000 m/s".to_owned()));
        let turned = said(&[(true, 3, 3, 1e271)]).unwrap();
        assert_eq!(turned, (3, "spins at 1e271 rad/s".to_owned()));
        assert_eq!(said(&[(false, 0, 3, f64::NAN)]).unwrap().0, 0);
        assert_eq!(said(&[(false, 2, 3, f64::INFINITY)]).unwrap().0, 2);
    }

    #[test]
    fn a_bearing_may_travel_as_a_whole() {
        let together: Vec<_> = (0..11).map(|body| (false, body, 2, 5.0)).collect();
        assert_eq!(said(&together), None);
        assert_eq!(said(&together[..10]).unwrap().0, 10);
    }
}
