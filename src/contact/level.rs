//! Contacts in closed form of balls that keep their axial places, as many as a register holds.

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use super::closed::{InPlane, LawInPlane};
use super::{Motion, Pair, Torus};
use crate::simd::{Choice, Simd, Vector};

/// A race and how its ring moves.
pub(crate) struct LevelRace<'a, S: Simd> {
    pair: &'a Pair,
    of: &'a InPlane,
    ring: &'a Motion,
    simd: S,
}

/// Balls in the plane of the scene.
#[derive(Clone, Copy)]
pub(crate) struct LevelBalls<S: Simd> {
    pub x: Vector<S>,
    pub y: Vector<S>,
    pub vx: Vector<S>,
    pub vy: Vector<S>,
    /// Raise of the race under them \[m\].
    pub raise: Vector<S>,
    /// Where there is a ball, whose contact sees no defect.
    pub whole: Choice<S>,
}

/// What a race puts on balls: the ring gets the opposite.
pub(crate) struct LevelForces<S: Simd> {
    /// Along x and y \[N\].
    pub x: Vector<S>,
    pub y: Vector<S>,
    /// Which contacts wanted to pull.
    pub pulls: Choice<S>,
    /// Which touch but are left out here: the form does not hold, or they are not whole.
    pub careful: Choice<S>,
    /// Pressed deeper than half the radius; what is not a number counts as lost.
    pub lost: Choice<S>,
}

impl<'a, S: Simd> LevelRace<'a, S> {
    pub fn new(simd: S, pair: &'a Pair, of: &'a InPlane, ring: &'a Motion) -> Self {
        Self {
            pair,
            of,
            ring,
            simd,
        }
    }

    #[inline(always)]
    pub fn press(&self, balls: &LevelBalls<S>) -> LevelForces<S> {
        let all = |x: f64| Vector::all(self.simd, x);
        let (zero, one) = (all(0.0), all(1.0));
        let Torus { sigma, a, r, .. } = self.pair.race;
        let ring = self.ring;
        let (x, y) = (balls.x - all(ring.centre.x), balls.y - all(ring.centre.y));
        let d = x.mul_add(x, y * y).sqrt();
        let over = all(sigma) / d;
        let n = (x * over, y * over);
        let e = (d - balls.raise - all(a)) * all(sigma);
        let l = if self.of.offset == 0.0 {
            e
        } else {
            e.mul_add(e, all(self.of.offset * self.of.offset)).sqrt()
        };
        let approach = l + all(self.of.radius - r);
        let speed =
            (balls.vx - all(ring.velocity.x)).mul_add(n.0, (balls.vy - all(ring.velocity.y)) * n.1);
        let pressed = approach.or_more(zero);
        let (elastic, tilt) = match &self.of.law {
            // Force and rate of the approach lie along the common normal.
            LawInPlane::Hertz(stiffness) => {
                let tilt = (self.of.offset != 0.0).then(|| e / l);
                (pressed * pressed.sqrt() * all(*stiffness), tilt)
            }
            LawInPlane::Iso(series) => (series.forces(pressed), None),
        };
        let rate = tilt.map_or(speed, |tilt| speed * tilt);
        let damped = elastic * rate.mul_add(all(1.5 * self.pair.damping), one);
        // Negated, so that what is not a number counts as touching and stays one.
        let in_front = zero.below(e);
        let touching = in_front.and(approach.below(zero)).not();
        let simple = all(self.of.limit)
            .below(approach)
            .or(e.below(zero))
            .not()
            .and(balls.whole);
        let damped = simple.choose(damped, zero);
        let normal = if self.pair.clamp_pull {
            damped.or_more(zero)
        } else {
            damped
        };
        let normal = tilt.map_or(normal, |tilt| normal * tilt);
        LevelForces {
            x: -(normal * n.0),
            y: -(normal * n.1),
            pulls: damped.below(zero),
            careful: touching.and(simple.not()),
            lost: approach.below(all(0.5 * self.of.radius)).not(),
        }
    }
}
