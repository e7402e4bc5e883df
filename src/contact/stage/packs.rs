//! Slices of contacts that are evaluated alone, in packs of eight.

use super::{Around, PlaneVector, StageElement, StageRolling};
use crate::contact::{Aside, OilTouch, Sink, Touch, V2, cross, turned};
use crate::simd::{LANES, Lanes};

/// Eight slices of one contact, each with its own direction.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SlicePack {
    pub n_e: PlaneVector,
    pub element: StageElement,
    pub rolling: StageRolling,
}

/// Collects the slices of a contact in packs of some lane.
pub(crate) struct SlicePacking<'a> {
    pub packs: &'a mut Vec<(usize, SlicePack)>,
    /// The contacts, of which a gothic arch has two: their lane, and what their slices share.
    pub contacts: &'a mut Vec<(usize, Around)>,
    pub lane: usize,
    /// Ball radius \[m\].
    pub radius: f64,
    /// From the ring's centre to the ball's, of length 1.
    pub outwards: V2,
    /// Whether all slices press along the common normal.
    pub flat: bool,
    /// Sum of forces beside those of slices: x, y, z and about the ball's centre.
    pub aside: [f64; 4],
    /// Slices so far.
    pub count: usize,
    /// What slices share beside their film.
    pub around: Around,
    /// Whether the next slice begins another contact.
    pub is_new: bool,
}

impl Sink for SlicePacking<'_> {
    fn touch(&mut self, touch: &Touch) {
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
        } = pack;
        // α of the slice: that of the place on the ball (flat contact), or of the force's direction.
        let (sin, cos) = if self.flat {
            let sin = touch.zeta / self.radius;
            (sin, (1.0 - sin * sin).sqrt())
        } else {
            let tan = touch.share.1 / touch.share.0;
            let cos = 1.0 / (1.0 + tan * tan).sqrt();
            (tan * cos, cos)
        };
        let (out, arm) = (touch.n_e, touch.arm_ball);
        (n_e[0][lane], n_e[1][lane]) = (out.x, out.y);
        element.elastic[lane] = touch.elastic;
        (element.share.0[lane], element.share.1[lane]) = touch.share;
        element.rubbing[lane] = touch.rubbing;
        (element.slope.0[lane], element.slope.1[lane]) = (sin, cos);
        rolling.load[lane] = touch.elastic / touch.width;
        rolling.depth[lane] = touch.depth;
        rolling.arm[lane] = arm.dot(&self.outwards);
        element.levers[0][lane] = cross(arm, out);
        element.levers[1][lane] = cross(arm, turned(out));
    }

    fn oil(&mut self, touch: &OilTouch) {
        if self.is_new {
            // Nothing touched.
            return;
        }
        if let Some((_, around)) = self.contacts.last_mut() {
            around.oil = touch.oil.map(|number| Lanes::all(*number));
            around.distance = Lanes::all(touch.apart.norm());
            around.lever = Lanes::all(touch.lever);
        }
        self.is_new = true;
    }

    fn aside(&mut self, force: &Aside) {
        let (on_ball, _) = force.wrenches();
        for (sum, part) in self.aside.iter_mut().zip(on_ball) {
            *sum += part;
        }
    }
}
