//! The loop of the planar right-hand side.

// Everything here must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]

use super::{Balls, Direction, Planar};
use crate::contact::{AxiallyFixedBalls, AxiallyFixedRace, InPlane, Motion, Pair, V2};
use crate::forces::cage::links::pull;
use crate::forces::support::resistance;
use crate::model::{Model, Race};
use crate::scene::CageLinks;
use crate::simd::{Simd, Vector, Wide};

/// Finds the rates of a state; false where the general right-hand side must.
pub(in crate::dynamics) struct Rates<'a> {
    pub planar: &'a mut Planar,
    pub model: &'a Model,
    pub y: &'a [f64],
    pub dy: &'a mut [f64],
}

impl Wide for Rates<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let Self {
            planar,
            model,
            y,
            dy,
        } = self;
        let (q, v) = y.split_at(y.len() / 2);
        let (rates, accelerations) = dy.split_at_mut(q.len());
        rates.copy_from_slice(v);
        let rings = [
            planar.motion(Race::Outer, q, v),
            planar.motion(Race::Inner, q, v),
        ];
        let mut on_rings = [[0.0; 2]; 2];
        for row in &mut planar.rows {
            let compiled = &model.rows[row.row];
            if let Some(cage) = model.scene.cage_links() {
                row.link(simd, cage, compiled.cage_distance, q, v);
            }
            let pairs = &compiled.pairs;
            let plain = if row.forms.iter().all(InPlane::is_middle) {
                row.forces::<S, true>(simd, pairs, &rings, q, v, accelerations, &mut on_rings)
            } else {
                row.forces::<S, false>(simd, pairs, &rings, q, v, accelerations, &mut on_rings)
            };
            if !plain {
                return false;
            }
        }
        for (ring, forces) in planar.rings.iter().zip(on_rings) {
            for (direction, force) in ring.iter().zip(forces) {
                direction.accelerate(planar.times * force, q, v, accelerations);
            }
        }
        true
    }
}

impl Planar {
    #[inline(always)]
    fn motion(&self, race: Race, q: &[f64], v: &[f64]) -> Motion {
        let [x, y] = &self.rings[race];
        let ((x, vx), (y, vy)) = (x.of(q, v), y.of(q, v));
        Motion {
            centre: V2::new(x, y),
            velocity: V2::new(vx, vy),
            ..Motion::default()
        }
    }
}

impl Direction {
    /// Place and speed.
    #[inline(always)]
    fn of(&self, q: &[f64], v: &[f64]) -> (f64, f64) {
        self.at.map_or((self.place, 0.0), |at| (q[at], v[at]))
    }

    /// Writes the acceleration by a force of the contacts, the support's spring and the steady forces.
    #[inline(always)]
    fn accelerate(&self, force: f64, q: &[f64], v: &[f64], to: &mut [f64]) {
        let Some(at) = self.at else { return };
        let spring = self
            .spring
            .as_ref()
            .map_or(0.0, |spring| resistance(spring, q[at], v[at]));
        to[at] = (force + self.steady - spring) * self.mobility;
    }
}

impl Balls {
    /// Balls along x or y.
    #[inline(always)]
    fn of<'a>(&self, direction: usize, of: &'a [f64]) -> &'a [f64] {
        &of[self.at[direction]..][..self.count]
    }

    /// The forces of the cage's links.
    #[inline(always)]
    fn link<S: Simd>(&mut self, simd: S, cage: &CageLinks, nominal: f64, q: &[f64], v: &[f64]) {
        let all = |x: f64| Vector::all(simd, x);
        let of = [self.of(0, q), self.of(1, q), self.of(0, v), self.of(1, v)];
        let last = self.count - 1;
        let mut apart = [all(0.0); 4];
        for (apart, of) in apart.iter_mut().zip(of) {
            *apart = all(of[0] - of[last]);
        }
        let closing = pull(cage, nominal, apart);
        for (links, closing) in self.links.iter_mut().zip(closing) {
            (links[0], links[last + 1]) = (closing.first(), closing.first());
        }
        for (at, _) in Vector::<S>::cover(last) {
            for (apart, of) in apart.iter_mut().zip(of) {
                *apart = Vector::load(simd, &of[at + 1..]) - Vector::load(simd, &of[at..]);
            }
            for (links, pull) in self.links.iter_mut().zip(pull(cage, nominal, apart)) {
                pull.store(&mut links[at + 1..]);
            }
        }
    }

    /// The contacts, and the accelerations of the balls by all forces; false where a contact is out of the reach of its form.
    #[allow(clippy::too_many_arguments)]
    #[inline(always)]
    fn forces<S: Simd, const MIDDLE: bool>(
        &self,
        simd: S,
        pairs: &[Pair; 2],
        rings: &[Motion; 2],
        q: &[f64],
        v: &[f64],
        to: &mut [f64],
        on_rings: &mut [[f64; 2]; 2],
    ) -> bool {
        let all = |x: f64| Vector::all(simd, x);
        let (zero, mobility) = (all(0.0), all(self.mobility));
        let steady = [all(self.steady[0]), all(self.steady[1])];
        let n = self.count;
        let races = [
            AxiallyFixedRace::new(simd, &pairs[0], &self.forms[0], &rings[0]),
            AxiallyFixedRace::new(simd, &pairs[1], &self.forms[1], &rings[1]),
        ];
        let [x, y, vx, vy] = [self.of(0, q), self.of(1, q), self.of(0, v), self.of(1, v)];
        let [ahead, behind] = [1, 0].map(|from| self.links.each_ref().map(|of| &of[from..][..n]));
        let mut sums = [[zero; 2]; 2];
        for (at, again) in Vector::<S>::cover(n) {
            let balls = AxiallyFixedBalls {
                x: Vector::load(simd, &x[at..]),
                y: Vector::load(simd, &y[at..]),
                vx: Vector::load(simd, &vx[at..]),
                vy: Vector::load(simd, &vy[at..]),
                raise: zero,
                slope: None,
                whole: None,
            };
            let outer = races[0].forces::<MIDDLE>(&balls);
            let inner = races[1].forces::<MIDDLE>(&balls);
            let odd = [outer, inner].map(|of| of.left_out.or(of.pulls));
            if odd[0].or(odd[1]).any() {
                return false;
            }
            let forces = [outer.x + inner.x, outer.y + inner.y];
            for (i, force) in forces.into_iter().enumerate() {
                let [ahead, behind] = [ahead[i], behind[i]].map(|of| Vector::load(simd, &of[at..]));
                let force = force + (ahead - behind) + steady[i];
                (force * mobility).store(&mut to[self.at[i]..][..n][at..]);
            }
            for (sums, mut found) in sums.iter_mut().zip([outer, inner]) {
                if again > 0 {
                    let new = all(again as f64 - 0.5).below(Vector::count(simd));
                    (found.x, found.y) = (new.choose(found.x, zero), new.choose(found.y, zero));
                }
                sums[0] += found.x;
                sums[1] += found.y;
            }
        }
        for (on_ring, [x, y]) in on_rings.iter_mut().zip(sums) {
            on_ring[0] -= x.sum();
            on_ring[1] -= y.sum();
        }
        true
    }
}
