//! Analytic: what caps of a ball do, against the elastic energy, its rate, and defects of other shapes.

use nalgebra::{Rotation3, Vector3};

use super::gradient_tests::{RADIUS, pair};
use crate::contact::damage::{Bed, PittedContact};
use crate::contact::hertz::Hertz;
use crate::contact::laws::elastic::tests::laws;
use crate::contact::{
    BallSide, ContactForce, Damping, Motion, Pair, PointForce, Sink, SurfaceDefect, Torus,
    Traction, V2, Wrench, ZoneSlices,
};
use crate::scene::{Cap, Defect, Floor, Friction, Material, Patch, Pit, Surface, WidthProfile};

/// Effect of a contact on its ball, and of it what normal forces and friction take out.
#[derive(Default)]
struct ContactParts {
    energy: f64,
    elastic: Wrench,
    normal: Wrench,
    friction: Wrench,
    /// Σ N v_n and friction power \[W\].
    powers: [f64; 2],
    edges: usize,
}

impl Sink for ContactParts {
    fn asks_energy(&self) -> bool {
        true
    }

    fn force(&mut self, force: &ContactForce) {
        self.energy += force.energy;
        self.elastic.add(&force.on_ball(force.elastic, 0.0));
        self.normal.add(&force.on_ball(force.normal, 0.0));
        self.friction.add(&force.on_ball(0.0, 1.0));
        self.powers[0] += force.normal * force.approach;
        self.powers[1] += force.friction_power;
        self.edges += usize::from(force.turn_axis != Vector3::z());
    }

    fn point(&mut self, force: &PointForce) {
        self.elastic.add(&force.on_ball());
    }
}

/// A cap in the direction e, of a ball that has not turned.
fn cap(e: &Vector3<f64>, width: f64, floor: Option<Floor>) -> BallSide {
    let cap = Cap {
        floor,
        ..Cap::of_width(width).edge_radius(0.3e-3)
    };
    let defect = Defect::of(cap, Surface::Ball, e.y.atan2(e.x));
    BallSide {
        defects: vec![SurfaceDefect::new(&defect, RADIUS * e.z, RADIUS)],
        ..BallSide::whole(RADIUS)
    }
}

/// A ball that is pressed into a race in some direction of the plane, and the normal out of it at its contact.
struct Pressed {
    place: Vector3<f64>,
    normal: Vector3<f64>,
}

impl Pressed {
    /// A ball pressed in by 15 µm, at an angle to the plane.
    fn at(race: &Torus, angle: f64) -> Self {
        let (l, (sin, cos)) = (race.r - RADIUS + 15e-6, angle.sin_cos());
        let direction = V2::new(0.4_f64.cos(), 0.4_f64.sin());
        let centre = direction * (race.a + race.sigma * l * cos);
        let out = direction * (race.sigma * cos);
        Self {
            place: Vector3::new(centre.x, centre.y, race.centre + l * sin),
            normal: Vector3::new(out.x, out.y, sin),
        }
    }

    fn motion(&self, velocity: &Vector3<f64>, w: &Vector3<f64>) -> Motion {
        Motion {
            centre: self.place.xy(),
            z: self.place.z,
            velocity: velocity.xy(),
            vz: velocity.z,
            omega: w.z,
            across: w.xy(),
            ..Motion::default()
        }
    }

    /// A direction of the ball so far from the contact, towards t and z \[rad\].
    fn beside(&self, [along, across]: [f64; 2]) -> Vector3<f64> {
        let t = Vector3::z().cross(&self.normal).normalize();
        let up = self.normal.cross(&t);
        (self.normal + t * along + up * across).normalize()
    }

    fn evaluate(&self, pair: &Pair, ball: &BallSide) -> ContactParts {
        self.moving(pair, ball, &Vector3::zeros(), &Vector3::zeros())
    }

    fn moving(
        &self,
        pair: &Pair,
        ball: &BallSide,
        velocity: &Vector3<f64>,
        w: &Vector3<f64>,
    ) -> ContactParts {
        let mut found = ContactParts::default();
        let (b, r) = (self.motion(velocity, w), Motion::default());
        pair.evaluate(ball, &b, &r, &mut found);
        found
    }
}

