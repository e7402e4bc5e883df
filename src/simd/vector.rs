//! Vector of as many numbers as a register of the instruction set holds: for loops along tables, where eight at a time would leave half of
//! them idle or spill.

use std::any::TypeId;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use pulp::Scalar256b;

pub(crate) use pulp::{Simd, WithSimd as Wide};

use super::lanes::LANES;
use super::number::{Decision, GUESS, MANTISSA, Number, ONE};

/// The numbers of a register.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Vector<S: Simd> {
    simd: S,
    numbers: S::f64s,
}

/// Yes or no for each.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Choice<S: Simd> {
    simd: S,
    lanes: S::m64s,
}

impl<S: Simd> Vector<S> {
    /// Number of lanes. A mask's size says nothing about it: AVX-512 has a bit a number.
    pub(crate) const LANES: usize = {
        assert!(S::F64_LANES.is_power_of_two() && S::F64_LANES <= LANES);
        S::F64_LANES
    };

    /// The same number everywhere.
    #[inline(always)]
    pub(crate) fn all(simd: S, x: f64) -> Self {
        Self {
            simd,
            numbers: simd.splat_f64s(x),
        }
    }

    /// 0, 1, 2, …
    #[inline(always)]
    pub(crate) fn count(simd: S) -> Self {
        Self::load(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0])
    }

    /// The first numbers of a slice.
    ///
    /// # Panics
    /// If there are too few.
    #[inline(always)]
    pub(crate) fn load(simd: S, from: &[f64]) -> Self {
        Self::of(simd, S::as_simd_f64s(from).0[0])
    }

    /// Writes the vector into the first numbers of a slice.
    ///
    /// # Panics
    /// If there are too few.
    #[inline(always)]
    pub(crate) fn store(self, to: &mut [f64]) {
        S::as_mut_simd_f64s(to).0[0] = self.numbers;
    }

    /// Registers of a slice, and what is left.
    #[inline(always)]
    pub(crate) fn split(of: &[f64]) -> (&[S::f64s], &[f64]) {
        S::as_simd_f64s(of)
    }

    /// The vector that a register holds.
    #[inline(always)]
    pub(crate) fn of(simd: S, numbers: S::f64s) -> Self {
        Self { simd, numbers }
    }

    /// Writes the vector into a register.
    #[inline(always)]
    pub(crate) fn put(self, to: &mut S::f64s) {
        *to = self.numbers;
    }

    /// Registers of a slice, so many of them.
    ///
    /// # Panics
    /// If there are too few.
    #[inline(always)]
    pub(crate) fn registers(of: &[f64], count: usize) -> &[S::f64s] {
        &S::as_simd_f64s(of).0[..count]
    }

    /// The same to write into.
    ///
    /// # Panics
    /// If there are too few.
    #[inline(always)]
    pub(crate) fn registers_mut(of: &mut [f64], count: usize) -> &mut [S::f64s] {
        &mut S::as_mut_simd_f64s(of).0[..count]
    }

    /// Beginnings of registers that cover so many numbers, which fill at least one, and how many of its numbers each has
    /// in common with that before it.
    #[inline(always)]
    pub(crate) fn cover(count: usize) -> impl Iterator<Item = (usize, usize)> {
        (0..count.div_ceil(Self::LANES)).map(move |i| {
            let at = (i * Self::LANES).min(count - Self::LANES);
            (at, i * Self::LANES - at)
        })
    }

    #[inline(always)]
    fn with(self, numbers: S::f64s) -> Self {
        Self { numbers, ..self }
    }

    #[inline(always)]
    fn choice(self, lanes: S::m64s) -> Choice<S> {
        Choice {
            simd: self.simd,
            lanes,
        }
    }

    /// Vector with another number everywhere.
    #[inline(always)]
    pub(crate) fn same(self, x: f64) -> Self {
        Self::all(self.simd, x)
    }

    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.numbers))
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.with(self.simd.abs_f64s(self.numbers))
    }

    /// The greater of two; where this is not a number, it stays so. Levels differ in what their maximum does with a NaN.
    #[inline(always)]
    pub(crate) fn or_more(self, least: Self) -> Self {
        self.below(least).choose(least, self)
    }

    /// The lesser of two, likewise.
    #[inline(always)]
    pub(crate) fn or_less(self, most: Self) -> Self {
        most.below(self).choose(most, self)
    }

    /// self · b + c, fused where the instructions have it: elsewhere a fused product is a slow call. NEON has it everywhere.
    #[inline(always)]
    pub(crate) fn mul_add(self, b: Self, c: Self) -> Self {
        if TypeId::of::<S>() == TypeId::of::<Scalar256b>() && !cfg!(target_arch = "aarch64") {
            return self * b + c;
        }
        self.with(self.simd.mul_add_e_f64s(self.numbers, b.numbers, c.numbers))
    }

    /// Choice of the numbers below those of another; nowhere where one of them is not a number.
    #[inline(always)]
    pub(crate) fn below(self, other: Self) -> Choice<S> {
        self.choice(self.simd.less_than_f64s(self.numbers, other.numbers))
    }

    /// Each by a function of one number.
    #[inline(always)]
    pub(crate) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut numbers = [0.0; LANES];
        self.store(&mut numbers);
        for number in &mut numbers[..Self::LANES] {
            *number = f(*number);
        }
        Self::load(self.simd, &numbers)
    }

    /// The last number of `before`, and all but the last of these.
    #[inline(always)]
    pub(crate) fn after(self, before: Self) -> Self {
        let turned = |of: Self| self.with(self.simd.rotate_right_f64s(of.numbers, 1));
        let first = Self::count(self.simd).below(self.same(0.5));
        first.choose(turned(before), turned(self))
    }

    /// The first number.
    #[inline(always)]
    pub(crate) fn first(self) -> f64 {
        let mut numbers = [0.0; LANES];
        self.store(&mut numbers);
        numbers[0]
    }

    #[inline(always)]
    pub(crate) fn sum(self) -> f64 {
        self.simd.reduce_sum_f64s(self.numbers)
    }
}

