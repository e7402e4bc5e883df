//! An evaluation allocates nothing, nor does an implicit stage.

use ballrace::compile;
use ballrace::dynamics::Dynamics;
use ballrace::implicit::ImplicitDynamics;
use ballrace::integrate::{ImplicitVelocity, System};
use ballrace::scene::{Lubricant, Mount, Slices, presets};
use ballrace::{Start, start};

/// Analytic: counted by the allocator, on a state with a ball in the spall.
#[test]
fn a_right_hand_side_allocates_nothing() {
    for slices in [Slices::Fitted(6), Slices::Fixed(50)] {
        let mut scene = presets::wheel_bearing(3000.0);
        scene.contact.slices = slices;
        let model = compile(&scene).unwrap();
        let y = start(&model, &Start::Equilibrium).unwrap();
        let mut dynamics = Dynamics::new(&model);
        let mut dy = vec![0.0; model.dim()];
        dynamics.rhs(0.0, &y, &mut dy);
        let counted = allocation_counter::measure(|| dynamics.rhs(0.0, &y, &mut dy));
        assert_eq!(counted.count_total, 0, "{slices:?}: {counted:?}");
    }
}

/// The same where rings tilt, dry and in oil.
#[test]
fn a_right_hand_side_of_leaning_rings_allocates_nothing() {
    for oil in [None, Some(Lubricant::named("vg68", 328.15))] {
        let mut scene = presets::wheel_bearing(3000.0);
        scene.lubricant = oil;
        (
            scene.inner_ring.support.tilt_x,
            scene.inner_ring.support.tilt_y,
        ) = (Some(Mount::Free), Some(Mount::Free));
        let model = compile(&scene).unwrap();
        let y = start(&model, &Start::Equilibrium).unwrap();
        let mut dynamics = Dynamics::new(&model);
        let mut dy = vec![0.0; model.dim()];
        dynamics.rhs(0.0, &y, &mut dy);
        let counted = allocation_counter::measure(|| dynamics.rhs(0.0, &y, &mut dy));
        assert_eq!(counted.count_total, 0, "{counted:?}");
    }
}

/// Analytic: counted by the allocator, once the memory of implicit stages is there.
#[test]
fn an_implicit_stage_allocates_nothing() {
    let model = compile(&presets::wheel_bearing(3000.0)).unwrap();
    let y = start(&model, &Start::Equilibrium).unwrap();
    let base = &y[model.dim() / 2..];
    let mut dynamics = Dynamics::new(&model);
    let mut implicit = ImplicitDynamics::new(&mut dynamics);
    let mut stage = |y: &mut [f64]| implicit.solve_velocity(0.0, y, base, 1e-6).unwrap();
    stage(&mut y.clone());
    let mut y = y.clone();
    let counted = allocation_counter::measure(|| {
        stage(&mut y);
    });
    assert_eq!(counted.count_total, 0, "{counted:?}");
}
