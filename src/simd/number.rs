//! The numbers of the contact kernel: one, eight side by side, or those of a register.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use super::lanes::{Lanes, Mask, mul_add};

/// Real numbers of one kind, of which each operation treats every one alone.
pub(crate) trait Number:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
    + AddAssign
{
    /// Answer of a comparison.
    type Decision: Decision;

    /// A number of the same kind that is x everywhere.
    fn same(self, x: f64) -> Self;

    /// Square root.
    fn sqrt(self) -> Self;

    /// self · b + c, fused where the instructions have it: elsewhere a fused product is a slow call.
    fn mul_add<const FMA: bool>(self, b: Self, c: Self) -> Self;

    /// Selection: another number where this one is positive, 0 where it is not; where this one is NaN, the other stays.
    fn positive_then(self, other: Self) -> Self;

    /// Comparison: whether it is above another; no where one of them is NaN.
    fn above(self, other: Self) -> Self::Decision;

    /// A function of each, with its slope from argument and value.
    fn curve(self, f: impl Fn(f64) -> f64, slope: impl Fn(f64, f64) -> f64) -> Self;

    /// Size without sign.
    fn abs(self) -> Self;

    /// A function of each with its partner in another; of neither any slope is known.
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self;

    /// The least and the greatest of them.
    fn range(self) -> (f64, f64);

    /// 0 in place of what is below; a NaN stays.
    #[inline(always)]
    fn or_zero(self) -> Self {
        self.positive_then(self)
    }

    /// 1/√x of each x > 0 to 3.5 %, without a division or a root; no slope is known of it.
    #[inline(always)]
    fn guess_inverse_root(self) -> Self {
        self.curve(guess_inverse_root, |_, _| 0.0)
    }

    /// k and m of each normal x = 2^k m > 0, 1 ≤ m < 2; no slope is known of them.
    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        let part = |f: fn(f64) -> f64| self.curve(f, |_, _| 0.0);
        (part(exponent), part(mantissa))
    }

    /// Runs work with numbers of this kind in a function of its own, compiled for the same instructions. Without optimisation each
    /// operation takes memory in the frame of the function it is taken into, which else sums up to megabytes.
    #[inline(always)]
    fn outlined<R>(self, work: impl FnOnce() -> R) -> R {
        work()
    }

    /// e to the power of each.
    fn exp(self) -> Self {
        self.curve(f64::exp, |_, value| value)
    }
}

/// Bits of the guess at 1/√1, from which half of x's are taken: the exponent is halved so, and the mantissa nearly.
pub(super) const GUESS: u64 = 0x5fe6_eb50_c7b5_37a9;

/// 1/√x from its bits. The words of 32 bits are halved each by itself, as registers do it.
#[inline(always)]
fn guess_inverse_root(x: f64) -> f64 {
    const WORDS: u64 = 0x7fff_ffff_7fff_ffff;
    f64::from_bits(GUESS.wrapping_sub(x.to_bits() >> 1 & WORDS))
}

/// Yes or no, for each number of its kind.
pub(crate) trait Decision: Copy {
    /// Conjunction: yes where both say yes.
    fn and(self, other: Self) -> Self;
}

/// Bits of a mantissa, and of an exponent of 0.
pub(super) const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
pub(super) const ONE: u64 = 0x3ff0_0000_0000_0000;

#[inline(always)]
fn exponent(x: f64) -> f64 {
    // Eleven bits.
    #[allow(clippy::cast_precision_loss)]
    let raised = (x.to_bits() >> 52) as f64;
    // What is not a number stays so.
    raised - 1023.0 + x * 0.0
}

#[inline(always)]
fn mantissa(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & MANTISSA | ONE)
}

impl Decision for bool {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self & other
    }
}

impl Number for f64 {
    type Decision = bool;

    #[inline(always)]
    fn same(self, x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn mul_add<const FMA: bool>(self, b: Self, c: Self) -> Self {
        mul_add::<FMA>(self, b, c)
    }

    #[inline(always)]
    fn positive_then(self, other: Self) -> Self {
        if self <= 0.0 { 0.0 } else { other }
    }

    #[inline(always)]
    fn above(self, other: Self) -> bool {
        self > other
    }

    #[inline(always)]
    fn curve(self, f: impl Fn(f64) -> f64, _slope: impl Fn(f64, f64) -> f64) -> Self {
        f(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, other)
    }

    #[inline(always)]
    fn range(self) -> (f64, f64) {
        (self, self)
    }
}

impl Decision for Mask {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self.and(other)
    }
}

impl Number for Lanes {
    type Decision = Mask;

    #[inline(always)]
    fn same(self, x: f64) -> Self {
        Self::all(x)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn mul_add<const FMA: bool>(self, b: Self, c: Self) -> Self {
        self.mul_add::<FMA>(b, c)
    }

    #[inline(always)]
    fn positive_then(self, other: Self) -> Self {
        self.zip(other, |a, b| if a <= 0.0 { 0.0 } else { b })
    }

    #[inline(always)]
    fn above(self, other: Self) -> Mask {
        self.above(other)
    }

    #[inline(always)]
    fn curve(self, f: impl Fn(f64) -> f64, _slope: impl Fn(f64, f64) -> f64) -> Self {
        self.map(f)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        self.zip(other, f)
    }

    #[inline(always)]
    fn range(self) -> (f64, f64) {
        (self.least(), self.greatest())
    }
}
