//! A race through points: the cubic spline R(z).

use nalgebra::{DMatrix, DVector};

use super::Inclination;
use crate::simd::{LANES, Lanes};

/// Terms of the polynomial that smooths points.
const TERMS: usize = 9;

/// The cubic spline through points (z_k, R_k), twice continuously differentiable.
///
/// ```text
/// R(z) = R_k + b x + c x² + d x³,   x = z − z_k on the piece z_k … z_{k+1}
/// ```
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | z_k | axial places of the points, strictly increasing, at least four | m |
/// | R_k | radii of the race there | m |
/// | b, c, d | coefficients of a piece: R', R'' and R''' are continuous but for the last, which is at the second point from either end | 1, 1/m, 1/m² |
///
/// Its end conditions are "not a knot": the first two pieces are one cubic, and the last two, so that a smooth shape is met
/// to the fourth order of the points' distance up to its ends. There the race ends: nothing is extrapolated.
///
/// Source: C. de Boor, *A Practical Guide to Splines*, ch. IV. Validity: a tabulated circle of radius r errs by less than h⁴/(128 r³)
/// at its bottom for points at a distance h.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curve {
    /// Knots: where pieces begin, and where the last one ends.
    knots: Vec<f64>,
    pieces: Vec<Piece>,
    /// The piece that each of equally wide cells begins in.
    cells: Vec<usize>,
    /// Whether more than one piece begins within any of them.
    crowded: bool,
    /// Cells per length \[1/m\].
    per_length: f64,
}

/// A piece: where it begins and the next one does, and its coefficients from the lowest power up.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    start: f64,
    end: f64,
    powers: [f64; 4],
}

/// The race at an axial place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RacePoint {
    /// R \[m\].
    pub radius: f64,
    /// R'.
    pub slope: f64,
    /// R'' \[1/m\].
    pub bend: f64,
}

impl RacePoint {
    /// Curvature of the race in its meridional plane \[1/m\], positive where it is hollow, towards balls of an outer (σ = +1) or
    /// inner race.
    pub fn hollow(&self, sigma: f64) -> f64 {
        -sigma * self.bend / (1.0 + self.slope * self.slope).powf(1.5)
    }

    /// Normal out of a ball that touches there.
    pub fn normal(&self, sigma: f64) -> Inclination<f64> {
        let over = 1.0 / (1.0 + self.slope * self.slope).sqrt();
        Inclination {
            cos: over,
            sin: -sigma * self.slope * over,
        }
    }
}

impl Curve {
    /// The curve through points that are in order; at least four.
    pub fn through(z: &[f64], r: &[f64]) -> Self {
        let slopes = slopes(z, r);
        let piece = |k: usize| {
            let (h, rise) = (z[k + 1] - z[k], (r[k + 1] - r[k]) / (z[k + 1] - z[k]));
            let excess = (slopes[k] + slopes[k + 1] - 2.0 * rise) / h;
            let powers = [r[k], slopes[k], (rise - slopes[k]) / h - excess, excess / h];
            Piece {
                start: z[k],
                end: if k + 2 < z.len() {
                    z[k + 1]
                } else {
                    f64::INFINITY
                },
                powers,
            }
        };
        let count = z.len() - 1;
        // Mostly fine enough to hold one point at most.
        let cells = 8 * count;
        let width = (z[count] - z[0]) / cells as f64;
        let first_in = |cell: usize| {
            let start = z[0] + width * cell as f64;
            z[1..count]
                .iter()
                .take_while(|knot| **knot <= start)
                .count()
        };
        let cells: Vec<usize> = (0..cells).map(first_in).collect();
        Self {
            knots: z.to_vec(),
            pieces: (0..count).map(piece).collect(),
            crowded: cells.windows(2).any(|k| k[1] > k[0] + 1)
                || cells.last().is_some_and(|k| count > k + 2),
            cells,
            per_length: 1.0 / width,
        }
    }

    /// Ends of the curve \[m\].
    pub fn ends(&self) -> [f64; 2] {
        [self.knots[0], self.knots[self.knots.len() - 1]]
    }

