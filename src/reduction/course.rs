//! Motions that no force changes.

use crate::model::{BodyId, Dof, Race};
use crate::scene::{Antiderivative, Scene, TimeFunction};

/// A place whose speed is constant or the one that is given to a ring.
#[derive(Debug, Clone)]
pub(crate) struct Course {
    place: f64,
    /// The part of the speed that is constant.
    speed: f64,
    /// The ring's speed, where it changes.
    given: Option<Given>,
}

/// A speed that changes.
#[derive(Debug, Clone)]
struct Given {
    speed: TimeFunction,
    turned: Antiderivative,
}

impl Given {
    /// Angle and speed at a time.
    fn at(&self, t: f64) -> (f64, f64) {
        (self.turned.at(&self.speed, t), self.speed.at(t))
    }
}

impl Course {
    /// A course at a constant speed, at a place at a time.
    pub fn steady(t: f64, place: f64, speed: f64) -> Self {
        Self {
            place: place - speed * t,
            speed,
            given: None,
        }
    }

    /// A course at a place at a time, with a speed that changes as the one that is given to a ring.
    pub fn driven(t: f64, place: f64, speed: f64, race: Race, scene: &Scene) -> Self {
        let given = match scene.given_speed(race.into()) {
            None | Some(TimeFunction::Constant(_)) => return Self::steady(t, place, speed),
            Some(speed) => Given {
                turned: Antiderivative::new(speed),
                speed: speed.clone(),
            },
        };
        let (turned, following) = given.at(t);
        let extra = speed - following;
        Self {
            place: place - (extra * t + turned),
            speed: extra,
            given: Some(given),
        }
    }

    /// Whether the body ever leaves its place.
    pub fn moves(&self) -> bool {
        self.speed != 0.0 || self.given.is_some()
    }

    /// Place and speed at a time.
    pub fn at(&self, t: f64) -> (f64, f64) {
        let Some(given) = &self.given else {
            return (self.place + self.speed * t, self.speed);
        };
        let (turned, speed) = given.at(t);
        (self.place + self.speed * t + turned, self.speed + speed)
    }

    /// Acceleration at a time.
    pub fn rate(&self, t: f64) -> f64 {
        let given = self.given.as_ref();
        given.map_or(0.0, |given| given.speed.rate(t))
    }
}

/// A degree of freedom whose motion is prescribed.
#[derive(Debug, Clone)]
pub(crate) struct Prescribed {
    pub body: BodyId,
    pub dof: Dof,
    pub course: Course,
}
