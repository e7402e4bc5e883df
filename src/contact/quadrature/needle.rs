//! Functions with the shape of friction where slip vanishes within a zone ("needles"), whose integrals are known in closed form.

use crate::contact::slip::Slip;
use crate::simd::{Number, arctan_over, inverse_root, ln};

/// Places of slip's zeros beyond the zone that are still looked at, over half of its length.
const REACH: f64 = 1.2;
/// Keeps quotients of what may both vanish finite; no square of a speed is as small.
const TINY: f64 = 1e-300;

/// The needles of a film's friction K = 1/(h (c + √(u_t² + u_m² + c²))) at the places x_0 where slip along the race vanishes: with
/// y = x − x_0 and r = √(y² + η²)
///
/// ```text
/// K ≈ (k + κ y² dk/dy)/(b h_0),   k = 1/(γ + r),   dk/dy = −y k²/r
/// ```
///
/// | symbol | meaning |
/// |---|---|
/// | x | place in the zone, −1 … 1 |
/// | b | slope of u_t by x at x_0, in size |
/// | γ | c/b: a thousandth to a tenth |
/// | η | √(u_m² + c²)/b at x_0; μ = |u_m|/b |
/// | κ | curvature u_t''/(2 u_t') at x_0, of u_t = b (y + κ y²) |
/// | h_0 | h at x_0 |
///
/// What is left of K is smooth on the scale of the zone, and a rule of few places integrates it; the needles are integrated in closed form.
/// Both sums hold for any x_0 and b, which only say how smooth the rest is: two zeros are those of u_t's first three powers, mended by
/// Newton's method; where they meet or leave the zone their needles are wide, and nothing jumps.
#[derive(Debug, Clone, Copy)]
pub(super) struct Needles<T> {
    needles: [Needle<T>; 2],
    /// Number of needles: none or one wherever spin governs slip.
    count: usize,
}

/// A needle; `size` is 0 where there is none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Needle<T> {
    /// x_0.
    place: T,
    /// 1/(b h_0).
    size: T,
    /// μ² and γ.
    across: T,
    bend: T,
    /// η², and η.
    width: T,
    blunt: T,
    /// κ.
    curve: T,
}

impl<T: Number> Needles<T> {
    /// The needles of the slip along a zone about a centre, `half` to both sides \[m\].
    #[inline(always)]
    pub fn of<const FMA: bool>(slip: &Slip<T>, centre: T, half: T) -> Self {
        let zone = CutZone::new::<FMA>(slip, centre, half);
        let [c_0, c_1, c_2, ..] = zone.along;
        let one = half.same(1.0);
        let square = c_1 * c_1 - c_0 * c_2 * 4.0;
        let root = square.or_zero().sqrt();
        let sign = c_1.positive_then(one + one) + -1.0;
        let q = (c_1 + sign * root) * -0.5;
        let there = square.positive_then(one);
        // No step of Newton's method leads from one zero to the other.
        let far = root / (c_2.abs() + TINY) * 0.125;
        let limit = far - (far + -0.1).or_zero();
        let near = |over, under| {
            half.outlined(
                #[inline(always)]
                || Needle::of::<FMA>(&zone, over, under, there, limit),
            )
        };
        let (first, second) = (near(c_0, q), near(q, c_2));
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

    /// Integrals of the needles over the zone times powers of x.
    #[inline(always)]
    pub fn moments<const FMA: bool>(&self, to: &mut [T]) {
        let [first, second] = &self.needles;
        let known = |needle| {
            first.place.outlined(
                #[inline(always)]
                move || Known::new::<FMA>(needle),
            )
        };
        match self.count {
            0 => {}
            1 => {
                let mut first = known(first);
                for (k, to) in to.iter_mut().enumerate() {
                    *to = first.next::<FMA>(k);
                }
            }
            // Side by side, since each power waits for those below it.
            _ => {
                let (mut first, mut second) = (known(first), known(second));
                for (k, to) in to.iter_mut().enumerate() {
                    *to = first.next::<FMA>(k) + second.next::<FMA>(k);
                }
            }
        }
    }

    /// Sum of the needles at x.
    #[inline(always)]
    pub fn at<const FMA: bool>(&self, x: T) -> T {
        let [first, second] = &self.needles;
        if self.count == 0 {
            return x.same(0.0);
        }
        let mut sum = first.at::<FMA>(x);
        if self.count > 1 {
            sum += second.at::<FMA>(x);
        }
        sum
    }
}

/// Slip by the place in a zone.
struct CutZone<'a, T> {
    slip: &'a Slip<T>,
    centre: T,
    half: T,
    along: [T; 5],
    across: [T; 3],
}

