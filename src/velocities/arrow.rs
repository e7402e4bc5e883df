//! A linear system whose matrix is an arrow: every ball is coupled to the two rings only.

// Loops over matrices read as their formulae do.
#![allow(clippy::needless_range_loop)]

use std::array::from_fn;

use nalgebra::SMatrix;

use super::carrier::{Carrier, RingRotation};
use super::matrices::{LaneMatrix, OnBothRings, added, inverse, invert, product};
use crate::contact::AXIAL;
use crate::simd::{LANES, Lanes, Simd, Vector};

/// Balls eliminated by eights, and the rings' own matrix factorised: good for any right-hand side.
///
/// With contacts of slope S between ball and ring, which see w = Φᵀ x − T J X ([`Carrier`]), ball and rings obey
/// (1 − Σ D Φ S Φᵀ) x + Σ D Φ S T J X = r and (1 + d) X − L Σ Tᵀ S (T J X − Φᵀ x) = R. Bodies have N directions.
#[derive(Debug, Clone)]
pub(super) struct Arrow<const N: usize> {
    /// Blocks that the balls put into each ring's rows for either ring, before L and J, and into their right-hand side.
    rings: [[LaneMatrix<N>; 2]; 2],
    right: [[Lanes; N]; 2],
    /// Inverse of the rings' matrix, once there is one; none if it is singular.
    inverse: Option<[[SMatrix<f64, N, N>; 2]; 2]>,
    carriers: [Carrier<N>; 2],
    /// Largest part of a ball's own velocity in its acceleration, times γh.
    pub stiffest: f64,
    eights: Vec<EightBalls<N>>,
}

/// Blocks of eight balls' rows A x + B J X = r and the rings' C x.
#[derive(Debug, Clone)]
struct EightBalls<const N: usize> {
    /// A⁻¹.
    inverse: LaneMatrix<N>,
    /// A⁻¹ B, by ring.
    wide: [LaneMatrix<N>; 2],
    /// Tᵀ S Φᵀ, and whether there is any.
    from: [LaneMatrix<N>; 2],
    touches: [bool; 2],
    /// A⁻¹ r.
    part: [Lanes; N],
}

/// Eight contacts with a ring.
pub(super) struct EightOnRing<'a, const N: usize> {
    /// S, in the ring's frame.
    pub slope: &'a LaneMatrix<N>,
    /// Vector from the origin of that frame to the balls, in it.
    pub apart: [Lanes; 3],
    /// Φ, where it is not 1.
    pub turn: Option<RingRotation<'a>>,
}

impl<const N: usize> Arrow<N> {
    pub fn new(eights: usize) -> Self {
        let none = [[Lanes::ZERO; N]; N];
        let eight = EightBalls {
            inverse: none,
            wide: [none; 2],
            from: [none; 2],
            touches: [false; 2],
            part: [Lanes::ZERO; N],
        };
        Self {
            rings: [[none; 2]; 2],
            right: [[Lanes::ZERO; N]; 2],
            inverse: None,
            carriers: [Carrier::default(); 2],
            stiffest: 0.0,
            eights: vec![eight; eights],
        }
    }

    /// Begins a new matrix.
    pub fn begin(&mut self) {
        self.rings = [[[[Lanes::ZERO; N]; N]; 2]; 2];
        self.stiffest = 0.0;
    }

