//! Slip of ball and race along a zone as a formula of the position, from which friction is integrated.

use super::laws::film::FilmEffect;
use super::laws::traction::Rolling;
use super::profile::{Inclination, Section};
use super::{Cut, Law};
use crate::simd::{Lanes, Number, Simd, Vector, inverse_root};

/// How a ball moves against its ring, or eight balls do.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moves<T> {
    /// Velocity of the ball's centre along n_e and z \[m/s\].
    pub v_e: T,
    pub v_z: T,
    /// Slip along t_e is slide + spin · arm.
    pub slide: T,
    pub spin: T,
    pub rolling: Rolling<T>,
    /// A contact's arm from the ball's centre, R(z) − d, is this and σ times the groove's height.
    pub arm: T,
    /// Effect of the contact's film.
    pub oil: FilmEffect<T>,
}

impl Moves<f64> {
    /// Whether nothing moves, as in statics: there is no friction then.
    pub fn are_none(&self) -> bool {
        [self.v_e, self.v_z, self.slide, self.spin] == [0.0; 4]
    }
}

/// Slip along the line that a zone is cut along, by its coordinate u \[m\] from the middle of the zone.
///
/// | symbol | meaning | unit |
/// |---|---|---|
/// | u_t | along the race, c₀ + c₁ u + … + c₄ u⁴ | m/s |
/// | u_m | along the meridian, m₀ + m₁ u + m₂ u² | m/s |
/// | w | width of the traction law ([`super::Traction::width`]); of a film half of the slip at which it bends | m/s |
/// | h | 1 − b z (1 + (1 − b)/2 z), z = (u/r)²: the force of the element goes like (1 − x²)^β/h, b = 3/4 β on the chord | |
///
/// A model, not the slip itself: by how much it is off, the weights of friction lose exactness and no more.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slip<T> {
    along: [T; 5],
    across: [T; 3],
    /// w².
    width: T,
    /// w of a film; 0 without.
    bend: T,
    /// 1/r².
    over: T,
    /// b, and b (1 − b)/2.
    fade: [f64; 2],
}

impl<T: Number> Slip<T> {
    /// (u_t² + u_m² + w²) h² at u: the inverse square of what friction per force and slip goes like.
    #[inline(always)]
    pub fn square<const FMA: bool>(&self, u: T) -> T {
        self.squares::<FMA>(u).0
    }

    /// The same at u and at −u, which have their even and odd parts in common.
    #[inline(always)]
    pub fn squares<const FMA: bool>(&self, u: T) -> (T, T) {
        let ([c_0, c_1, c_2, c_3, c_4], [m_0, m_1, m_2]) = (self.along, self.across);
        let v = u * u;
        let even = c_4.mul_add::<FMA>(v, c_2).mul_add::<FMA>(v, c_0);
        let odd = c_3.mul_add::<FMA>(v, c_1) * u;
        let (across_even, across_odd) = (m_2.mul_add::<FMA>(v, m_0), m_1 * u);
        let fade = self.fading::<FMA>(v);
        let fade = fade * fade;
        let plus = self.sum::<FMA>(even + odd, across_even + across_odd);
        let minus = self.sum::<FMA>(even - odd, across_even - across_odd);
        (plus * fade, minus * fade)
    }

    /// Sum of the squares of slip along and across the race and of the width.
    #[inline(always)]
    fn sum<const FMA: bool>(&self, along: T, across: T) -> T {
        let square = across.mul_add::<FMA>(across, self.width);
        along.mul_add::<FMA>(along, square)
    }

    /// h at u² = v.
    #[inline(always)]
    fn fading<const FMA: bool>(&self, v: T) -> T {
        let [first, second] = self.fade;
        let z = v * self.over;
        (z * -second + -first).mul_add::<FMA>(z, v.same(1.0))
    }

