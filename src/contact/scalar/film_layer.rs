//! Oil films on a race and on its fault circles.

use super::Pair;
use crate::contact::laws::film::Oiled;
use crate::contact::{Rules, Traction, ZoneSlices};

impl Pair {
    /// Gives the race its film.
    pub(crate) fn lubricate(&mut self, oiled: &Oiled, traction: bool) {
        self.law.film = Some(*oiled);
        if traction {
            self.law.traction = Some(Traction::of_film(&oiled.now));
            if let ZoneSlices::Fitted(rules) = &self.slices {
                let exponent = self.law.elastic.exponent();
                self.slices = ZoneSlices::Fitted(Rules::for_films(rules.count(), exponent));
            }
        }
        self.lay_film(oiled.now.thickness());
    }

    /// The film at another speed of the rings against each other \[rad/s\].
    pub(crate) fn turn_film(&mut self, speed: f64) {
        let Some(oiled) = &self.law.film else {
            return;
        };
        let oiled = Oiled::new(oiled.film, oiled.bare_radius, speed);
        if oiled.film.effects().traction {
            self.law.traction = Some(Traction::of_film(&oiled.now));
        }
        self.law.film = Some(oiled);
        self.lay_film(oiled.now.thickness());
    }

    /// Lays a film of a thickness \[m\] on the race and on its fault circles, whose centres stay.
    fn lay_film(&mut self, thickness: f64) {
        if let Some(oiled) = &self.law.film {
            self.race.r = oiled.bare_radius - thickness;
        }
        for defect in &mut self.defects {
            defect.film_layer = thickness;
        }
    }
}
