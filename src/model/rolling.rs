//! How a ball that spins freely rolls on both races ([*Rings that tilt*](crate::equations#rings-that-tilt-balls-that-spin-freely)).
//!
//! ```text
//! ω_c d + ω_z R cos α_o − ω_n R sin α_o = 0
//! ω_c d − ω_z R cos α_i + ω_n R sin α_i = Ω (d − R cos α_i)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ω_c | orbit speed | rad/s |
//! | ω_z, ω_n | the ball's angular velocity along the axis and outwards | rad/s |
//! | α_i, α_o | contact angles, positive towards +z outside | rad |
//! | d, R | distance of the ball's centre from the axis, its radius | m |
//!
//! That leaves one number open: how pivoting is shared between the races. With none at the outer race it is what Jones and
//! Harris call outer race control, with none at the inner race inner race control. Neither is a law of this model.

use super::Race;

/// A ball that rolls without slip on the outer race, which rests or turns, and on the inner race.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PureRolling {
    pub orbit: f64,
    /// ω_z.
    pub axial: f64,
    /// ω_n.
    pub outward: f64,
}

impl PureRolling {
    /// The same where both rings turn faster by a speed \[rad/s\].
    pub fn turned_by(self, speed: f64) -> Self {
        Self {
            orbit: self.orbit + speed,
            axial: self.axial + speed,
            ..self
        }
    }
}

/// A ball between its races, seen from the outer ring.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Between {
    /// R.
    pub radius: f64,
    /// d.
    pub distance: f64,
    /// α_o and α_i.
    pub angles: [f64; 2],
    /// Speed of the inner ring against the outer \[rad/s\].
    pub speed: f64,
}

impl Between {
    /// Rolling without pivoting on one race.
    pub fn controlled_by(&self, race: Race) -> PureRolling {
        let Self {
            radius,
            distance,
            angles: [outer, inner],
            speed,
        } = *self;
        let ((sin_o, cos_o), (sin_i, cos_i)) = (outer.sin_cos(), inner.sin_cos());
        // The ball turns by `rate` about an axis across one contact's normal, plus `along` about the normal itself.
        let (sin, cos, along) = match race {
            Race::Outer => (sin_o, cos_o, 0.0),
            Race::Inner => (sin_i, cos_i, speed * sin_i),
        };
        // ω_z = rate cos + along sin, ω_n = along cos − rate sin, set into both equations.
        let [on_outer, on_inner] =
            [(sin_o, cos_o), (sin_i, cos_i)].map(|(s, c)| (cos * c + sin * s, sin * c - cos * s));
        let lever = radius * (on_outer.0 + on_inner.0);
        let free = speed * (distance - radius * cos_i);
        let pivots = along * radius * (on_outer.1 + on_inner.1);
        let rate = -(free + pivots) / lever;
        PureRolling {
            orbit: -radius * (rate * on_outer.0 + along * on_outer.1) / distance,
            axial: rate * cos + along * sin,
            outward: along * cos - rate * sin,
        }
    }

    /// Pivoting rates against outer and inner race \[rad/s\].
    pub fn pivoting(&self, of: &PureRolling) -> [f64; 2] {
        let [(sin_o, cos_o), (sin_i, cos_i)] = self.angles.map(f64::sin_cos);
        [
            of.outward * cos_o + of.axial * sin_o,
            of.outward * cos_i + (of.axial - self.speed) * sin_i,
        ]
    }

    /// Rolling with pivoting rates as one over how much the races resist it: what friction far below sliding settles to.
    pub fn resisted(&self, [outer, inner]: [f64; 2]) -> PureRolling {
        let [at_outer, at_inner] = Race::BOTH.map(|race| self.controlled_by(race));
        let ([_, inner_rate], [outer_rate, _]) =
            (self.pivoting(&at_outer), self.pivoting(&at_inner));
        let (held_outside, held_inside) = (outer * outer_rate.abs(), inner * inner_rate.abs());
        let both = held_outside + held_inside;
        let share = if both > 0.0 { held_outside / both } else { 0.5 };
        let mix = |a: f64, b: f64| share * a + (1.0 - share) * b;
        PureRolling {
            orbit: mix(at_outer.orbit, at_inner.orbit),
            axial: mix(at_outer.axial, at_inner.axial),
            outward: mix(at_outer.outward, at_inner.outward),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ball and pitch of a 218 at 10 000 1/min in Harris' example.
    fn between() -> Between {
        Between {
            radius: 22.23e-3 / 2.0,
            distance: 125.26e-3 / 2.0,
            angles: [33.3_f64, 48.8].map(f64::to_radians),
            speed: 1.0,
        }
    }

    /// Literature: Jones' and Harris' speeds with control by either race ([*Rings that
    /// tilt*](crate::equations#rings-that-tilt-balls-that-spin-freely)).
    #[test]
    fn control_by_a_race_is_jones() {
        let between = between();
        for (race, orbit, about, pitch_angle) in [
            (Race::Outer, 0.449_729, 2.92044, 28.450_f64),
            (Race::Inner, 0.415_200, 2.94307, 57.398),
        ] {
            let found = between.controlled_by(race);
            assert!((found.orbit - orbit).abs() < 1e-6, "{race:?} {found:?}");
            // As the cage sees it.
            let (axial, outward) = (found.axial - found.orbit, found.outward);
            assert!(
                (axial.hypot(outward) - about).abs() < 1e-5,
                "{race:?} {found:?}"
            );
            let pitched = outward.atan2(-axial).to_degrees();
            assert!(
                (pitched.abs() - pitch_angle).abs() < 1e-3,
                "{race:?} {pitched}"
            );
            assert!(between.pivoting(&found)[race].abs() < 1e-12);
        }
    }

    /// Analytic: both races are rolled on whatever the shares, and the pivoting rates are as one over the resistances.
    #[test]
    fn resisted_pivoting_is_shared() {
        let between = between();
        for shares in [[1.0, 1.0], [1.0, 27.0 / 73.0], [0.2, 3.0]] {
            let found = between.resisted(shares);
            let [outer, inner] = between.pivoting(&found);
            assert!((shares[0] * outer.abs() - shares[1] * inner.abs()).abs() < 1e-12);
            let ((sin, cos), r) = (between.angles[0].sin_cos(), between.radius);
            let slip =
                found.orbit * between.distance + r * (found.axial * cos - found.outward * sin);
            assert!(slip.abs() < 1e-14);
        }
    }

    /// Limits: without contact angles a ball spins about the axis at the speed of rolling.
    #[test]
    fn in_the_plane_it_spins_about_the_axis() {
        let between = Between {
            angles: [0.0; 2],
            ..between()
        };
        let found = between.resisted([1.0, 2.0]);
        let gamma = 22.23 / 125.26;
        let orbit = (1.0 - gamma) / 2.0;
        assert!((found.orbit - orbit).abs() < 1e-15);
        assert!((found.axial + orbit / gamma).abs() < 1e-14);
        assert_eq!(found.outward, 0.0);
    }
}
