//! The scene's own scales: a typical approach, the highest contact frequency, and what follows from them.

use super::{Degree, Model};
use crate::contact::{BallSide, Motion, Pair, Sink, Touch, V2};
use crate::scene::Drive;

/// Scales that tolerances and the step cap follow.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Scales {
    /// Estimated load of the heaviest loaded ball \[N\].
    pub load: f64,
    /// Approach of ball and race under that load \[m\].
    pub approach: f64,
    /// Highest angular frequency: a ball between its races, a ring on its balls, supports, cage \[rad/s\].
    pub frequency: f64,
}

impl Scales {
    /// Estimated from loads at their peaks; a wrong load by half moves the frequency by a tenth.
    pub(super) fn of(model: &Model) -> Self {
        let scene = &model.scene;
        let speed = match &scene.drive {
            Drive::Speed(speed) => speed.peak(),
            Drive::Torque { initial_speed, .. } => initial_speed.abs(),
        };
        let (mut radial, mut axial) = (0.0, 0.0);
        for load in &model.loads {
            let peak = load.force.peak();
            radial += peak * load.direction[0].hypot(load.direction[1]);
            axial += peak * load.direction[2].abs();
        }
        for unbalance in &model.unbalances {
            radial += unbalance.moment * speed * speed;
        }
        for body in &model.bodies {
            radial += body.mass[0] * scene.gravity[0].hypot(scene.gravity[1]);
            axial += body.mass[0] * scene.gravity[2].abs();
        }
        let mut scales = Self::default();
        for (i, row) in model.rows.iter().enumerate() {
            let geometry = &scene.rows[i];
            let body = &model.bodies[2 + row.first];
            let ball = &model.balls[row.first];
            // Stribeck's five for the heaviest of the balls of all rows; one row takes the whole thrust, at
            // an angle that a deep-groove bearing reaches under load.
            let (sin, cos) = geometry.contact_angle.max(10_f64.to_radians()).sin_cos();
            let external =
                5.0 * radial / (model.balls.len() as f64 * cos) + axial / (row.count as f64 * sin);
            let orbit = 0.4 * speed;
            let centrifugal = body.mass[0] * orbit * orbit * geometry.pitch_diameter / 2.0;
            let squeeze = (-geometry.clearance / 4.0 * cos).max(0.0)
                + (geometry.axial_preload / 2.0 * sin).max(0.0);
            // Where nothing acts, a touch of a hundred-thousandth of the ball.
            let touch = force_at(&row.pairs[0], &ball.side, 2e-5 * ball.side.radius);
            let mut load = (external + centrifugal).max(touch);
            for pair in &row.pairs {
                load = load.max(force_at(pair, &ball.side, squeeze) + external);
            }
            let stiffness = row.pairs.each_ref().map(|pair| {
                let approach = approach_at(pair, &ball.side, load);
                scales.approach = scales.approach.max(approach);
                let step = 1e-3 * approach;
                (force_at(pair, &ball.side, approach + step)
                    - force_at(pair, &ball.side, approach - step))
                    / (2.0 * step)
            });
            scales.load = scales.load.max(load);
            let cage = scene.cage.as_ref().map_or(0.0, |cage| 4.0 * cage.stiffness);
            let on_ball = (stiffness[0] + stiffness[1] + cage) / body.mass[0];
            scales.frequency = scales.frequency.max(on_ball.sqrt());
            for (ring, stiffness) in model.bodies[..2].iter().zip(stiffness) {
                let on_ring =
                    model.rows.len() as f64 * row.count as f64 / 2.0 * stiffness / ring.mass[0];
                if ring.degrees[..3]
                    .iter()
                    .any(|d| matches!(d, Degree::Free { .. }))
                {
                    scales.frequency = scales.frequency.max(on_ring.sqrt());
                }
            }
        }
        for body in &model.bodies {
            for (degree, mass) in body.degrees.iter().zip(body.mass) {
                if let Degree::Free { stiffness, .. } = degree {
                    scales.frequency = scales.frequency.max((stiffness / mass).sqrt());
                }
            }
        }
        scales
    }
}

/// Adds up the elastic force.
struct Elastic(f64);

impl Sink for Elastic {
    fn touch(&mut self, touch: &Touch) {
        self.0 += touch.elastic * touch.share.0;
    }
}

/// Elastic force of a ball pressed radially into a healthy groove's bottom by an approach \[m\].
fn force_at(pair: &Pair, ball: &BallSide, approach: f64) -> f64 {
    let race = &pair.race;
    let distance = race.a + race.sigma * (race.r - ball.radius + approach);
    let at = |x: f64, z: f64| Motion {
        centre: V2::new(x, 0.0),
        z,
        theta: 0.0,
        velocity: V2::zeros(),
        vz: 0.0,
        omega: 0.0,
    };
    let healthy = BallSide {
        radius: ball.radius,
        faults: Vec::new(),
    };
    let whole = Pair {
        faults: Vec::new(),
        waves: crate::contact::Waves::default(),
        ..pair.clone()
    };
    let mut sum = Elastic(0.0);
    whole.evaluate(
        &healthy,
        &at(distance, race.centre),
        &at(0.0, 0.0),
        &mut sum,
    );
    sum.0
}

/// The approach \[m\] at which that force is reached, by bisection.
fn approach_at(pair: &Pair, ball: &BallSide, load: f64) -> f64 {
    let (mut low, mut high) = (1e-9 * ball.radius, 0.5 * ball.radius);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        if force_at(pair, ball, middle) < load {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
