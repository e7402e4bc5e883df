//! A linear system whose matrix is an arrow: every ball is coupled to the two rings only.

use nalgebra::{Matrix4, SMatrix, SVector, Vector4};

type Rings = SVector<f64, 8>;

/// Balls eliminated one by one, then the rings solved.
#[derive(Debug, Clone)]
pub(super) struct Arrow {
    /// Rings by rings, after the balls so far were eliminated.
    rings: SMatrix<f64, 8, 8>,
    rings_right: Rings,
    /// For every ball A⁻¹ r and A⁻¹ B of its row A x + B (rings) = r.
    balls: Vec<(Vector4<f64>, SMatrix<f64, 4, 8>)>,
}

impl Arrow {
    pub fn new(balls: usize) -> Self {
        Self {
            rings: SMatrix::identity(),
            rings_right: Rings::zeros(),
            balls: Vec::with_capacity(balls),
        }
    }

    /// Begins anew with the rings' diagonal and right-hand side.
    pub fn begin(&mut self, diagonal: &Rings, right: &Rings) {
        self.rings = SMatrix::from_diagonal(diagonal);
        self.rings_right = *right;
        self.balls.clear();
    }

    /// Adds to the block of one ring by itself.
    pub fn add_ring(&mut self, ring: usize, block: &Matrix4<f64>) {
        let mut view = self.rings.fixed_view_mut::<4, 4>(4 * ring, 4 * ring);
        view += block;
    }

    /// Eliminates the next ball: `own` its diagonal block, `to` and `from` the blocks in its row and in the
    /// rings' rows. False if its block is singular.
    pub fn eliminate(
        &mut self,
        own: &Matrix4<f64>,
        to: &[Matrix4<f64>; 2],
        from: &[Matrix4<f64>; 2],
        right: &Vector4<f64>,
    ) -> bool {
        let Some(inverse) = own.try_inverse() else {
            return false;
        };
        let part = inverse * right;
        let mut coupling = SMatrix::<f64, 4, 8>::zeros();
        for (s, to) in to.iter().enumerate() {
            let mut block = coupling.fixed_view_mut::<4, 4>(0, 4 * s);
            block.copy_from(&(inverse * to));
        }
        for (s, from) in from.iter().enumerate() {
            let mut right = self.rings_right.fixed_rows_mut::<4>(4 * s);
            right -= from * part;
            let mut rows = self.rings.fixed_rows_mut::<4>(4 * s);
            rows -= from * coupling;
        }
        self.balls.push((part, coupling));
        true
    }

    /// A ball that touches nothing keeps its right-hand side.
    pub fn pass(&mut self, right: &Vector4<f64>) {
        self.balls.push((*right, SMatrix::zeros()));
    }

    /// The rings' unknowns; none if the system is singular.
    pub fn rings(&self) -> Option<Rings> {
        self.rings.lu().solve(&self.rings_right)
    }

    /// A ball's unknowns, once the rings' are known.
    pub fn ball(&self, j: usize, rings: &Rings) -> Vector4<f64> {
        let (part, coupling) = &self.balls[j];
        part - coupling * rings
    }
}

/// The truth is the residual of the written-out system.
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_the_arrow_it_was_given() {
        let block = |seed: f64| Matrix4::from_fn(|i, j| (seed + (5 * i + 3 * j) as f64).sin());
        let right = |seed: f64| Vector4::from_fn(|i, _| (seed + i as f64).cos());
        let own = |j: f64| block(j) + Matrix4::identity() * 4.0;
        let diagonal = Rings::repeat(9.0);
        let ring_right = Rings::from_fn(|i, _| i as f64);
        let mut arrow = Arrow::new(3);
        arrow.begin(&diagonal, &ring_right);
        arrow.add_ring(1, &block(7.0));
        for j in [0.0, 1.0, 2.0] {
            let (to, from) = (
                [block(j + 0.1), block(j + 0.2)],
                [block(j + 0.3), block(j + 0.4)],
            );
            assert!(arrow.eliminate(&own(j), &to, &from, &right(j)));
        }
        let rings = arrow.rings().unwrap();
        let ring = |s: usize| Vector4::from_fn(|i, _| rings[4 * s + i]);
        let mut sums = [ring(0) * 9.0, ring(1) * 9.0 + block(7.0) * ring(1)];
        for (j, n) in [0.0, 1.0, 2.0].into_iter().enumerate() {
            let ball = arrow.ball(j, &rings);
            let sum = own(n) * ball + block(n + 0.1) * ring(0) + block(n + 0.2) * ring(1);
            assert!((sum - right(n)).norm() < 1e-13);
            sums[0] += block(n + 0.3) * ball;
            sums[1] += block(n + 0.4) * ball;
        }
        for (s, sum) in sums.iter().enumerate() {
            let wanted = Vector4::from_fn(|i, _| ring_right[4 * s + i]);
            assert!((sum - wanted).norm() < 1e-12);
        }
    }
}
