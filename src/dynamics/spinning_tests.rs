//! Analytic: balls that spin about any axis conserve energy and momentum, lose the reported power, and in the plane equal those
//! that spin about the axis alone.

use super::tilted_tests::{free_rings, laws, momenta, stirred};
use super::{Dynamics, rhs};
use crate::contact::attitude_rates;
use crate::inspect;
use crate::integrate::{Options, Tolerance, VERNER, integrate};
use crate::model::{BodyId, Dof, Model, Race};
use crate::scene::{Cap, Defect, Friction, NormalLaw, Scene, Slices, Spin, Surface};
use crate::statics::compile;
use crate::statics::start::{Start, face, start};

/// Two rows between free rings whose balls spin freely, with friction.
fn free_balls(law: &NormalLaw) -> Scene {
    let mut scene = free_rings(law);
    scene.spin = Some(Spin::Free);
    scene.contact.slices = Slices::Fitted(16);
    scene.friction = Friction::Coulomb {
        coefficient: 0.1,
        slip_speed: 0.05,
    };
    scene
}

/// The same with a cap where ball 0 touches the outer race, and one on ball 3.
fn capped(law: &NormalLaw) -> Scene {
    let mut scene = free_balls(law);
    for (name, ball, angle) in [("first", 0, 0.05), ("other", 3, 1.0)] {
        let cap = Defect::of(
            Cap::of_width(1e-3).edge_radius(0.3e-3),
            Surface::Ball,
            angle,
        )
        .on_ball(ball)
        .at_offset(1.6e-3);
        scene.defects.insert(name.to_owned(), cap);
    }
    scene
}

/// A state in which everything moves, is tilted and spins.
fn spun(model: &Model) -> Vec<f64> {
    let mut y = stirred(model);
    let layout = model.layout();
    for j in 0..model.balls.len() {
        let ball = BodyId::ball(j);
        y[layout.speed_at(ball, Dof::TurnX)] += 30.0 * (j as f64).cos();
        y[layout.speed_at(ball, Dof::TurnY)] -= 50.0 * (1.3 * j as f64).sin();
    }
    face(model, &mut y);
    y
}

/// The state after a while.
fn after(model: &Model, y0: &[f64], duration: f64) -> Vec<f64> {
    let mut dynamics = Dynamics::new(model);
    let tolerance = Tolerance::uniform(y0.len(), 1e-13, 1e-13).unwrap();
    let options = Options {
        max_step: 0.2 / model.scales.frequency,
        ..Options::default()
    };
    let nobody = &mut |_: &mut Dynamics<'_>,
                       _: &crate::integrate::DenseStep<'_>,
                       _: &crate::integrate::StepStatistics| {
        std::ops::ControlFlow::Continue(())
    };
    let span = (0.0, duration);
    let end = integrate(
        &mut dynamics,
        &VERNER,
        span,
        y0,
        &tolerance,
        &options,
        nobody,
    );
    end.unwrap().y
}

/// Linear momentum and all of angular momentum between rings that tilt, with friction; energy too, without.
#[test]
fn free_balls_keep_momenta_and_energy() {
    for law in laws() {
        for rubs in [false, true] {
            let mut scene = free_balls(&law);
            if !rubs {
                scene.friction = Friction::None;
            }
            let model = compile(&scene).unwrap();
            let y0 = spun(&model);
            let end = after(&model, &y0, 5e-5);
            let [before, after] = [&y0, &end].map(|y| inspect::raw::energy(&model, y).total());
            let [from, to] = [&y0, &end].map(|y| momenta(&model, y));
            println!("{law:?} {rubs}: {:e}", after / before - 1.0);
            assert!((after / before - 1.0).abs() < 1e-9 || rubs, "{law:?}");
            assert!(
                after < before * (1.0 - 5e-6) || !rubs,
                "friction takes {law:?}"
            );
            for (from, to) in from.into_iter().zip(to) {
                println!("{from} {:e}", (from - to).norm());
                assert!((from - to).norm() < 1e-12 * from.norm().max(0.1), "{law:?}");
            }
        }
    }
}

/// Momenta where caps tumble through contacts, and the length of Euler parameters.
#[test]
fn caps_that_tumble_keep_momenta() {
    let model = compile(&capped(&NormalLaw::Hertz)).unwrap();
    let y0 = spun(&model);
    assert_eq!(model.dim(), 2 * (4 * 12 + 4 + 2 * 10 + 4 * 4));
    let end = after(&model, &y0, 5e-5);
    let [from, to] = [&y0, &end].map(|y| momenta(&model, y));
    for (from, to) in from.into_iter().zip(to) {
        println!("{from} {:e}", (from - to).norm());
        assert!((from - to).norm() < 1e-12 * from.norm().max(0.1));
    }
    let layout = model.layout();
    let motion = layout.motion(&end, BodyId::ball(0));
    let attitude = motion.attitude.unwrap();
    let length: f64 = attitude.iter().map(|e| e * e).sum();
    println!("{length}");
    assert!((length - 1.0).abs() < 1e-11);
    // ė is still ½ ω e, and the ball has turned by some degrees.
    let rates = Dof::ATTITUDE.map(|dof| end[layout.speed_at(BodyId::ball(0), dof)]);
    for (rate, expected) in rates
        .into_iter()
        .zip(attitude_rates(&motion.turning(), attitude))
    {
        assert!((rate - expected).abs() < 1e-9 * motion.turning().norm());
    }
    assert!(attitude[0] < 0.99999, "{attitude:?}");
}

