//! What friction goes like where slip vanishes within a zone: needles, whose integrals are known in closed form.

// Into loops that are compiled for the instructions at hand.
#![allow(clippy::inline_always)]

use crate::contact::slip::Slip;
use crate::simd::{Number, inverse_root};

/// 1/(1 + z) ≈ 1 − z + A z² − B z³ to 4e-3 for 0 ≤ z ≤ 1, best in the largest error.
const SERIES: [f64; 2] = [0.824_151_54, 0.328_086_07];
/// Places of slip's zeros beyond the zone that are still looked at, over half of its length.
const REACH: f64 = 1.2;
/// Keeps quotients of what may both vanish finite; no square of a speed is as small.
const TINY: f64 = 1e-300;

/// The needles of a film's friction K = 1/(h (c + √(u_t² + u_m² + c²))) at the places x_0 where slip along the race vanishes: with
/// ρ = b √((x − x_0)² + η²)
///
/// ```text
/// K ≈ (1/ρ − c/ρ² + A c²/ρ³ − B c³/ρ⁴)/h_0
/// ```
///
/// | symbol | meaning |
/// |---|---|
/// | x | place in the zone, −1 … 1 |
/// | b | slope of u_t by x at x_0, in size |
/// | b η | √(u_m² + c²) at x_0: a thousandth to a tenth of what slip sweeps over the zone |
/// | h_0 | h at x_0 |
///
/// with, of the curvature κ = u_t''/(2 u_t'), what y = x − x_0 adds to them, −κ y³/r³ + 2 κ c y³/(b r⁴), r = ρ/b.
/// What is left of K is smooth on the scale of the zone, and a rule of few places integrates it; the needles are integrated in closed form.
/// Both sums hold for any x_0 and b, which only say how smooth the rest is: two zeros are those of u_t's first three powers, mended by
/// Newton's method; where they meet or leave the zone their needles are wide, and nothing jumps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Needles<T> {
    needles: [Needle<T>; 2],
    /// How many there are: none or one wherever spin governs slip.
    count: usize,
}

/// One of them; `size` is 0 where there is none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Needle<T> {
    /// x_0.
    place: T,
    /// 1/(b h_0).
    size: T,
    /// η².
    width: T,
    /// c/b.
    bend: T,
    /// Curvature of u_t over twice its slope.
    curve: T,
}

impl<T: Number> Needles<T> {
    /// Those of the slip along a zone about a centre, `half` to both sides \[m\].
    #[inline(always)]
    pub fn of<const FMA: bool>(slip: &Slip<T>, centre: T, half: T) -> Self {
        let zone = Zone::new::<FMA>(slip, centre, half);
        let [c_0, c_1, c_2, ..] = zone.along;
        let one = half.same(1.0);
        let square = c_1 * c_1 - c_0 * c_2 * 4.0;
        let root = square.or_zero().sqrt();
        let sign = c_1.gates(one + one) + -1.0;
        let q = (c_1 + sign * root) * -0.5;
        let there = square.gates(one);
        // No step of Newton's method leads from one zero to the other.
        let far = root / (c_2.abs() + TINY) * 0.125;
        let limit = far - (far + -0.1).or_zero();
        let first = Needle::of::<FMA>(&zone, (c_0, q), (there, limit));
        let second = Needle::of::<FMA>(&zone, (q, c_2), (there, limit));
        let count = match (first.is_any(), second.is_any()) {
            (_, true) => 2,
            (true, false) => 1,
            (false, false) => 0,
        };
        Self {
            needles: [first, second],
            count,
        }
    }

    /// Those that are there.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = &Needle<T>> {
        self.needles[..self.count].iter()
    }

    /// Their sum at x.
    #[inline(always)]
    pub fn at<const FMA: bool>(&self, x: T) -> T {
        let [first, second] = &self.needles;
        match self.count {
            0 => x.same(0.0),
            1 => first.at::<FMA>(x),
            _ => first.at::<FMA>(x) + second.at::<FMA>(x),
        }
    }
}

