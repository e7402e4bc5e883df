//! Statics of random bearings under forces, moments and loads off the axis, whose rings tilt: solved, or refused by name.

use crate::common;
use ballrace::dynamics::rhs;
use ballrace::scene::{Drive, Load, Moment, Mount, NormalLaw, RingName, Row, Scene};
use ballrace::{BodyId, Dof, Error, Start, compile, start};
use common::Noise;

const SCENES: usize = 500;

/// Deep-groove and angular-contact bearings, one row or two in any arrangement, loaded up to half of the static rating.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
fn random(noise: &mut Noise) -> Scene {
    let count = noise.between(7.0, 19.0) as usize;
    let diameter = noise.between(4e-3, 20e-3);
    // Balls take 60 to 95 % of the pitch circle.
    let share = noise.between(0.6, 0.95);
    let pitch = diameter * count as f64 / (share * std::f64::consts::PI);
    let angle = if noise.yes() {
        0.0
    } else {
        noise.between(12.0, 45.0).to_radians()
    };
    let pair = noise.yes();
    let sides: &[i8] = match (pair, angle == 0.0) {
        (false, _) => &[1],
        (true, true) => &[1, 1],
        (true, false) => [&[1, -1], &[-1, 1], &[1, 1]][noise.between(0.0, 2.999) as usize],
    };
    let rows = sides.iter().enumerate().map(|(i, side)| {
        let mut row = Row::new(
            count,
            diameter,
            pitch,
            noise.between(0.51, 0.54),
            noise.between(0.51, 0.53),
        );
        (row.contact_angle, row.side) = (angle, *side);
        row.axial_position =
            (i as f64 - 0.5 * (sides.len() - 1) as f64) * noise.between(1.2, 2.5) * diameter;
        row.clearance = if angle == 0.0 {
            noise.between(-2e-6, 30e-6)
        } else {
            0.0
        };
        row.ball_mass = Some(7850.0 * std::f64::consts::PI / 6.0 * diameter.powi(3));
        row.start_angle = noise.between(-3.0, 3.0);
        row
    });
    let mut scene = Scene::new(rows.collect(), Drive::Speed(0.0.into()));
    scene.gravity = [0.0; 3];
    let lever = pitch / 2.0;
    let ring = &mut scene.inner_ring;
    (ring.mass, ring.inertia, ring.transverse_inertia) =
        (Some(1.0), Some(lever * lever), Some(0.5 * lever * lever));
    if noise.yes() {
        scene.contact.law = NormalLaw::iso16281();
    }
    let support = &mut scene.inner_ring.support;
    (support.tilt_x, support.tilt_y) = (Some(Mount::Free), Some(Mount::Free));
    let rating = 12e6 * (count * sides.len()) as f64 * diameter * diameter * angle.cos();
    let size = rating * noise.between(0.005, 0.5);
    let turned = noise.between(0.0, std::f64::consts::TAU);
    // One row with a contact angle bears thrust towards its side alone, and no load without thrust.
    let tandem = angle > 0.0 && sides.iter().all(|side| *side == 1);
    let thrust = if tandem {
        noise.between(0.8, 3.0)
    } else {
        noise.between(-1.0, 1.0)
    };
    let mut load = |name: &str, direction: [f64; 3], force: f64, at: Option<[f64; 3]>| {
        let mut load = Load::new(RingName::Inner, direction, force);
        load.at = at;
        scene.loads.insert(name.to_owned(), load);
    };
    let beside = noise.between(0.0, 0.3) * pitch;
    let off = noise
        .yes()
        .then(|| [0.0, beside, noise.between(-0.3, 0.3) * pitch]);
    load("radial", [turned.cos(), turned.sin(), 0.0], size, off);
    load(
        "axial",
        [0.0, 0.0, thrust.signum()],
        size * thrust.abs() * angle.tan().max(0.2),
        None,
    );
    let about = noise.between(0.0, std::f64::consts::TAU);
    let moment = size * pitch * noise.between(0.0, 0.8);
    scene.moments.insert(
        "bend".to_owned(),
        Moment::new(RingName::Inner, [about.cos(), about.sin(), 0.0], moment),
    );
    scene
}

/// Share of the load that the equations of motion leave unbalanced where statics says that all is at rest: of the inner ring, and
/// of balls along their radius and the axis.
fn unbalanced(scene: &Scene) -> Result<f64, Error> {
    let model = compile(scene)?;
    let y = start(&model, &Start::Equilibrium)?;
    let mut rates = vec![0.0; y.len()];
    rhs(&model, 0.0, &y, &mut rates);
    let half = y.len() / 2;
    let of = |body: BodyId, dof: Dof| rates[half + model.layout().at(body, dof)];
    let lever = scene.rows[0].pitch_diameter / 2.0;
    // The ring weighs 1 kg, and half of that at the lever where it tilts.
    let mut left = vec![
        of(BodyId::INNER, Dof::X),
        of(BodyId::INNER, Dof::Y),
        of(BodyId::INNER, Dof::Z),
        of(BodyId::INNER, Dof::TiltX) * 0.5 * lever,
        of(BodyId::INNER, Dof::TiltY) * 0.5 * lever,
    ];
    for ball in model
        .layout()
        .bodies()
        .filter(|body| model.layout().as_ball(*body).is_some())
    {
        let [x, y, _] = model.layout().centre(&y, ball);
        let outward = (of(ball, Dof::X) * x + of(ball, Dof::Y) * y) / x.hypot(y);
        left.extend(
            [outward, of(ball, Dof::Z)].map(|a| scene.rows[0].ball_mass.unwrap_or_default() * a),
        );
    }
    let load: f64 = scene
        .loads
        .values()
        .map(|load| load.force.at(0.0))
        .fold(0.0, f64::max);
    let worst = left
        .into_iter()
        .fold(0.0, |worst: f64, left| worst.max(left.abs()));
    Ok(worst / load)
}

/// Truth: the equations of motion, which know nothing of how statics solves.
#[test]
fn random_bearings_find_their_balance_or_say_why_not() {
    let mut noise = Noise(16281);
    let (mut solved, mut worst) = (0, 0.0_f64);
    for k in 0..SCENES {
        let scene = random(&mut noise);
        match unbalanced(&scene) {
            Ok(left) => {
                (solved, worst) = (solved + 1, worst.max(left));
                assert!(
                    left < 1e-8,
                    "scene {k}: {left:e} of the load is left\n{}",
                    scene.to_toml()
                );
            }
            // One row that tilts one way lifts off where the moment outweighs its thrust.
            Err(Error::Equilibrium { reason, .. }) => {
                println!("scene {k}: {reason}");
                let row = &scene.rows[0];
                assert!(
                    scene.rows.len() == 1 && row.contact_angle > 0.0,
                    "scene {k}: {reason}"
                );
            }
            Err(other) => panic!("scene {k}: {other}"),
        }
    }
    println!("{solved} of {SCENES} solved, at most {worst:e} of the load left");
    assert!(solved > SCENES - 10);
}
