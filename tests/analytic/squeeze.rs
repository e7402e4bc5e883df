//! Analytic: squeeze films between balls and races. A ball between two races loses speed as the integral of its films says, forces sum
//! to nothing and take what the power says, and all ways to evaluate them agree.

use crate::common::{Noise, ball_mass, one_ball, run, short};
use ballrace::dynamics::{contributions, rhs};
use ballrace::scene::{Drive, GothicArch, Method, Mount, Scene, SqueezeFilm, Waviness, presets};
use ballrace::{BodyId, Dof, Model, Run, Start, compile, inspect, start};

fn film(damping: f64, pull: f64) -> SqueezeFilm {
    let mut film = SqueezeFilm::default();
    (film.damping, film.pull) = (damping, pull);
    film
}

/// Truth: m dv/dx = −c/(1 + g_o/h) − c/(1 + g_i/h) has the integral m Δv = −c h ln((h + G_o)/(h + g_o)) − c h ln((h + g_i)/(h + G_i)),
/// of films that bear any pull.
#[test]
fn a_ball_between_races_loses_what_two_films_take() {
    const SPEED: f64 = 0.05;
    let mut scene = one_ball(-20e-6);
    scene.contact.squeeze = Some(film(30.0, 1e3));
    scene.solver.method = Method::Verner;
    let thickness = SqueezeFilm::default().thickness;
    let model = compile(&scene).unwrap();
    let mut y = start(&model, &Start::Rolling).unwrap();
    let ball = BodyId::ball(0);
    let layout = model.layout();
    y[layout.speed_at(ball, Dof::X)] = SPEED;
    let from = y[layout.at(ball, Dof::X)];
    let exact = Run {
        rtol: Some(1e-12),
        start: Start::State(y),
        fs: 1e6,
        ..short(1e-4)
    };
    let out = run(&scene, &exact);
    let (x, v) = (out.get("ball.x").unwrap(), out.get("ball.vx").unwrap());
    // A quarter of the diametral clearance and the same again on either side: the radial play.
    let gap = 5e-6;
    let last = out.t.len() - 1;
    for i in [last / 4, last / 2, last] {
        let moved = x[i] - from;
        let thinned = ((thickness + gap) / (thickness + gap - moved)).ln();
        let grown = ((thickness + gap + moved) / (thickness + gap)).ln();
        let wanted = SPEED - 30.0 * thickness * (thinned + grown) / ball_mass();
        assert!(moved > 1e-6 && moved < gap, "{moved:e} m");
        // A film that bears up to 1 kN gives way by 1e-4 to 0.1 N.
        let lost = (SPEED - v[i]) / (SPEED - wanted);
        assert!((lost - 1.0).abs() < 1e-4, "{} for {wanted}", v[i]);
    }
}

/// Truth: the law. A film that is pulled apart holds with less than its pull.
#[test]
fn a_film_holds_with_less_than_its_pull() {
    let mut scene = one_ball(-20e-6);
    scene.contact.squeeze = Some(film(30.0, 0.02));
    let model = compile(&scene).unwrap();
    let layout = model.layout();
    let y = start(&model, &Start::Rolling).unwrap();
    let force = |speed: f64| {
        let mut y = y.clone();
        y[layout.speed_at(BodyId::ball(0), Dof::X)] = speed;
        damping(&model, &y)[2][0]
    };
    // Equal gaps: what presses at one race pulls at the other.
    let pressed = 30.0 * 0.1 / (1.0 + 5e-6 / 0.3e-6);
    let pulled = pressed / (1.0 + pressed / 0.02);
    for way in [1.0, -1.0] {
        let found = force(0.1 * way);
        let wanted = -way * (pressed + pulled);
        assert!((found / wanted - 1.0).abs() < 1e-9, "{found} for {wanted}");
    }
}

/// Forces on all bodies by damping: along x, y and z, and about z.
fn damping(model: &Model, y: &[f64]) -> Vec<[f64; 4]> {
    let all = contributions(model, 0.0, y);
    let (_, part) = all.iter().find(|(name, _)| *name == "damping").unwrap();
    part.chunks_exact(4)
        .map(|f| [f[0], f[1], f[2], f[3]])
        .collect()
}

/// A 6205 with balls of several sizes and films, without other damping of contacts.
fn filmed() -> Scene {
    let mut scene = presets::deep_groove_6205(500.0, 200.0, 1800.0);
    scene.rows[0].diameter_errors = (0..9).map(|k| 0.7e-6 * f64::from(k % 4 - 2)).collect();
    scene.contact.damping = 0.0;
    scene.contact.squeeze = Some(film(30.0, 0.02));
    scene
}

fn tilting(mut scene: Scene) -> Scene {
    let spring = Some(Mount::Spring {
        stiffness: 1e4,
        damping: 0.0,
    });
    let support = &mut scene.inner_ring.support;
    (support.tilt_x, support.tilt_y) = (spring.clone(), spring);
    scene
}

/// A state in motion, with balls some micrometres from where they rest.
fn shaken(model: &Model, noise: &mut Noise) -> Vec<f64> {
    let mut y = start(model, &Start::Equilibrium).unwrap();
    let layout = model.layout();
    for (body, dof) in layout.degrees() {
        if Dof::TRANSLATIONS.contains(&dof) {
            y[layout.at(body, dof)] += 3e-6 * noise.next();
            y[layout.speed_at(body, dof)] += 0.05 * noise.next();
        }
    }
    y
}

