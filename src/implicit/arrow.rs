//! A linear system whose matrix is an arrow: every ball is coupled to the two rings only.

// Everything in lanes must be compiled for the instructions of its caller.
#![allow(clippy::inline_always)]
// Loops over matrices read as their formulae do.
#![allow(clippy::needless_range_loop)]

use nalgebra::{Const, LU, SMatrix, SVector};

use crate::model::{DOFS, RING_DOFS};
use crate::simd::Lanes;

type Rings = SVector<f64, RING_DOFS>;
type Factors = LU<f64, Const<RING_DOFS>, Const<RING_DOFS>>;

/// A matrix for each of eight balls, of which a row is a direction of the ball.
pub(super) type Block<const ROWS: usize, const COLUMNS: usize> = [[Lanes; COLUMNS]; ROWS];

/// Balls eliminated by eights, and the rings' own matrix factorised: good for any right-hand side.
///
/// With contacts of slope S between ball and ring, w = v_b − T v_r, ball and rings obey
/// (1 − Σ D S) x + Σ D S T X = r and (1 + d) X − D_r Σ Tᵀ S (T X − x) = R. Balls have N directions, rings those along the axes and
/// about z: what turns across the axis is the ball alone.
#[derive(Debug, Clone)]
pub(super) struct Arrow<const N: usize> {
    /// What the balls put into the rings' rows, before D_r, and into their right-hand side.
    rings: [[Lanes; RING_DOFS]; RING_DOFS],
    right: [Lanes; RING_DOFS],
    factors: Option<Factors>,
    scale: Rings,
    eights: Vec<Eight<N>>,
}

/// Of the balls' rows A x + B X = r and the rings' C x.
#[derive(Debug, Clone)]
struct Eight<const N: usize> {
    /// A⁻¹.
    inverse: Block<N, N>,
    /// A⁻¹ B.
    wide: Block<N, RING_DOFS>,
    /// Tᵀ S, and whether there is any.
    from: [Block<DOFS, N>; 2],
    touches: [bool; 2],
    /// A⁻¹ r.
    part: [Lanes; N],
}

/// The slopes S of eight contacts, and where the balls are from the ring's centre.
pub(super) type Contacts<'a, const N: usize> = Option<(&'a Block<N, N>, [Lanes; 2])>;

impl<const N: usize> Arrow<N> {
    pub fn new(eights: usize) -> Self {
        let eight = Eight {
            inverse: [[Lanes::ZERO; N]; N],
            wide: [[Lanes::ZERO; RING_DOFS]; N],
            from: [[[Lanes::ZERO; N]; DOFS]; 2],
            touches: [false; 2],
            part: [Lanes::ZERO; N],
        };
        Self {
            rings: [[Lanes::ZERO; RING_DOFS]; RING_DOFS],
            right: [Lanes::ZERO; RING_DOFS],
            factors: None,
            scale: Rings::zeros(),
            eights: vec![eight; eights],
        }
    }

    /// Begins a new matrix.
    pub fn begin(&mut self) {
        self.rings = [[Lanes::ZERO; RING_DOFS]; RING_DOFS];
    }

