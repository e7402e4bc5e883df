//! Evaluation of one ball on one race: finds the zone of contact, and cuts it into slices.

#[cfg(test)]
mod cap_tests;
mod ends;
mod film_layer;
mod friction_weights;
#[cfg(test)]
mod gradient_tests;
mod pressing;
mod shape;
mod slices;
mod within;

pub(super) use shape::Kind;
pub use shape::Shape;
use slices::Line;
pub(crate) use within::DefectContact;

use std::mem::discriminant;

use super::damage::{Facing, Moving, SurfaceSide, Unloading};
use super::laws::traction::Rolling;
use super::profile::{Before, Meeting, Raise, Section};
use super::slip::{Moves, Slip};
use super::{
    ContactDirection, ContactForce, Cut, FilmEffect, FilmNumbers, Law, Motion, OilForce, Oiled,
    Sink, SurfaceDefect, Torus, V2, Waves, ZoneSlices, turned,
};

/// Quantities that all contacts of a row's balls with one race share.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The race: a torus, or what is like a race of another shape where balls nominally touch it.
    pub race: Torus,
    /// Shape of the race.
    pub shape: Shape,
    /// Waviness of the race.
    pub waves: Waves,
    /// Law of the contacts.
    pub law: Law,
    /// Slices or nodes of a contact.
    pub slices: ZoneSlices,
    /// Defects of the race, in the ring's frame.
    pub defects: Vec<SurfaceDefect>,
}

/// Quantities of a contact that belong to the ball.
#[derive(Debug, Clone, PartialEq)]
pub struct BallSide {
    /// Radius \[m\].
    pub radius: f64,
    /// Texture of the ball, around the ring's axis.
    pub waves: Waves,
    /// Defects of the ball, in its frame.
    pub defects: Vec<SurfaceDefect>,
}

impl BallSide {
    /// A whole, smooth ball of a radius \[m\].
    pub fn whole(radius: f64) -> Self {
        Self {
            radius,
            waves: Waves::default(),
            defects: Vec::new(),
        }
    }

    /// Whether the race is smooth and has no defect.
    pub(crate) fn is_whole(&self) -> bool {
        self.waves.is_round() && self.defects.is_empty()
    }
}

