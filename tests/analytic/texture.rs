//! Waves of surfaces: where they move a bearing (`docs/model.md`, *Defects*), and how texture is read, drawn, limited and explained.

use ballrace::dynamics::{contributions, rhs};
use ballrace::scene::{
    Cap, Defect, Drive, GothicArch, Mount, NormalLaw, Patch, Scene, Spin, Surface, Texture,
    Waviness, presets,
};
use ballrace::{Error, Start, compile, equilibrium, explain, start};

use crate::common::{Noise, run, short};

const Z: f64 = 9.0;

/// A 6205 at a contact angle of 10 degrees under 400 N of thrust alone, its outer ring held.
fn thrust() -> Scene {
    let mut scene = presets::deep_groove_6205(0.0, 400.0, 0.0);
    scene.loads.retain(|_, load| load.direction[2] != 0.0);
    scene.gravity = [0.0; 3];
    scene.cage = None;
    let row = &mut scene.rows[0];
    (row.contact_angle, row.clearance) = (10_f64.to_radians(), 0.0);
    (row.outer_conformity, row.inner_conformity) = (0.525, 0.515);
    for mount in [
        &mut scene.outer_ring.support.x,
        &mut scene.outer_ring.support.y,
        &mut scene.outer_ring.support.z,
    ] {
        *mount = Some(Mount::Fixed);
    }
    scene
}

/// Where the inner ring stands when it and the balls have turned, with a wave of an order and amplitude on a race.
fn stands(outer: bool, (order, amplitude): (u32, f64), [ring, balls]: [f64; 2]) -> [f64; 3] {
    let mut scene = thrust();
    let row = &mut scene.rows[0];
    row.start_angle = balls;
    let phase = if outer { 0.0 } else { -f64::from(order) * ring };
    let waves = vec![Waviness::new(order, amplitude, phase)];
    *(if outer {
        &mut row.outer_waviness
    } else {
        &mut row.inner_waviness
    }) = waves;
    equilibrium(&scene).unwrap().inner
}

/// Quasi-static numbers, computed apart from this crate.
#[test]
fn the_contact_is_that_of_the_model() {
    let found = equilibrium(&thrust()).unwrap();
    let outer = &found.balls[0].outer;
    assert!(
        (outer.angle.unwrap().to_degrees() - 15.4157).abs() < 1e-3,
        "{outer:?}"
    );
    assert!((outer.load - 167.197).abs() < 1e-2, "{outer:?}");
}

/// F. P. Wardle's rules: waves of order kZ move the rings axially by A cot α (1 − ε)/(1 + ε cot² α), whichever race has them.
#[test]
fn orders_of_the_balls_move_the_ring_axially() {
    let (alpha, epsilon) = (15.4157_f64.to_radians(), 0.014_070_6);
    let cot = 1.0 / alpha.tan();
    let share = cot * (1.0 - epsilon) / (1.0 + epsilon * cot * cot);
    assert!((share - 3.0172).abs() < 1e-3);
    for outer in [true, false] {
        for order in [9, 18] {
            let at = |turned: f64| {
                let turned = if outer { [0.0, turned] } else { [turned, 0.0] };
                stands(outer, (order, 1e-9), turned)
            };
            let half_turn = std::f64::consts::PI / f64::from(order);
            let (one, other) = (at(0.0), at(half_turn));
            let moved = 0.5 * (one[2] - other[2]).abs();
            assert!(
                (moved / (1e-9 * share) - 1.0).abs() < 0.01,
                "{outer} {order}: {moved}"
            );
            assert!((one[0] - other[0]).abs() < 1e-12, "{one:?} {other:?}");
        }
    }
}