/// All laws, both races, with and without waves.
fn pairs() -> impl Iterator<Item = (Pair, String)> {
    [1.0, -1.0].into_iter().flat_map(|sigma| {
        laws(sigma, 2.0 * RADIUS)
            .into_iter()
            .flat_map(move |elastic| {
                [0, 30].into_iter().map(move |waves| {
                    let name = format!("{}, race {sigma}, waves {waves}", elastic.name());
                    (pair(sigma, elastic, None, waves), name)
                })
            })
    })
}

/// Width of a cap \[m\], where it stands \[rad\], and the depth of a floor that it has \[m\].
const CAPS: [(f64, [f64; 2], Option<f64>); 5] = [
    // As long as the zone and more, and within it.
    (2.4e-3, [0.07, 0.02], None),
    (0.9e-3, [0.0, 0.0], None),
    (0.9e-3, [-0.03, 0.02], None),
    (1.2e-3, [0.05, -0.06], None),
    // Its floor is met in the middle, and not at the rim, where the force would jump.
    (4e-3, [0.005, 0.01], Some(13.5e-6)),
];

/// Fourth-order difference of a function about 0.
fn slope(of: impl Fn(f64) -> f64, step: f64) -> f64 {
    let at = |share: f64| of(share * step);
    (8.0 * (at(1.0) - at(-1.0)) - at(2.0) + at(-2.0)) / (12.0 * step)
}

/// Truth: the elastic energy, differentiated by places and by rotations of the ball about three axes.
#[test]
fn forces_and_moments_are_the_gradient_of_the_energy() {
    let (mut worst, mut failed) = ([0.0_f64; 2], Vec::new());
    for (pair, name) in pairs() {
        for angle in [0.03, 0.35, -0.5] {
            let pressed = Pressed::at(&pair.race, angle);
            for (width, beside, depth) in CAPS {
                let floor = depth.map(|depth| Floor::new(depth, 3));
                let e = pressed.beside(beside);
                let ball = cap(&e, width, floor.clone());
                let found = pressed.evaluate(&pair, &ball);
                assert!(found.edges > 0, "{name} {angle} {width}");
                let Wrench { force, moment } = found.elastic;
                let mut off = [0.0_f64; 2];
                for axis in 0..3 {
                    let direction = Vector3::ith(axis, 1.0);
                    let moved = |by: f64| {
                        let place = pressed.place + direction * by;
                        let there = Pressed { place, ..pressed };
                        there.evaluate(&pair, &ball).energy
                    };
                    let turned = |by: f64| {
                        let e = Rotation3::new(direction * by) * e;
                        pressed
                            .evaluate(&pair, &cap(&e, width, floor.clone()))
                            .energy
                    };
                    let size = force.norm();
                    off[0] = off[0].max((force[axis] + slope(moved, 2e-8)).abs() / size);
                    let about = (moment[axis] + slope(turned, 4e-6)).abs();
                    off[1] = off[1].max(about / (RADIUS * size));
                }
                worst = [0, 1].map(|i| worst[i].max(off[i]));
                let limit = if depth.is_some() { 1e-5 } else { 1e-7 };
                if off[0] > limit || off[1] > limit {
                    failed.push(format!(
                        "{name} {angle} {width} {beside:?} {depth:?} {off:?}"
                    ));
                }
            }
        }
    }
    println!("{worst:?}");
    assert!(failed.is_empty(), "{failed:#?}");
}

