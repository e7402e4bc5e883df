//! Forces on rings by tables: springs that stiffen, magnetic pull, squeeze films, seals.

use serde::{Deserialize, Serialize};

use super::numbers::BoundedNumber;
use super::{RingForce, RingMotion, RingName};

/// A force on a ring's centre of mass that depends on its place along a direction, with a damper along the same.
///
/// ```text
/// s = e · r        F = (f(s) − c ds/dt) e        energy −∫ f ds from 0
/// ```
///
/// e is the direction with a length of 1, r the ring's displacement from its place in the scene; f is linear between the points of
/// the table, and continues its first and last piece beyond them.
///
/// # Panics
/// Methods of [`RingForce`] where the table has fewer than two points, or not as many forces as places, which
/// [`crate::Scene::validate`] refuses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct TableForce {
    /// The ring it acts on.
    pub ring: RingName,
    /// Direction; its length does not matter.
    pub direction: [f64; 3],
    /// Places along the direction \[m\], two or more, increasing.
    pub places: Vec<f64>,
    /// Force along the direction at each place \[N\]: decreasing for a spring, increasing for a magnetic pull.
    pub forces: Vec<f64>,
    /// Damping c \[N s/m\].
    #[serde(default)]
    pub damping: f64,
}

impl TableForce {
    /// Numbers of the force.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            ring: _,
            direction: _,
            places,
            forces,
            damping,
        } = self;
        let mut all = BoundedNumber::each("places", places, -1.0..=1.0, "m");
        all.extend(BoundedNumber::each("forces", forces, -1e12..=1e12, "N"));
        all.push(BoundedNumber::new("damping", *damping, 0.0..=1e12, "N s/m"));
        all
    }

    /// The table without damping.
    pub fn new(
        ring: RingName,
        direction: [f64; 3],
        places: impl Into<Vec<f64>>,
        forces: impl Into<Vec<f64>>,
    ) -> Self {
        Self {
            ring,
            direction,
            places: places.into(),
            forces: forces.into(),
            damping: 0.0,
        }
    }

    /// e.
    fn unit(&self) -> [f64; 3] {
        let length = self.direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        self.direction.map(|x| x / length)
    }

    fn slope(&self, i: usize) -> f64 {
        (self.forces[i + 1] - self.forces[i]) / (self.places[i + 1] - self.places[i])
    }

    /// The straight piece that a place lies on.
    fn piece(&self, s: f64) -> usize {
        let after = self.places.partition_point(|place| *place <= s);
        after.clamp(1, self.places.len() - 1) - 1
    }

    /// f.
    fn force(&self, s: f64) -> f64 {
        let i = self.piece(s);
        self.forces[i] + self.slope(i) * (s - self.places[i])
    }

    /// ∫ f ds from the first place.
    fn work(&self, s: f64) -> f64 {
        let last = self.piece(s);
        let mut work = 0.0;
        for i in 0..last {
            let width = self.places[i + 1] - self.places[i];
            work += 0.5 * width * (self.forces[i] + self.forces[i + 1]);
        }
        work + 0.5 * (s - self.places[last]) * (self.forces[last] + self.force(s))
    }
}

fn along(unit: [f64; 3], of: [f64; 3]) -> f64 {
    unit.iter().zip(of).map(|(e, x)| e * x).sum()
}

impl RingForce for TableForce {
    fn ring(&self) -> RingName {
        self.ring
    }

    fn wrench(&self, _t: f64, ring: &RingMotion) -> [f64; 6] {
        let unit = self.unit();
        let damped = self.damping * along(unit, ring.velocity);
        let force = self.force(along(unit, ring.place)) - damped;
        let [x, y, z] = unit.map(|e| e * force);
        [x, y, z, 0.0, 0.0, 0.0]
    }

    fn stiffness(&self) -> f64 {
        let slopes = (0..self.places.len() - 1).map(|i| self.slope(i).abs());
        slopes.fold(0.0, f64::max)
    }

    fn damping(&self) -> f64 {
        self.damping
    }

    fn energy(&self, ring: &RingMotion) -> f64 {
        self.work(0.0) - self.work(along(self.unit(), ring.place))
    }

    /// Peak at the scene's place of the ring.
    fn peak(&self) -> [f64; 2] {
        let [x, y, z] = self.unit();
        let force = self.force(0.0).abs();
        [force * x.hypot(y), force * z.abs()]
    }

    fn keeps_plane(&self) -> bool {
        self.direction[2] == 0.0
    }
}

/// Truth: closed forms.
#[cfg(test)]
mod tests {
    use super::*;

    fn at(y: f64, vy: f64) -> RingMotion {
        RingMotion {
            place: [0.0, y, 0.0],
            velocity: [0.0, vy, 0.0],
            ..RingMotion::default()
        }
    }

    #[test]
    fn a_table_is_straight_between_and_beyond_its_points() {
        let mut table = TableForce::new(
            RingName::Outer,
            [0.0, 2.0, 0.0],
            [-1e-5, 0.0, 2e-5],
            [100.0, 0.0, -50.0],
        );
        table.damping = 10.0;
        for (y, force) in [(-2e-5, 200.0), (-5e-6, 50.0), (1e-5, -25.0), (4e-5, -100.0)] {
            let found = table.wrench(0.0, &at(y, 0.1));
            assert!((found[1] - (force - 1.0)).abs() < 1e-9, "{y}: {found:?}");
            assert_eq!((found[0], found[2]), (0.0, 0.0));
        }
        assert!((table.stiffness() - 1e7).abs() < 1e-3);
        assert!(table.keeps_plane());
    }

    #[test]
    fn a_tables_energy_is_the_work_against_it() {
        let table = TableForce::new(RingName::Outer, [0.0, 1.0, 0.0], [-1e-5, 1e-5], [1e2, -1e2]);
        for y in [-3e-5, -1e-6, 5e-6, 4e-5] {
            let stored = 0.5 * 1e7 * y * y;
            assert!((table.energy(&at(y, 0.0)) - stored).abs() < 1e-12 * stored.max(1e-3));
        }
    }
}