macro_rules! operator {
    ($trait:ident, $function:ident, $of:ident) => {
        impl<S: Simd> $trait for Vector<S> {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                self.with(self.simd.$of(self.numbers, other.numbers))
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Simd> Neg for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.same(0.0) - self
    }
}

impl<S: Simd> AddAssign for Vector<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<S: Simd> Add<f64> for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        self + self.same(other)
    }
}

impl<S: Simd> Mul<f64> for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self * self.same(other)
    }
}

impl<S: Simd> Number for Vector<S> {
    type Decision = Choice<S>;

    #[inline(always)]
    fn same(self, x: f64) -> Self {
        self.same(x)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    /// Fused where the instructions have it, whatever `FMA` is.
    #[inline(always)]
    fn mul_add<const FMA: bool>(self, b: Self, c: Self) -> Self {
        self.mul_add(b, c)
    }

    #[inline(always)]
    fn positive_then(self, other: Self) -> Self {
        let zero = self.same(0.0);
        let off = self
            .simd
            .less_than_or_equal_f64s(self.numbers, zero.numbers);
        self.choice(off).choose(zero, other)
    }

    #[inline(always)]
    fn above(self, other: Self) -> Choice<S> {
        other.below(self)
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
        let mut numbers = [[0.0; LANES]; 2];
        self.store(&mut numbers[0]);
        other.store(&mut numbers[1]);
        let [a, b] = numbers;
        let mut both = [0.0; LANES];
        for (i, to) in both.iter_mut().enumerate().take(Self::LANES) {
            *to = f(a[i], b[i]);
        }
        Self::load(self.simd, &both)
    }

    #[inline(always)]
    fn range(self) -> (f64, f64) {
        let mut numbers = [0.0; LANES];
        self.store(&mut numbers);
        let numbers = &numbers[..Self::LANES];
        let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
        let most = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (least, most)
    }

    #[inline(always)]
    fn outlined<R>(self, work: impl FnOnce() -> R) -> R {
        self.simd.vectorize(Outlined(work))
    }

    #[inline(always)]
    fn guess_inverse_root(self) -> Self {
        let simd = self.simd;
        let words: S::u32s = pulp::cast(self.numbers);
        let halved: S::u64s = pulp::cast(simd.wrapping_dyn_shr_u32s(words, simd.splat_u32s(1)));
        let guess = simd.sub_u64s(simd.splat_u64s(GUESS), halved);
        self.with(simd.transmute_f64s_u64s(guess))
    }

    #[inline(always)]
    fn exponent_and_mantissa(self) -> (Self, Self) {
        /// 2⁵², whose mantissa's last bits count ones, and the bits of the upper word that hold an exponent once it is shifted to its end.
        const COUNTS: f64 = 4_503_599_627_370_496.0;
        const UPPER: u64 = 0x0000_07ff_0000_0000;
        let simd = self.simd;
        let bits = simd.transmute_u64s_f64s(self.numbers);
        let and = |of: u64| simd.and_u64s(bits, simd.splat_u64s(of));
        let mantissa = simd.or_u64s(and(MANTISSA), simd.splat_u64s(ONE));
        // Only words of 32 bits can be shifted: the exponent comes out 2³² times too large.
        let words: S::u32s = pulp::cast(self.numbers);
        let shifted: S::u64s = pulp::cast(simd.wrapping_dyn_shr_u32s(words, simd.splat_u32s(20)));
        let shifted = simd.and_u64s(shifted, simd.splat_u64s(UPPER));
        let counted = simd.or_u64s(shifted, simd.splat_u64s(COUNTS.to_bits()));
        let counted = self.with(simd.transmute_f64s_u64s(counted)) + -COUNTS;
        let exponent = counted * (-32.0_f64).exp2() + -1023.0 + self * 0.0;
        (exponent, self.with(simd.transmute_f64s_u64s(mantissa)))
    }
}

/// Work that is compiled for the instruction set of its caller.
struct Outlined<F>(F);

impl<R, F: FnOnce() -> R> Wide for Outlined<F> {
    type Output = R;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> R {
        self.0()
    }
}

impl<S: Simd> Decision for Choice<S> {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self.and(other)
    }
}