/// Truth: actio and reactio, and that what films take out of all motions is their power; in registers and one by one alike.
#[test]
fn forces_sum_to_nothing_and_take_their_power() {
    let plain = filmed();
    let mut arched = plain.clone();
    arched.rows[0].outer_arch = Some(GothicArch::new(0.3));
    for scene in [plain.clone(), tilting(plain), arched] {
        let model = compile(&scene).unwrap();
        let layout = model.layout();
        let mut noise = Noise(7);
        for _ in 0..20 {
            let y = shaken(&model, &mut noise);
            let (mut sums, mut sizes, mut work) = ([0.0; 3], [0.0; 3], 0.0);
            for (body, f) in layout.bodies().zip(damping(&model, &y)) {
                for (i, dof) in Dof::TRANSLATIONS.into_iter().enumerate() {
                    sums[i] += f[i];
                    sizes[i] += f[i].abs();
                    work += f[i] * y[layout.speed_at(body, dof)];
                }
            }
            for (sum, size) in sums.iter().zip(sizes) {
                assert!(
                    size > 0.1 && sum.abs() <= 1e-13 * size,
                    "{sum:e} of {size:e}"
                );
            }
            let lost = inspect::energy(&model, &y).unwrap().damping_power;
            let off = (work + lost).abs() / lost;
            assert!(lost > 0.0 && off < 1e-9, "{off:e} of {lost} W");
        }
    }
}

/// Truth: the same film by another way. Rings that may tilt and stand straight, and races with waves too small to matter, are
/// evaluated ball by ball.
#[test]
fn all_ways_to_evaluate_agree() {
    let plain = filmed();
    let mut wavy = plain.clone();
    wavy.rows[0].outer_waviness = vec![Waviness::new(5, 1e-18, 0.3)];
    let model = compile(&plain).unwrap();
    let y = shaken(&model, &mut Noise(9));
    let wanted = damping(&model, &y);
    for scene in [wavy, tilting(plain)] {
        let other = compile(&scene).unwrap();
        let names = model.names();
        let mut carried = start(&other, &Start::Rolling).unwrap();
        for (name, value) in other.names().iter().zip(&mut carried) {
            if let Some(i) = names.iter().position(|own| own == name) {
                *value = y[i];
            }
        }
        let found = damping(&other, &carried);
        for (found, wanted) in found.iter().flatten().zip(wanted.iter().flatten()) {
            let off = (found - wanted).abs();
            assert!(off < 1e-9, "{found} N for {wanted}");
        }
    }
}

/// Truth: geometry. A ball that follows a wave of its race, at a constant gap, squeezes nothing.
#[test]
fn a_ball_that_follows_a_wave_squeezes_nothing() {
    const ORDER: u32 = 20;
    let mut scene = one_ball(-20e-6);
    scene.contact.squeeze = Some(film(30.0, 1e3));
    let amplitude = 1e-6;
    // It rises where the ball is.
    scene.rows[0].outer_waviness = vec![Waviness::new(
        ORDER,
        amplitude,
        -std::f64::consts::FRAC_PI_2,
    )];
    let model = compile(&scene).unwrap();
    let layout = model.layout();
    let ball = BodyId::ball(0);
    let mut y = start(&model, &Start::Rolling).unwrap();
    let radius = y[layout.at(ball, Dof::X)];
    let orbit = 50.0;
    y[layout.speed_at(ball, Dof::Y)] = orbit * radius;
    let on_way = |radial: f64| {
        let mut y = y.clone();
        y[layout.speed_at(ball, Dof::X)] = radial;
        damping(&model, &y)[BodyId::OUTER.index()][0]
    };
    // The race's radius grows along the ball's way, averaged over the contact, which is shorter than the wave by far.
    let rise = amplitude * f64::from(ORDER) * orbit;
    let [still, following] = [0.0, rise].map(on_way);
    assert!(
        following.abs() < 0.02 * still.abs(),
        "{following} of {still} N"
    );
}

/// Truth: energy. What films do to all accelerations takes their power out of the kinetic energy, of a ring that has tilted and tilts,
/// too; in states without contacts' damping, to rounding.
#[test]
fn films_take_their_power_out_of_the_motion() {
    let still = |mut scene: Scene| {
        scene.drive = Drive::Torque {
            value: 0.0.into(),
            initial_speed: 0.0,
        };
        scene
    };
    for scene in [filmed(), tilting(filmed())].map(still) {
        let model = compile(&scene).unwrap();
        let mut dry = scene.clone();
        dry.contact.squeeze = None;
        let dry = compile(&dry).unwrap();
        let mut noise = Noise(11);
        for _ in 0..20 {
            let mut y = shaken(&model, &mut noise);
            for (name, value) in model.names().iter().zip(&mut y) {
                match name.split_once("tilt_") {
                    Some((_, "x" | "y")) => *value += 1e-3 * noise.next(),
                    Some((_, "vx" | "vy")) => *value += noise.next(),
                    _ => {}
                }
            }
            let [with, without] = [&model, &dry].map(|model| {
                let mut rates = vec![0.0; y.len()];
                rhs(model, 0.0, &y, &mut rates);
                rates
            });
            let half = y.len() / 2;
            let kinetic = |way: f64| {
                let mut y = y.clone();
                for i in half..2 * half {
                    y[i] += way * (with[i] - without[i]);
                }
                inspect::energy(&model, &y).unwrap().kinetic
            };
            let step = 1e-6;
            let taken = (kinetic(-step) - kinetic(step)) / (2.0 * step);
            let lost = inspect::energy(&model, &y).unwrap().damping_power;
            let off = (taken - lost).abs() / lost;
            assert!(lost > 1e-3 && off < 1e-8, "{off:e} of {lost} W");
        }
    }
}
