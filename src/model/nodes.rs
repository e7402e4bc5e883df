//! The number of nodes that a contact needs for a requested accuracy of its force.

use nalgebra::Vector3;

use super::{Between, Model, Race, Scales};
use crate::contact::{BallSide, ContactForce, Motion, Pair, Rules, Sink, V2, Waves, ZoneSlices};

/// Nodes against which others are measured.
pub(super) const MANY: usize = 64;
/// Fewest and most nodes that are chosen.
const FEWEST: usize = 3;
const MOST: usize = 48;
/// Approaches over that of the heaviest loaded ball, and contact angles over the nominal one \[rad\], at which they
/// are measured: thrust and speed turn the contact.
const APPROACHES: [f64; 2] = [0.3, 1.0];
const TURNS: [f64; 2] = [0.0, 0.2];

/// Nodes beyond those of a rule by which the friction of all contacts is resolved. Slip that sweeps over half a zone by `sweep`
/// times the width of the traction law gives friction poles at about 1/sweep, which n nodes meet to e^(−2 n/sweep).
pub(super) fn finer(model: &Model) -> usize {
    /// Nodes a sweep, beside the nodes of the rule itself. On six nodes friction of the wheel bearing then errs by 2e-5 and the
    /// signal of 6 ms with an impact by 0.3 %; with 1.0 by 9e-5 and 1.1 %, with 1.6 by 1e-5 and 0.1 %.
    const EACH: f64 = 1.3;
    /// Range of the number of nodes: the least for what may start from rest too; and as many as cost less than the elements, beyond which friction is left as it is.
    const RANGE: [f64; 2] = [8.0, 96.0];
    let speed = model.scene.peak_relative_speed();
    let sweeps = model.rows.iter().enumerate().flat_map(|(i, row)| {
        let (radius, geometry) = (model.balls[row.first].side.radius, &model.scene.rows[i]);
        let turning = speed * (1.0 + model.rolling_shares(i).1.abs());
        let angle = geometry.contact_angle.abs() + TURNS[1];
        let approach = model.scales.approach;
        row.pairs
            .iter()
            .filter_map(move |pair| pair.sweep(radius, approach, angle, turning))
    });
    let Some(sweep) = sweeps.reduce(f64::max) else {
        return 0;
    };
    let nodes = (EACH * sweep).ceil();
    if nodes > RANGE[1] {
        return 0;
    }
    // A whole number below a hundred.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let nodes = nodes.max(RANGE[0]) as usize;
    nodes
}

/// The fewest nodes that give normal and friction force of the rolling balls of some rows, all of one law, on one race to an
/// accuracy, relative to the normal force.
pub(super) fn fewest(
    model: &Model,
    rows: &[usize],
    race: Race,
    accuracy: f64,
    finer: usize,
) -> ZoneSlices {
    let exponent = model.rows[rows[0]].pairs[race].law.elastic.exponent();
    let rules = |m: usize| ZoneSlices::Fitted(Rules::for_friction(m, exponent, finer));
    let error = |m: usize| {
        let errors = rows.iter().map(|row| worst(model, *row, race, &rules(m)));
        errors.fold(0.0, f64::max)
    };
    let mut before = error(FEWEST);
    for m in FEWEST..MOST {
        // The error does not fall evenly from one number of nodes to the next: two in a row must be accurate enough.
        let next = error(m + 1);
        if before.max(next) <= accuracy {
            return rules(m);
        }
        before = next;
    }
    rules(MOST)
}

/// Largest error over approaches and angles.
fn worst(model: &Model, row: usize, race: Race, rules: &ZoneSlices) -> f64 {
    let compiled = &model.rows[row];
    let mut many = compiled.pairs[race].clone();
    many.change(|flank| {
        (flank.defects, flank.waves) = (Vec::new(), Waves::default());
    });
    let mut pair = many.clone();
    pair.change(|flank| flank.slices.clone_from(rules));
    let ball = BallSide::whole(model.balls[compiled.first].side.radius);
    let mut largest = 0.0_f64;
    for approach in APPROACHES {
        for turn in TURNS {
            let angle = model.scene.rows[row]
                .contact_angle
                .max(pair.nominal_angle().abs())
                + turn;
            let (b, r) = rolling(model, row, race, &pair, approach, angle, ball.radius);
            let [few, exact] = [&pair, &many].map(|pair| {
                let mut force = NodeSum::default();
                pair.evaluate(&ball, &b, &r, &mut force);
                force
            });
            if exact.normal > 0.0 {
                largest = largest.max((few.total - exact.total).norm() / exact.normal);
            }
        }
    }
    largest
}

