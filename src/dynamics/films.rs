//! Films of rings whose speed changes: thickness, traction and damping of the races follow the state.

use super::batch::Batch;
use crate::forces::State;
use crate::model::Model;

/// A model whose films follow the rings' speed.
#[derive(Debug)]
pub(super) struct Films {
    model: Box<Model>,
    /// Speed of the rings against each other \[rad/s\].
    speed: f64,
}

impl Films {
    /// The films; none where they stay as they are: without oil, or at a steady speed of the rings.
    pub fn new(model: &Model) -> Option<Self> {
        model.has_films_in_motion().then(|| Self {
            model: Box::new(model.clone()),
            speed: model.scene.relative_speed(0.0),
        })
    }

    /// Films of the speed that a state of all bodies has; none where they stay as they are.
    pub fn of(model: &Model, y: &[f64]) -> Option<Self> {
        let mut films = Self::new(model)?;
        let mut state = State::new(model);
        state.read(y);
        films.update(&state);
        Some(films)
    }

    /// The model with the films of the last state.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The model with the films of a state, after the contacts were given them.
    pub fn follow(&mut self, state: &State, contacts: &mut Batch) -> &Model {
        if self.update(state) {
            contacts.update_films(&self.model);
        }
        &self.model
    }

    /// The speed that they have \[rad/s\].
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Gives films and contacts a speed \[rad/s\].
    pub fn set(&mut self, speed: f64, contacts: &mut Batch) {
        if self.set_speed(speed) {
            contacts.update_films(&self.model);
        }
    }

    /// Gives the films the speed of a state; whether that changes them.
    fn update(&mut self, state: &State) -> bool {
        let [outer, inner] = state.rings();
        self.set_speed(inner.omega - outer.omega)
    }

    fn set_speed(&mut self, speed: f64) -> bool {
        let changes = speed.to_bits() != self.speed.to_bits();
        if changes {
            self.speed = speed;
            self.model.set_film_speed(speed);
        }
        changes
    }
}
