//! Damages smaller than a contact in it: the forces that follow from how the energy that they release depends on their places.
//!
//! All elastic forces of the contact are scaled by [`Unloading`]. Beside that, with U_x = −e^{−X} V_x + R_x and U_y = −e^{−X} V_y + R_y, n_c = cos α' n_e + sin α' ẑ,
//! τ̂ = −sin α' n_e + cos α' ẑ and t_e = ẑ × n_e (15.5):
//!
//! ```text
//! of a race, at φ_f and z_f:  x₀ = r (α_f − α'), sin α_f = (z_f − z_g)/r,  y₀ = R(z_f) (φ_f + θ_r − φ)
//!     ∂U/∂φ = −R(z_f) U_y,   ∂U/∂α' = −r U_x
//! of a ball, direction e:     x₀ = R e·τ̂,  y₀ = R e·t_e,  where e·n_c > 0
//!     ∂U/∂φ = −R (sin α' (e·t_e) U_x + (e·n_e) U_y),   ∂U/∂α' = −R (e·n_c) U_x,   moment on the ball −R e × (U_x τ̂ + U_y t_e)
//! ```
//!
//! −(∂U/∂φ)/d acts across the ball's radius: of a race's damage through the ball's centre, of a ball's at the ring's.

use nalgebra::Vector3;

use super::SurfaceDefect;
use super::facing::Facing;
use super::hole::{Released, Unloading};
use super::recess::CompiledRecess;
use crate::contact::profile::Inclination;
use crate::contact::{PointForce, Sink, V2, turned, wrapped};

/// Damages smaller than it that a contact meets at once, at most.
pub(crate) const MOST_AT_ONCE: usize = 4;

/// How many damages of a race that are smaller than a contact one may meet at once.
pub(crate) fn met_at_once(defects: &[SurfaceDefect]) -> usize {
    let all = defects.iter().filter(|defect| defect.is_small());
    let beyond = |one: &SurfaceDefect, other: &SurfaceDefect| {
        let apart = wrapped(other.angle - one.angle);
        (0.0..=one.reach + other.reach).contains(&apart)
    };
    let from = |one: &SurfaceDefect| all.clone().filter(|other| beyond(one, other)).count();
    all.clone().map(from).max().unwrap_or(0)
}

/// Place of a damage in a contact, and its body.
#[derive(Clone, Copy)]
struct SmallPlace {
    at: [f64; 2],
    body: PlaceBody,
}

#[derive(Clone, Copy)]
enum PlaceBody {
    Race {
        radius: f64,
    },
    /// A ball, with the direction e.
    Ball(Vector3<f64>),
}

/// A damage that a contact meets.
#[derive(Clone, Copy)]
struct MetDamage<'a> {
    small: &'a CompiledRecess,
    place: SmallPlace,
}

/// The damages that a contact meets which are smaller than it.
pub(in crate::contact) struct MetDamages<'a>([Option<MetDamage<'a>>; MOST_AT_ONCE]);

/// Effect of damages beside scaling the contact's forces.
pub(in crate::contact) struct Moving {
    places: [Option<(SmallPlace, Released)>; MOST_AT_ONCE],
}

impl MetDamages<'_> {
    /// Effect on a contact with the outer (0) or the inner race (1) that has so much elastic energy without damages \[J\]: a share of
    /// its elastic forces, and more.
    pub fn release(&self, race: usize, energy: f64) -> Option<(Unloading, Moving)> {
        let of = &self.0[0].as_ref()?.small.bed.contacts[race];
        let (depth, _) = of.pressed(energy);
        let mut places = [None; MOST_AT_ONCE];
        let mut released = [Released::default(); MOST_AT_ONCE];
        for (i, met) in self.0.iter().flatten().enumerate() {
            released[i] = met.small.released(race, depth, met.place.at);
            places[i] = Some((met.place, released[i]));
        }
        Some((Unloading::of(of, energy, &released), Moving { places }))
    }
}