/// Ball and ring in pure rolling, pressed by a share of the scene's approach at an angle. A ball that spins freely pivots on this
/// race alone.
fn rolling(
    model: &Model,
    row: usize,
    side: Race,
    pair: &Pair,
    share: f64,
    angle: f64,
    radius: f64,
) -> (Motion, Motion) {
    let Scales { approach, .. } = model.scales;
    let race = &pair.race;
    let l = race.r - radius + share * approach;
    // The outer contact is inclined to the row's side, the inner one away from it.
    let nominal = pair.nominal_angle();
    let towards = if nominal == 0.0 {
        race.sigma * model.rows[row].side
    } else {
        // A flank of a gothic arch has its own angle.
        nominal.signum()
    };
    let (sin, cos) = (towards * angle).sin_cos();
    let distance = race.a + race.sigma * l * cos;
    // Seen from the outer ring.
    let speed = model.scene.relative_speed(0.0);
    let (orbit, spin) = model.rolling_shares(row);
    let (orbit, spin) = (speed * orbit, speed * spin);
    let ball = Motion {
        centre: V2::new(distance, 0.0),
        z: race.centre + l * sin,
        velocity: V2::new(0.0, orbit * distance),
        omega: spin,
        ..Motion::default()
    };
    let ball = if model.balls_turn() {
        let between = Between {
            radius,
            distance,
            angles: [towards * race.sigma * angle; 2],
            speed,
        };
        let rolling = between.controlled_by(side.other());
        Motion {
            velocity: V2::new(0.0, rolling.orbit * distance),
            omega: rolling.axial,
            ..ball.turning_across([rolling.outward, 0.0])
        }
    } else {
        ball
    };
    let turning = if race.sigma > 0.0 { 0.0 } else { speed };
    let ring = Motion {
        omega: turning,
        ..Motion::default()
    };
    (ball, ring)
}

/// Force on the ball, and the sum of the normal forces.
#[derive(Default)]
struct NodeSum {
    total: Vector3<f64>,
    normal: f64,
}

impl Sink for NodeSum {
    fn force(&mut self, force: &ContactForce) {
        self.total += force.on_ball(force.normal, 1.0).force;
        self.normal += force.normal;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile;
    use crate::scene::{Friction, GothicArch, presets};

    /// Limits: both flanks of a gothic arch weigh for friction in the same way, finely resolved or not at all.
    #[test]
    fn both_flanks_are_resolved_alike() {
        for slip_speed in [0.1, 1e-3] {
            let mut scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
            scene.friction = Friction::Coulomb {
                coefficient: 0.05,
                slip_speed,
            };
            scene.rows[0].inner_arch = Some(GothicArch::new(0.5));
            let model = compile(&scene).unwrap();
            let pair = &model.rows[0].pairs[Race::Inner];
            let other = pair.other_flank().unwrap();
            assert_eq!(pair.slices, other.slices, "{slip_speed}");
        }
    }

    /// Limits: finer where slip sweeps over more slip speeds; not at all without friction, nor where it would cost too much.
    #[test]
    fn friction_is_resolved_as_it_is_steep() {
        let nodes = |friction: Friction| {
            let mut scene = presets::wheel_bearing(3000.0);
            scene.friction = friction;
            finer(&compile(&scene).unwrap())
        };
        let coulomb = |slip_speed: f64| {
            nodes(Friction::Coulomb {
                coefficient: 0.05,
                slip_speed,
            })
        };
        let [wide, usual, narrow] = [1.0, 0.1, 0.05].map(coulomb);
        assert_eq!(wide, 8);
        assert!(
            (12..24).contains(&usual) && narrow > usual,
            "{usual} {narrow}"
        );
        assert_eq!([coulomb(1e-3), nodes(Friction::None)], [0, 0]);
    }
}