/// The same: waves of order kZ ± 1 lead the ring around a circle of radius A; by the outer race with kZ f_c, backwards for +1; by the
/// inner race with kZ (f_r − f_c) ± f_r, forwards for +1.
#[test]
fn orders_beside_those_of_the_balls_move_the_ring_radially() {
    for (order, k, side) in [
        (8_u32, 1.0, -1.0),
        (10, 1.0, 1.0),
        (17, 2.0, -1.0),
        (19, 2.0, 1.0),
    ] {
        for outer in [true, false] {
            let mut seen: Vec<[f64; 2]> = Vec::new();
            for step in 0..4 {
                let ring = 0.11 * f64::from(step);
                let balls = 0.4 * ring;
                let [x, y, _] = stands(outer, (order, 1e-9), [ring, balls]);
                let phase = if outer {
                    -side * k * Z * balls
                } else {
                    side * (k * Z * (ring - balls) + side * ring)
                };
                // Turned back by where it should have gone.
                let (sin, cos) = phase.sin_cos();
                seen.push([x * cos + y * sin, y * cos - x * sin]);
            }
            for [x, y] in &seen {
                assert!(
                    (x.hypot(*y) / 1e-9 - 1.0).abs() < 0.01,
                    "{outer} {order}: {seen:?}"
                );
                let off = (x - seen[0][0]).hypot(y - seen[0][1]);
                assert!(off < 0.01e-9, "{outer} {order}: {seen:?}");
            }
        }
    }
}

