//! Walks the slices of a contact: fixed ones, or nodes fitted to the zone that touches.
//!
//! Ball and groove are two circles in the meridional plane, so the ends of the zone are known in closed form,
//! the penetration vanishes there linearly and the force with the law's exponent. Gauss–Jacobi nodes for that
//! weight on the whole zone converge exponentially ([*Slices*](crate::equations#slices), but along
//! the common chord instead of ζ: six nodes err by 1.3e-6 instead of 6.5e-4, rms over angles to 45° and approaches to
//! 40 µm). Where the end of a defect or a shoulder
//! cuts the zone, the outer pieces keep the weight at their free end only. Inside a defect the elements have
//! zones of their own: their ends are searched for, and plain Gauss nodes lie on every smooth piece.

use super::OneContact;
use crate::contact::damage::{BESIDE, Node, Owner};
use crate::contact::profile::{Chord, Ends, Inclination, Section, Zone};
use crate::contact::quadrature::MOST;
use crate::contact::{ContactDirection, Rules, Sink, SurfaceDefect, ZoneSlices};

/// The line along which a contact is cut, over the zone low … high of u.
pub(in crate::contact) struct Line {
    along: Along,
    low: f64,
    high: f64,
    /// Whether the penetration vanishes at the zone's ends.
    sealed: [bool; 2],
}

enum Along {
    /// The ball's surface over the common chord; the penetration is that of the slice in the plane, s_k.
    Surface(Chord),
    /// The common tangent, ζ = middle + u · cos; the penetration is δ − κ u²/2 of the Hertz law.
    Tangent {
        middle: f64,
        cos: f64,
        curvature: f64,
    },
}

impl Line {
    /// The line along the ball's surface.
    pub(super) fn along_ball(section: &Section<f64>) -> Self {
        let (chord, ends) = Chord::of(section);
        Self::along_chord(chord, ends)
    }

    /// The line along a chord, between the ends of a zone.
    pub(super) fn along_chord(
        chord: Chord,
        [(low, low_sealed), (high, high_sealed)]: Ends,
    ) -> Self {
        Self {
            along: Along::Surface(chord),
            low,
            high,
            sealed: [low_sealed, high_sealed],
        }
    }

    /// The line along the common tangent, where the gap has some curvature.
    pub(super) fn along_tangent(curvature: f64, section: &Section<f64>) -> Option<Self> {
        if section.e <= 0.0 || section.approach <= 0.0 {
            return None;
        }
        let Inclination { cos, sin } = section.normal;
        let half = Zone::on_tangent(section, 0.5 * curvature).half;
        Some(Self {
            along: Along::Tangent {
                middle: section.radius * sin,
                cos,
                curvature,
            },
            low: -half,
            high: half,
            sealed: [true; 2],
        })
    }

    /// Ends of the line along ζ.
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.low, self.high].map(|u| self.zeta(u).0)
    }

    /// u of its middle.
    pub(super) fn middle(&self) -> f64 {
        f64::midpoint(self.low, self.high)
    }

    /// Whether the line is the common chord or tangent, and not the ball's axis in place of one.
    pub(super) fn is_common(&self, section: &Section<f64>) -> bool {
        match &self.along {
            Along::Surface(chord) => chord.normal == section.normal,
            Along::Tangent { .. } => true,
        }
    }

    /// Whether the line is the common tangent.
    fn is_tangent(&self) -> bool {
        matches!(self.along, Along::Tangent { .. })
    }

    /// Half of the line's length, where the penetration vanishes at both ends of a zone.
    pub(super) fn half(&self, section: &Section<f64>) -> Option<f64> {
        let whole = self.is_common(section) && self.sealed == [true; 2];
        whole.then_some((self.high - self.low) / 2.0)
    }

    /// Place ζ at u, and the width that a unit of u stands for: of a slice, or of the common tangent.
    fn zeta(&self, u: f64) -> (f64, f64) {
        match &self.along {
            Along::Surface(chord) => chord.zeta(u),
            Along::Tangent { middle, cos, .. } => (middle + u * cos, 1.0),
        }
    }

    /// u at a place ζ; a surface has none beyond the ball.
    fn u(&self, zeta: f64) -> Option<f64> {
        match &self.along {
            Along::Surface(chord) => chord.u(zeta),
            Along::Tangent { middle, cos, .. } => Some((zeta - middle) / cos),
        }
    }

    /// Width of a fixed slice that is `width` wide along ζ.
    fn of_slice(&self, width: f64) -> f64 {
        match &self.along {
            Along::Surface(_) => width,
            Along::Tangent { cos, .. } => width / cos,
        }
    }
}