impl<'a> Facing<'a> {
    /// Damages in reach of the contact that are smaller than it, if any.
    pub(in crate::contact) fn small_damages(&self) -> Option<MetDamages<'a>> {
        let mut found = [None; MOST_AT_ONCE];
        let on_race = self.race_side.defects.iter();
        let on_race = on_race.filter_map(|defect| self.met_on_race(defect));
        let on_ball = self.ball_side.defects.iter();
        let on_ball = on_ball.filter_map(|defect| self.met_on_ball(defect));
        for (slot, met) in found.iter_mut().zip(on_race.chain(on_ball)) {
            *slot = Some(met);
        }
        found[0].is_some().then_some(MetDamages(found))
    }

    fn met_on_race<'d>(&self, defect: &'d SurfaceDefect) -> Option<MetDamage<'d>> {
        let small = defect.as_releases()?;
        let offset = wrapped(defect.angle - self.on_ring);
        if offset.abs() > defect.reach {
            return None;
        }
        let Inclination { cos, sin } = self.section.normal;
        let angle = ((defect.middle - self.race.centre) / self.race.r).asin();
        let radius = small.bed.radius;
        let at = [self.race.r * (angle - sin.atan2(cos)), radius * offset];
        let place = SmallPlace {
            at,
            body: PlaceBody::Race { radius },
        };
        Some(MetDamage { small, place })
    }

    fn met_on_ball<'d>(&self, defect: &'d SurfaceDefect) -> Option<MetDamage<'d>> {
        let (small, e) = (defect.as_releases()?, defect.pole(self.b)?);
        let [n_c, along, across] = self.axes();
        if e.dot(&n_c) <= 0.0 {
            return None;
        }
        let radius = self.radius;
        let at = [radius * e.dot(&along), radius * e.dot(&across)];
        let place = SmallPlace {
            at,
            body: PlaceBody::Ball(e),
        };
        (at[1].abs() <= defect.reach * radius).then_some(MetDamage { small, place })
    }

    /// n_c, τ̂ and t_e.
    fn axes(&self) -> [Vector3<f64>; 3] {
        let Inclination { cos, sin } = self.section.normal;
        let n = self.n * self.race.sigma;
        let t = turned(n);
        [
            Vector3::new(n.x * cos, n.y * cos, sin),
            Vector3::new(-n.x * sin, -n.y * sin, cos),
            Vector3::new(t.x, t.y, 0.0),
        ]
    }

    /// Forces by the places of damages.
    pub(in crate::contact) fn place_forces<S: Sink + ?Sized>(&self, of: &Moving, sink: &mut S) {
        for (place, released) in of.places.iter().flatten() {
            let (lost, gained) = (&released.lost, &released.gained);
            let left = self.unloading.left;
            let u_x = -left * lost.by_x + gained.by_x;
            let u_y = -left * lost.by_y + gained.by_y;
            match place.body {
                PlaceBody::Race { radius } => {
                    let by_angle = -self.race.r * u_x;
                    sink.point(&self.turning_by(by_angle));
                    let plane = turned(self.n) * (radius * u_y / self.distance);
                    sink.point(&PointForce::at(V2::zeros(), plane, 0.0));
                }
                PlaceBody::Ball(e) => self.ball_force(&e, [u_x, u_y], sink),
            }
        }
    }

    fn ball_force<S: Sink + ?Sized>(&self, e: &Vector3<f64>, [u_x, u_y]: [f64; 2], sink: &mut S) {
        let radius = self.radius;
        let [n_c, along, across] = self.axes();
        sink.point(&self.turning_by(-radius * e.dot(&n_c) * u_x));
        let moment = e.cross(&(along * u_x + across * u_y)) * -radius;
        // Its part about the axis is ∂U/∂φ, of a force at the ring's centre.
        let plane = turned(self.n) * (-moment.z / self.distance);
        sink.point(&PointForce {
            across: moment.xy(),
            ..PointForce::at(-self.apart, plane, 0.0)
        });
    }
}