impl<'a, T: Number> CutZone<'a, T> {
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

/// Quotient over/under, which is finite where both vanish.
#[inline(always)]
fn quotient<T: Number, const FMA: bool>(over: T, under: T) -> T {
    over * under / under.mul_add::<FMA>(under, under.same(TINY))
}

impl<T: Number> Needle<T> {
    /// The needle near x = over/under, if that lies near the zone, and where it is `there`.
    #[inline(always)]
    fn of<const FMA: bool>(zone: &CutZone<'_, T>, over: T, under: T, there: T, limit: T) -> Self {
        let one = over.same(1.0);
        let near = (under.abs() * REACH - over.abs()).positive_then(there);
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
        let (across, bend) = (across * over_steep, bend * over_steep);
        let width = across.mul_add::<FMA>(across, bend * bend);
        // A needle as wide as the zone is none, and would not be a number where nothing slips.
        let narrow = (one - width).positive_then(near);
        let none = one - narrow;
        let width = narrow.positive_then(width) + none;
        Self {
            place,
            size: narrow.positive_then(over_steep / fading),
            across: narrow.positive_then(across * across),
            bend: narrow.positive_then(bend) + none,
            width,
            blunt: width.sqrt(),
            // No more than a needle of its width can bend.
            curve: narrow.positive_then(
                second * slope / (second * second).mul_add::<FMA>(width * 4.0, steepest),
            ),
        }
    }

    /// Whether the needle is there for any contact.
    #[inline(always)]
    fn is_any(&self) -> bool {
        self.size.range().1 > 0.0
    }

    #[inline(always)]
    fn at<const FMA: bool>(&self, x: T) -> T {
        let y = x - self.place;
        let square = y.mul_add::<FMA>(y, self.width);
        let over = inverse_root::<T, FMA>(square);
        let root = inverse_root::<T, FMA>(square.mul_add::<FMA>(over, self.bend));
        let k = root * root;
        let bent = y * y * y * over * k;
        self.size * k * (-bent).mul_add::<FMA>(self.curve, x.same(1.0))
    }

