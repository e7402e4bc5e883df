//! Contacts in closed form of balls that keep their axial places, as many as a register holds.

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use super::{InPlane, LawInPlane};
use crate::contact::{Motion, Pair, Torus};
use crate::simd::{Choice, Simd, Vector};

/// A race and how its ring moves.
#[derive(Clone, Copy)]
pub(crate) struct AxiallyFixedRace<'a, S: Simd> {
    law: &'a LawInPlane,
    /// Whether damping may pull.
    clamp: bool,
    /// +1 for the outer, −1 for the inner race.
    sigma: Vector<S>,
    /// Radius of the circle of groove centres \[m\].
    a: Vector<S>,
    /// The balls' axial place from the groove's centre, squared \[m²\].
    offset_squared: Vector<S>,
    /// Ball radius less groove radius \[m\].
    margin: Vector<S>,
    /// Approach up to which the form holds \[m\].
    limit: Vector<S>,
    /// Distance from which balls are lost \[m\], see [`Torus::farthest`].
    farthest: Vector<S>,
    /// 3/2 of the damping \[s/m\].
    damping: Vector<S>,
    centre: [Vector<S>; 2],
    velocity: [Vector<S>; 2],
}

/// Balls in the plane of the scene.
#[derive(Clone, Copy)]
pub(crate) struct AxiallyFixedBalls<S: Simd> {
    pub x: Vector<S>,
    pub y: Vector<S>,
    pub vx: Vector<S>,
    pub vy: Vector<S>,
    /// Raise of the race under them \[m\].
    pub raise: Vector<S>,
    /// Derivative of the radius by the angle \[m\]; none where races are round.
    pub slope: Option<Vector<S>>,
    /// Lanes with a ball whose contact sees no defect. If that is unknown, all are to be left out as soon as
    /// one needs care.
    pub whole: Option<Choice<S>>,
}

/// Forces of a race on balls: the ring gets the opposite.
#[derive(Clone, Copy)]
pub(crate) struct AxiallyFixedForces<S: Simd> {
    /// Force along x and y \[N\].
    pub x: Vector<S>,
    pub y: Vector<S>,
    /// Moment about the ring's centre \[N m\].
    pub moment: Vector<S>,
    /// Contacts that wanted to pull.
    pub pulls: Choice<S>,
    /// Contacts that touch but are left out here: the form does not hold, or they are not whole.
    pub left_out: Choice<S>,
    /// Distance from the groove's centre to the ball's along their line; in the middle of the groove less than nothing beyond the
    /// centre \[m\].
    l: Vector<S>,
}

impl<'a, S: Simd> AxiallyFixedRace<'a, S> {
    #[inline(always)]
    pub fn new(simd: S, pair: &'a Pair, of: &'a InPlane, ring: &Motion) -> Self {
        let all = |x: f64| Vector::all(simd, x);
        let Torus { sigma, a, r, .. } = pair.race;
        Self {
            law: &of.law,
            clamp: pair.law.damping.clamp_pull,
            sigma: all(sigma),
            a: all(a),
            offset_squared: all(of.offset * of.offset),
            margin: all(of.radius - r),
            limit: all(of.limit),
            farthest: all(pair.race.farthest(of.radius)),
            damping: all(pair.law.damping.rate()),
            centre: [all(ring.centre.x), all(ring.centre.y)],
            velocity: [all(ring.velocity.x), all(ring.velocity.y)],
        }
    }

    /// `MIDDLE` where the balls are in the middle of the groove: a branch in the loop would take the root all the same.
    #[inline(always)]
    pub fn forces<const MIDDLE: bool>(
        &self,
        balls: &AxiallyFixedBalls<S>,
    ) -> AxiallyFixedForces<S> {
        let all = |x: f64| self.a.same(x);
        let (zero, one) = (all(0.0), all(1.0));
        let (x, y) = (balls.x - self.centre[0], balls.y - self.centre[1]);
        let d = x.mul_add(x, y * y).sqrt();
        let over = self.sigma / d;
        let n = (x * over, y * over);
        let e = (d - balls.raise - self.a) * self.sigma;
        let l = if MIDDLE {
            e
        } else {
            e.mul_add(e, self.offset_squared).sqrt()
        };
        let approach = l + self.margin;
        let (vx, vy) = (balls.vx - self.velocity[0], balls.vy - self.velocity[1]);
        let speed = vx.mul_add(n.0, vy * n.1);
        let pressed = approach.or_more(zero);
        // Of Hertz's law force and rate of the approach lie along the common normal.
        let (elastic, tilt) = match self.law {
            LawInPlane::Hertz(stiffness) => {
                let tilt = (!MIDDLE).then(|| e / l);
                (pressed * pressed.sqrt() * all(*stiffness), tilt)
            }
            LawInPlane::Iso(series) => (series.forces(pressed), None),
        };
        let rate = tilt.map_or(speed, |tilt| speed * tilt);
        let damped = elastic * rate.mul_add(self.damping, one);
        // What is not a number is not beyond and stays one.
        let beyond = self.limit.below(approach).or(e.below(zero));
        let (elastic, damped, left_out) = if let Some(whole) = balls.whole {
            let apart = zero.below(e).and(approach.below(zero));
            let regular = beyond.not().and(whole);
            let [elastic, damped] = [elastic, damped].map(|force| regular.choose(force, zero));
            (elastic, damped, apart.or(regular).not())
        } else {
            (elastic, damped, beyond)
        };
        let normal = if self.clamp {
            damped.or_more(zero)
        } else {
            damped
        };
        let normal = tilt.map_or(normal, |tilt| normal * tilt);
        let push = zero - normal;
        let (mut force, mut moment) = ((push * n.0, push * n.1), zero);
        if let Some(slope) = balls.slope {
            // The waves' slope: σ F R'(φ) about the ring's centre, F the elastic force in the plane (see `gradient`).
            let radial = tilt.map_or(elastic, |tilt| elastic * tilt);
            let turning = radial * slope;
            let across = turning / d;
            force = (force.0 - across * n.1, force.1 + across * n.0);
            moment = turning * self.sigma;
        }
        AxiallyFixedForces {
            x: force.0,
            y: force.1,
            moment,
            pulls: damped.below(zero),
            left_out,
            l,
        }
    }

    /// Balls that are lost, among those that need care.
    #[inline(always)]
    pub fn lost(&self, forces: &AxiallyFixedForces<S>) -> Choice<S> {
        let inside = forces.l.abs().below(self.farthest);
        forces.left_out.and(inside.not())
    }
}
