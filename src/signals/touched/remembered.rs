//! State on which the counts of passes over defects depend, for a run that goes on.

use super::{DefectWatch, MostLoaded, Pass};
use crate::base::words::{Remembered, Words};
use crate::model::Race;

impl Remembered for DefectWatch {
    fn pass(&mut self, words: &mut Words) {
        self.y.pass(words);
        self.next.pass(words);
        for of in &mut self.defects {
            of.passes.pass(words);
            of.touched.pass(words);
            of.largest_load.pass(words);
            of.most.pass(words);
            for contact in &mut of.contacts {
                contact.offset.pass(words);
                contact.pass.pass(words);
            }
        }
    }
}

impl Remembered for MostLoaded {
    fn pass(&mut self, words: &mut Words) {
        self.load.pass(words);
        self.place.pass(words);
        let mut is_inner = self.race == Race::Inner;
        is_inner.pass(words);
        self.race = if is_inner { Race::Inner } else { Race::Outer };
    }
}

impl Remembered for Pass {
    fn pass(&mut self, words: &mut Words) {
        let known = [Self::None, Self::Untouched, Self::Touched];
        let mut at = known.iter().position(|pass| pass == self).unwrap_or(0);
        at.pass(words);
        *self = known.get(at).copied().unwrap_or(Self::None);
    }
}