    /// Eliminates eight balls with their contacts and their D.
    #[inline(always)]
    pub fn eliminate<const FMA: bool>(
        &mut self,
        eight: usize,
        contacts: &[Option<EightOnRing<'_, N>>; 2],
        scale: &[Lanes; N],
    ) {
        let eight = &mut self.eights[eight];
        let mut own = [[Lanes::ZERO; N]; N];
        let mut to = [[[Lanes::ZERO; N]; N]; 2];
        for (s, contact) in contacts.iter().enumerate() {
            eight.touches[s] = contact.is_some();
            let Some(EightOnRing { slope, apart, turn }) = contact else {
                continue;
            };
            // Of the ring: Tᵀ S, and Tᵀ S T.
            let mut from = carried_back::<FMA, N>(slope, apart);
            for i in 0..N {
                let carried = carried::<FMA, N>(&from[i], apart);
                for j in 0..N {
                    self.rings[s][s][i][j] += carried[j];
                }
            }
            let mut both = **slope;
            if let Some(turn) = turn {
                turn.rows::<FMA, N>(&mut both);
            }
            for i in 0..N {
                let carried = carried::<FMA, N>(&both[i], apart);
                for j in 0..N {
                    to[s][i][j] = scale[i] * carried[j];
                }
            }
            if let Some(turn) = turn {
                turn.columns::<FMA, N>(&mut both);
                turn.columns::<FMA, N>(&mut from);
            }
            for i in 0..N {
                for j in 0..N {
                    own[i][j] = own[i][j] - both[i][j];
                }
            }
            eight.from[s] = from;
        }
        for i in 0..N {
            for j in 0..N {
                own[i][j] = own[i][j] * scale[i];
            }
            self.stiffest = self.stiffest.max(own[i][i].greatest());
            own[i][i] = own[i][i] + 1.0;
        }
        invert::<FMA, N>(&mut own);
        for s in 0..2 {
            for i in 0..N {
                for j in 0..N {
                    let mut sum = own[i][0] * to[s][0][j];
                    for k in 1..N {
                        sum = own[i][k].mul_add::<FMA>(to[s][k][j], sum);
                    }
                    eight.wide[s][i][j] = sum;
                }
            }
        }
        eight.inverse = own;
        for s in (0..2).filter(|&s| eight.touches[s]) {
            // Tᵀ S (T J X − Φᵀ x), with x = A⁻¹ r − A⁻¹ B J X.
            for (row, i) in eight.from[s].iter().zip(0..N) {
                for other in 0..2 {
                    let sums = &mut self.rings[s][other][i];
                    for k in 0..N {
                        for j in 0..N {
                            sums[j] = row[k].mul_add::<FMA>(eight.wide[other][k][j], sums[j]);
                        }
                    }
                }
            }
        }
    }

    /// Ends the matrix with the rings' 1 + d, and what carries them.
    pub fn factorise(&mut self, diagonal: &OnBothRings<N>, carriers: &[Carrier<N>; 2]) {
        let blocks: [[SMatrix<f64, N, N>; 2]; 2] = from_fn(|s| {
            from_fn(|other| {
                let of = SMatrix::from_fn(|i, j| self.rings[s][other][i][j].sum());
                carriers[s].scale * of * carriers[other].seen
            })
        });
        self.inverse = inverse(|i, j| {
            let own = if i == j { diagonal[i / N][i % N] } else { 0.0 };
            own - blocks[i / N][j / N][(i % N, j % N)]
        });
        self.carriers = *carriers;
    }

    /// Begins a new right-hand side.
    pub fn begin_right(&mut self) {
        self.right = [[Lanes::ZERO; N]; 2];
    }

    /// Eliminates eight balls from the right-hand side.
    // In registers: of loops over lanes the compiler makes gathers along the matrices (`benches/records.md`).
    #[inline(always)]
    pub fn eliminate_right<S: Simd>(&mut self, simd: S, eight: usize, right: &[Lanes; N]) {
        let EightBalls {
            inverse,
            from,
            touches,
            part,
            ..
        } = &mut self.eights[eight];
        for at in (0..LANES).step_by(Vector::<S>::LANES) {
            let own = product(simd, at, inverse, right);
            for (to, own) in part.iter_mut().zip(own) {
                own.store(&mut to.numbers_mut()[at..]);
            }
            for s in (0..2).filter(|&s| touches[s]) {
                let to_ring = product(simd, at, &from[s], part);
                for (to, more) in self.right[s].iter_mut().zip(to_ring) {
                    let to = &mut to.numbers_mut()[at..];
                    (Vector::load(simd, to) + more).store(to);
                }
            }
        }
    }

    /// The rings' unknowns for their R; none if the system is singular.
    #[inline(always)]
    pub fn rings(&self, right: &OnBothRings<N>) -> Option<OnBothRings<N>> {
        let inverse = self.inverse.as_ref()?;
        let known: OnBothRings<N> = from_fn(|s| {
            let sums = from_fn(|i| -self.right[s][i].sum());
            added(right[s], &self.carriers[s].scale, &sums)
        });
        Some(from_fn(|s| {
            let first = added([0.0; N], &inverse[s][0], &known[0]);
            added(first, &inverse[s][1], &known[1])
        }))
    }

    /// The rings' unknowns as the contacts see them, J X.
    #[inline(always)]
    pub fn seen(&self, rings: &OnBothRings<N>) -> OnBothRings<N> {
        from_fn(|s| added([0.0; N], &self.carriers[s].seen, &rings[s]))
    }

    /// The unknowns of eight balls, once the rings' are known as the contacts see them.
    #[inline(always)]
    pub fn balls<S: Simd>(&self, simd: S, eight: usize, rings: &OnBothRings<N>) -> [Lanes; N] {
        let EightBalls { part, wide, .. } = &self.eights[eight];
        let mut balls = *part;
        for at in (0..LANES).step_by(Vector::<S>::LANES) {
            for (i, ball) in balls.iter_mut().enumerate() {
                let to = &mut ball.numbers_mut()[at..];
                let mut x = Vector::load(simd, to);
                for (wide, ring) in wide.iter().zip(rings) {
                    for (wide, ring) in wide[i].iter().zip(ring) {
                        x = x - Vector::load(simd, &wide.numbers()[at..]) * *ring;
                    }
                }
                x.store(to);
            }
        }
        balls
    }
}

/// A row times T: a ring that turns about an axis e moves what stands at a by e × a.
#[inline(always)]
fn carried<const FMA: bool, const N: usize>(row: &[Lanes; N], a: &[Lanes; 3]) -> [Lanes; N] {
    let mut carried = *row;
    let about = |i: usize, j: usize, own: Lanes| {
        let turned = row[j].mul_add::<FMA>(a[i], own);
        (-row[i]).mul_add::<FMA>(a[j], turned)
    };
    carried[3] = about(0, 1, row[3]);
    if N > AXIAL {
        carried[AXIAL] = about(1, 2, row[AXIAL]);
        carried[AXIAL + 1] = about(2, 0, row[AXIAL + 1]);
    }
    carried
}

/// Tᵀ times a matrix.
#[inline(always)]
fn carried_back<const FMA: bool, const N: usize>(
    of: &LaneMatrix<N>,
    a: &[Lanes; 3],
) -> LaneMatrix<N> {
    let mut carried = *of;
    for k in 0..N {
        let mut column = [Lanes::ZERO; N];
        for i in 0..N {
            column[i] = of[i][k];
        }
        let column = self::carried::<FMA, N>(&column, a);
        for i in 3..N {
            carried[i][k] = column[i];
        }
    }
    carried
}

/// The truth is the residual of the written-out system.
#[cfg(test)]
mod tests {
    use nalgebra::{SMatrix, SVector};

