//! Ball and groove as two circles in their meridional plane.

use crate::simd::{Decision, Number};

/// A direction in the meridional plane, by cosine and sine of its angle from the bearing's plane towards +z.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Inclination<T> {
    pub cos: T,
    pub sin: T,
}

impl<T> Inclination<T> {
    /// Shares of a force that presses along the normal in the plane and along the axis.
    #[inline(always)]
    pub fn share(self) -> (T, T) {
        (self.cos, self.sin)
    }

    /// Inclination in another kind of number.
    #[inline(always)]
    pub fn map<U>(self, of: impl Fn(T) -> U) -> Inclination<U> {
        Inclination {
            cos: of(self.cos),
            sin: of(self.sin),
        }
    }
}

/// A ball before a groove: the ball's centre is the origin, the groove's centre lies at axial place c and at −e along
/// the outward normal n_e; both races look alike here ([*Slices*](crate::equations#slices)).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Section<T> {
    /// Ball radius R \[m\].
    pub radius: T,
    /// Groove radius r \[m\].
    pub r: T,
    /// Distance of the ball's centre from the groove's along n_e \[m\].
    pub e: T,
    /// Axial place of the groove's centre from the ball's \[m\].
    pub c: T,
    /// Distance of the two centres \[m\].
    pub l: T,
    /// Common normal, out of the ball, at α'.
    pub normal: Inclination<T>,
    /// Normal approach δ = l + R − r, negative without contact \[m\].
    pub approach: T,
}

impl<T: Number> Section<T> {
    /// The section from the centres' distances; where all is `SYMMETRIC` about the groove's middle, c is known to be 0 and e to be positive.
    #[inline(always)]
    pub fn new<const FMA: bool, const SYMMETRIC: bool>(radius: T, r: T, e: T, c: T) -> Self {
        let (l, normal) = if SYMMETRIC {
            let (cos, sin) = (e.same(1.0), e.same(0.0));
            (e, Inclination { cos, sin })
        } else {
            let l = e.mul_add::<FMA>(e, c * c).sqrt();
            let over = l.same(1.0) / l;
            let (cos, sin) = (e * over, -(c * over));
            (l, Inclination { cos, sin })
        };
        Self {
            radius,
            r,
            e,
            c,
            l,
            normal,
            approach: l + radius - r,
        }
    }

    /// The same of a ball that a texture raises by a height where it touches: along the common normal, or in the plane, as its law
    /// counts penetrations.
    #[inline(always)]
    pub fn raised<const FMA: bool, const SYMMETRIC: bool>(self, is_flat: bool, height: T) -> Self {
        if is_flat {
            let approach = self.approach + height;
            return Self { approach, ..self };
        }
        Self::new::<FMA, SYMMETRIC>(self.radius, self.r, self.e + height, self.c)
    }

    /// Whether the ball is in front of the groove and clear of it. What is not a number touches, so that it shows.
    #[inline(always)]
    pub fn is_clear(&self) -> T::Decision {
        let zero = self.e.same(0.0);
        let in_front = self.e.above(zero);
        in_front.and((-self.approach).above(zero))
    }

    /// Height √(r² − x²) of the groove over its centre, under a point of the ball at sin α = ζ/R.
    #[inline(always)]
    pub fn groove<const FMA: bool>(&self, sin: T) -> T {
        let x = sin.mul_add::<FMA>(self.radius, -self.c);
        (-x).mul_add::<FMA>(x, self.r * self.r).sqrt()
    }

    /// Penetration of a slice in the plane, s = σ (d − R(z)) + ρ, into a groove of some height.
    #[inline(always)]
    pub fn penetration(&self, rho: T, groove: T) -> T {
        self.e + (rho - groove)
    }
}