    /// ∫ k and ∫ y k over the zone, and ∫ r.
    #[inline(always)]
    fn first_integrals<const FMA: bool>(&self, low: &End<T>, high: &End<T>) -> [T; 3] {
        let Self {
            place,
            across,
            bend,
            width,
            blunt,
            ..
        } = *self;
        let one = place.same(1.0);
        // asinh(y/η) at the two ends as one logarithm, in which nothing cancels, of the farther and the nearer end.
        let (near, far) = (place.abs() + -1.0, place.abs() + 1.0);
        let (sum, apart) = (high.r + low.r, (high.r - low.r).abs());
        let (long, short) = ((sum + apart) * 0.5, (sum - apart) * 0.5);
        let beyond = near.positive_then(one);
        let within = one - beyond;
        let over = beyond + within * (short - near);
        let under = beyond * (near + short) + within * width;
        let asinh = ln::<T, FMA>((far + long) * over / under);
        // ∫ dy/(r (γ + r)) as one arctangent: 2 arctan(μ g)/μ.
        let (e_0, e_1) = (blunt + low.r, blunt + high.r);
        let square = (blunt + bend) * (blunt + bend);
        let turned = (high.y * e_0 - low.y * e_1) * (blunt + bend);
        let g = turned / (square * e_0).mul_add::<FMA>(e_1, across * high.y * low.y);
        let angle = arctan_over::<T, FMA>(across * g * g) * g * 2.0;
        // dr = y dy/r, and so ∫ y k = r − γ ln(γ + r).
        let log = ln::<T, FMA>((bend + high.r) * low.k);
        [
            asinh - bend * angle,
            (high.r - low.r) - bend * log,
            (high.y * high.r - low.y * low.r + width * asinh) * 0.5,
        ]
    }
}

/// Quantities known of a needle before its integral over the zone times x^n.
///
/// With I_n = ∫ x^n k, R_n = ∫ x^n r, e_n = ∫ x^n and V_n = ∫ x^n y² k = R_n − γ e_n − μ² I_n, which is k (r² − γ²) = r − γ,
///
/// ```text
/// I_{n+2} = 2 x_0 I_{n+1} − x_0² I_n + V_n
/// (n + 3) R_{n+1} = (2 n + 3) x_0 R_n − n (x_0² + η²) R_{n−1} + [x^n r³]
/// ∫ x^n y² dk/dy = [x^n y² k] − n V_{n−1} − 2 (I_{n+1} − x_0 I_n)
/// ```
struct Known<'a, T> {
    needle: &'a Needle<T>,
    /// I_n and I_{n+1}, R_{n−1} and R_n, V_{n−1}.
    integrals: [T; 2],
    roots: [T; 2],
    before: T,
    /// [x^n r³] and [x^n y² k], of even and of odd n.
    cubes: [T; 2],
    bounds: [T; 2],
    /// 2 x_0, x_0² and x_0² + η².
    twice: T,
    square: T,
    reach: T,
}

impl<'a, T: Number> Known<'a, T> {
    #[inline(always)]
    fn new<const FMA: bool>(needle: &'a Needle<T>) -> Self {
        let (place, one) = (needle.place, needle.place.same(1.0));
        // One by one: what is mapped over an array is not taken into this loop.
        let [low, high] = [End::new(needle, -one), End::new(needle, one)];
        let [first, second, root] = needle.first_integrals::<FMA>(&low, &high);
        let (low_cube, high_cube) = (low.r * low.r * low.r, high.r * high.r * high.r);
        let (low_bound, high_bound) = (low.y * low.y * low.k, high.y * high.y * high.k);
        let square = place * place;
        Self {
            needle,
            integrals: [first, place.mul_add::<FMA>(first, second)],
            roots: [one.same(0.0), root],
            before: one.same(0.0),
            cubes: [high_cube - low_cube, high_cube + low_cube],
            bounds: [high_bound - low_bound, high_bound + low_bound],
            twice: place + place,
            square,
            reach: square + needle.width,
        }
    }

    /// The integral with x^n.
    #[inline(always)]
    fn next<const FMA: bool>(&mut self, n: usize) -> T {
        let needle = self.needle;
        let (place, parity, n) = (needle.place, n % 2, n as f64);
        let even = if parity == 0 { 2.0 / (n + 1.0) } else { 0.0 };
        let [now, next] = self.integrals;
        let [lower, root] = self.roots;
        let beyond = (needle.bend * -even - needle.across * now) + root;
        let along = place.mul_add::<FMA>(-now, next);
        let bent = self.bounds[parity] - self.before * n - along * 2.0;
        let after = self.twice.mul_add::<FMA>(next, beyond - self.square * now);
        let higher = (place * (2.0 * n + 3.0))
            .mul_add::<FMA>(root, self.cubes[parity] - self.reach * lower * n);
        self.integrals = [next, after];
        self.roots = [root, higher * (1.0 / (n + 3.0))];
        self.before = beyond;
        needle.size * needle.curve.mul_add::<FMA>(bent, now)
    }
}

/// An end of the zone.
#[derive(Clone, Copy)]
struct End<T> {
    y: T,
    r: T,
    k: T,
}

impl<T: Number> End<T> {
    #[inline(always)]
    fn new(needle: &Needle<T>, x: T) -> Self {
        let y = x - needle.place;
        let r = (y * y + needle.width).sqrt();
        Self {
            y,
            r,
            k: x.same(1.0) / (needle.bend + r),
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