/// The same of pits.
#[test]
fn forces_and_moments_of_pits_are_the_gradient_of_the_energy() {
    let steel = Material::default();
    let (mut worst, mut failed) = ([0.0_f64; 2], Vec::new());
    for (pair, name) in pairs() {
        let sigma = pair.race.sigma;
        let hertz = Hertz::new(sigma, 2.0 * RADIUS, 60e-3, 0.52, 0.3, &steel, &steel);
        let ball_with = |e: &Vector3<f64>| {
            let defect = Defect::of(Pit::of_width(0.3e-3), Surface::Ball, e.y.atan2(e.x));
            let mut pit = SurfaceDefect::within(
                &defect,
                &Bed::round(RADIUS * e.z, RADIUS, [PittedContact::of(&hertz); 2]),
            );
            pit.widen(0.4e-3);
            BallSide {
                defects: vec![pit],
                ..BallSide::whole(RADIUS)
            }
        };
        for angle in [0.03, 0.35, -0.5] {
            let pressed = Pressed::at(&pair.race, angle);
            for beside in [[0.0, 0.0], [0.01, 0.02], [-0.02, -0.05]] {
                let e = pressed.beside(beside);
                let found = pressed.evaluate(&pair, &ball_with(&e));
                let whole = pressed.evaluate(&pair, &BallSide::whole(RADIUS)).energy;
                assert!(found.energy < 0.9999 * whole, "{name} {angle} {beside:?}");
                let Wrench { force, moment } = found.elastic;
                let mut off = [0.0_f64; 2];
                for axis in 0..3 {
                    let direction = Vector3::ith(axis, 1.0);
                    let moved = |by: f64| {
                        let place = pressed.place + direction * by;
                        Pressed { place, ..pressed }
                            .evaluate(&pair, &ball_with(&e))
                            .energy
                    };
                    let turned = |by: f64| {
                        let e = Rotation3::new(direction * by) * e;
                        pressed.evaluate(&pair, &ball_with(&e)).energy
                    };
                    let size = force.norm();
                    off[0] = off[0].max((force[axis] + slope(moved, 2e-8)).abs() / size);
                    let about = (moment[axis] + slope(turned, 4e-6)).abs();
                    off[1] = off[1].max(about / (RADIUS * size));
                }
                worst = [0, 1].map(|i| worst[i].max(off[i]));
                if off[0] > 1e-7 || off[1] > 1e-7 {
                    failed.push(format!("{name} {angle} {beside:?} {off:?}"));
                }
            }
        }
    }
    println!("{worst:?}");
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Pseudo-random numbers between −1 and 1.
struct Chance(u64);

impl Chance {
    fn number(&mut self) -> f64 {
        let factor = 6_364_136_223_846_793_005_u64;
        self.0 = self
            .0
            .wrapping_mul(factor)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| size * self.number())
    }
}

/// Truth: power is force times velocity. Of normal forces it is that of their approach, of friction the reported loss,
/// and elastic forces have the energy's rate, however the ball moves and turns.
#[test]
fn powers_are_those_of_forces_and_moments() {
    let mut chance = Chance(3);
    let mut met = 0;
    for (mut pair, name) in pairs() {
        pair.law.damping = Damping {
            coefficient: 0.3,
            clamp_pull: false,
        };
        pair.law.traction = Traction::new(&Friction::Coulomb {
            coefficient: 0.1,
            slip_speed: 0.05,
        });
        for _ in 0..12 {
            let pressed = Pressed::at(&pair.race, 0.6 * chance.number());
            let e = pressed.beside([0.1 * chance.number(), 0.1 * chance.number()]);
            let ball = cap(&e, 1.4e-3, None);
            let (v, w) = (chance.vector(0.3), chance.vector(50.0));
            let found = pressed.moving(&pair, &ball, &v, &w);
            met += usize::from(found.edges > 0);
            let power = |of: &Wrench| of.force.dot(&v) + of.moment.dot(&w);
            let size = found.elastic.force.norm() * (v.norm() + RADIUS * w.norm());
            let normal = power(&found.normal) + found.powers[0];
            let friction = power(&found.friction) + found.powers[1];
            assert!(normal.abs() < 1e-12 * size, "{name}: {normal} {size}");
            assert!(friction.abs() < 1e-12 * size, "{name}: {friction} {size}");
            let energy = |t: f64| {
                let place = pressed.place + v * t;
                let e = Rotation3::new(w * t) * e;
                Pressed { place, ..pressed }
                    .evaluate(&pair, &cap(&e, 1.4e-3, None))
                    .energy
            };
            let off = power(&found.elastic) + slope(energy, 4e-8);
            assert!(off.abs() < 1e-5 * size, "{name}: {off} {size}");
        }
    }
    assert!(met > 60, "{met}");
}

fn whole() -> BallSide {
    BallSide::whole(RADIUS)
}