    use super::*;
    use crate::contact::FREE;
    use crate::simd::{InstructionSet, Wide};
    use crate::tilt::Frame;

    type Square<const N: usize> = SMatrix<f64, N, N>;

    fn block<const N: usize>(seed: f64) -> Square<N> {
        SMatrix::from_fn(|i, j| (seed + (5 * i + 3 * j) as f64).sin())
    }

    /// T of a ball at a place: what a ring's turning moves there.
    fn carry<const N: usize>([x, y, z]: [f64; 3]) -> Square<N> {
        let mut carry = SMatrix::identity();
        // e × a for e along z, x and y.
        for (column, moved) in [[-y, x, 0.0], [0.0, -z, y], [z, 0.0, -x]]
            .iter()
            .enumerate()
        {
            for i in (0..3).filter(|_| 3 + column < N) {
                carry[(i, 3 + column)] = moved[i];
            }
        }
        carry
    }

    /// Φ.
    fn turned<const N: usize>(frame: &Frame) -> Square<N> {
        let mut turned = SMatrix::identity();
        for at in [[0, 1, 2], [4, 5, 3]]
            .iter()
            .take(if N > AXIAL { 2 } else { 0 })
        {
            for j in 0..3 {
                let unit = nalgebra::Vector3::ith(j, 1.0);
                for i in 0..3 {
                    turned[(at[i], at[j])] = frame.to_scene(&unit)[i];
                }
            }
        }
        turned
    }

    /// The unknowns of the rings and of sixteen balls.
    struct SolveArrow<'a, const N: usize> {
        arrow: &'a mut Arrow<N>,
        right: [[Lanes; N]; 2],
        ring_right: OnBothRings<N>,
    }