/// Limits: a cap that spins about the axis is the same whether its ball may spin freely or not.
#[test]
fn a_cap_on_the_axis_of_spin_is_carried_by_theta() {
    let mut scene = capped(&NormalLaw::Hertz);
    let free = compile(&scene).unwrap();
    scene.spin = None;
    let axial = compile(&scene).unwrap();
    let mut y = stirred(&axial);
    let turned = axial.layout().at(BodyId::ball(0), Dof::Theta);
    y[turned] = 0.02;
    let (half, bodies) = (axial.layout().half(), axial.layout().half());
    let mut of_free = vec![0.0; free.dim()];
    let free_half = free.layout().half();
    of_free[..bodies].copy_from_slice(&y[..bodies]);
    of_free[free_half..free_half + bodies].copy_from_slice(&y[half..]);
    face(&free, &mut of_free);
    for race in Race::BOTH {
        let [a, b] = [(&axial, &y), (&free, &of_free)].map(|(model, y)| {
            let found = inspect::raw::contact(model, y, 0, race);
            [found.load, found.angle]
        });
        assert!(a[0] > 0.0 || race == Race::Inner);
        for (a, b) in a.into_iter().zip(b) {
            assert!(
                (a - b).abs() < 1e-9 * a.abs() || (a.is_nan() && b.is_nan()),
                "{race:?}: {a} {b}"
            );
        }
    }
}

/// Truth: the energy, differentiated along the motion. Its loss is the reported power.
#[test]
fn powers_of_free_balls_balance() {
    for law in laws() {
        let mut scene = capped(&law);
        scene.contact.damping = 0.3;
        scene.contact.slices = Slices::Fitted(24);
        let model = compile(&scene).unwrap();
        let y = spun(&model);
        let mut dy = vec![0.0; y.len()];
        rhs(&model, 0.0, &y, &mut dy);
        let moved = |h: f64| -> Vec<f64> { y.iter().zip(&dy).map(|(y, d)| y + h * d).collect() };
        let energy = |h: f64| inspect::raw::energy(&model, &moved(h)).total();
        let h = 2e-9;
        let rate =
            (8.0 * (energy(h) - energy(-h)) - energy(2.0 * h) + energy(-2.0 * h)) / (12.0 * h);
        let powers = inspect::raw::energy(&model, &y);
        let lost = powers.damping_power + powers.friction_power;
        println!("{law:?}: {rate} {lost}");
        assert!(powers.friction_power > 1.0);
        // The nodes of a law in slices are exact to so much.
        assert!((rate + lost).abs() < 2e-5 * lost, "{law:?}: {rate} {lost}");
    }
}

/// Limits: in the plane a ball that spins freely is one that spins about the axis.
#[test]
fn in_the_plane_balls_spin_about_the_axis() {
    let mut scene = crate::scene::presets::deep_groove_6205(500.0, 0.0, 1800.0);
    let axial = compile(&scene).unwrap();
    scene.spin = Some(Spin::Free);
    let free = compile(&scene).unwrap();
    let (y, plain) = (
        start(&free, &Start::Equilibrium).unwrap(),
        start(&axial, &Start::Equilibrium).unwrap(),
    );
    let (half, bodies) = (free.layout().half(), axial.layout().half());
    let mut dy = [vec![0.0; y.len()], vec![0.0; plain.len()]];
    rhs(&free, 0.0, &y, &mut dy[0]);
    rhs(&axial, 0.0, &plain, &mut dy[1]);
    let size = dy[1].iter().fold(0.0, |m: f64, a| m.max(a.abs()));
    for at in 0..bodies {
        let (a, b) = (y[half + at], plain[bodies + at]);
        assert!(
            (a - b).abs() < 1e-3 * b.abs().max(1.0),
            "speed {at}: {a} {b}"
        );
    }
    let mut y = y;
    y[half..half + bodies].copy_from_slice(&plain[bodies..]);
    y[half + bodies..].fill(0.0);
    rhs(&free, 0.0, &y, &mut dy[0]);
    for at in 0..half {
        let expected = if at < bodies { dy[1][bodies + at] } else { 0.0 };
        let found = dy[0][half + at];
        assert!(
            (found - expected).abs() < 1e-10 * size,
            "{at}: {found} {expected}"
        );
    }
}
