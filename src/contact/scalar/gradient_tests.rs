//! Analytic: forces over defects against the elastic energy, differentiated numerically.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::*;
use crate::contact::damage::{Bed, PittedContact};
use crate::contact::hertz::Hertz;
use crate::contact::laws::elastic::tests::laws;
use crate::contact::{
    BallSide, ContactForce, Elastic, Law, Motion, Pair, PointForce, Rules, Shape, SurfaceDefect,
    Torus, Waves, WrenchSum, ZoneSlices,
};
use crate::scene::{
    Damage, Defect, Dent, Floor, Material, Patch, Pit, Surface, Waviness, Width, WidthProfile,
};

pub(super) const RADIUS: f64 = 6e-3;

/// Energy, and what the ball gets.
#[derive(Default)]
struct ElasticParts {
    energy: f64,
    on_ball: WrenchSum,
}

impl Sink for ElasticParts {
    fn asks_energy(&self) -> bool {
        true
    }

    fn force(&mut self, force: &ContactForce) {
        self.energy += force.energy;
        self.on_ball.add(force, force.elastic, 0.0);
    }

    fn point(&mut self, force: &PointForce) {
        self.on_ball.point(force);
    }
}

/// A race whose groove is centred at 0.1 mm, without damping and friction, and a defect of it.
pub(super) fn pair(sigma: f64, elastic: Elastic, defect: Option<&Defect>, waves: u32) -> Pair {
    let race = Torus {
        sigma,
        a: 30e-3,
        centre: 0.1e-3,
        r: 6.24e-3,
        lowest: -6.24e-3,
        highest: 6.24e-3,
    };
    let wave = Waviness {
        order: waves,
        amplitude: 1e-6,
        phase: 0.4,
    };
    let compiled = |d: &Defect| {
        SurfaceDefect::new(d, d.axial_offset.number().unwrap(), 30e-3 + sigma * race.r)
    };
    Pair {
        race,
        shape: Shape::default(),
        waves: Waves::of(if waves > 0 { vec![wave] } else { Vec::new() }),
        law: Law::elastic(elastic),
        // Inside a defect forces like s^{10/9} end within pieces, without a weight for them.
        slices: ZoneSlices::Fitted(Rules::new(24, elastic.exponent())),
        defects: defect.map(compiled).into_iter().collect(),
    }
}

/// A ball at x, y, z, turned, on a ring that is turned.
fn at(pair: &Pair, ball: &BallSide, [x, y, z, theta, ring]: [f64; 5]) -> ElasticParts {
    let motion = |x, y, z, theta| Motion::new(&[x, y, z, theta], &[0.0; 4]);
    let mut found = ElasticParts::default();
    let (b, r) = (motion(x, y, z, theta), motion(0.0, 0.0, 0.0, ring));
    pair.evaluate(ball, &b, &r, &mut found);
    found
}

fn off(pair: &Pair, ball: &BallSide, place: [f64; 5]) -> f64 {
    let found = at(pair, ball, place);
    let on_ball = found.on_ball.wrench;
    let size = on_ball.force.norm();
    assert!(size > 10.0, "nothing presses: {size}");
    let centre = Vector3::new(place[0], place[1], place[2]);
    let [x, y, z, turn] = on_ball.about_axis();
    let forces = [x, y, z, turn, on_ball.on_ring(&centre).moment.z];
    let mut worst: f64 = 0.0;
    for (i, force) in forces.into_iter().enumerate() {
        let lever = if i < 3 { 1.0 } else { RADIUS };
        let step = 1e-8 / lever;
        let energy = |share: f64| {
            let mut moved = place;
            moved[i] += share * step;
            at(pair, ball, moved).energy
        };
        let slope =
            (8.0 * (energy(1.0) - energy(-1.0)) - energy(2.0) + energy(-2.0)) / (12.0 * step);
        worst = worst.max((force + slope).abs() / (lever * size));
    }
    worst
}

/// Waves of a ball: as many around it as the order, of a tenth of a micrometre; none of order 0.
fn wave_of_ball(order: u32) -> Waves {
    let wave = Waviness {
        order,
        amplitude: 1e-7,
        phase: -0.2,
    };
    Waves::of(if order > 0 { vec![wave] } else { Vec::new() })
}

fn defects() -> Vec<(&'static str, Defect)> {
    let varying = WidthProfile {
        positions: vec![-6e-3, 6e-3],
        widths: vec![0.5e-3, 0.9e-3],
    };
    let floor = Floor {
        depth: 3e-6,
        elements: 3,
    };
    let of = |length: f64, width: Width, floor: Option<Floor>| {
        let patch = Patch {
            floor,
            ..Patch::of_width(width).length(length).edge_radius(0.3e-3)
        };
        Defect::of(patch, Surface::OuterRace, 0.0).at_offset(0.0)
    };
    let width = Width::Constant(0.7e-3);
    vec![
        ("edges", of(4.9e-3, width.clone(), None)),
        ("narrow", of(4.9e-3, 0.1e-3.into(), None)),
        ("ends", of(0.5e-3, width.clone(), None)),
        ("varying", of(4.9e-3, Width::Profile(varying), None)),
        ("floor", of(0.5e-3, width, Some(floor))),
    ]
}