    /// Eliminates eight balls with their contacts and their D.
    #[inline(always)]
    pub fn eliminate<const FMA: bool>(
        &mut self,
        eight: usize,
        contacts: &[Contacts<'_, N>; 2],
        scale: &[Lanes; N],
    ) {
        let eight = &mut self.eights[eight];
        let mut own = [[Lanes::ZERO; N]; N];
        let mut to = [[Lanes::ZERO; RING_DOFS]; N];
        for (s, contact) in contacts.iter().enumerate() {
            eight.touches[s] = contact.is_some();
            let Some((slope, apart)) = *contact else {
                continue;
            };
            for i in 0..N {
                let carried = carried::<FMA, N>(&slope[i], apart);
                for j in 0..N {
                    own[i][j] = own[i][j] - slope[i][j];
                }
                for j in 0..DOFS {
                    to[i][DOFS * s + j] = scale[i] * carried[j];
                }
            }
            let from = &mut eight.from[s];
            from.copy_from_slice(&slope[..DOFS]);
            for j in 0..N {
                let turned = slope[1][j].mul_add::<FMA>(apart[0], slope[3][j]);
                from[3][j] = (-slope[0][j]).mul_add::<FMA>(apart[1], turned);
            }
        }
        for i in 0..N {
            for j in 0..N {
                own[i][j] = own[i][j] * scale[i];
            }
            own[i][i] = own[i][i] + 1.0;
        }
        invert::<FMA, N>(&mut own);
        for i in 0..N {
            for j in 0..RING_DOFS {
                let mut sum = own[i][0] * to[0][j];
                for k in 1..N {
                    sum = own[i][k].mul_add::<FMA>(to[k][j], sum);
                }
                eight.wide[i][j] = sum;
            }
        }
        eight.inverse = own;
        for (s, contact) in contacts.iter().enumerate() {
            let Some((_, apart)) = *contact else {
                continue;
            };
            // Tᵀ S (T X − x), with x = A⁻¹ r − A⁻¹ B X.
            for (row, sums) in eight.from[s].iter().zip(&mut self.rings[DOFS * s..]) {
                let own = carried::<FMA, N>(row, apart);
                for j in 0..DOFS {
                    sums[DOFS * s + j] += own[j];
                }
                for k in 0..N {
                    for j in 0..RING_DOFS {
                        sums[j] = row[k].mul_add::<FMA>(eight.wide[k][j], sums[j]);
                    }
                }
            }
        }
    }

    /// Ends the matrix with the rings' 1 + d and D.
    pub fn factorise(&mut self, diagonal: &Rings, scale: &Rings) {
        let mut matrix = SMatrix::<f64, RING_DOFS, RING_DOFS>::from_diagonal(diagonal);
        for i in (0..RING_DOFS).filter(|&i| scale[i] != 0.0) {
            for j in 0..RING_DOFS {
                matrix[(i, j)] -= scale[i] * self.rings[i][j].sum();
            }
        }
        self.factors = Some(matrix.lu());
        self.scale = *scale;
    }

    /// Begins a new right-hand side.
    pub fn begin_right(&mut self) {
        self.right = [Lanes::ZERO; RING_DOFS];
    }

    /// Eliminates eight balls from the right-hand side.
    #[inline(always)]
    pub fn eliminate_right<const FMA: bool>(&mut self, eight: usize, right: &[Lanes; N]) {
        let eight = &mut self.eights[eight];
        eight.part = product::<FMA, _, _>(&eight.inverse, right);
        for s in (0..2).filter(|&s| eight.touches[s]) {
            let sums = product::<FMA, _, _>(&eight.from[s], &eight.part);
            for i in 0..DOFS {
                self.right[DOFS * s + i] += sums[i];
            }
        }
    }

    /// The rings' unknowns for their R; none if the system is singular.
    pub fn rings(&self, right: &Rings) -> Option<Rings> {
        let of = |i: usize| right[i] - self.scale[i] * self.right[i].sum();
        let known = Rings::from_fn(|i, _| of(i));
        self.factors.as_ref()?.solve(&known)
    }

    /// The unknowns of eight balls, once the rings' are known.
    #[inline(always)]
    pub fn balls<const FMA: bool>(&self, eight: usize, rings: &Rings) -> [Lanes; N] {
        let Eight { part, wide, .. } = &self.eights[eight];
        let mut x = *part;
        for i in 0..N {
            for j in 0..RING_DOFS {
                x[i] = x[i] - wide[i][j] * rings[j];
            }
        }
        x
    }
}

#[inline(always)]
fn product<const FMA: bool, const ROWS: usize, const N: usize>(
    a: &Block<ROWS, N>,
    x: &[Lanes; N],
) -> [Lanes; ROWS] {
    let mut product = [Lanes::ZERO; ROWS];
    for i in 0..ROWS {
        product[i] = a[i][0] * x[0];
        for k in 1..N {
            product[i] = a[i][k].mul_add::<FMA>(x[k], product[i]);
        }
    }
    product
}

/// A row times T, whose last column is (−a_y, a_x, 0, 1).
#[inline(always)]
fn carried<const FMA: bool, const N: usize>(row: &[Lanes; N], apart: [Lanes; 2]) -> [Lanes; DOFS] {
    let turned = row[1].mul_add::<FMA>(apart[0], row[3]);
    let last = (-row[0]).mul_add::<FMA>(apart[1], turned);
    [row[0], row[1], row[2], last]
}

/// Replaces a matrix by its inverse (Gauss and Jordan).
///
/// There is no pivoting: 1 − D S is the unit matrix and what friction and damping add to its definite side.
#[inline(always)]
fn invert<const FMA: bool, const N: usize>(a: &mut Block<N, N>) {
    for k in 0..N {
        let inverse = Lanes::all(1.0) / a[k][k];
        a[k][k] = Lanes::all(1.0);
        for j in 0..N {
            a[k][j] = a[k][j] * inverse;
        }
        for i in (0..N).filter(|&i| i != k) {
            let factor = -a[i][k];
            a[i][k] = Lanes::ZERO;
            for j in 0..N {
                a[i][j] = factor.mul_add::<FMA>(a[k][j], a[i][j]);
            }
        }
    }
}

/// The truth is the residual of the written-out system.
#[cfg(test)]
mod tests {
    use nalgebra::{SMatrix, SVector, Vector4};

