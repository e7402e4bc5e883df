//! As many nodes as a contact needs for a requested accuracy of its force.

use super::{Model, Race, RowModel, Scales};
use crate::contact::{BallSide, Motion, Pair, Rules, Sink, Slices, Touch, V2, Waves};

/// Nodes against which others are measured.
pub(super) const MANY: usize = 64;
/// Fewest and most nodes that are chosen.
const FEWEST: usize = 3;
const MOST: usize = 48;
/// Approaches over that of the heaviest loaded ball, and contact angles over the nominal one \[rad\], at which they
/// are measured: thrust and speed turn the contact.
const APPROACHES: [f64; 2] = [0.3, 1.0];
const TURNS: [f64; 2] = [0.0, 0.2];

/// The fewest nodes that give normal and friction force of the rolling balls of some rows, all of one law, on one race to an
/// accuracy, relative to the normal force.
pub(super) fn fewest(model: &Model, rows: &[usize], race: Race, accuracy: f64) -> Slices {
    let exponent = model.rows[rows[0]].pairs[race].law.elastic.exponent();
    let rules = |m: usize| Slices::Fitted(Rules::new(m, exponent));
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
fn worst(model: &Model, row: usize, race: Race, rules: &Slices) -> f64 {
    let compiled = &model.rows[row];
    let pair = Pair {
        slices: rules.clone(),
        faults: Vec::new(),
        waves: Waves::default(),
        ..compiled.pairs[race].clone()
    };
    let many = Pair {
        slices: compiled.pairs[race].slices.clone(),
        ..pair.clone()
    };
    let ball = BallSide {
        radius: model.balls[compiled.first].side.radius,
        faults: Vec::new(),
    };
    let mut largest = 0.0_f64;
    for approach in APPROACHES {
        for turn in TURNS {
            let angle = model.scene.rows[row].contact_angle + turn;
            let (b, r) = rolling(
                model,
                (row, compiled),
                &pair,
                (approach, angle),
                ball.radius,
            );
            let [few, exact] = [&pair, &many].map(|pair| {
                let mut force = Force::default();
                pair.evaluate(&ball, &b, &r, &mut force);
                force
            });
            let apart: f64 = few
                .total
                .iter()
                .zip(&exact.total)
                .map(|(x, y)| (x - y).powi(2))
                .sum();
            if exact.normal > 0.0 {
                largest = largest.max(apart.sqrt() / exact.normal);
            }
        }
    }
    largest
}

/// Ball and ring in pure rolling, pressed by a share of the scene's approach at an angle.
fn rolling(
    model: &Model,
    (row, compiled): (usize, &RowModel),
    pair: &Pair,
    (share, angle): (f64, f64),
    radius: f64,
) -> (Motion, Motion) {
    let Scales { approach, .. } = model.scales;
    let race = &pair.race;
    let l = race.r - radius + share * approach;
    // The outer contact leans to the row's side, the inner one away from it.
    let (sin, cos) = (race.sigma * compiled.side * angle).sin_cos();
    let distance = race.a + race.sigma * l * cos;
    let (orbit, spin) = model.rolling_speeds(row);
    let ball = Motion {
        centre: V2::new(distance, 0.0),
        z: race.centre + l * sin,
        theta: 0.0,
        velocity: V2::new(0.0, orbit * distance),
        vz: 0.0,
        omega: spin,
    };
    let turning = if race.sigma > 0.0 {
        0.0
    } else {
        model.scene.drive.initial_speed()
    };
    let ring = Motion {
        centre: V2::zeros(),
        z: 0.0,
        theta: 0.0,
        velocity: V2::zeros(),
        vz: 0.0,
        omega: turning,
    };
    (ball, ring)
}

/// Force on the ball, and the sum of the normal forces.
#[derive(Default)]
struct Force {
    total: [f64; 3],
    normal: f64,
}

impl Sink for Force {
    fn touch(&mut self, touch: &Touch) {
        let (on_ball, _) = touch.wrenches(touch.normal, 1.0);
        for (total, force) in self.total.iter_mut().zip(on_ball) {
            *total += force;
        }
        self.normal += touch.normal;
    }
}