impl<S: Simd> Choice<S> {
    #[inline(always)]
    fn with(self, lanes: S::m64s) -> Self {
        Self { lanes, ..self }
    }

    #[inline(always)]
    pub(crate) fn and(self, other: Self) -> Self {
        self.with(self.simd.and_m64s(self.lanes, other.lanes))
    }

    #[inline(always)]
    pub(crate) fn or(self, other: Self) -> Self {
        self.with(self.simd.or_m64s(self.lanes, other.lanes))
    }

    #[inline(always)]
    pub(crate) fn not(self) -> Self {
        self.with(self.simd.not_m64s(self.lanes))
    }

    /// Number that the choice takes from the one or the other vector.
    #[inline(always)]
    pub(crate) fn choose(self, yes: Vector<S>, no: Vector<S>) -> Vector<S> {
        yes.with(self.simd.select_f64s(self.lanes, yes.numbers, no.numbers))
    }

    #[inline(always)]
    pub(crate) fn any(self) -> bool {
        self.simd.first_true_m64s(self.lanes) < Vector::<S>::LANES
    }

    /// Lanes that are chosen.
    #[inline(always)]
    pub(crate) fn lanes(self) -> impl Iterator<Item = usize> {
        let mut marks = [0.0; LANES];
        let all = |x| Vector::all(self.simd, x);
        self.choose(all(1.0), all(0.0)).store(&mut marks);
        (0..Vector::<S>::LANES).filter(move |lane| marks[*lane] > 0.0)
    }
}
