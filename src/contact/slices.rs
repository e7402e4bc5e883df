//! Where a ball is cut: fixed slices of equal width, or quadrature nodes on the zone that touches.

use nalgebra::{DMatrix, SymmetricEigen};

/// Fixed slices or fitted nodes.
#[derive(Debug, Clone, PartialEq)]
pub enum Slices {
    /// n slices of width D/n over the ball, at fixed places in it.
    Fixed(usize),
    /// Nodes in −1 … 1 and weights that sum to 2, laid on every smooth piece of the zone.
    Fitted(Vec<(f64, f64)>),
}

impl Slices {
    /// m Gauss–Legendre nodes a piece.
    ///
    /// Golub and Welsch: the eigenvalues of the recurrence's Jacobi matrix (Math. Comp. 23 (1969) 221).
    ///
    /// ```
    /// use ballrace::contact::Slices;
    /// let Slices::Fitted(nodes) = Slices::fitted(3) else { unreachable!() };
    /// // Three nodes integrate x⁴ over −1 … 1 exactly: 2/5.
    /// let sum: f64 = nodes.iter().map(|(x, w)| w * x.powi(4)).sum();
    /// assert!((sum - 0.4).abs() < 1e-15);
    /// ```
    pub fn fitted(m: usize) -> Self {
        let recurrence = DMatrix::from_fn(m, m, |i, j| {
            if i.abs_diff(j) == 1 {
                let k = i.max(j) as f64;
                k / (4.0 * k * k - 1.0).sqrt()
            } else {
                0.0
            }
        });
        let eigen = SymmetricEigen::new(recurrence);
        let mut nodes: Vec<(f64, f64)> = eigen
            .eigenvalues
            .iter()
            .zip(eigen.eigenvectors.column_iter())
            .map(|(x, v)| (*x, 2.0 * v[0] * v[0]))
            .collect();
        nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self::Fitted(nodes)
    }
}
