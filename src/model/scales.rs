//! Typical magnitudes of a scene: an approach, the highest contact frequency, and what follows from them.

use nalgebra::Vector3;

use super::{BodyId, BodyKind, Degree, Dof, Model, Race};
use crate::contact::{BallSide, ContactForce, Motion, Pair, Sink, V2, Waves, centrifugal};
use crate::scene::Row;

/// Scales that tolerances and the step cap follow.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
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
        let [outer, inner] = scene.peak_speeds();
        let speed = inner.max(outer);
        let (mut radial, mut axial) = (0.0, 0.0);
        for load in &model.loads {
            let peak = load.force.peak();
            radial += peak * load.direction[0].hypot(load.direction[1]);
            axial += peak * load.direction[2].abs();
        }
        // The heaviest ball of a row under a moment M carries 4.37 M/(Z d_m sin α), as under so much thrust.
        for (lever, size) in moments(model) {
            axial += 4.37 * lever * size / (2.0 * model.radius(BodyId::INNER));
        }
        for unbalance in &model.unbalances {
            radial += unbalance.moment * speed * speed;
        }
        for (_, force) in scene.forces_of_motion() {
            let peak = force.peak();
            radial += peak[0];
            axial += peak[1];
        }
        for body in model.layout().bodies() {
            let mass = model.bodies[body].mass;
            if matches!(model.layout().kind(body), BodyKind::Mode(_)) {
                continue;
            }
            radial += mass[Dof::X] * scene.gravity[0].hypot(scene.gravity[1]);
            axial += mass[Dof::Z] * scene.gravity[2].abs();
        }
        let mut scales = Self::default();
        for (i, row) in model.rows.iter().enumerate() {
            let geometry = &scene.rows[i];
            let body = &model.bodies[row.first_body()];
            let ball = &model.balls[row.first];
            // Stribeck's five for the heaviest of the balls of all rows; one row takes the whole thrust, at
            // an angle that a deep-groove bearing reaches under load.
            let (sin, cos) = geometry.contact_angle.max(10_f64.to_radians()).sin_cos();
            let external =
                5.0 * radial / (model.balls.len() as f64 * cos) + axial / (row.count as f64 * sin);
            let orbit = 0.4 * inner + 0.6 * outer;
            let outwards = centrifugal(body.mass[Dof::X], orbit) * geometry.pitch_diameter / 2.0;
            let squeeze = (-geometry.clearance / 4.0 * cos).max(0.0)
                + (geometry.axial_preload / 2.0 * sin).max(0.0);
            let bottoms = row
                .pairs
                .each_ref()
                .map(|pair| Bottom::new(pair, &ball.side));
            // Where no load acts: the force at an approach of 2e-5 of the ball's radius.
            let touch = bottoms[0].force(2e-5 * ball.side.radius);
            let mut load = (external + outwards).max(touch);
            for bottom in &bottoms {
                load = load.max(bottom.force(squeeze) + external);
            }
            let stiffness = bottoms.each_ref().map(|bottom| {
                let approach = bottom.approach(load);
                scales.approach = scales.approach.max(approach);
                let step = 1e-3 * approach;
                (bottom.force(approach + step) - bottom.force(approach - step)) / (2.0 * step)
            });
            scales.load = scales.load.max(load);
            let cage = scene.cage_links().map_or(0.0, |cage| 4.0 * cage.stiffness);
            let on_ball = (stiffness[0] + stiffness[1] + cage) / body.mass[Dof::X];
            scales.frequency = scales.frequency.max(on_ball.sqrt());
            if let Some(cage) = &row.cage {
                scales.frequency = scales.frequency.max(cage.frequency());
            }
            for race in Race::BOTH {
                let ring = &model.bodies[race.ring()];
                let balls = model.rows.len() as f64 * row.count as f64;
                let on_ring = balls / 2.0 * stiffness[race] / ring.mass[Dof::X];
                if ring.moves_along_axes() {
                    scales.frequency = scales.frequency.max(on_ring.sqrt());
                }
            }
        }
        scales.frequency = scales.frequency.max(tilts(model, &scales));
        for (_, force) in scene.forces_of_motion() {
            let ring = &model.bodies[Race::from(force.ring()).ring()];
            let square = force.stiffness() / ring.mass[Dof::X];
            scales.frequency = scales.frequency.max(square.sqrt());
        }
        for body in &model.bodies {
            for (degree, mass) in body.degrees.iter().zip(body.mass) {
                if let Degree::Free { stiffness, .. } = degree {
                    scales.frequency = scales.frequency.max((stiffness / mass).sqrt());
                }
            }
        }
        if let Some(structure) = &model.structure {
            let ring = model.bodies[BodyId::OUTER].mass[Dof::X];
            scales.frequency = scales.frequency.max(structure.frequency(ring));
        }
        scales
    }
}