/// Places of a ball pressed by some 15 µm at different angles, near the middle of a defect of the race at 0.4.
fn places(sigma: f64, on_ball: bool) -> Vec<[f64; 5]> {
    let mut places = Vec::new();
    for (tilt, share) in [(0.03, 0.2), (0.25, -0.5), (-0.4, 0.7), (0.11, -0.83)] {
        let l: f64 = 6.24e-3 - RADIUS + 15e-6 + 4e-6 * share;
        let d = 30e-3 + sigma * l * f64::cos(tilt);
        let half = 0.05e-3
            / if on_ball {
                RADIUS
            } else {
                30e-3 + sigma * RADIUS
            };
        let direction: f64 = 0.4 + share;
        let facing = if sigma > 0.0 {
            direction
        } else {
            direction + PI
        };
        places.push([
            d * direction.cos(),
            d * direction.sin(),
            0.1e-3 + l * f64::sin(tilt),
            facing - half * share,
            direction + half * share,
        ]);
    }
    places
}

/// A defect's middle where the contact is.
fn moved(defect: &Defect, place: &[f64; 5], on_ball: bool) -> Defect {
    let l = 6.24e-3 - RADIUS + 15e-6;
    let zeta = RADIUS * (place[2] - 0.1e-3) / l + 0.1e-3;
    Defect {
        axial_offset: (zeta + if on_ball { 0.0 } else { place[2] }).into(),
        ..defect.clone()
    }
}

#[test]
fn forces_of_pits_are_the_gradient_of_the_energy() {
    forces_of_small_damages([
        Pit::of_width(0.24e-3).length(0.3e-3).into(),
        Pit::of_width(0.2e-3).into(),
    ]);
}

#[test]
fn forces_of_dents_are_the_gradient_of_the_energy() {
    forces_of_small_damages([
        Dent::of_width(0.24e-3)
            .length(0.3e-3)
            .depth(9e-6)
            .rim_height(0.5e-6)
            .into(),
        Dent::of_width(0.2e-3)
            .depth(0.8e-6)
            .rim_height(0.5e-6)
            .into(),
    ]);
}

/// Forces of damages of race and ball at once, beside waves of both, at contacts steep and light.
fn forces_of_small_damages([of_race, of_ball]: [Damage; 2]) {
    let mut worst: f64 = 0.0;
    for sigma in [1.0, -1.0] {
        for elastic in laws(sigma, 2.0 * RADIUS) {
            let plain = pair(sigma, elastic, None, 0);
            let steel = Material::default();
            let hertz = Hertz::new(sigma, 2.0 * RADIUS, 60e-3, 0.52, 0.3, &steel, &steel);
            let contacts = [PittedContact::of(&hertz); 2];
            for (k, place) in places(sigma, false).into_iter().enumerate() {
                let (moved, across) = ([0.02e-3, -0.05e-3, 0.0, 0.07e-3][k], 0.1e-3);
                let l = 6.24e-3 - RADIUS + 15e-6;
                let angle = ((place[2] - 0.1e-3) / l).asin();
                let direction = place[1].atan2(place[0]);
                let turned = direction - place[4] + moved / 30e-3;
                let on_race = Defect::of(of_race.clone(), Surface::OuterRace, turned);
                let z = 0.1e-3 + 6.24e-3 * angle.sin() + across;
                let radius = plain.race.radius(z).unwrap();
                let mut pitted = SurfaceDefect::within(&on_race, &Bed::round(z, radius, contacts));
                pitted.widen(0.3e-3);
                let facing = if sigma > 0.0 {
                    direction
                } else {
                    direction + PI
                };
                let turned = facing - place[3] - moved / RADIUS;
                let on_ball = Defect::of(of_ball.clone(), Surface::Ball, turned);
                let bed = Bed::round(RADIUS * angle.sin() - across, RADIUS, contacts);
                let mut pit = SurfaceDefect::within(&on_ball, &bed);
                pit.widen(0.3e-3);
                let mut race = pair(sigma, elastic, None, 30);
                race.defects = vec![pitted];
                let ball = BallSide {
                    defects: vec![pit],
                    waves: wave_of_ball(5),
                    ..BallSide::whole(RADIUS)
                };
                let less = at(&race, &ball, place).energy;
                let smooth = BallSide {
                    defects: Vec::new(),
                    ..ball.clone()
                };
                let healthy = at(&pair(sigma, elastic, None, 30), &smooth, place).energy;
                assert!(less < 0.999 * healthy, "{less:e} {healthy:e}");
                worst = worst.max(off(&race, &ball, place));
            }
        }
    }
    println!("{worst:e}");
    assert!(worst < 1e-7, "{worst:e}");
}

#[test]
fn forces_are_the_gradient_of_the_energy() {
    let mut failed = Vec::new();
    for sigma in [1.0, -1.0] {
        for elastic in laws(sigma, 2.0 * RADIUS) {
            for (name, defect) in defects() {
                for on_ball in [false, true] {
                    for waves in [0, 30] {
                        let mut worst: f64 = 0.0;
                        for place in places(sigma, on_ball) {
                            let defect = moved(&defect, &place, on_ball);
                            let compiled = SurfaceDefect::new(
                                &defect,
                                defect.axial_offset.number().unwrap(),
                                5e-3,
                            );
                            let ball = BallSide {
                                defects: on_ball.then_some(compiled).into_iter().collect(),
                                // Both bodies are wavy, or none.
                                waves: wave_of_ball(waves / 6),
                                ..BallSide::whole(RADIUS)
                            };
                            let on_race = Some(&defect).filter(|_| !on_ball);
                            let pair = pair(sigma, elastic, on_race, waves);
                            worst = worst.max(off(&pair, &ball, place));
                        }
                        let body = if on_ball { "ball" } else { "race" };
                        let law = elastic.name();
                        let case = format!("{law} {sigma} {name} {body} {waves}: {worst:.1e}");
                        println!("{case}");
                        if worst > 1e-7 {
                            failed.push(case);
                        }
                    }
                }
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
