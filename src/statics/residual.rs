//! Residual of a solution: what it leaves unbalanced, by the forces themselves.

use nalgebra::Vector2;

use super::problem::Problem;
use super::unknowns::{self, RingStiffness, Rings};
use crate::base::error::{Error, Result};
use crate::base::interrupt;
use crate::base::quantities;
use crate::contact::Motion;
use crate::forces::cage::links;
use crate::model::{BodyId, DOFS, Race};

/// Force left on a body, over the largest load, above which there is no equilibrium.
const REFUSED: f64 = 1e-4;

/// The body that is worst off.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Residual {
    /// Force left on a body, along the free directions of a ring or along radius and z of a ball \[N\].
    pub(super) force: f64,
    /// The largest force of a contact, or of all loads on a ring \[N\].
    pub(super) largest: f64,
    body: BodyId,
}

impl Residual {
    fn add(&mut self, body: BodyId, force: f64) {
        if force > self.force || force.is_nan() {
            (self.force, self.body) = (force, body);
        }
    }

    /// Whether the residual is too much.
    pub(super) fn is_off(&self) -> bool {
        let share = self.share();
        share > REFUSED || share.is_nan()
    }

    /// Share of the largest load; 0 where nothing acts.
    pub(super) fn share(&self) -> f64 {
        if self.force == 0.0 {
            0.0
        } else {
            self.force / self.largest
        }
    }
}

impl Problem<'_> {
    /// Residual of the places of rings and balls: springs that stood in for the cage, and balls that followed the rings to
    /// first order, have no part in it.
    pub(super) fn residual(&self, rings: &Rings, places: &[Vector2<f64>]) -> Result<Residual> {
        let mut on_rings = self.loads;
        let mut found = Residual {
            largest: self.largest_load(),
            ..Residual::default()
        };
        for (j, (&place, pull)) in places.iter().zip(self.cage_pulls(places)).enumerate() {
            interrupt::check()?;
            let ball = self.ball_at(j, rings, place);
            for contact in &ball.contacts {
                found.largest = found.largest.max(contact.force.norm());
            }
            ball.press(&mut on_rings);
            if !self.is_held(j) {
                let more = pull - self.cage_spring[j].pull(place.x);
                found.add(BodyId::ball(j), (ball.force.x + more).hypot(ball.force.y));
            }
        }
        self.apply(rings, &mut on_rings, &mut RingStiffness::zeros());
        let left = self.left_on_rings(rings, &on_rings);
        for race in Race::BOTH {
            found.add(race.ring(), left[race]);
        }
        Ok(found)
    }

    /// Force of loads and balls that is left to each ring beside its support, along free directions.
    fn left_on_rings(&self, rings: &Rings, forces: &Rings) -> [f64; 2] {
        let mut left = [0.0_f64; 2];
        for &i in &self.free {
            let (race, _) = unknowns::degree(i);
            left[race] = left[race].hypot(forces[i] - self.resistance(i, rings));
        }
        left
    }

    /// Load of the ring that has the larger one.
    fn largest_load(&self) -> f64 {
        let on = |race| unknowns::of(&self.loads, race).norm();
        on(Race::Outer).max(on(Race::Inner))
    }

    /// Pull of the cage on every ball outwards, link by link.
    pub(super) fn cage_pulls(&self, places: &[Vector2<f64>]) -> Vec<f64> {
        let mut pulls = vec![0.0; places.len()];
        let Some(cage) = self.model.scene.cage_links() else {
            return pulls;
        };
        let at = |j: usize| {
            let centre = self.directions[j] * places[j].x;
            Motion::new(&[centre.x, centre.y, places[j].y, 0.0], &[0.0; DOFS])
        };
        for row in &self.model.rows {
            for (j, k) in row.links() {
                let (first, second) = (at(j), at(k));
                let tension = links::link(cage, row.cage_distance, &first, &second).force;
                let along = (second.centre - first.centre).normalize() * tension;
                pulls[j] += along.dot(&self.directions[j]);
                pulls[k] -= along.dot(&self.directions[k]);
            }
        }
        pulls
    }

    /// Refuses what is not balanced.
    pub(super) fn accept(&self, residual: &Residual) -> Result<()> {
        if !residual.is_off() {
            return Ok(());
        }
        Err(Error::Equilibrium {
            reason: format!(
                "{} on {} are not balanced, {} % of the largest load ({}), where {} % is allowed; \
                 check loads, clearance and cage, cut contacts by fitted nodes, or use start = \"rolling\"",
                quantities::force(residual.force),
                self.model.bodies[residual.body].name,
                quantities::number(100.0 * residual.share()),
                quantities::force(residual.largest),
                quantities::number(100.0 * REFUSED)
            ),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Dof;
    use crate::scene::presets;
    use crate::statics::compile;
    use crate::statics::{RaceControl, solve};

    /// Truth: the tangent stiffness. A ring out of its place is refused, by its name and the force that is not balanced.
    #[test]
    fn a_ring_out_of_place_is_named_and_refused() {
        let mut scene = presets::deep_groove_6205(500.0, 200.0, 1800.0);
        scene.cage = None;
        let model = compile(&scene).unwrap();
        let problem = Problem::new(&model);
        let solved = solve(&model, RaceControl::Friction).unwrap();
        assert!(solved.residual.share() < 1e-8);
        let centre = |body| model.layout().centre(&solved.y, body);
        let balls: Vec<_> = (0..model.balls.len())
            .map(|j| centre(BodyId::ball(j)))
            .map(|[x, y, z]| Vector2::new(x.hypot(y), z))
            .collect();
        let mut rings = Rings::zeros();
        for race in Race::BOTH {
            unknowns::add(&mut rings, race, &centre(race.ring()).into());
        }
        let fine = problem.residual(&rings, &balls).unwrap();
        assert!(problem.accept(&fine).is_ok());
        // A metre of the spring under the outer ring, and as much of its contacts, is some 10⁸ N.
        rings[unknowns::at(Race::Outer, Dof::Y)] += 1e-9;
        let off = problem.residual(&rings, &balls).unwrap();
        assert!((0.05..1.0).contains(&off.force), "{off:?}");
        let error = problem.accept(&off).unwrap_err().to_string();
        assert!(error.contains(" N on outer are not balanced"), "{error}");
        assert!(error.contains("where 0.01 % is allowed"), "{error}");
    }
}
