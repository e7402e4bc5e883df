//! An evaluation allocates nothing.

use ballrace::dynamics::Dynamics;
use ballrace::integrate::System;
use ballrace::scene::{
    Drive, Lubricant, Mount, Profile, Scene, Slices, Spin, TimeFunction, presets,
};
use ballrace::{BodyId, Dof, compile};
use ballrace::{Start, start};

/// Counts what an evaluation of a scene allocates, at its equilibrium and with the shaft a little faster.
fn allocated(scene: &Scene) -> u64 {
    let model = compile(scene).unwrap();
    let y = start(&model, &Start::Equilibrium).unwrap();
    let mut faster = y.clone();
    let shaft = model.layout().speed_at(BodyId::INNER, Dof::Theta);
    faster[shaft] *= 1.01;
    let mut dynamics = Dynamics::new(&model);
    let mut dy = vec![0.0; model.dim()];
    dynamics.rhs(0.0, &y, &mut dy);
    let counted = allocation_counter::measure(|| {
        dynamics.rhs(0.0, &y, &mut dy);
        dynamics.rhs(0.0, &faster, &mut dy);
    });
    counted.count_total
}

/// Analytic: counted by the allocator, on a state with a ball in the spall.
#[test]
fn a_right_hand_side_allocates_nothing() {
    for slices in [Slices::Fitted(6), Slices::Fixed(50)] {
        let mut scene = presets::wheel_bearing(3000.0);
        scene.contact.slices = slices;
        assert_eq!(allocated(&scene), 0, "{slices:?}");
    }
}

/// The same where rings tilt and balls spin freely, dry and in oil.
#[test]
fn a_right_hand_side_in_space_allocates_nothing() {
    for oil in [None, Some(Lubricant::named("vg68", 328.15))] {
        let mut scene = presets::wheel_bearing(3000.0);
        scene.lubricant = oil;
        let support = &mut scene.inner_ring.support;
        (support.tilt_x, support.tilt_y) = (Some(Mount::Free), Some(Mount::Free));
        assert_eq!(allocated(&scene), 0, "tilt");
        scene.spin = Some(Spin::Free);
        assert_eq!(allocated(&scene), 0, "tilt and spin");
    }
}

/// Analytic: counted likewise, of films that stay as they are and of films that follow the shaft's speed.
#[test]
fn a_right_hand_side_in_oil_allocates_nothing() {
    let mut scene = presets::wheel_bearing(3000.0);
    scene.lubricant = Some(Lubricant::named("vg68", 328.15));
    assert_eq!(allocated(&scene), 0, "steady");
    let run_up = Profile::Ramp {
        from: 100.0,
        to: 200.0,
        start: 0.0,
        end: 1.0,
    };
    scene.drive = Drive::Speed(TimeFunction::Profile(run_up));
    assert_eq!(allocated(&scene), 0, "a run-up");
}
