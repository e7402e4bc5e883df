//! Slices of contacts that are evaluated alone, in packs of eight.

use super::{AXIAL, Around, HeldElement, HeldRolling, PlaneVector};
use crate::contact::profile::Inclination;
use crate::contact::{ContactForce, OilForce, Sink, V2, cross, turned};
use crate::simd::{LANES, Lanes};

/// Eight slices of one contact, each with its own direction.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SlicePack {
    pub n_e: PlaneVector,
    pub element: HeldElement,
    pub rolling: HeldRolling,
    /// Axis by which edges of the ball's own turn beside the ring's axis, along n_e and t_e (see [`ContactForce`]).
    turn_axis: PlaneVector,
}

impl SlicePack {
    /// Approach by a ball that turns across the ring's axis at a relative twist in the frame (n_e, t_e, z, about z …): its own edges come
    /// nearer, without slip. What their moments do in turn is left out: few slices have such edges, and what they dampen is slow.
    #[inline(always)]
    pub fn approach<const N: usize>(&self, twist: &mut [Lanes; N]) {
        if N > AXIAL {
            let rate = self.turn_axis[0] * twist[AXIAL] + self.turn_axis[1] * twist[AXIAL + 1];
            let Inclination { cos, sin } = self.element.slope;
            let size = rate * self.element.levers[0] * self.pressing();
            twist[0] += size * cos;
            twist[2] += size * sin;
        }
    }

    /// The part of a normal force in the plane, over what of it shows along (cos α, sin α).
    #[inline(always)]
    fn pressing(&self) -> Lanes {
        let HeldElement { share, slope, .. } = self.element;
        let ((in_plane, axial), Inclination { cos, sin }) = (share, slope);
        let shows = in_plane * cos + axial * sin;
        // Nothing in lanes without a slice.
        let pressing = in_plane / shows;
        shows.above(Lanes::ZERO).choose(pressing, Lanes::ZERO)
    }
}

/// Collects the slices of a contact in packs of some lane.
pub(crate) struct SlicePacking<'a> {
    pub packs: &'a mut Vec<(usize, SlicePack)>,
    /// The contacts, of which a gothic arch has two: their lane, and what their slices share.
    pub contacts: &'a mut Vec<(usize, Around)>,
    pub lane: usize,
    /// Direction from the ring's centre to the ball's, of length 1.
    pub outwards: V2,
    /// Exponent of the elastic law for a slice.
    pub exponent: f64,
    /// Slices so far.
    pub count: usize,
    /// Quantities that slices share beside their film.
    pub around: Around,
    /// Whether the next slice begins another contact.
    pub is_new: bool,
}

impl Sink for SlicePacking<'_> {
    fn force(&mut self, force: &ContactForce) {
        if std::mem::take(&mut self.is_new) {
            self.contacts.push((self.lane, self.around));
            self.count = 0;
        }
        let lane = self.count % LANES;
        if lane == 0 {
            let contact = self.contacts.len() - 1;
            self.packs.push((contact, SlicePack::default()));
        }
        self.count += 1;
        let Some((_, pack)) = self.packs.last_mut() else {
            return;
        };
        let SlicePack {
            n_e,
            element,
            rolling,
            turn_axis,
        } = pack;
        // Friction lies across the force's direction, whose share on the common normal is of length 1.
        let (in_plane, axial) = force.share;
        let over = in_plane.hypot(axial).recip();
        let (sin, cos) = (axial * over, in_plane * over);
        let (out, arm) = (force.n_e, force.arm_ball);
        (n_e[0][lane], n_e[1][lane]) = (out.x, out.y);
        element.elastic[lane] = force.elastic;
        element.hardening[lane] = if force.depth > 0.0 {
            self.exponent / force.depth
        } else {
            0.0
        };
        (element.share.0[lane], element.share.1[lane]) = force.share;
        element.friction_weight[lane] = force.friction_weight;
        (element.slope.sin[lane], element.slope.cos[lane]) = (sin, cos);
        rolling.load[lane] = force.elastic / force.width;
        rolling.depth[lane] = force.depth;
        rolling.arm[lane] = arm.dot(&self.outwards);
        element.levers[0][lane] = cross(arm, out);
        element.levers[1][lane] = cross(arm, turned(out));
        element.place[lane] = force.zeta;
        (turn_axis[0][lane], turn_axis[1][lane]) = (
            force.turn_axis.xy().dot(&out),
            force.turn_axis.xy().dot(&turned(out)),
        );
    }

    fn oil(&mut self, force: &OilForce) {
        if self.is_new {
            // Nothing touched.
            return;
        }
        if let Some((_, around)) = self.contacts.last_mut() {
            around.oil = force.oil.map(|number| Lanes::all(*number));
            around.distance = Lanes::all(force.apart.norm());
            around.lever = Lanes::all(force.lever);
        }
        self.is_new = true;
    }
}
