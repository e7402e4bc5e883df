//! The forces of a contact by their origin.

use crate::contact::{ContactForce, OilForce, PointForce, Sink, WrenchSum};

/// Wrench of a contact on its ball by elastic force, damping and friction.
#[derive(Default)]
pub(super) struct SumsByOrigin(pub [WrenchSum; 3]);

impl SumsByOrigin {
    /// Names of the three.
    pub const NAMES: [&str; 3] = ["contact", "damping", "friction"];
}

impl Sink for SumsByOrigin {
    fn force(&mut self, force: &ContactForce) {
        let [elastic, damping, friction] = &mut self.0;
        elastic.add(force, force.elastic, 0.0);
        damping.add(force, force.normal - force.elastic, 0.0);
        friction.add(force, 0.0, 1.0);
    }

    fn point(&mut self, force: &PointForce) {
        self.0[0].point(force);
    }

    fn oil(&mut self, force: &OilForce) {
        self.0[2].oil(force);
    }
}