impl Pair {
    /// Whether contacts with it follow the same equations as with another race, but for numbers that every contact has of its own.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        discriminant(&self.law.elastic) == discriminant(&other.law.elastic)
            && (self.shape.is_torus() && other.shape.is_torus() || self.shape == other.shape)
            && (&self.slices, self.law.damping) == (&other.slices, other.law.damping)
            && self.law.rubs_like(&other.law)
    }

    /// Whether friction asks how the surfaces roll: only then it is found out.
    pub(super) fn reads_rolling(&self) -> bool {
        self.law.traction.is_some_and(|law| law.reads_rolling())
    }

    /// Evaluates all forces between a ball and the race of its ring.
    pub fn evaluate(&self, ball: &BallSide, b: &Motion, r: &Motion, sink: &mut dyn Sink) {
        self.evaluate_into(ball, b, r, sink);
    }

    /// The same into a sink whose code is taken in: compiled anew for each, so only what a run spends its time in asks for it.
    pub(crate) fn evaluate_into<S: Sink + ?Sized>(
        &self,
        ball: &BallSide,
        b: &Motion,
        r: &Motion,
        sink: &mut S,
    ) {
        let seen = b.seen_from(r);
        let apart = seen.centre;
        let distance = apart.norm();
        if distance == 0.0 {
            return;
        }
        let n = apart / distance;
        let needs_angle = !(self.waves.is_round() && self.defects.is_empty() && ball.is_whole());
        let angle = if needs_angle { seen.direction() } else { 0.0 };
        let raise = self.waves.raise(r.angle_of(angle));
        let swell = ball.waves.raise(b.angle_of(self.outwards(angle)));
        let z = seen.z;
        let standing = Standing {
            apart,
            distance,
            z,
            n,
            angle,
            raise,
            swell,
        };
        if let Kind::Points { contour, .. } = self.shape.kind() {
            let before = Before {
                radius: ball.radius,
                d: distance - raise.height,
                z,
            };
            for meeting in contour.meetings(before) {
                self.meet(ball, [b, r], &standing, &meeting, sink);
            }
            return;
        }
        for flank in self.flanks() {
            let race = &flank.race;
            let mut section = race.section(ball.radius, distance, z, raise.height);
            if !ball.waves.is_round() {
                let is_flat = flank.law.cut().is_flat();
                section = section.raised::<false, false>(is_flat, swell.height);
            }
            if section.is_clear() {
                continue;
            }
            let line = match flank.law.cut() {
                Cut::BallSurface => Some(Line::along_ball(&section)),
                Cut::CommonTangent { curvature } => Line::along_tangent(curvature, &section),
            };
            let Some(line) = line else { continue };
            let contact = flank.contact(ball, [b, r], &standing, section);
            contact.press(&line, [b, r], &standing, sink);
        }
    }

    /// Evaluates a contact with a race through points.
    fn meet<S: Sink + ?Sized>(
        &self,
        ball: &BallSide,
        motions: [&Motion; 2],
        standing: &Standing,
        meeting: &Meeting<'_>,
        sink: &mut S,
    ) {
        let section = meeting.section;
        let line = match self.law.cut() {
            Cut::BallSurface => {
                let (chord, ends) = meeting.chord();
                Some(Line::along_chord(chord, ends))
            }
            Cut::CommonTangent { curvature } => Line::along_tangent(curvature, &section),
        };
        let Some(line) = line else { return };
        if meeting.ends_within(line.ends()) {
            sink.truncated();
        }
        let mut contact = self.contact(ball, motions, standing, section);
        contact.facing.race = meeting.torus;
        contact.facing.surface = Some(meeting.surface);
        contact.middle = line.middle();
        contact.press(&line, motions, standing, sink);
    }

    /// A contact with the torus.
    fn contact<'a>(
        &'a self,
        ball: &'a BallSide,
        [b, r]: [&'a Motion; 2],
        standing: &Standing,
        section: Section<f64>,
    ) -> OneContact<'a> {
        let Standing {
            apart,
            distance,
            z,
            n,
            angle,
            raise,
            swell,
        } = *standing;
        let on_ring = r.angle_of(angle);
        let direction = ContactDirection::ball(b, n * self.race.sigma, self.outwards(angle));
        let cuts = |defect: &&SurfaceDefect| defect.cuts();
        let on_race = ContactDirection::race(on_ring);
        let mut arcs = self.defects.iter().filter(cuts);
        let ring_open = arcs.any(|defect| defect.in_reach(&on_race));
        let mut arcs = ball.defects.iter().filter(cuts);
        let ball_near = arcs.any(|defect| defect.in_reach(&direction));
        OneContact {
            facing: Facing {
                race: self.race,
                surface: None,
                race_side: SurfaceSide {
                    waves: &self.waves,
                    defects: &self.defects,
                },
                ball_side: SurfaceSide {
                    waves: &ball.waves,
                    defects: &ball.defects,
                },
                law: &self.law,
                radius: ball.radius,
                b,
                r,
                apart,
                distance,
                z,
                n,
                on_ring,
                raise,
                swell,
                ring_open,
                // A ring edge is met in another direction than the race.
                ball_open: ball_near || ring_open && ball.defects.iter().any(|f| cuts(&f)),
                unloading: Unloading::default(),
                section,
            },
            pair: self,
            slip: None,
            middle: 0.0,
            oil: FilmEffect::default(),
            rolling: self.moves([b, r], standing).rolling,
        }
    }

    /// The direction out of a ball to the race, of a ball in a direction from the axis \[rad\].
    pub(crate) fn outwards(&self, direction: f64) -> f64 {
        if self.race.sigma > 0.0 {
            direction
        } else {
            direction + std::f64::consts::PI
        }
    }

    /// Whether a defect of the race may be met at an angle from the ring's mark \[rad\].
    pub(super) fn is_near(&self, angle: f64) -> bool {
        let direction = ContactDirection::race(angle);
        self.defects
            .iter()
            .any(|defect| defect.in_reach(&direction))
    }

    /// How the ball moves against the ring.
    fn moves(&self, [b, r]: [&Motion; 2], standing: &Standing) -> Moves<f64> {
        let Standing { distance, n, .. } = *standing;
        let (velocity, sigma) = (b.seen_from(r).velocity, self.race.sigma);
        let across = velocity.dot(&turned(n));
        Moves {
            v_e: velocity.dot(&n) * sigma,
            v_z: b.vz - r.vz,
            slide: (across - distance * r.omega) * sigma,
            spin: (b.omega - r.omega) * sigma,
            rolling: if self.reads_rolling() {
                Rolling::new(distance, across, [b.omega, r.omega])
            } else {
                Rolling::resting(distance)
            },
            arm: self.race.a + standing.raise.height - distance,
            oil: FilmEffect::default(),
        }
    }

    /// The slip along a line, where it is a zone's and there is friction, of a ball that turns across the ring's axis with w_n and w_t
    /// along n_e and t_e.
    fn slip_along(
        &self,
        line: &Line,
        section: &Section<f64>,
        moves: &Moves<f64>,
        across: [f64; 2],
    ) -> Option<Slip<f64>> {
        let turns = across != [0.0; 2];
        if !line.is_common(section) || moves.are_none() && !turns {
            return None;
        }
        let mut slip = Slip::along::<false>(&self.law, self.race.sigma, section, moves)?;
        if turns {
            slip = slip.turning_across::<false>(&self.law, section, across);
        }
        // Beside the groove there is no slip to report, nor a node with a weight.
        Some(slip).filter(Slip::is_finite)
    }
}

