//! Arithmetic on eight numbers.

use std::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, Neg, Sub};

/// Numbers in one [`Lanes`]: a register of AVX-512, two of AVX2, four of SSE2.
pub(crate) const LANES: usize = 8;

/// Eight numbers, of which each operation treats every one alone.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(align(64))]
pub(crate) struct Lanes([f64; LANES]);

/// Eight numbers, each by the same expression of its index. Written out: a loop of eight would be unrolled anew wherever it is
/// taken in, which took two thirds of the time that the compiler needed for the whole crate.
macro_rules! each {
    ($i:ident => $number:expr) => {
        Lanes([
            each!($i = 0, $number),
            each!($i = 1, $number),
            each!($i = 2, $number),
            each!($i = 3, $number),
            each!($i = 4, $number),
            each!($i = 5, $number),
            each!($i = 6, $number),
            each!($i = 7, $number),
        ])
    };
    ($i:ident = $value:literal, $number:expr) => {{
        const $i: usize = $value;
        $number
    }};
}

impl Lanes {
    pub(crate) const ZERO: Self = Self([0.0; LANES]);

    /// The same number eight times.
    #[inline(always)]
    pub(crate) fn all(x: f64) -> Self {
        Self([x; LANES])
    }

    #[inline(always)]
    pub(crate) fn from_fn(mut f: impl FnMut(usize) -> f64) -> Self {
        each!(I => f(I))
    }

    /// The first eight numbers of a slice.
    ///
    /// # Panics
    /// If there are fewer.
    #[inline(always)]
    pub(crate) fn from_slice(slice: &[f64]) -> Self {
        let mut lanes = [0.0; LANES];
        lanes.copy_from_slice(&slice[..LANES]);
        Self(lanes)
    }

    /// Writes the lanes into the first eight numbers of a slice.
    ///
    /// # Panics
    /// If there are fewer.
    #[inline(always)]
    pub(crate) fn to_slice(self, slice: &mut [f64]) {
        slice[..LANES].copy_from_slice(&self.0);
    }

    /// The numbers themselves.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> &[f64; LANES] {
        &self.0
    }

    #[inline(always)]
    pub(crate) fn numbers_mut(&mut self) -> &mut [f64; LANES] {
        &mut self.0
    }

    #[inline(always)]
    pub(crate) fn map(self, mut f: impl FnMut(f64) -> f64) -> Self {
        each!(I => f(self.0[I]))
    }

    #[inline(always)]
    pub(crate) fn zip(self, other: Self, mut f: impl FnMut(f64, f64) -> f64) -> Self {
        each!(I => f(self.0[I], other.0[I]))
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        each!(I => self.0[I].sqrt())
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        each!(I => self.0[I].abs())
    }

    /// 0 in place of what is below; a NaN stays.
    #[inline(always)]
    pub(crate) fn or_zero(self) -> Self {
        each!(I => if self.0[I] <= 0.0 { 0.0 } else { self.0[I] })
    }

    /// self · b + c, fused where the instructions have it: elsewhere a fused product is a slow call.
    #[inline(always)]
    pub(crate) fn mul_add<const FMA: bool>(self, b: Self, c: Self) -> Self {
        each!(I => mul_add::<FMA>(self.0[I], b.0[I], c.0[I]))
    }

    /// Mask of the lanes above those of another; nowhere where one of them is not a number.
    #[inline(always)]
    pub(crate) fn above(self, other: Self) -> Mask {
        Mask(each!(I => if self.0[I] > other.0[I] { 1.0 } else { 0.0 }))
    }

    #[inline(always)]
    pub(crate) fn is_nan(self) -> Mask {
        Mask(self.map(|x| if x.is_nan() { 1.0 } else { 0.0 }))
    }

    /// Sum of the lanes, by halves.
    #[inline(always)]
    pub(crate) fn sum(self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.0;
        ((a + e) + (c + g)) + ((b + f) + (d + h))
    }

    #[inline(always)]
    pub(crate) fn least(self) -> f64 {
        self.0.into_iter().fold(f64::INFINITY, f64::min)
    }

    #[inline(always)]
    pub(crate) fn greatest(self) -> f64 {
        self.0.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }
}

/// a · b + c, fused or not.
#[inline(always)]
pub(crate) fn mul_add<const FMA: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FMA { a.mul_add(b, c) } else { a * b + c }
}

macro_rules! operator {
    ($trait:ident, $function:ident, $symbol:tt) => {
        impl $trait for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                each!(I => self.0[I] $symbol other.0[I])
            }
        }

        impl $trait<f64> for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                each!(I => self.0[I] $symbol other)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        each!(I => -self.0[I])
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Index<usize> for Lanes {
    type Output = f64;
    #[inline(always)]
    fn index(&self, lane: usize) -> &f64 {
        &self.0[lane]
    }
}

impl IndexMut<usize> for Lanes {
    #[inline(always)]
    fn index_mut(&mut self, lane: usize) -> &mut f64 {
        &mut self.0[lane]
    }
}

/// Eight decisions: 1 for yes, 0 for no, so that they stay in the registers of what they decide.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Mask(Lanes);

impl Mask {
    pub(crate) fn from_fn(mut f: impl FnMut(usize) -> bool) -> Self {
        Self(Lanes::from_fn(|lane| f64::from(u8::from(f(lane)))))
    }

    #[inline(always)]
    pub(crate) fn any(self) -> bool {
        self.0.sum() > 0.0
    }

    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }

    #[inline(always)]
    pub(crate) fn or(self, other: Self) -> Self {
        Self(self.0.zip(other.0, |a, b| if a > b { a } else { b }))
    }

    #[inline(always)]
    pub(crate) fn not(self) -> Self {
        Self(Lanes::all(1.0) - self.0)
    }

    #[inline(always)]
    pub(crate) fn lane(self, lane: usize) -> bool {
        self.0[lane] > 0.0
    }

    /// The lanes of `yes` where it is true, of `no` elsewhere.
    #[inline(always)]
    pub(crate) fn choose(self, yes: Lanes, no: Lanes) -> Lanes {
        each!(I => if self.0.0[I] > 0.0 { yes.0[I] } else { no.0[I] })
    }

    /// The lanes that are true.
    #[inline(always)]
    pub(crate) fn lanes(self) -> impl Iterator<Item = usize> {
        (0..LANES).filter(move |lane| self.lane(*lane))
    }
}

/// Counts, lane by lane, how often something was so.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Counters(Lanes);

impl Counters {
    #[inline(always)]
    pub(crate) fn add(&mut self, mask: Mask, times: u32) {
        self.0 += mask.0 * f64::from(times);
    }

    /// Sum of the lanes, which hold whole numbers.
    // Whole numbers, and few.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    pub(crate) fn total(self) -> u32 {
        self.0.0.iter().sum::<f64>() as u32
    }
}
