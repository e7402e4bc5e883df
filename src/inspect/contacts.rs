//! A contact in a state: load, angle, zone, slip, and the forces of its slices.

use serde::{Deserialize, Serialize};

use crate::base::nulls;

use crate::contact::{ContactForce, Pair, Sink, V2};
use crate::model::{Model, Race};
use crate::scene::ContactQuantity;

/// A contact in a few numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ContactSummary {
    /// Magnitude of the normal force, elastic and damping \[N\].
    pub load: f64,
    /// Angle of the contact against the radial plane, positive in the sense of the nominal contact angle \[rad\]; NaN without load.
    #[serde(deserialize_with = "nulls::number")]
    pub angle: f64,
    /// Axial place of the zone's middle of force, in the ring's frame \[m\]; NaN without load.
    #[serde(deserialize_with = "nulls::number")]
    pub zone_centre: f64,
    /// Axial extent of the slices that touch \[m\].
    pub zone_width: f64,
    /// Load-weighted slip speed \[m/s\]; NaN without load.
    #[serde(deserialize_with = "nulls::number")]
    pub slip: f64,
}

impl ContactSummary {
    /// Value of a quantity.
    pub fn get(&self, quantity: ContactQuantity) -> f64 {
        match quantity {
            ContactQuantity::Load => self.load,
            ContactQuantity::Angle => self.angle,
            ContactQuantity::ZoneCentre => self.zone_centre,
            ContactQuantity::ZoneWidth => self.zone_width,
            ContactQuantity::Slip => self.slip,
        }
    }
}

/// The force of one slice.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SliceForce {
    /// Place along the ball, from its centre \[m\].
    pub zeta: f64,
    /// Axial place in the ring's frame \[m\].
    pub z: f64,
    /// Width of the slice \[m\].
    pub width: f64,
    /// Penetration \[m\].
    pub penetration: f64,
    /// Normal force \[N\].
    pub force: f64,
}

/// Sums of the forces of a contact.
#[derive(Default)]
pub(super) struct Summary {
    plane: V2,
    axial: f64,
    weight: f64,
    moment: f64,
    slip: f64,
    low: f64,
    high: f64,
}

impl Sink for Summary {
    fn force(&mut self, force: &ContactForce) {
        let half = force.width / 2.0;
        if self.weight == 0.0 {
            (self.low, self.high) = (f64::INFINITY, f64::NEG_INFINITY);
        }
        self.plane += force.n_e * (force.normal * force.share.0);
        self.axial += force.normal * force.share.1;
        self.weight += force.normal;
        self.moment += force.normal * force.z;
        self.slip += force.normal * force.slip;
        self.low = self.low.min(force.z - half);
        self.high = self.high.max(force.z + half);
    }
}

struct List(Vec<SliceForce>);

impl Sink for List {
    fn force(&mut self, force: &ContactForce) {
        self.0.push(SliceForce {
            zeta: force.zeta,
            z: force.z,
            width: force.width,
            penetration: force.depth,
            force: force.normal,
        });
    }
}

/// A contact in a few numbers: ball `j` among all balls on a race.
pub(crate) fn contact(model: &Model, y: &[f64], j: usize, race: Race) -> ContactSummary {
    let mut sum = Summary::default();
    let side = visit(model, y, j, race, &mut sum);
    sum.contact_summary(race, side)
}

impl Summary {
    /// The sums in a few numbers, on a race of a row whose nominal contact angle has this sense.
    pub(super) fn contact_summary(&self, race: Race, side: f64) -> ContactSummary {
        if self.weight == 0.0 {
            return ContactSummary {
                load: 0.0,
                angle: f64::NAN,
                zone_centre: f64::NAN,
                zone_width: self.high - self.low,
                slip: f64::NAN,
            };
        }
        let radial = self.plane.norm();
        ContactSummary {
            load: radial.hypot(self.axial),
            angle: (self.axial * race.sigma() * side).atan2(radial),
            zone_centre: self.moment / self.weight,
            zone_width: self.high - self.low,
            slip: self.slip / self.weight,
        }
    }
}

/// Largest Hertz pressure of any contact \[Pa\], at the zone's centre; of the smooth race where there is a defect.
pub(crate) fn largest_pressure(model: &Model, y: &[f64]) -> f64 {
    let balls = 0..model.balls.len();
    let contacts = balls.flat_map(|j| Race::BOTH.map(|race| (j, race)));
    contacts
        .map(|(j, race)| pressure(model, y, j, race, contact(model, y, j, race).load))
        .fold(0.0, f64::max)
}

/// Largest slip speed \[m/s\], load-weighted in each contact, of contacts that rub by their film and bear a tenth of the largest load or more:
/// lighter ones heat nothing. 0 without films.
pub(crate) fn film_slip(model: &Model, y: &[f64]) -> f64 {
    let row = |j: usize| &model.rows[model.balls[j].row];
    let oiled: Vec<ContactSummary> = (0..model.balls.len())
        .flat_map(|j| Race::BOTH.map(|race| (j, race)))
        .filter(|(j, race)| row(*j).pairs[*race].law.rubs_by_film())
        .map(|(j, race)| contact(model, y, j, race))
        .collect();
    let heaviest = oiled.iter().map(|one| one.load).fold(0.0, f64::max);
    let loaded = oiled.iter().filter(|one| one.load > 0.1 * heaviest);
    loaded.map(|one| one.slip).fold(0.0, f64::max)
}

/// Hertz pressure \[Pa\] of a ball on a race under a load \[N\]; on a gothic arch of the flank that bears more.
pub(crate) fn pressure(model: &Model, y: &[f64], j: usize, race: Race, load: f64) -> f64 {
    let row = &model.rows[model.balls[j].row];
    let pair = &row.pairs[race];
    let heaviest = if pair.other_flank().is_some() {
        let mut flanks = Flanks {
            pair,
            sums: <[Summary; 2]>::default(),
        };
        visit(model, y, j, race, &mut flanks);
        let [own, other] = flanks.sums.map(|sum| sum.plane.norm().hypot(sum.axial));
        own.max(other)
    } else {
        load
    };
    row.hertz[race].pressure(heaviest)
}

/// Loads of the flank of a gothic arch that comes first, and of the other.
struct Flanks<'a> {
    pair: &'a Pair,
    sums: [Summary; 2],
}

impl Sink for Flanks<'_> {
    fn force(&mut self, force: &ContactForce) {
        let other = self.pair.is_beyond_cusp(force.z);
        self.sums[usize::from(other)].force(force);
    }
}

/// The forces of the slices of one contact, in order of ζ; on a defect a slice may appear more than once.
pub(crate) fn slice_forces(model: &Model, y: &[f64], j: usize, race: Race) -> Vec<SliceForce> {
    let mut list = List(Vec::new());
    visit(model, y, j, race, &mut list);
    list.0
}

/// Hands the forces of a contact to a sink; returns the sense of the nominal contact angle.
pub(crate) fn visit(model: &Model, y: &[f64], j: usize, race: Race, sink: &mut dyn Sink) -> f64 {
    let ball = &model.balls[j];
    let row = &model.rows[ball.row];
    let [at, ring] = model.facing(y, j, race);
    row.pairs[race].evaluate(&ball.side, &at, &ring, sink);
    row.side
}
