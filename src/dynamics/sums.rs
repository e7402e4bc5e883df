//! The forces of a contact by their origin.

use crate::contact::{Aside, OilTouch, Sink, Touch, WrenchSum};

/// Wrench of a contact on its ball by elastic force, damping and friction.
#[derive(Default)]
pub(super) struct SumsByOrigin(pub [WrenchSum; 3]);

impl SumsByOrigin {
    /// Names of the three.
    pub const NAMES: [&str; 3] = ["contact", "damping", "friction"];
}

impl Sink for SumsByOrigin {
    fn touch(&mut self, touch: &Touch) {
        let [elastic, damping, friction] = &mut self.0;
        elastic.add(touch, touch.elastic, 0.0);
        damping.add(touch, touch.normal - touch.elastic, 0.0);
        friction.add(touch, 0.0, 1.0);
    }

    fn aside(&mut self, force: &Aside) {
        self.0[0].aside(force);
    }

    fn oil(&mut self, touch: &OilTouch) {
        self.0[2].oil(touch);
    }
}