    /// Peak of friction per force and slip, 1/(h √(u² + w²)), of a film 1/(h (w + √(u² + w²))). From the [`Self::square`] at u.
    #[inline(always)]
    pub fn peak<const FMA: bool, const FILM: bool>(&self, square: T, u: T) -> T {
        let over = inverse_root::<T, FMA>(square);
        if !FILM {
            return over;
        }
        let bend = self.bend * self.fading::<FMA>(u * u);
        let root = inverse_root::<T, FMA>(square.mul_add::<FMA>(over, bend));
        root * root
    }

    /// A number over it.
    #[inline(always)]
    pub fn over_peak<const FMA: bool, const FILM: bool>(&self, number: T, square: T, u: T) -> T {
        let over = inverse_root::<T, FMA>(square);
        if !FILM {
            return number * square * over;
        }
        let bend = self.bend * self.fading::<FMA>(u * u);
        number * square.mul_add::<FMA>(over, bend)
    }

    /// Slips along and across the race as polynomials of x, u = centre + half · x.
    #[inline(always)]
    pub fn over_zone<const FMA: bool>(&self, centre: T, half: T) -> ([T; 5], [T; 3]) {
        let Self {
            mut along,
            mut across,
            ..
        } = self.from::<FMA>(centre);
        let mut scale = half;
        for k in 1..5 {
            along[k] = along[k] * scale;
            if k < 3 {
                across[k] = across[k] * scale;
            }
            scale = scale * half;
        }
        (along, across)
    }

    /// h at u, and w of a film.
    #[inline(always)]
    pub fn fading_and_bend<const FMA: bool>(&self, u: T) -> (T, T) {
        (self.fading::<FMA>(u * u), self.bend)
    }

    /// The same counted from another u.
    #[inline(always)]
    pub fn from<const FMA: bool>(mut self, middle: T) -> Self {
        shift::<T, 5, FMA>(&mut self.along, middle);
        shift::<T, 3, FMA>(&mut self.across, middle);
        self
    }
}

/// Powers of a polynomial about another place, by Horner's scheme.
#[inline(always)]
fn shift<T: Number, const N: usize, const FMA: bool>(powers: &mut [T; N], place: T) {
    for last in 0..N - 1 {
        for k in (last..N - 1).rev() {
            powers[k] = powers[k + 1].mul_add::<FMA>(place, powers[k]);
        }
    }
}

impl<T: Number> Slip<T> {
    /// Slip along the line that a zone is cut along, under a law and on a race of some σ; none without friction.
    ///
    /// Along the race it is linear in the groove's height, which is developed about the middle of the zone; across it the
    /// ball's surface alone says which way.
    #[inline(always)]
    pub fn along<const FMA: bool>(
        law: &Law,
        sigma: T,
        section: &Section<T>,
        moves: &Moves<T>,
    ) -> Option<Self> {
        let traction = law.traction?;
        let bend = moves.oil.bend;
        let width = if traction.is_film() {
            bend * bend
        } else {
            bend.same(traction.width() * traction.width())
        };
        let Inclination { cos, sin } = section.normal;
        let groove = section.groove::<FMA>(sin);
        let one = cos.same(1.0);
        let (inverse, over, steep) = (one / section.radius, one / section.r, one / groove);
        // Of the groove at the middle: its slope along z, and half of its curvature along the line.
        let (tan, across_z) = ((section.radius * sin - section.c) * steep, cos * steep);
        let rise = tan.mul_add::<FMA>(tan, one);
        let second = rise * cos * across_z * -0.5;
        let (heights, fade, bent) = match law.cut() {
            // Over u, ζ runs along the ball, and both circles meet at the chord's ends: c₄ is that of √(r² − u²).
            Cut::BallSurface => {
                let second = second + tan * sin * inverse * 0.5;
                let heights = [second, cos.same(0.0), second * over * over * 0.25];
                let fade = 0.75 * law.elastic.exponent();
                (heights, fade, inverse * inverse * -0.5)
            }
            // g √(1 − 2 t v − v²) with v = u cos α'/g.
            Cut::CommonTangent { .. } => {
                let third = second * tan * across_z;
                let fourth = (rise * 5.0 + -4.0) * second * across_z * across_z * 0.25;
                ([second, third, fourth], 0.0, cos.same(0.0))
            }
        };
        let turning = moves.spin * sigma;
        let across = moves.v_z * cos - moves.v_e * sin;
        let middle = (groove - section.e) * sigma;
        // The common tangent is straight, the ball's surface is not.
        let falls = if law.cut().is_flat() {
            [cos.same(0.0); 2]
        } else {
            [
                -((moves.v_z * sin + moves.v_e * cos) * inverse),
                across * bent,
            ]
        };
        Some(Self {
            along: [
                moves.spin.mul_add::<FMA>(middle, moves.slide),
                -(turning * tan * cos),
                turning * heights[0],
                turning * heights[1],
                turning * heights[2],
            ],
            across: [across, falls[0], falls[1]],
            width,
            bend,
            over: over * over,
            fade: [fade, 0.5 * fade * (1.0 - fade)],
        })
    }