/// Slip by the place in a zone.
struct Zone<'a, T> {
    slip: &'a Slip<T>,
    centre: T,
    half: T,
    along: [T; 5],
    across: [T; 3],
}

impl<'a, T: Number> Zone<'a, T> {
    #[inline(always)]
    fn new<const FMA: bool>(slip: &'a Slip<T>, centre: T, half: T) -> Self {
        let (along, across) = slip.over_zone::<FMA>(centre, half);
        Self {
            slip,
            centre,
            half,
            along,
            across,
        }
    }
}

/// over/under, which is finite where both vanish.
#[inline(always)]
fn quotient<T: Number, const FMA: bool>(over: T, under: T) -> T {
    over * under / under.mul_add::<FMA>(under, under.same(TINY))
}

impl<T: Number> Needle<T> {
    /// Near x = over/under, if that lies near the zone, and where it is `there`.
    #[inline(always)]
    fn of<const FMA: bool>(
        zone: &Zone<'_, T>,
        (over, under): (T, T),
        (there, limit): (T, T),
    ) -> Self {
        let one = over.same(1.0);
        let near = (under.abs() * REACH - over.abs()).gates(there);
        let mut place = near * quotient::<T, FMA>(over, under);
        for _ in 0..2 {
            let (value, slope) = polynomial::<T, FMA>(&zone.along, place);
            let step = -quotient::<T, FMA>(value, slope);
            let step = step - (step - limit).or_zero();
            place += step + (-limit - step).or_zero();
        }
        let (_, slope) = polynomial::<T, FMA>(&zone.along, place);
        let over_steep = one / (slope.abs() + TINY);
        let [_, _, c_2, c_3, c_4] = zone.along;
        let second = (c_4 * place).mul_add::<FMA>(place.same(6.0), c_3 * 3.0);
        let second = second.mul_add::<FMA>(place, c_2);
        let steepest = slope.mul_add::<FMA>(slope, over.same(TINY));
        let [m_0, m_1, m_2] = zone.across;
        let across = m_2.mul_add::<FMA>(place, m_1).mul_add::<FMA>(place, m_0);
        let u = zone.half.mul_add::<FMA>(place, zone.centre);
        let (fading, bend) = zone.slip.fading_and_bend::<FMA>(u);
        let width = across.mul_add::<FMA>(across, bend * bend) * over_steep * over_steep;
        // A needle as wide as the zone is none, and would not be a number where nothing slips.
        let narrow = (one - width).gates(near);
        Self {
            place,
            size: narrow.gates(over_steep / fading),
            width: narrow.gates(width) + (one - narrow),
            bend: narrow.gates(bend * over_steep),
            // No more than a needle of its width can bend.
            curve: narrow
                .gates(second * slope / (second * second).mul_add::<FMA>(width * 4.0, steepest)),
        }
    }

    /// Whether it is there for any contact.
    #[inline(always)]
    fn is_any(&self) -> bool {
        self.size.range().1 > 0.0
    }

    #[inline(always)]
    fn at<const FMA: bool>(&self, x: T) -> T {
        let y = x - self.place;
        let over = inverse_root::<T, FMA>(y.mul_add::<FMA>(y, self.width));
        let bent = self.bend * over;
        let [third, fourth] = SERIES;
        let series = (bent * -fourth + third)
            .mul_add::<FMA>(bent, x.same(-1.0))
            .mul_add::<FMA>(bent, x.same(1.0));
        let cubic = y * over * (self.width * -1.0).mul_add::<FMA>(over * over, x.same(1.0));
        let bent = self.curve * cubic * (bent * 2.0 + -1.0);
        self.size * over.mul_add::<FMA>(series, bent)
    }

