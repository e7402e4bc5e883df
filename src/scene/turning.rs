//! How fast the rings turn, as far as a scene gives it, and how that moves rolling balls.
//!
//! Balls roll between two rings as they do between a ring that stands and one that turns at Ω_i − Ω_o, seen by an observer who
//! turns with the outer ring (Harris & Kotzalas, Essential Concepts of Bearing Technology: "both rings rotating"):
//!
//! ```text
//! ω_c = Ω_o + ½ (1 − γ) (Ω_i − Ω_o)        γ = D cos α / d_m
//! ```
//!
//! Contacts, films and fault frequencies follow the difference; inertia, loads and gravity the speeds themselves.

use super::{Drive, Profile, RingName, Scene, TimeFunction};

impl Scene {
    /// The given speed of a ring about the axis \[rad/s\]; `None` for a ring that is held, turns freely or is driven by a torque.
    pub fn given_speed(&self, ring: RingName) -> Option<&TimeFunction> {
        match (ring, &self.drive) {
            (RingName::Outer, _) => self.outer_speed.as_ref(),
            (RingName::Inner, Drive::Speed(speed)) => Some(speed),
            (RingName::Inner, Drive::Torque { .. }) => None,
        }
    }

    /// Speeds of outer and inner ring for a run that begins at a time \[s\]; of a torque, the initial one \[rad/s\].
    pub fn ring_speeds(&self, t: f64) -> [f64; 2] {
        let outer = self.outer_speed.as_ref().map_or(0.0, |speed| speed.at(t));
        [outer, self.drive.speed_from(t)]
    }

    /// Speed of the inner ring relative to the outer, Ω_i − Ω_o, for a run that begins at a time \[s\] \[rad/s\].
    pub fn relative_speed(&self, t: f64) -> f64 {
        let [outer, inner] = self.ring_speeds(t);
        inner - outer
    }

    /// Whether both rings keep their speeds all the time.
    pub(crate) fn turns_steadily(&self) -> bool {
        let is_steady = |speed: &TimeFunction| matches!(speed, TimeFunction::Constant(_));
        matches!(&self.drive, Drive::Speed(speed) if is_steady(speed))
            && self.outer_speed.as_ref().is_none_or(is_steady)
    }

    /// Largest speeds of outer and inner ring that are known \[rad/s\].
    pub(crate) fn peak_speeds(&self) -> [f64; 2] {
        let outer = self.outer_speed.as_ref().map_or(0.0, TimeFunction::peak);
        [outer, self.drive.peak_speed()]
    }

    /// Largest relative speed of the rings that is known, |Ω_i − Ω_o| \[rad/s\]; an upper bound where one of them is a sine or a
    /// spline.
    pub(crate) fn peak_relative_speed(&self) -> f64 {
        let Some(outer) = &self.outer_speed else {
            return self.drive.peak_speed();
        };
        let initial;
        let inner = match &self.drive {
            Drive::Speed(speed) => speed,
            Drive::Torque { initial_speed, .. } => {
                initial = TimeFunction::Constant(*initial_speed);
                &initial
            }
        };
        // Between corners both are linear, beyond them constant.
        let corners = [outer, inner].map(TimeFunction::breakpoints).concat();
        let apart = |t: f64| {
            let [outer, inner] = [outer, inner].map(|speed| ends(speed, t));
            (inner[1] - outer[0]).abs().max((outer[1] - inner[0]).abs())
        };
        corners.into_iter().map(apart).fold(apart(0.0), f64::max)
    }
}

/// Least and largest value at a time; of a sine or a spline those at any time.
fn ends(of: &TimeFunction, t: f64) -> [f64; 2] {
    match of {
        TimeFunction::Profile(Profile::Sine { .. } | Profile::Spline { .. }) => of.range(),
        _ => [of.at(t); 2],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;

    /// Analytic: two ramps in opposite ways, and a sine beside a constant.
    #[test]
    fn the_largest_relative_speed_is_found() {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        let ramp = |from, to, start, end| {
            TimeFunction::Profile(Profile::Ramp {
                from,
                to,
                start,
                end,
            })
        };
        scene.drive = Drive::Speed(ramp(0.0, 100.0, 0.0, 1.0));
        for (outer, largest) in [
            (ramp(0.0, -50.0, 2.0, 3.0), 150.0),
            (ramp(0.0, 100.0, 1.0, 2.0), 100.0),
            (ramp(0.0, 50.0, 0.0, 1.0), 50.0),
            (70.0.into(), 70.0),
            (
                TimeFunction::Profile(Profile::Sine {
                    mean: 0.0,
                    amplitude: -10.0,
                    frequency: 1.0,
                    phase: 0.0,
                }),
                110.0,
            ),
        ] {
            scene.outer_speed = Some(outer);
            assert_eq!(scene.peak_relative_speed(), largest);
        }
        scene.outer_speed = Some(ramp(3.0, 30.0, 0.0, 1.0));
        assert_eq!(scene.ring_speeds(1.0), [30.0, 100.0]);
        assert_eq!(scene.relative_speed(0.0), -3.0);
    }
}
