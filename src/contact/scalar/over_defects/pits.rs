//! Pits of races and balls in a contact: the forces that follow from how the released energy depends on their places.
//!
//! All elastic forces of the contact are scaled by [`Yield`]. Beside that, with U_x = −e^{−X} V_x and U_y = −e^{−X} V_y, n_c = cos α' n_e + sin α' ẑ,
//! τ̂ = −sin α' n_e + cos α' ẑ and t_e = ẑ × n_e (15.5):
//!
//! ```text
//! of a race, at φ_f and z_f:  x₀ = r (α_f − α'), sin α_f = (z_f − z_g)/r,  y₀ = R(z_f) (φ_f + θ_r − φ)
//!     ∂U/∂φ = −R(z_f) U_y,   ∂U/∂α' = −r U_x
//! of a ball, direction e:     x₀ = R e·τ̂,  y₀ = R e·t_e,  where e·n_c > 0
//!     ∂U/∂φ = −R (sin α' (e·t_e) U_x + (e·n_e) U_y),   ∂U/∂α' = −R (e·n_c) U_x,   moment on the ball −R e × (U_x τ̂ + U_y t_e)
//! ```
//!
//! −(∂U/∂φ)/d acts across the ball's radius: of a race's pit through the ball's centre, of a ball's at the ring's.

use nalgebra::Vector3;

use crate::contact::defect::{MOST_PITS, Pit, PittedContact, Released, Yield};
use crate::contact::scalar::{Line, OneContact};
use crate::contact::{Aside, Sink, SurfaceDefect, Touch, V2, turned, wrapped};

/// Where a pit lies in a contact, and on which body.
#[derive(Clone, Copy)]
struct PitPlace {
    at: [f64; 2],
    body: PitBody,
}

#[derive(Clone, Copy)]
enum PitBody {
    Race {
        radius: f64,
    },
    /// With the direction e.
    Ball(Vector3<f64>),
}

/// What pits do beside scaling the contact's forces.
pub(in crate::contact) struct Pitted {
    places: [Option<(PitPlace, Released)>; MOST_PITS],
}

impl OneContact<'_> {
    /// Finds the pits of the contact, and scales its elastic forces by them.
    pub(in crate::contact::scalar) fn find_pits(&mut self, line: &Line) -> Option<Pitted> {
        let places = self.pit_places();
        places[0]?;
        let mut sum = EnergySum(0.0);
        self.slices(line, &mut sum);
        if sum.0 <= 0.0 {
            return None;
        }
        let of = self.pitted_contact(&places[0]?.0);
        let (depth, _) = of.pressed(sum.0);
        let mut found = Pitted {
            places: [None; MOST_PITS],
        };
        let mut released = [Released::default(); MOST_PITS];
        for (i, (pit, place)) in places.iter().flatten().enumerate() {
            released[i] = pit
                .hole
                .released(&self.pitted_contact(pit), depth, place.at);
            found.places[i] = Some((*place, released[i]));
        }
        self.yields = Yield::of(&of, sum.0, &released);
        Some(found)
    }

    fn pitted_contact(&self, pit: &Pit) -> PittedContact {
        pit.contacts[usize::from(self.race.sigma < 0.0)]
    }

    /// Pits in reach of the contact.
    fn pit_places(&self) -> [Option<(Pit, PitPlace)>; MOST_PITS] {
        let mut found = [None; MOST_PITS];
        let on_race = self
            .pair
            .defects
            .iter()
            .filter_map(|defect| self.on_race(defect));
        let on_ball = self
            .ball
            .defects
            .iter()
            .filter_map(|defect| self.on_ball_of(defect));
        for (slot, place) in found.iter_mut().zip(on_race.chain(on_ball)) {
            *slot = Some(place);
        }
        found
    }

    fn on_race(&self, defect: &SurfaceDefect) -> Option<(Pit, PitPlace)> {
        let pit = defect.pit?;
        let aside = wrapped(defect.angle - self.on_ring);
        if aside.abs() > defect.reach {
            return None;
        }
        let (cos, sin) = self.section.normal;
        let angle = ((defect.middle - self.race.centre) / self.race.r).asin();
        let at = [self.race.r * (angle - sin.atan2(cos)), pit.radius * aside];
        let body = PitBody::Race { radius: pit.radius };
        Some((pit, PitPlace { at, body }))
    }

    fn on_ball_of(&self, defect: &SurfaceDefect) -> Option<(Pit, PitPlace)> {
        let (pit, e) = (defect.pit?, defect.pit_pole(self.b)?);
        let [n_c, along, across] = self.axes();
        if e.dot(&n_c) <= 0.0 {
            return None;
        }
        let radius = self.ball.radius;
        let at = [radius * e.dot(&along), radius * e.dot(&across)];
        let body = PitBody::Ball(e);
        (at[1].abs() <= defect.reach * radius).then_some((pit, PitPlace { at, body }))
    }

    /// n_c, τ̂ and t_e.
    fn axes(&self) -> [Vector3<f64>; 3] {
        let (cos, sin) = self.section.normal;
        let n = self.n * self.race.sigma;
        let t = turned(n);
        [
            Vector3::new(n.x * cos, n.y * cos, sin),
            Vector3::new(-n.x * sin, -n.y * sin, cos),
            Vector3::new(t.x, t.y, 0.0),
        ]
    }

    /// What the places of pits do.
    pub(in crate::contact) fn pit_forces<S: Sink + ?Sized>(&self, pits: &Pitted, sink: &mut S) {
        for (place, released) in pits.places.iter().flatten() {
            let [u_x, u_y] = [released.by_x, released.by_y].map(|by| -self.yields.energy * by);
            match place.body {
                PitBody::Race { radius } => {
                    let by_angle = -self.race.r * u_x;
                    sink.aside(&self.turning_by(by_angle));
                    let plane = turned(self.n) * (radius * u_y / self.distance);
                    sink.aside(&Aside::at(V2::zeros(), plane, 0.0));
                }
                PitBody::Ball(e) => self.ball_pit(&e, [u_x, u_y], sink),
            }
        }
    }

    fn ball_pit<S: Sink + ?Sized>(&self, e: &Vector3<f64>, [u_x, u_y]: [f64; 2], sink: &mut S) {
        let radius = self.ball.radius;
        let [n_c, along, across] = self.axes();
        sink.aside(&self.turning_by(-radius * e.dot(&n_c) * u_x));
        let moment = e.cross(&(along * u_x + across * u_y)) * -radius;
        // Its part about the axis is ∂U/∂φ, of a force at the ring's centre.
        let plane = turned(self.n) * (-moment.z / self.distance);
        sink.aside(&Aside {
            across: moment.xy(),
            ..Aside::at(-self.apart, plane, 0.0)
        });
    }
}

/// Adds up elastic energies.
struct EnergySum(f64);

impl Sink for EnergySum {
    fn asks_energy(&self) -> bool {
        true
    }

    fn touch(&mut self, touch: &Touch) {
        self.0 += touch.energy;
    }
}
