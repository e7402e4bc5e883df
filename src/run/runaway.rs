//! Detects a motion that is no longer physical: a body far outside the bearing, or faster than any solid body can be.
//!
//! With a step that is too long for the contacts a motion grows without bound, while its numbers stay finite for a long time.

use crate::base::quantities::{length, number};
use crate::dynamics::Dynamics;
use crate::model::{BodyId, BodyKind, Dof};
use crate::scene::Row;

/// Speed of a body or of a turning surface beyond which nothing holds together \[m/s\]: that of sound in steel.
const FASTEST: f64 = 5000.0;

/// Tilt of a ring beyond which nothing here is a bearing \[rad\].
const FURTHEST: f64 = 0.5;

/// The bounds of a run's states.
pub(crate) struct Bounds {
    /// Place of each state, 0 for speeds and angles.
    centre: Vec<f64>,
    /// Distances that bodies may be from there.
    reach: Vec<f64>,
    /// Body and direction of each of the first half of them.
    degrees: Vec<(BodyId, Dof)>,
}

impl Bounds {
    /// The bounds of runs that start from the state `y0` of all bodies: a pitch diameter around the start of a ring, around the
    /// pitch circle for a ball.
    pub fn new(dynamics: &Dynamics<'_>, y0: &[f64]) -> Self {
        let model = dynamics.model();
        let degrees = dynamics.degrees();
        let scene = model.scene();
        let [outer, inner] = scene.peak_speeds();
        let driven = inner.max(outer);
        let pitch = |row: &Row| row.pitch_diameter;
        let pitch = scene.rows.iter().map(pitch).fold(0.0, f64::max);
        let fastest = FASTEST.max(driven * pitch);
        let place = |&(body, dof): &(BodyId, Dof)| match (model.layout().kind(body), dof) {
            (_, Dof::TiltX | Dof::TiltY) => (0.0, FURTHEST),
            (_, dof) if dof.is_rotation() => (0.0, f64::MAX),
            (BodyKind::Ball(_), Dof::X | Dof::Y) => (0.0, 1.5 * pitch),
            _ => (y0[model.layout().at(body, dof)], pitch),
        };
        let speed = |&(body, dof): &(BodyId, Dof)| (0.0, fastest / model.lever(body, dof));
        let places = degrees.iter().map(place);
        let (centre, reach) = places.chain(degrees.iter().map(speed)).unzip();
        Self {
            centre,
            reach,
            degrees,
        }
    }

    /// The body that has left them in a state of the run, if any, and what it does.
    #[inline]
    pub fn left(&self, y: &[f64]) -> Option<(BodyId, String)> {
        let within = |i: usize| (y[i] - self.centre[i]).abs() <= self.reach[i];
        // Numbers that are none are not within. All are looked at, several at a time.
        let bounds = self.centre.iter().zip(&self.reach);
        let inside = y
            .iter()
            .zip(bounds)
            .map(|(y, (centre, reach))| usize::from((y - centre).abs() <= *reach));
        if inside.sum::<usize>() == y.len() {
            return None;
        }
        let half = self.degrees.len();
        // A bearing that nothing holds may travel as a whole.
        let carried = |i: usize| {
            let ring = self
                .degrees
                .iter()
                .position(|d| *d == (BodyId::OUTER, self.degrees[i].1));
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
        let (body, dof) = self.degrees[i % half];
        let does = match (i < half, dof.is_rotation()) {
            (true, true) if Dof::TILTS.contains(&dof) => {
                format!("tilts by {} rad ({})", number(y[i]), dof.name())
            }
            (true, true) => format!("has turned by {} rad", number(y[i])),
            (true, false) => format!(
                "is {} from its place",
                length((y[i] - self.centre[i]).abs())
            ),
            (false, true) => format!("spins at {} rad/s", number(y[i])),
            (false, false) => format!("moves at {} m/s", number(y[i].abs())),
        };
        Some((body, does))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Dof::{Theta, X, Y, Z};
    use crate::scene::presets;
    use crate::statics::compile;
    use crate::{Start, start};

    const INNER: BodyId = BodyId::INNER;

    /// Body that has left the bounds after some states of the start are changed: (is it a speed, body, direction, what is added).
    fn left_after(changes: &[(bool, BodyId, Dof, f64)]) -> Option<(BodyId, String)> {
        let model = compile(&presets::deep_groove_6205(500.0, 0.0, 1800.0)).unwrap();
        let mut y = start(&model, &Start::Equilibrium).unwrap();
        let dynamics = Dynamics::new(&model);
        let bounds = Bounds::new(&dynamics, &y);
        let layout = model.layout();
        for &(is_speed, body, dof, added) in changes {
            let at = if is_speed {
                layout.speed_at(body, dof)
            } else {
                layout.at(body, dof)
            };
            y[at] += added;
        }
        bounds.left(&y)
    }

    #[test]
    fn a_bearing_in_its_place_is_fine() {
        assert_eq!(left_after(&[]), None);
        assert_eq!(
            left_after(&[(false, INNER, Theta, 1e6), (true, INNER, Theta, 1e4)]),
            None
        );
    }

    #[test]
    fn what_leaves_is_named() {
        let [first, second, third] = [0, 1, 2].map(BodyId::ball);
        let far = left_after(&[(false, third, Y, -0.1)]).unwrap();
        assert!(
            far.0 == third && far.1.contains(" from its place"),
            "{far:?}"
        );
        let fast = left_after(&[(true, INNER, X, -6e3)]).unwrap();
        assert_eq!(fast, (INNER, "moves at 6000 m/s".to_owned()));
        let turned = left_after(&[(true, second, Theta, 1e271)]).unwrap();
        assert_eq!(turned, (second, "spins at 1e271 rad/s".to_owned()));
        let of = |body, value| left_after(&[(false, body, Theta, value)]).unwrap().0;
        assert_eq!(of(BodyId::OUTER, f64::NAN), BodyId::OUTER);
        assert_eq!(of(first, f64::INFINITY), first);
    }

    #[test]
    fn a_bearing_may_travel_as_a_whole() {
        let together: Vec<_> = (0..11)
            .map(|body| (false, BodyId::new(body), Z, 5.0))
            .collect();
        assert_eq!(left_after(&together), None);
        assert_eq!(left_after(&together[..10]).unwrap().0, BodyId::new(10));
    }
}