/// The same: other orders move nothing to first order.
#[test]
fn other_orders_move_nothing_to_first_order() {
    for outer in [true, false] {
        for order in [4, 5, 12, 23] {
            let moved = |amplitude: f64| {
                let at = |turned: f64| {
                    let turned = if outer { [0.0, turned] } else { [turned, 0.0] };
                    stands(outer, (order, amplitude), turned)
                };
                let (a, b) = (at(0.0), at(0.07));
                (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
            };
            let (much, little) = (moved(100e-9), moved(10e-9));
            assert!(
                little < 0.012 * much + 2e-15,
                "{outer} {order}: {much:e} {little:e}"
            );
        }
    }
}

/// Analytic: what a contact leaves of a listed wave, sin κ/κ, κ = n b/R, of which nothing at λ = 2 b.
#[test]
fn contacts_average_listed_waves() {
    let (alpha, load) = (15.4157_f64.to_radians(), 167.197_f64);
    let arc = 0.115_654e-3 * (load / 250.0).cbrt() / 23.49e-3;
    let cot = 1.0 / alpha.tan();
    let epsilon = 0.014_070_6;
    let share = cot * (1.0 - epsilon) / (1.0 + epsilon * cot * cot);
    for order in [90_u32, 270, 450, 630, 900] {
        let at = |turned: f64| stands(true, (order, 1e-9), [0.0, turned])[2];
        let moved = 0.5 * (at(0.0) - at(std::f64::consts::PI / f64::from(order)));
        let kappa = f64::from(order) * arc;
        let expected = share * 1e-9 * kappa.sin() / kappa;
        assert!(
            (moved.abs() - expected.abs()).abs() < 0.02e-9,
            "{order}: {moved:e} {expected:e}"
        );
    }
}

fn textured(amplitude: f64) -> Scene {
    let mut scene = presets::deep_groove_6205(300.0, 80.0, 1797.0);
    scene.rows[0].texture = Some(Texture::of_races(amplitude));
    scene
}

/// Analytic: a texture of next to nothing is none.
#[test]
fn little_texture_is_none() {
    let rates = |scene: &Scene| {
        let model = compile(scene).unwrap();
        let y = start(
            &compile(&presets::deep_groove_6205(300.0, 80.0, 1797.0)).unwrap(),
            &Start::Equilibrium,
        )
        .unwrap();
        let mut dy = vec![0.0; y.len()];
        rhs(&model, 0.0, &y, &mut dy);
        dy
    };
    let mut smooth = textured(0.0);
    smooth.rows[0].texture = None;
    let (wanted, found) = (rates(&smooth), rates(&textured(1e-24)));
    let size = wanted.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for (a, b) in wanted.iter().zip(&found) {
        assert!((a - b).abs() <= 1e-9 * size, "{a} {b}");
    }
}

/// Analytic: textures of all surfaces are inner forces. Force and moment about z of all bodies vanish, and so they do on the part of
/// balls.
#[test]
fn textures_keep_force_and_moment() {
    let mut scene = textured(5e-9);
    scene.rows[0].texture.as_mut().unwrap().ball = 5e-9;
    for law in [NormalLaw::Hertz, NormalLaw::iso16281()] {
        scene.contact.law = law;
        let model = compile(&scene).unwrap();
        let mut y = start(&model, &Start::Equilibrium).unwrap();
        let mut noise = Noise(5);
        let half = y.len() / 2;
        for (i, q) in y[..half].iter_mut().enumerate() {
            *q += if i % 4 == 3 { 3.0 } else { 2e-6 } * noise.next();
        }
        let parts = contributions(&model, 0.0, &y);
        let (_, contacts) = parts.iter().find(|(name, _)| *name == "contact").unwrap();
        let mut sums = [0.0; 4];
        let mut sizes = [0.0; 4];
        for (force, place) in contacts.chunks(4).zip(y.chunks(4)) {
            let moment = force[3] + place[0] * force[1] - place[1] * force[0];
            for (i, part) in [force[0], force[1], force[2], moment]
                .into_iter()
                .enumerate()
            {
                sums[i] += part;
                sizes[i] += part.abs();
            }
        }
        let limit = 1e-13 * (sizes[0] + sizes[1] + sizes[2]);
        assert!(
            sums.iter().all(|sum| sum.abs() < limit),
            "{sums:?} {sizes:?}"
        );
    }
}

/// Analytic: one seed is one surface, another another; in every process.
#[test]
fn a_seed_is_a_surface() {
    let record = |seed: u64| {
        let mut scene = textured(1e-9);
        scene.rows[0].texture.as_mut().unwrap().seed = seed;
        run(&scene, &short(1e-3)).columns[0].values.clone()
    };
    assert_eq!(record(3), record(3));
    assert_ne!(record(3), record(4));
}

/// Analytic: the step that sees waves down to half of the contact's width, at a speed where contacts ask for longer ones.
#[test]
fn steps_see_the_shortest_waves() {
    let mut scene = presets::deep_groove_6205(300.0, 80.0, 20_000.0);
    let plain = run(&scene, &short(1e-3)).stats.largest_step;
    scene.rows[0].texture = Some(Texture::of_races(1e-10));
    let textures = &explain(&scene).unwrap().textures;
    let most = textures
        .iter()
        .map(|of| of.largest_step)
        .fold(f64::INFINITY, f64::min);
    let found = run(&scene, &short(1e-3)).stats.largest_step;
    println!("{plain:e} {most:e} {found:e}");
    assert!(
        found <= most * 1.000_001 && most < plain,
        "{plain:e} {most:e} {found:e}"
    );
}

/// Refusals: one error that names the field.
#[test]
fn impossible_textures_are_refused() {
    let refused = |change: &dyn Fn(&mut Scene)| {
        let mut scene = textured(1e-9);
        change(&mut scene);
        match compile(&scene) {
            Err(Error::Scene { path, .. }) => path,
            other => panic!("{other:?}"),
        }
    };
    let of = |change: &dyn Fn(&mut Texture)| {
        refused(&|scene| change(scene.rows[0].texture.as_mut().unwrap()))
    };
    assert_eq!(of(&|t| t.outer = -1e-9), "rows[0].texture.outer");
    assert_eq!(of(&|t| t.inner = f64::NAN), "rows[0].texture.inner");
    assert_eq!(of(&|t| t.ball = 2e-6), "rows[0].texture.ball");
    assert_eq!(of(&|t| t.slope = 5.0), "rows[0].texture.slope");
    assert_eq!(of(&|t| (t.outer, t.inner) = (0.0, 0.0)), "rows[0].texture");
    assert_eq!(of(&|t| t.orders = Some([9, 8])), "rows[0].texture.orders");
    assert_eq!(of(&|t| t.orders = Some([1, 8])), "rows[0].texture.orders");
    // λ = b/4 is at order 5100 or so.
    assert_eq!(
        of(&|t| t.orders = Some([2, 9000])),
        "rows[0].texture.orders"
    );
    assert_eq!(of(&|t| t.seed = 1 << 53), "rows[0].texture.seed");
    assert_eq!(
        of(&|t| t.reference_load = Some(0.0)),
        "rows[0].texture.reference_load"
    );
    let arch = |scene: &mut Scene| scene.rows[0].outer_arch = Some(GothicArch::new(0.3));
    assert_eq!(refused(&arch), "rows[0].texture");
    let tumbling = |scene: &mut Scene| {
        scene.spin = Some(Spin::Free);
        scene.rows[0].texture.as_mut().unwrap().ball = 1e-11;
        let mut cap = Defect::of(Cap::of_width(1e-3).edge_radius(0.2e-3), Surface::Ball, 0.0);
        cap.ball = Some(0);
        scene.defects.insert("cap".into(), cap);
    };
    assert_eq!(refused(&tumbling), "rows[0].texture.ball");
}

/// Where nothing is at rest texture asks for a load, and listed waves take a typical one.
#[test]
fn without_equilibrium_a_load_is_asked_for() {
    let mut scene = textured(1e-9);
    scene.outer_ring.support.x = Some(Mount::Free);
    scene.outer_ring.support.y = Some(Mount::Free);
    scene.drive = Drive::Speed(10.0.into());
    let error = compile(&scene).unwrap_err().to_string();
    assert!(
        error.starts_with("rows[0].texture.reference_load = absent"),
        "{error}"
    );
    scene.rows[0].texture.as_mut().unwrap().reference_load = Some(250.0);
    assert!(compile(&scene).is_ok());
    scene.rows[0].texture = None;
    scene.rows[0].outer_waviness = vec![Waviness::new(9, 1e-6, 0.0)];
    assert!(compile(&scene).is_ok());
}

/// A texture stands beside listed waves, defects and oil, and is explained.
#[test]
fn a_texture_is_explained() {
    let mut scene = textured(1e-9);
    let row = &mut scene.rows[0];
    let texture = row.texture.as_mut().unwrap();
    (texture.reference_load, texture.ball) = (Some(250.0), 3e-11);
    row.outer_waviness = vec![Waviness::new(9, 1e-6, 0.0)];
    scene.defects.insert(
        "spall".into(),
        Defect::of(
            Patch::of_width(0.5e-3).length(2e-3).edge_radius(0.3e-3),
            Surface::OuterRace,
            -1.5,
        ),
    );
    let explanation = explain(&scene).unwrap();
    let [outer, inner, balls] = &explanation.textures[..] else {
        panic!("{:?}", explanation.textures)
    };
    assert_eq!(
        (outer.surface.as_str(), inner.surface.as_str()),
        ("outer race", "inner race")
    );
    assert_eq!((outer.orders[0], outer.knots), (2, 16_384));
    assert!(outer.orders[1].abs_diff(1276) <= 2, "{outer:?}");
    assert_eq!(
        (balls.surface.as_str(), balls.orders, balls.knots),
        ("balls", [2, 215], 4096)
    );
    assert!((1e6 * outer.roughness - 0.18).abs() < 0.005, "{outer:?}");
    assert!((1e9 * outer.fine_roughness - 6.6).abs() < 0.1, "{outer:?}");
    assert!((1e-3 * outer.frequency - 7.6).abs() < 0.1, "{outer:?}");
    let text = explanation.to_string();
    assert!(
        text.contains("outer race of row 0: 1 nm at order 30, slope 2, orders 2 to 127"),
        "{text}"
    );
    assert!(text.contains("step ≤ 16 µs"), "{text}");
}
