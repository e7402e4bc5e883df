//! What a solution leaves unbalanced, by the forces themselves.

use nalgebra::{SVector, Vector2};

use super::problem::Problem;
use crate::contact::Motion;
use crate::dynamics::link;
use crate::error::{Error, Result};
use crate::interrupt;
use crate::told;

/// Force left on a body, over the largest load, above which there is no equilibrium.
const REFUSED: f64 = 1e-4;

/// The body that is worst off.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Residual {
    /// On it, along the free directions of a ring or along radius and z of a ball \[N\].
    pub(super) force: f64,
    /// The largest force of a contact, or of all loads on a ring \[N\].
    pub(super) largest: f64,
    body: usize,
}

impl Residual {
    fn add(&mut self, body: usize, force: f64) {
        if force > self.force || force.is_nan() {
            (self.force, self.body) = (force, body);
        }
    }

    /// Whether that is too much.
    pub(super) fn is_off(&self) -> bool {
        let share = self.share();
        share > REFUSED || share.is_nan()
    }

    /// Over the largest load; 0 where nothing acts.
    pub(super) fn share(&self) -> f64 {
        if self.force == 0.0 {
            0.0
        } else {
            self.force / self.largest
        }
    }
}

impl Problem<'_> {
    /// What the places of rings and balls leave: springs that stood in for the cage, and balls that followed the rings to
    /// first order, have no part in it.
    pub(super) fn residual(
        &self,
        rings: &SVector<f64, 6>,
        places: &[Vector2<f64>],
    ) -> Result<Residual> {
        let mut on_rings = self.loads;
        let mut found = Residual {
            largest: self.largest_load(),
            ..Residual::default()
        };
        for (j, (&place, pull)) in places.iter().zip(self.cage_pulls(places)).enumerate() {
            interrupt::check()?;
            let ball = self.ball_at(j, rings, place);
            for (race, contact) in ball.contacts.iter().enumerate() {
                found.largest = found.largest.max(contact.force.norm());
                let mut on_ring = on_rings.fixed_rows_mut::<3>(3 * race);
                on_ring -= contact.force;
            }
            if !self.is_held(j) {
                let more = pull - self.cage_spring[j].pull(place.x);
                found.add(2 + j, (ball.force.x + more).hypot(ball.force.y));
            }
        }
        let mut left = [0.0_f64; 2];
        for &i in &self.free {
            let support = self.model.bodies[i / 3].degrees[i % 3].stiffness();
            left[i / 3] = left[i / 3].hypot(on_rings[i] - support * rings[i]);
        }
        (0..2).for_each(|ring| found.add(ring, left[ring]));
        Ok(found)
    }

    /// Of the two rings' loads the larger one.
    fn largest_load(&self) -> f64 {
        let on = |ring: usize| self.loads.fixed_rows::<3>(3 * ring).norm();
        on(0).max(on(1))
    }

    /// What the cage pulls every ball outwards, link by link.
    pub(super) fn cage_pulls(&self, places: &[Vector2<f64>]) -> Vec<f64> {
        let mut pulls = vec![0.0; places.len()];
        let Some(cage) = &self.model.scene.cage else {
            return pulls;
        };
        let at = |j: usize| {
            let centre = self.directions[j] * places[j].x;
            Motion::new(&[centre.x, centre.y, places[j].y, 0.0], &[0.0; 4])
        };
        for row in &self.model.rows {
            for (j, k) in row.links() {
                let (first, second) = (at(j), at(k));
                let tension = link(cage, row.cage_distance, &first, &second).force;
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
                 check loads, clearance and cage, cut contacts by fitted nodes, or start rolling",
                told::force(residual.force),
                self.model.bodies[residual.body].name,
                told::number(100.0 * residual.share()),
                told::force(residual.largest),
                told::number(100.0 * REFUSED)
            ),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equilibrium::solve;
    use crate::model::Model;
    use crate::scene::presets;

    /// Truth: the tangent stiffness. What a ring leaves that is not where it should be is told by name, and refused.
    #[test]
    fn a_ring_out_of_place_is_told_and_refused() {
        let mut scene = presets::deep_groove_6205(500.0, 200.0, 1800.0);
        scene.cage = None;
        let model = Model::new(&scene).unwrap();
        let problem = Problem::new(&model);
        let solved = solve(&model).unwrap();
        assert!(solved.residual.share() < 1e-8);
        let at = |body: usize, i: usize| solved.y[4 * body + i];
        let balls: Vec<_> = (2..model.bodies.len())
            .map(|body| Vector2::new(at(body, 0).hypot(at(body, 1)), at(body, 2)))
            .collect();
        let mut rings = SVector::<f64, 6>::from_fn(|i, _| at(i / 3, i % 3));
        let fine = problem.residual(&rings, &balls).unwrap();
        assert!(problem.accept(&fine).is_ok());
        // A metre of the spring under the outer ring, and as much of its contacts, is some 10⁸ N.
        rings[1] += 1e-9;
        let off = problem.residual(&rings, &balls).unwrap();
        assert!((0.05..1.0).contains(&off.force), "{off:?}");
        let error = problem.accept(&off).unwrap_err().to_string();
        assert!(error.contains(" N on outer are not balanced"), "{error}");
        assert!(error.contains("where 0.01 % is allowed"), "{error}");
    }
}