    /// The places of its points.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The race at a place between its ends; beyond them, what the outermost piece goes on to.
    #[inline]
    pub fn at(&self, z: f64) -> RacePoint {
        let (Piece { powers, .. }, x) = self.piece(z);
        let [a, b, c, d] = powers;
        RacePoint {
            radius: ((d * x + c) * x + b) * x + a,
            slope: (3.0 * d * x + 2.0 * c) * x + b,
            bend: 6.0 * d * x + 2.0 * c,
        }
    }

    /// The race at a place by the polynomial nearest to the points within some reach \[m\], or to as many as it needs: a spline's second
    /// derivative errs with the square of the points' distance, and shows every digit that points lack.
    pub fn smoothed(&self, z: f64, reach: f64) -> RacePoint {
        let mut apart: Vec<f64> = self.knots.iter().map(|knot| (knot - z).abs()).collect();
        apart.sort_by(f64::total_cmp);
        let reach = reach.max(apart[apart.len().min(TERMS) - 1]);
        let near: Vec<f64> = self
            .knots
            .iter()
            .copied()
            .filter(|knot| (knot - z).abs() <= reach)
            .collect();
        let terms = near.len().min(TERMS);
        let powers = DMatrix::from_fn(near.len(), terms, |i, power| {
            ((near[i] - z) / reach).powi(i32::try_from(power).unwrap_or(0))
        });
        let middle = self.at(z);
        let rises = DVector::from_fn(near.len(), |i, _| self.at(near[i]).radius - middle.radius);
        let Ok(found) = powers.svd(true, true).solve(&rises, 1e-14) else {
            return middle;
        };
        RacePoint {
            radius: middle.radius,
            slope: found[1] / reach,
            bend: 2.0 * found[2] / (reach * reach),
        }
    }

    /// R, R' and R'' at eight places.
    #[inline(always)]
    pub fn at_eight<const FMA: bool>(&self, z: Lanes) -> [Lanes; 3] {
        let pieces = self.pieces_at(&z);
        // Number by number into registers: what is stored one by one and loaded as eight makes the processor wait.
        let x = z - Lanes::from_fn(|i| pieces[i].start);
        let [a, b, c, d] = [
            Lanes::from_fn(|i| pieces[i].powers[0]),
            Lanes::from_fn(|i| pieces[i].powers[1]),
            Lanes::from_fn(|i| pieces[i].powers[2]),
            Lanes::from_fn(|i| pieces[i].powers[3]),
        ];
        let radius = d
            .mul_add::<FMA>(x, c)
            .mul_add::<FMA>(x, b)
            .mul_add::<FMA>(x, a);
        let slope = (d * 3.0).mul_add::<FMA>(x, c * 2.0).mul_add::<FMA>(x, b);
        [radius, slope, (d * 6.0).mul_add::<FMA>(x, c * 2.0)]
    }

    /// The pieces at eight places.
    // Looking up is no work for vector instructions, and one copy of it is enough.
    #[inline(never)]
    fn pieces_at(&self, z: &Lanes) -> [&Piece; LANES] {
        let mut pieces = [&self.pieces[0]; LANES];
        for (lane, piece) in pieces.iter_mut().enumerate() {
            *piece = self.piece(z[lane]).0;
        }
        pieces
    }

    /// The piece at a place, and how far into it that is.
    #[inline]
    fn piece(&self, z: f64) -> (&Piece, f64) {
        // A float becomes the nearest index that exists.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let cell = ((z - self.knots[0]) * self.per_length) as usize;
        let mut k = self.cells[cell.min(self.cells.len() - 1)];
        // Without a branch that no processor can guess; the last piece has no end.
        k += usize::from(z >= self.pieces[k].end);
        if self.crowded {
            while z >= self.pieces[k].end {
                k += 1;
            }
        }
        let piece = &self.pieces[k];
        (piece, z - piece.start)
    }
}