    impl<const N: usize> Wide for SolveArrow<'_, N> {
        type Output = (OnBothRings<N>, [[Lanes; N]; 2]);

        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let Self { arrow, right, .. } = self;
            arrow.begin_right();
            for (eight, right) in right.iter().enumerate() {
                arrow.eliminate_right(simd, eight, right);
            }
            let rings = arrow.rings(&self.ring_right).unwrap();
            let seen = arrow.seen(&rings);
            (rings, [0, 1].map(|eight| arrow.balls(simd, eight, &seen)))
        }
    }

    fn solves_the_arrow<const N: usize>() {
        // Ball by ring and lane; the second eight has no contact with the first ring.
        let slope = |eight: usize, s: usize, lane: usize| {
            block::<N>((eight * 31 + s * 7 + lane) as f64) - SMatrix::identity() * 4.0
        };
        let apart = |s: usize, lane: usize| [0.3 + lane as f64 / 9.0, 0.7 - s as f64, 0.2];
        let right = |eight: usize, lane: usize| {
            SVector::<f64, N>::from_fn(|i, _| ((eight * 8 + lane * 3 + i) as f64).cos())
        };
        let frames = [Frame::new([0.2, -0.1]), Frame::new([-0.3, 0.4])];
        let scale: [f64; N] = from_fn(|i| [0.5, 0.25, 1.0, 0.0, 0.7, 0.3][i]);
        let carriers = [0, 1].map(|s| Carrier {
            seen: block::<N>(3.0 + f64::from(s)) * 0.2 + SMatrix::identity(),
            scale: block::<N>(8.0 + f64::from(s)) * 0.3,
        });
        let ring_right: OnBothRings<N> = from_fn(|s| from_fn(|i| (s * N + i) as f64));
        let mut arrow = Arrow::<N>::new(2);
        arrow.begin();
        let has = |eight: usize, s: usize| eight == 0 || s == 1;
        for eight in 0..2 {
            let blocks: [LaneMatrix<N>; 2] = [0, 1].map(|s| {
                from_fn(|i| from_fn(|j| Lanes::from_fn(|lane| slope(eight, s, lane)[(i, j)])))
            });
            let contacts = [0, 1].map(|s| {
                let apart = [0, 1, 2].map(|k| Lanes::from_fn(|lane| apart(s, lane)[k]));
                let turn = (N > AXIAL).then_some(RingRotation::of(&frames[s]));
                let slope = &blocks[s];
                has(eight, s).then_some(EightOnRing { slope, apart, turn })
            });
            arrow.eliminate::<true>(eight, &contacts, &scale.map(Lanes::all));
        }
        arrow.factorise(&[[9.0; N]; 2], &carriers);
        let (rings, balls) = InstructionSet::current().run_wide(SolveArrow {
            arrow: &mut arrow,
            right: from_fn(|eight| from_fn(|i| Lanes::from_fn(|lane| right(eight, lane)[i]))),
            ring_right,
        });
        let mut sums = [0, 1].map(|s| SVector::from(rings[s]) * 9.0 - SVector::from(ring_right[s]));
        for eight in 0..2 {
            for lane in 0..8 {
                let ball = SVector::<f64, N>::from_fn(|i, _| balls[eight][i][lane]);
                let mut off = ball - right(eight, lane);
                for s in (0..2).filter(|&s| has(eight, s)) {
                    let (carry, turn) = (carry::<N>(apart(s, lane)), turned::<N>(&frames[s]));
                    let ring = carriers[s].seen * SVector::from(rings[s]);
                    let force = slope(eight, s, lane) * (turn.tr_mul(&ball) - carry * ring);
                    off -= SVector::from(scale).component_mul(&(turn * force));
                    sums[s] += carriers[s].scale * carry.tr_mul(&force);
                }
                assert!(off.norm() < 1e-12, "ball {lane} of {eight}: {off}");
            }
        }
        assert!(sums.iter().all(|sum| sum.norm() < 1e-11), "{sums:?}");
    }

    #[test]
    fn solves_the_arrow_it_was_given() {
        solves_the_arrow::<AXIAL>();
        solves_the_arrow::<FREE>();
    }
}