/// Limits: a cap of no width is a healthy ball, and one that no race meets changes nothing.
#[test]
fn without_a_width_or_a_race_it_is_healthy() {
    for (pair, name) in pairs() {
        let pressed = Pressed::at(&pair.race, 0.35);
        let healthy = pressed.evaluate(&pair, &whole());
        let off = |width: f64, beside: [f64; 2]| {
            let found = pressed.evaluate(&pair, &cap(&pressed.beside(beside), width, None));
            let force = (found.elastic.force - healthy.elastic.force).norm();
            let moment = (found.elastic.moment - healthy.elastic.moment).norm() / RADIUS;
            (force + moment) / healthy.elastic.force.norm()
        };
        let limit = [1e-3, 1e-4, 1e-5, 1e-8].map(|width| off(width, [0.3 * width / RADIUS, 0.0]));
        println!("{name}: {limit:?}");
        assert!(
            limit[0] > 1e-2 && limit[1] < limit[0] && limit[2] < limit[1],
            "{name} {limit:?}"
        );
        assert!(limit[3] < 1e-7, "{name} {limit:?}");
        assert!(
            off(1e-3, [0.0, 0.9]) == 0.0 && off(1e-3, [2.0, 0.0]) == 0.0,
            "{name}"
        );
    }
}

/// Truth: a patch with the cap's outline, and for a small one in the middle a disc. They differ in nothing about the ring's axis.
#[test]
fn a_patch_of_the_same_outline_does_the_same() {
    let patch = |e: &Vector3<f64>, positions: Vec<f64>, widths: Vec<f64>| {
        let outline = WidthProfile::new(positions, widths);
        let defect = Defect::of(
            Patch::of_width(outline)
                .length(1.9 * RADIUS)
                .edge_radius(0.3e-3),
            Surface::Ball,
            e.y.atan2(e.x),
        );
        BallSide {
            defects: vec![SurfaceDefect::new(&defect, 0.0, 0.3 * RADIUS)],
            ..BallSide::whole(RADIUS)
        }
    };
    for (mut pair, name) in pairs() {
        pair.slices = ZoneSlices::Fixed(2000);
        for (width, angle, beside) in [(1.4e-3, 0.35, [0.02, 0.1]), (0.2e-3, 0.0, [0.01, 0.0])] {
            let pressed = Pressed::at(&pair.race, angle);
            let e = pressed.beside(beside);
            let beta = width / (2.0 * RADIUS);
            let (middle, across) = (e.z.asin(), e.xy().norm());
            let from_middle = |k: i32| -beta * (f64::from(k) * std::f64::consts::PI / 4000.0).cos();
            let zeta = |k: i32| RADIUS * (middle + from_middle(k)).sin();
            let half = |k: i32| {
                let (zeta, rho) = (zeta(k), RADIUS * (middle + from_middle(k)).cos());
                let c = (RADIUS * beta.cos() - zeta * e.z) / (rho * across);
                2.0 * rho * c.min(1.0).acos()
            };
            let outline = patch(
                &e,
                (0..=4000).map(zeta).collect(),
                (0..=4000).map(half).collect(),
            );
            let found = pressed.evaluate(&pair, &cap(&e, width, None));
            let same = pressed.evaluate(&pair, &outline);
            let healthy = pressed.evaluate(&pair, &whole());
            let effect = (found.elastic.force - healthy.elastic.force).norm();
            let off = |other: &ContactParts| {
                let force = (found.elastic.force - other.elastic.force).norm();
                let moment = (found.elastic.moment.z - other.elastic.moment.z).abs() / RADIUS;
                (force + moment) / effect
            };
            println!("{name} {width}: {:e}, effect {effect}", off(&same));
            assert!(off(&same) < 1e-4, "{name} {width}: {}", off(&same));
            if e.z.abs() < 1e-2 {
                let r = width / 2.0;
                let disc = |k: i32| 2.0 * (r * r - zeta(k) * zeta(k)).max(0.0).sqrt();
                let disc = patch(
                    &e,
                    (0..=4000).map(zeta).collect(),
                    (0..=4000).map(disc).collect(),
                );
                let disc = off(&pressed.evaluate(&pair, &disc));
                println!("{name} disc {disc:e}");
                assert!(disc < 1e-2, "{name} disc {disc}");
            }
        }
    }
}
