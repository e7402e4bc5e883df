//! Tilts of rings among the unknowns: frames, moments on tilts in addition to those of contacts, and springs between groove centres
//! with a ring that tilts.

use nalgebra::{Matrix3x2, SMatrix, Vector3, Vector6};

use super::arms::{Arm, OfRing, OnRing};
use super::problem::Problem;
use super::unknowns::{self, OF_A_RING, RingStiffness, Rings};
use crate::forces::{self, load};
use crate::model::{Dof, Model, Race, RingModel};
use crate::scene::RingMotion;
use crate::tilt::{Frame, Rotation};

impl Problem<'_> {
    /// Half of the mean pitch diameter \[m\], which makes a length of a tilt.
    pub(super) fn lever(&self) -> f64 {
        self.model.radius(Race::Inner.ring())
    }

    /// Tilt of a ring \[rad\].
    pub(super) fn tilt(&self, rings: &Rings, race: Race) -> [f64; 2] {
        Dof::TILTS.map(|dof| rings[unknowns::at(race, dof)] / self.lever())
    }

    /// The frame of a ring that may tilt.
    pub(super) fn frame(&self, rings: &Rings, race: Race) -> Frame {
        Frame::new(self.tilt(rings, race))
    }

    /// Rotation of a ring by its tilts, expressed as lengths.
    fn turning(&self, rings: &Rings, race: Race) -> Matrix3x2<f64> {
        let tilt = self.tilt(rings, race);
        let by = |rates: [f64; 2]| Rotation::new(tilt, rates, 0.0).angular_velocity();
        Matrix3x2::from_columns(&[by([1.0, 0.0]), by([0.0, 1.0])]) / self.lever()
    }

    /// How a ball stands from a ring whose contacts it meets at a place from the ring's origin, both in the scene's frame.
    pub(super) fn arm(&self, rings: &Rings, race: Race, centre: &Vector3<f64>) -> Arm {
        let of_ring = Vector3::z() * self.model.rings[race].centre_of_mass;
        Arm {
            from: centre - unknowns::of(rings, race) - of_ring,
            turning: self.turning(rings, race),
        }
    }

    /// The place of a ball in the frame of a ring that may tilt.
    pub(super) fn seen(&self, rings: &Rings, race: Race, centre: &Vector3<f64>) -> Vector3<f64> {
        let from = centre - unknowns::of(rings, race);
        if !self.model.tilts() {
            return from;
        }
        let of_ring = Vector3::z() * self.model.rings[race].centre_of_mass;
        self.frame(rings, race).to_ring(&(from - of_ring)) + of_ring
    }

    /// Adds what loads, moments and coupled supports do to tilts, what forces do that depend on a ring's place, and their stiffness.
    pub(super) fn apply(&self, rings: &Rings, forces: &mut Rings, stiffness: &mut RingStiffness) {
        for race in Race::BOTH {
            let k = unknowns::first(race);
            let (more, against) = match (self.model.tilts(), self.placed) {
                (false, false) => continue,
                (true, false) => self.applied(rings, race),
                (false, true) => self.by_place(rings, race),
                (true, true) => {
                    let (applied, placed) = (self.applied(rings, race), self.by_place(rings, race));
                    (applied.0 + placed.0, applied.1 + placed.1)
                }
            };
            let mut on_ring = forces.fixed_rows_mut::<OF_A_RING>(k);
            on_ring += more;
            let mut own = stiffness.fixed_view_mut::<OF_A_RING, OF_A_RING>(k, k);
            own += against;
        }
    }

    /// Wrench of loads, moments and supports on a ring's tilts, coupled supports to its places too; and the stiffness of all that.
    /// Springs of single directions have no part in it.
    fn applied(&self, rings: &Rings, race: Race) -> (OnRing, OfRing) {
        let (mut forces, mut stiffness) = (OnRing::zeros(), OfRing::zeros());
        let (frame, turning) = (self.frame(rings, race), self.turning(rings, race));
        let moment = load::moment(self.model, 0.0, race, |arm| frame.to_scene(arm))
            + frame.to_scene(&self.turning[race])
            + self.couples[race];
        let on_tilts = turning.tr_mul(&moment);
        forces.fixed_rows_mut::<2>(3).copy_from(&on_tilts);
        for push in self.pushes.iter().filter(|push| push.race == race) {
            // δM = (δφ × p) × f.
            let arm = frame.to_scene(&push.arm).cross_matrix();
            let own = -turning.tr_mul(&(push.force.cross_matrix() * arm)) * turning;
            let mut of_tilts = stiffness.fixed_view_mut::<2, 2>(3, 3);
            of_tilts += own;
        }
        let (coupled, against) = self.coupled(rings, race, &frame);
        (forces + coupled, stiffness + against)
    }

    /// Wrench of forces that depend on a ring's place, along its unknowns; and their stiffness by differences.
    fn by_place(&self, rings: &Rings, race: Race) -> (OnRing, OfRing) {
        let step = 1e-3 * self.model.scales.approach;
        let at = |offset: usize, by: f64| {
            let mut moved = *rings;
            moved[unknowns::first(race) + offset] += by;
            self.placed_forces(&moved, race)
        };
        let mut stiffness = OfRing::zeros();
        for i in 0..OF_A_RING {
            let slope = (at(i, -step) - at(i, step)) / (2.0 * step);
            stiffness.set_column(i, &slope);
        }
        (self.placed_forces(rings, race), stiffness)
    }

    fn placed_forces(&self, rings: &Rings, race: Race) -> OnRing {
        let [x, y] = self.tilt(rings, race);
        let omega = self.model.scene.ring_speeds(0.0)[race];
        let centre = unknowns::of(rings, race);
        let ring = RingMotion {
            place: [centre.x, centre.y, centre.z],
            angles: [x, y, 0.0],
            rates: [0.0, 0.0, omega],
            ..RingMotion::default()
        };
        let mut sum = OnRing::zeros();
        for force in forces::ALL {
            let wrench = force.at_place(self.model, race, &ring);
            let mut force = sum.fixed_rows_mut::<3>(0);
            force += wrench.force;
            let mut tilts = sum.fixed_rows_mut::<2>(3);
            tilts += self.turning(rings, race).tr_mul(&wrench.moment);
        }
        sum
    }

    /// Wrench of a coupled support, −Gᵀ K ξ with G = ∂ξ/∂(places, tilts), and its stiffness Gᵀ K G.
    fn coupled(&self, rings: &Rings, race: Race, frame: &Frame) -> (OnRing, OfRing) {
        let ring: &RingModel = &self.model.rings[race];
        let Some(coupled) = &ring.coupled else {
            return (OnRing::zeros(), OfRing::zeros());
        };
        let lever = self.lever();
        let axis = frame.axis();
        let [x, y] = frame.tilt;
        let moved = (axis - Frame::new(ring.tilt).axis()) * coupled.place;
        let place = unknowns::of(rings, race) + moved;
        let stretched = Vector6::new(
            place.x,
            place.y,
            place.z,
            x - ring.tilt[0],
            y - ring.tilt[1],
            0.0,
        );
        let mut by = SMatrix::<f64, 6, OF_A_RING>::identity();
        let along = coupled.place / lever;
        by[(1, 3)] = -along;
        by[(0, 4)] = along;
        (by[(2, 3)], by[(2, 4)]) = (-x / axis.z * along, -y / axis.z * along);
        (by[(3, 3)], by[(4, 4)]) = (1.0 / lever, 1.0 / lever);
        let pull = coupled.stiffness * stretched;
        (-by.tr_mul(&pull), by.tr_mul(&(coupled.stiffness * by)))
    }

    /// Displacement of a tilted ring's groove centre at a ball, for springs between groove centres: along the ball's direction, and
    /// axially.
    pub(super) fn by_tilt(&self, j: usize, rings: &Rings, race: Race) -> [f64; 2] {
        if !self.model.tilts() {
            return [0.0; 2];
        }
        let row = &self.model.scene.rows[self.model.balls[j].row];
        let [x, y] = self.tilt(rings, race);
        let n = self.directions[j];
        let along = row.axial_position - self.model.rings[race].centre_of_mass;
        let pitch = row.pitch_diameter / 2.0;
        [along * (y * n.x - x * n.y), pitch * (x * n.y - y * n.x)]
    }

    /// The tilts of the rings in the scene, as unknowns.
    pub(super) fn nominal(model: &Model) -> Rings {
        let lever = model.radius(Race::Inner.ring());
        let mut rings = Rings::zeros();
        for race in Race::BOTH {
            for dof in Dof::TRANSLATIONS {
                rings[unknowns::at(race, dof)] = model.bodies[race.ring()].nominal[dof];
            }
            for (dof, tilt) in Dof::TILTS.into_iter().zip(model.rings[race].tilt) {
                rings[unknowns::at(race, dof)] = lever * tilt;
            }
        }
        rings
    }
}