/// A ball as it stands before a ring.
struct Standing {
    /// Vector from the ring's centre to the ball's, and its length.
    apart: V2,
    distance: f64,
    /// Axially, in the ring's frame.
    z: f64,
    /// The unit vector across the axis and, where anything depends on it, its angle.
    n: V2,
    angle: f64,
    /// Raise of the race by its waves.
    raise: Raise<f64>,
    /// Raise of the ball by its texture.
    swell: Raise<f64>,
}

/// A contact being evaluated.
#[derive(Clone, Copy)]
struct OneContact<'a> {
    facing: Facing<'a>,
    pair: &'a Pair,
    /// Slip along the line, if there is friction; on a curve through points that along the circle of curvature.
    slip: Option<Slip<f64>>,
    /// The place on the line that slip is counted from: the middle of the zone.
    middle: f64,
    rolling: Rolling<f64>,
    /// Effect of the contact's film.
    oil: FilmEffect<f64>,
}

impl OneContact<'_> {
    /// Hands all its forces to the sink.
    fn press<S: Sink + ?Sized>(
        mut self,
        line: &Line,
        motions: [&Motion; 2],
        standing: &Standing,
        sink: &mut S,
    ) {
        let mut moves = self.pair.moves(motions, standing);
        let oiled = self.pair.law.film.as_ref().map(|oiled| {
            let r = self.load_measure(oiled, line);
            (oiled, r)
        });
        let damages = self.release(line);
        let oiled = oiled.map(|(oiled, r)| (oiled, r * self.facing.unloading.share.cbrt()));
        if let Some((oiled, r)) = oiled {
            self.oil = FilmEffect::at(&FilmNumbers::new(oiled), r);
            moves.oil = self.oil;
        }
        let n_e = self.facing.n * self.facing.race.sigma;
        let across = [
            self.facing.b.across.dot(&n_e),
            self.facing.b.across.dot(&turned(n_e)),
        ];
        self.slip = self
            .pair
            .slip_along(line, &self.facing.section, &moves, across);
        if self.middle != 0.0 {
            self.slip = self.slip.map(|slip| slip.from::<false>(self.middle));
        }
        self.slices(line, sink);
        if let Some(damages) = &damages {
            self.facing.place_forces(damages, sink);
        }
        if let Some((oiled, r)) = oiled {
            let (sigma, lever) = (
                self.facing.race.sigma,
                self.facing.section.radius * self.facing.section.normal.cos,
            );
            sink.oil(&OilForce::new(
                oiled,
                r,
                &moves,
                sigma,
                self.facing.apart,
                lever,
            ));
        }
    }

    /// Cube root r of the contact's load over the film's reference load (12.14): of a whole race by its zone's length, which is
    /// known before the nodes.
    fn load_measure(&self, oiled: &Oiled, line: &Line) -> f64 {
        let reference = oiled.film.reference();
        let Some(half) = line.half(&self.facing.section) else {
            return (self.elastic_force(line) / reference.load).cbrt();
        };
        let r = half / reference.half_length;
        if !(self.facing.ring_open || self.facing.ball_open) || r == 0.0 {
            return r;
        }
        // Cut at the same places, so that nothing jumps where a defect comes into reach.
        let mut healthy = *self;
        (healthy.facing.ring_open, healthy.facing.ball_open) = (false, false);
        let [pressed, whole] = [self, &healthy].map(|contact| contact.elastic_force(line));
        if whole > 0.0 {
            r * (pressed / whole).cbrt()
        } else {
            r
        }
    }

    /// Sum of its elastic forces \[N\].
    fn elastic_force(&self, line: &Line) -> f64 {
        let mut sum = ElasticSum(0.0);
        self.slices(line, &mut sum);
        sum.0
    }

    /// Finds the damages in the contact that are smaller than it, and scales its elastic forces by them.
    fn release(&mut self, line: &Line) -> Option<Moving> {
        let damages = self.facing.small_damages()?;
        let mut sum = EnergySum(0.0);
        self.slices(line, &mut sum);
        if sum.0 <= 0.0 {
            return None;
        }
        let race = usize::from(self.facing.race.sigma < 0.0);
        let (share, moving) = damages.release(race, sum.0)?;
        self.facing.unloading = share;
        Some(moving)
    }
}

/// Adds up elastic forces.
struct ElasticSum(f64);

impl Sink for ElasticSum {
    fn force(&mut self, force: &ContactForce) {
        self.0 += force.elastic;
    }
}

/// Adds up elastic energies.
struct EnergySum(f64);

impl Sink for EnergySum {
    fn asks_energy(&self) -> bool {
        true
    }

    fn force(&mut self, force: &ContactForce) {
        self.0 += force.energy;
    }
}
