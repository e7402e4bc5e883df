//! Numbers with their derivatives (forward differentiation).

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

use crate::simd::Number;

/// A number and its derivatives by N variables: what a kernel that computes with it differentiates itself by.
///
/// Slopes are treated in loops, not by `map`: the compiler does not always take closures into what it compiles for
/// other instructions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dual<T, const N: usize> {
    pub value: T,
    pub slopes: [T; N],
}

impl<T: Number, const N: usize> Dual<T, N> {
    /// A number that depends on none of the variables.
    #[inline(always)]
    pub fn constant(value: T) -> Self {
        let slopes = [value.same(0.0); N];
        Self { value, slopes }
    }

    /// The i-th of the variables.
    #[inline(always)]
    pub fn variable(value: T, i: usize) -> Self {
        let mut dual = Self::constant(value);
        dual.slopes[i] = value.same(1.0);
        dual
    }

    /// Chain rule: a function of the number, from the function's value and slope.
    #[inline(always)]
    fn chain(self, value: T, slope: T) -> Self {
        let mut slopes = self.slopes;
        for own in &mut slopes {
            *own = *own * slope;
        }
        Self { value, slopes }
    }
}

impl<T: Number, const N: usize> Add for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl<T: Number, const N: usize> AddAssign for Dual<T, N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        self.value += other.value;
        for (slope, other) in self.slopes.iter_mut().zip(other.slopes) {
            *slope += other;
        }
    }
}

impl<T: Number, const N: usize> Neg for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        let mut slopes = self.slopes;
        for slope in &mut slopes {
            *slope = -*slope;
        }
        Self {
            value: -self.value,
            slopes,
        }
    }
}

impl<T: Number, const N: usize> Sub for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Number, const N: usize> Mul for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let mut product = self.chain(self.value * other.value, other.value);
        for (slope, by_other) in product.slopes.iter_mut().zip(other.slopes) {
            *slope += self.value * by_other;
        }
        product
    }
}

impl<T: Number, const N: usize> Div for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let over = other.value.same(1.0) / other.value;
        let value = self.value * over;
        let mut quotient = self.chain(value, over);
        let by_other = -(value * over);
        for (slope, other) in quotient.slopes.iter_mut().zip(other.slopes) {
            *slope += by_other * other;
        }
        quotient
    }
}

impl<T: Number, const N: usize> Add<f64> for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: f64) -> Self {
        self.value = self.value + other;
        self
    }
}

impl<T: Number, const N: usize> Mul<f64> for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.chain(self.value * other, self.value.same(other))
    }
}

impl<T: Number, const N: usize> Number for Dual<T, N> {
    type Decision = T::Decision;

    #[inline(always)]
    fn same(self, x: f64) -> Self {
        Self::constant(self.value.same(x))
    }

    /// Square root; at 0, where it has no slope, the slope counts as 0.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        self.chain(value, value.positive_then(value.same(0.5) / value))
    }

    #[inline(always)]
    fn mul_add<const FMA: bool>(self, b: Self, c: Self) -> Self {
        let mut slopes = c.slopes;
        for (i, slope) in slopes.iter_mut().enumerate() {
            let rest = self.value.mul_add::<FMA>(b.slopes[i], *slope);
            *slope = self.slopes[i].mul_add::<FMA>(b.value, rest);
        }
        Self {
            value: self.value.mul_add::<FMA>(b.value, c.value),
            slopes,
        }
    }

    #[inline(always)]
    fn positive_then(self, other: Self) -> Self {
        let mut slopes = other.slopes;
        for slope in &mut slopes {
            *slope = self.value.positive_then(*slope);
        }
        Self {
            value: self.value.positive_then(other.value),
            slopes,
        }
    }

    #[inline(always)]
    fn above(self, other: Self) -> T::Decision {
        self.value.above(other.value)
    }

    #[inline(always)]
    fn curve(self, f: impl Fn(f64) -> f64, slope: impl Fn(f64, f64) -> f64) -> Self {
        let value = self.value.curve(&f, &slope);
        self.chain(value, self.value.zip(value, slope))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        let one = self.value.same(1.0);
        let sign = self.value.positive_then(one) - (-self.value).positive_then(one);
        self.chain(self.value.abs(), sign)
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self::constant(self.value.zip(other.value, f))
    }

    #[inline(always)]
    fn range(self) -> (f64, f64) {
        self.value.range()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Analytic: of f(x, y) = √(x y) / (x + 2) − e^{−y} at (3, 1.5), by hand.
    #[test]
    fn differentiates() {
        let (x, y) = (
            Dual::<f64, 2>::variable(3.0, 0),
            Dual::<f64, 2>::variable(1.5, 1),
        );
        let f = (x * y).sqrt() / (x + 2.0) - (-y).exp();
        let root = 4.5_f64.sqrt();
        let by_x = 1.5 / (2.0 * root) / 5.0 - root / 25.0;
        let by_y = 3.0 / (2.0 * root) / 5.0 + (-1.5_f64).exp();
        assert!((f.value - (root / 5.0 - (-1.5_f64).exp())).abs() < 1e-15);
        assert!((f.slopes[0] - by_x).abs() < 1e-15);
        assert!((f.slopes[1] - by_y).abs() < 1e-15);
    }

    /// Analytic: nothing is left of slopes where a number is not positive.
    #[test]
    fn gates_its_slopes() {
        let x = Dual::<f64, 1>::variable(-1.0, 0);
        assert_eq!(x.or_zero().slopes, [0.0]);
        assert_eq!((-x).or_zero().slopes, [-1.0]);
        assert_eq!(x.or_zero().sqrt().slopes, [0.0]);
    }
}