/// A stretch of the zone and how the penetration ends on both sides.
#[derive(Clone, Copy)]
struct ZonePiece {
    low: f64,
    high: f64,
    sealed: [bool; 2],
}

/// Approach over the ball's radius from which a ball is being lost rather than pressed, and its zone ends with its surface.
const DEEPEST: f64 = 0.05;

impl OneContact<'_> {
    /// Hands the forces of all slices to the sink.
    pub(in crate::contact) fn slices<S: Sink + ?Sized>(&self, line: &Line, sink: &mut S) {
        match &self.pair.slices {
            ZoneSlices::Fixed(count) => self.fixed(line, *count, sink),
            ZoneSlices::Fitted(rules) => self.fitted(line, rules, sink),
        }
        if self.facing.ring_open && self.facing.feels_ring_ends() {
            // Of all: one out of reach may overlap one in reach.
            for zeta in different(self.ends_on_race(|_| true)) {
                self.end(line, zeta, Owner::Ring, sink);
            }
        }
        if self.facing.ball_open {
            for zeta in different(self.ends_on_ball()) {
                self.end(line, zeta, Owner::Ball, sink);
            }
        }
    }

    /// Adds the force of the axial end of a defect at a place ζ of a line.
    fn end<S: Sink + ?Sized>(&self, line: &Line, zeta: f64, owner: Owner, sink: &mut S) {
        if let Some(node) = self.node_of(line, zeta) {
            self.facing.end(&node, owner, sink);
        }
    }

    /// Places ζ where defects of the race end, of those that are wanted.
    fn ends_on_race(
        &self,
        wanted: impl Fn(&SurfaceDefect) -> bool + Clone,
    ) -> impl Iterator<Item = f64> + Clone {
        let dz = self.facing.z;
        let defects = self.facing.race_side.defects.iter();
        defects
            .filter(move |defect| wanted(defect))
            .flat_map(SurfaceDefect::ends)
            .map(move |z| z - dz)
    }

    /// Places ζ where defects of the ball end.
    fn ends_on_ball(&self) -> impl Iterator<Item = f64> + Clone {
        let defects = self.facing.ball_side.defects.iter();
        defects
            .filter(|_| self.facing.ball_open)
            .flat_map(SurfaceDefect::ends)
    }

    fn fixed<S: Sink + ?Sized>(&self, line: &Line, count: usize, sink: &mut S) {
        let radius = self.facing.radius;
        let width = line.of_slice(2.0 * radius / count as f64);
        let [low, high] = line.ends();
        if line.is_tangent() && low.min(-high) < -radius {
            sink.truncated();
        }
        let ends = [low, high].map(|zeta| zeta.clamp(-radius, radius));
        for zeta in fixed_places(radius, count, ends) {
            let node = line
                .u(zeta)
                .and_then(|u| self.node_at(line, zeta, u, width));
            if let Some(node) = node {
                self.slice(&node, sink);
            }
        }
    }

    /// The zone in pieces between the ends of shoulders and of defects in reach.
    fn fitted<S: Sink + ?Sized>(&self, line: &Line, rules: &Rules, sink: &mut S) {
        let race = &self.facing.race;
        let dz = self.facing.z;
        let direction = ContactDirection::race(self.facing.on_ring);
        let shoulders = [race.centre + race.lowest, race.centre + race.highest];
        // Few, so the next one is found by looking at all.
        let cuts = shoulders
            .into_iter()
            .map(|z| z - dz)
            .chain(self.ends_on_race(|defect| defect.in_reach(&direction)))
            .chain(self.ends_on_ball())
            .chain(self.facing.crossings())
            .filter_map(|zeta| line.u(zeta));
        let mut low = line.low;
        while low < line.high {
            let high = cuts.clone().filter(|&u| u > low).fold(line.high, f64::min);
            let sealed = [
                line.sealed[0] && low == line.low,
                line.sealed[1] && high == line.high,
            ];
            self.piece(line, ZonePiece { low, high, sealed }, rules, sink);
            low = high;
        }
    }

    fn piece<S: Sink + ?Sized>(&self, line: &Line, piece: ZonePiece, rules: &Rules, sink: &mut S) {
        let open = (self.facing.ring_open || self.facing.ball_open)
            && self
                .node(line, f64::midpoint(piece.low, piece.high), 0.0)
                .is_some_and(|node| self.facing.is_open(&node));
        if !open {
            self.nodes(line, piece, rules, sink);
            return;
        }
        let (ends, count) = self.zone_ends(line, [piece.low, piece.high]);
        let mut low = piece.low;
        for high in ends[..count].iter().copied().chain([piece.high]) {
            self.nodes(
                line,
                ZonePiece {
                    low,
                    high,
                    sealed: [false; 2],
                },
                rules,
                sink,
            );
            low = high;
        }
    }

    fn nodes<S: Sink + ?Sized>(&self, line: &Line, piece: ZonePiece, rules: &Rules, sink: &mut S) {
        let (centre, half) = (
            f64::midpoint(piece.low, piece.high),
            (piece.high - piece.low) / 2.0,
        );
        let product = rules.product(piece.sealed);
        let weighed = self.slip.as_ref().zip(product);
        let mut friction_weight = [if weighed.is_some() { 0.0 } else { 1.0 }; 2 * MOST];
        if let Some((slip, product)) = weighed {
            let centre = centre - self.middle;
            product.weights::<_, false>(slip, centre, half, &mut friction_weight);
        }
        for (k, (x, weight)) in rules.on(piece.sealed).iter().enumerate() {
            match self.node(line, centre + half * x, half * weight) {
                Some(mut node) => {
                    node.friction_weight = friction_weight.get(k).copied().unwrap_or(1.0);
                    self.slice(&node, sink);
                }
                // In a defect, or on a curve through points, past a pole.
                None if line.is_tangent() => sink.truncated(),
                None => {}
            }
        }
    }

    /// Whether a zone goes on past the pole of the ball, ζ = R, and of the groove: that on the common tangent of whole surfaces,
    /// which has none. Friction takes such a node to lie at the pole.
    fn passes_poles(&self, line: &Line) -> bool {
        let is_whole =
            self.facing.surface.is_none() && !(self.facing.ring_open || self.facing.ball_open);
        line.is_tangent() && is_whole && self.facing.section.approach < DEEPEST * self.facing.radius
    }

    /// The node at u that stands for a stretch of u.
    pub(super) fn node(&self, line: &Line, u: f64, stretch: f64) -> Option<Node> {
        let (zeta, width) = line.zeta(u);
        self.node_at(line, zeta, u, stretch * width)
    }

    /// The node at ζ within the zone, for a length of 1.
    fn node_of(&self, line: &Line, zeta: f64) -> Option<Node> {
        let u = line.u(zeta).filter(|u| (line.low..line.high).contains(u))?;
        self.node_at(line, zeta, u, 1.0)
    }

    fn node_at(&self, line: &Line, zeta: f64, u: f64, width: f64) -> Option<Node> {
        let square = self.facing.radius * self.facing.radius - zeta * zeta;
        let goes_on = self.passes_poles(line);
        if square <= 0.0 && !goes_on {
            return None;
        }
        let z = self.facing.z + zeta;
        let race = &self.facing.race;
        let groove = self.facing.groove(z).or(goes_on.then_some(0.0))?;
        let rho = square.max(0.0).sqrt();
        let depth = match line.along {
            Along::Surface(_) => self.facing.section.penetration(rho, groove),
            Along::Tangent { curvature, .. } => {
                self.facing.section.approach - curvature * u * u / 2.0
            }
        };
        Some(Node {
            zeta,
            rho,
            z,
            width,
            depth,
            groove,
            torus_radius: race.a + race.sigma * groove,
            beside: 0.0,
            friction_weight: 1.0,
        })
    }
}

/// Places without those that are a rounding from one before them: defects may end together.
fn different(places: impl Iterator<Item = f64> + Clone) -> impl Iterator<Item = f64> {
    let all = places.clone();
    places.enumerate().filter_map(move |(i, place)| {
        let known = |other: f64| (other - place).abs() <= 2.0 * BESIDE;
        (!all.clone().take(i).any(known)).then_some(place)
    })
}

/// Middles of the fixed slices that may lie in a zone.
fn fixed_places(radius: f64, count: usize, [low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    let width = 2.0 * radius / count as f64;
    let place = move |k: usize| -radius + (k as f64 + 0.5) * width;
    // A float becomes the nearest index that exists; one slice more on either side decides for itself.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let index = |zeta: f64| ((zeta + radius) / width) as usize;
    (index(low).saturating_sub(1)..(index(high) + 2).min(count)).map(place)
}