    use super::*;

    fn block<const N: usize>(seed: f64) -> SMatrix<f64, N, N> {
        SMatrix::from_fn(|i, j| (seed + (5 * i + 3 * j) as f64).sin())
    }

    /// T: what turns across the axis is the ball alone.
    fn carry<const N: usize>(apart: [f64; 2]) -> SMatrix<f64, N, DOFS> {
        let mut carry = SMatrix::identity();
        (carry[(0, 3)], carry[(1, 3)]) = (-apart[1], apart[0]);
        carry
    }

    fn solves_the_arrow<const N: usize>() {
        // Ball by ring and lane; the second eight has no contact with the first ring.
        let slope = |eight: usize, s: usize, lane: usize| {
            block::<N>((eight * 31 + s * 7 + lane) as f64) - SMatrix::identity() * 4.0
        };
        let apart = |s: usize, lane: usize| [0.3 + lane as f64 / 9.0, 0.7 - s as f64];
        let right = |eight: usize, lane: usize| {
            SVector::<f64, N>::from_fn(|i, _| ((eight * 8 + lane * 3 + i) as f64).cos())
        };
        let scale: [f64; N] = std::array::from_fn(|i| [0.5, 0.25, 1.0, 0.0, 0.7, 0.3][i]);
        let (ring_scale, diagonal) = (Rings::from_fn(|i, _| i as f64 / 4.0), Rings::repeat(9.0));
        let ring_right = Rings::from_fn(|i, _| i as f64);
        let mut arrow = Arrow::<N>::new(2);
        arrow.begin();
        arrow.begin_right();
        let has = |eight: usize, s: usize| eight == 0 || s == 1;
        for eight in 0..2 {
            let blocks: [Block<N, N>; 2] = [0, 1].map(|s| {
                std::array::from_fn(|i| {
                    std::array::from_fn(|j| Lanes::from_fn(|lane| slope(eight, s, lane)[(i, j)]))
                })
            });
            let contacts = [0, 1].map(|s| {
                let apart = [0, 1].map(|k| Lanes::from_fn(|lane| apart(s, lane)[k]));
                has(eight, s).then_some((&blocks[s], apart))
            });
            let right = std::array::from_fn(|i| Lanes::from_fn(|lane| right(eight, lane)[i]));
            arrow.eliminate::<true>(eight, &contacts, &scale.map(Lanes::all));
            arrow.eliminate_right::<true>(eight, &right);
        }
        arrow.factorise(&diagonal, &ring_scale);
        let rings = arrow.rings(&ring_right).unwrap();
        let ring = |s: usize| Vector4::from(rings.fixed_rows::<4>(4 * s));
        let mut sums = diagonal.component_mul(&rings) - ring_right;
        for eight in 0..2 {
            let balls = arrow.balls::<true>(eight, &rings);
            for lane in 0..8 {
                let ball = SVector::<f64, N>::from_fn(|i, _| balls[i][lane]);
                let mut off = ball - right(eight, lane);
                for s in (0..2).filter(|&s| has(eight, s)) {
                    let carry = carry::<N>(apart(s, lane));
                    let force = slope(eight, s, lane) * (ball - carry * ring(s));
                    off -= SVector::from(scale).component_mul(&force);
                    let mut rows = sums.fixed_rows_mut::<4>(4 * s);
                    let scale = ring_scale.fixed_rows::<4>(4 * s);
                    rows += scale.component_mul(&carry.tr_mul(&force));
                }
                assert!(off.norm() < 1e-12, "ball {lane} of {eight}: {off}");
            }
        }
        assert!(sums.norm() < 1e-11, "{sums}");
    }

    #[test]
    fn solves_the_arrow_it_was_given() {
        solves_the_arrow::<4>();
        solves_the_arrow::<6>();
    }
}