/// Levers \[m\] of forces off the axis, and of moments across it (1), each with the largest size that it takes.
fn moments(model: &Model) -> impl Iterator<Item = (f64, f64)> {
    let forces = model.loads.iter().filter_map(|load| {
        let arm = load.arm?;
        let lever = arm.cross(&Vector3::from(load.direction)).xy().norm();
        Some((lever, load.force.peak()))
    });
    let moments = model.moments.iter().map(|moment| {
        let [x, y, _] = moment.direction;
        (x.hypot(y), moment.moment.peak())
    });
    forces.chain(moments)
}

/// Highest frequency of a ring's tilts \[rad/s\], on its contacts under the typical load and on its springs; 0 where none moves.
fn tilts(model: &Model, scales: &Scales) -> f64 {
    let contact = 1.5 * scales.load / scales.approach;
    let mut highest: f64 = 0.0;
    for ring in &model.rings {
        if !ring.degrees.iter().any(Degree::is_free) {
            continue;
        }
        let of_row = |row: &Row| {
            let (sin, cos) = row.contact_angle.max(20_f64.to_radians()).sin_cos();
            let along = (row.axial_position - ring.centre_of_mass).abs();
            let lever = row.pitch_diameter / 2.0 * sin + along * cos;
            row.ball_count as f64 / 2.0 * contact * lever * lever
        };
        let contacts: f64 = model.scene.rows.iter().map(of_row).sum();
        let own = ring
            .degrees
            .iter()
            .map(Degree::stiffness)
            .fold(0.0, f64::max);
        let coupled = ring.coupled.as_ref().map_or(0.0, |coupled| {
            coupled.stiffness.fixed_view::<3, 3>(3, 3).amax()
        });
        highest = highest.max((contacts + own + coupled) / ring.inertia.transverse);
    }
    highest.sqrt()
}

/// Adds up the elastic force.
struct ElasticTotal(f64);

impl Sink for ElasticTotal {
    fn force(&mut self, force: &ContactForce) {
        self.0 += force.elastic * force.share.0;
    }
}

/// A ball at the bottom of a healthy groove.
pub(super) struct Bottom {
    pair: Pair,
    ball: BallSide,
}

impl Bottom {
    pub fn new(pair: &Pair, ball: &BallSide) -> Self {
        let mut pair = pair.clone();
        pair.change(|flank| {
            (flank.defects, flank.waves) = (Vec::new(), Waves::default());
            flank.law.traction = None;
        });
        Self {
            pair,
            ball: BallSide::whole(ball.radius),
        }
    }

    /// Elastic force when pressed radially by an approach \[m\].
    fn force(&self, approach: f64) -> f64 {
        let (distance, z) = self.pair.seat(self.ball.radius, approach);
        let at = |x: f64, z: f64| Motion {
            centre: V2::new(x, 0.0),
            z,
            ..Motion::default()
        };
        let mut sum = ElasticTotal(0.0);
        let (ball, ring) = (at(distance, z), at(0.0, 0.0));
        self.pair.evaluate(&self.ball, &ball, &ring, &mut sum);
        sum.0
    }

    /// The approach \[m\] at which that force is reached, at most half the ball's radius: nearly a power of it, of 1.5 or
    /// a little more, so that each step leaves a fourteenth of the error at most.
    pub fn approach(&self, load: f64) -> f64 {
        const STEPS: usize = 12;
        let radius = self.ball.radius;
        let (least, most) = (1e-9 * radius, 0.5 * radius);
        let mut approach = 1e-3 * radius;
        for _ in 0..STEPS {
            let force = self.force(approach);
            if force <= 0.0 {
                return least;
            }
            approach = (approach * (load / force).powf(1.0 / 1.5)).clamp(least, most);
        }
        approach
    }
}