    /// The same of a ball that turns across its ring's axis, with w_n and w_t along n_e and t_e \[rad/s\]: less w_n ζ along the race, and
    /// less w_t times the distance of the race from the ball's centre across it: along the ball's surface it grows by u² (1/R − 1/r)/2,
    /// along the common tangent it falls by u²/2r.
    #[inline(always)]
    pub fn turning_across<const FMA: bool>(
        mut self,
        law: &Law,
        section: &Section<T>,
        [w_n, w_t]: [T; 2],
    ) -> Self {
        let Inclination { cos, sin } = section.normal;
        let middle = section.radius * sin;
        let (inverse, over) = (sin.same(1.0) / section.radius, sin.same(1.0) / section.r);
        self.along[0] = self.along[0] - w_n * middle;
        self.along[1] = self.along[1] - w_n * cos;
        if !law.cut().is_flat() {
            // The ball's surface bends away from the line.
            self.along[2] += w_n * middle * inverse * inverse * 0.5;
        }
        let h = section.groove::<FMA>(sin) - section.e;
        let lever = middle.mul_add::<FMA>(sin, h * cos);
        self.across[0] = self.across[0] - w_t * lever;
        let bends = if law.cut().is_flat() {
            -over
        } else {
            inverse - over
        };
        self.across[2] = self.across[2] - w_t * bends * 0.5;
        self
    }
}

impl Slip<Lanes> {
    /// The slip of the contacts that a register holds, from one of them on.
    #[inline(always)]
    pub fn register<S: Simd>(&self, simd: S, from: usize) -> Slip<Vector<S>> {
        let of = |lanes: &Lanes| Vector::load(simd, &lanes.numbers()[from..]);
        let ([c_0, c_1, c_2, c_3, c_4], [m_0, m_1, m_2]) = (&self.along, &self.across);
        Slip {
            along: [of(c_0), of(c_1), of(c_2), of(c_3), of(c_4)],
            across: [of(m_0), of(m_1), of(m_2)],
            width: of(&self.width),
            bend: of(&self.bend),
            over: of(&self.over),
            fade: self.fade,
        }
    }
}

impl Slip<f64> {
    /// A slip for tests.
    #[cfg(test)]
    pub fn made(along: [f64; 5], across: [f64; 3]) -> Self {
        Self {
            along,
            across,
            width: 1e-4,
            bend: 0.0,
            over: 2e4,
            fade: [0.8, 0.08],
        }
    }

    /// A slip under a film, for tests.
    #[cfg(test)]
    pub fn of_film(along: [f64; 5], across: [f64; 3], bend: f64) -> Self {
        Self {
            along,
            across,
            width: bend * bend,
            bend,
            over: 1.0,
            fade: [0.0; 2],
        }
    }

    /// Whether the slip is a number everywhere: the middle of the zone lies in the groove.
    pub fn is_finite(&self) -> bool {
        self.along.iter().chain(&self.across).all(|c| c.is_finite())
    }
}