    /// Adds its integrals over the zone times powers of x to the first of `to`.
    #[inline(always)]
    pub fn add_moments<const FMA: bool>(&self, to: &mut [T]) {
        let Self {
            place,
            size,
            width,
            bend,
            curve,
        } = *self;
        let one = place.same(1.0);
        let (high, low) = (one - place, -(one + place));
        let square = place.mul_add::<FMA>(place, width);
        let (r_1, r_0) = (
            high.mul_add::<FMA>(high, width).sqrt(),
            low.mul_add::<FMA>(low, width).sqrt(),
        );
        let eta = width.sqrt();
        let (over_1, over_0, over_eta) = (one / r_1, one / r_0, one / eta);
        // asinh(high/η) − asinh(low/η) as one logarithm, in which nothing cancels, of the two ends as the middle lies left of x_0.
        let (near, far) = (place.abs() + -1.0, place.abs() + 1.0);
        let long = far.mul_add::<FMA>(far, width).sqrt();
        let short = near.mul_add::<FMA>(near, width).sqrt();
        let beyond = near.gates(one);
        let under = beyond * (near + short) + (one - beyond) * (width / (short - near));
        let log = ((far + long) / under).curve(f64::ln, |_, _| 0.0);
        // atan(high/η) − atan(low/η) as one angle.
        let angle = (eta + eta).zip(high.mul_add::<FMA>(low, width), f64::atan2);
        // ∫ x^k/r, ∫ x^k/r², ∫ x^k/r³ and ∫ x^k/r⁴ with r² = (x − x_0)² + η².
        let mut roots = [log, (r_1 - r_0) + place * log];
        let mut squares = [
            angle * over_eta,
            place * (angle * over_eta) + (r_1 * over_0).curve(f64::ln, |_, _| 0.0),
        ];
        let cube = (high * over_1 - low * over_0) / width;
        let mut cubes = [cube, place * cube - (over_1 - over_0)];
        let (square_1, square_0) = (over_1 * over_1, over_0 * over_0);
        let fourth = (high * square_1 - low * square_0 + squares[0]) / width * 0.5;
        let mut fourths = [fourth, place * fourth - (square_1 - square_0) * 0.5];
        let by_third = bend * bend * SERIES[0];
        let by_fourth = bend * bend * bend * -SERIES[1];
        for (k, to) in to.iter_mut().enumerate() {
            let all = squares[0].mul_add::<FMA>(-bend, roots[0]);
            let all = cubes[0].mul_add::<FMA>(by_third, all);
            let all = fourths[0].mul_add::<FMA>(by_fourth, all);
            // ∫ x^k y³/r³ and ∫ x^k y³/r⁴.
            let along = roots[1] - place * roots[0] - width * (cubes[1] - place * cubes[0]);
            let beyond =
                squares[1] - place * squares[0] - width * (fourths[1] - place * fourths[0]);
            let bent = (beyond * bend * 2.0 - along) * curve;
            *to = size.mul_add::<FMA>(all + bent, *to);
            let n = k as f64;
            let sides = if k % 2 == 0 { r_1 + r_0 } else { r_1 - r_0 };
            let even = if k % 2 == 0 { 2.0 / (n + 1.0) } else { 0.0 };
            let cube = place.mul_add::<FMA>(cubes[1] * 2.0, roots[0]) - square * cubes[0];
            let fourth = place.mul_add::<FMA>(fourths[1] * 2.0, squares[0]) - square * fourths[0];
            let next =
                place.mul_add::<FMA>(squares[1] * 2.0, place.same(even)) - square * squares[0];
            // (k + 2) R_{k+2} = [x^{k+1} r] + (2k + 3) x_0 R_{k+1} − (k + 1)(x_0² + η²) R_k.
            let root = (place * roots[1]).mul_add::<FMA>(place.same(2.0 * n + 3.0), sides)
                - square * roots[0] * (n + 1.0);
            roots = [roots[1], root * (1.0 / (n + 2.0))];
            squares = [squares[1], next];
            cubes = [cubes[1], cube];
            fourths = [fourths[1], fourth];
        }
    }
}

/// Value and slope of a polynomial.
#[inline(always)]
pub(super) fn polynomial<T: Number, const FMA: bool>(powers: &[T; 5], x: T) -> (T, T) {
    let (mut value, mut slope) = (powers[4], x.same(0.0));
    for power in powers[..4].iter().rev() {
        slope = slope.mul_add::<FMA>(x, value);
        value = value.mul_add::<FMA>(x, *power);
    }
    (value, slope)
}