/// Slopes of the spline at its points: those with which neighbouring pieces have one second derivative.
fn slopes(z: &[f64], r: &[f64]) -> Vec<f64> {
    let n = z.len();
    let h: Vec<f64> = z.windows(2).map(|z| z[1] - z[0]).collect();
    let rise: Vec<f64> = (0..n - 1).map(|k| (r[k + 1] - r[k]) / h[k]).collect();
    // Below, on and above the diagonal, and the right-hand side.
    let (mut below, mut on, mut above) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut s = vec![0.0; n];
    for k in 1..n - 1 {
        (below[k], on[k], above[k]) = (h[k], 2.0 * (h[k - 1] + h[k]), h[k - 1]);
        s[k] = 3.0 * (h[k] * rise[k - 1] + h[k - 1] * rise[k]);
    }
    // The first two pieces are one cubic, and so are the last two.
    let end = |own: f64, next: f64, [first, second]: [f64; 2]| {
        let both = own + next;
        let right = ((own + 2.0 * both) * next * first + own * own * second) / both;
        (next, both, right)
    };
    (on[0], above[0], s[0]) = end(h[0], h[1], [rise[0], rise[1]]);
    let m = n - 1;
    (on[m], below[m], s[m]) = end(h[m - 1], h[m - 2], [rise[m - 1], rise[m - 2]]);
    for k in 1..n {
        let share = below[k] / on[k - 1];
        on[k] -= share * above[k - 1];
        s[k] -= share * s[k - 1];
    }
    s[m] /= on[m];
    for k in (0..m).rev() {
        s[k] = (s[k] - above[k] * s[k + 1]) / on[k];
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: a cubic is met exactly, whatever the distances of its points, with its derivatives.
    #[test]
    fn meets_a_cubic() {
        let of = |z: f64| 0.03 + z * (0.1 + z * (-7.0 + z * 900.0));
        let z = [-5e-3, -4e-3, -1e-3, 0.2e-3, 0.3e-3, 2e-3, 6e-3];
        let curve = Curve::through(&z, &z.map(of));
        for k in 0..=110 {
            let z = -5e-3 + 1e-4 * f64::from(k);
            let at = curve.at(z);
            assert!((at.radius - of(z)).abs() < 1e-16, "{z}");
            assert!((at.slope - (0.1 - 14.0 * z + 2700.0 * z * z)).abs() < 1e-12);
            assert!((at.bend - (-14.0 + 5400.0 * z)).abs() < 1e-9);
        }
    }

    /// Analytic: of a circle the curvature, which Hertz's law depends on by its difference to that of the ball.
    #[test]
    fn knows_curvatures() {
        let r = 6e-3;
        let z: Vec<f64> = (0..=200)
            .map(|k| r * (f64::from(k) / 125.0 - 0.8))
            .collect();
        let radii: Vec<f64> = z.iter().map(|z| 30e-3 - (r * r - z * z).sqrt()).collect();
        let curve = Curve::through(&z, &radii);
        for place in [0.0, 1e-3, -3.5e-3] {
            let off = r * curve.smoothed(place, 0.1 * r).hollow(-1.0) - 1.0;
            // What eight powers leave of a circle within a tenth of its radius: most where it is steepest.
            assert!(off.abs() < 1e-7, "{place}: {off:e}");
        }
    }

    /// Analytic: of a circle the error falls with the fourth power of the points' distance, and the second derivative
    /// is continuous.
    #[test]
    fn is_smooth_and_of_the_fourth_order() {
        let r = 6e-3;
        let of = |z: f64| 30e-3 + (r * r - z * z).sqrt();
        let error = |count: usize| {
            let z: Vec<f64> = (0..=count)
                .map(|k| r * (1.6 * k as f64 / count as f64 - 0.8))
                .collect();
            let radii: Vec<f64> = z.iter().map(|z| of(*z)).collect();
            let curve = Curve::through(&z, &radii);
            for knot in &z[1..count] {
                let (low, high) = (curve.at(knot - 1e-12), curve.at(knot + 1e-12));
                assert!((low.bend - high.bend).abs() < 1e-3, "R'' jumps at {knot}");
            }
            let off = |k: usize| {
                let z = 0.4 * r * (k as f64 / 500.0 - 1.0);
                (curve.at(z).radius - of(z)).abs()
            };
            (0..1000).map(off).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(40), error(80));
        assert!(coarse / fine > 13.0, "{coarse:e} {fine:e}");
    }
}
