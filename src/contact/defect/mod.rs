//! Arcs where a surface is absent, and the fault circles at their edges (model section 7).

mod cap;
mod hole;
mod pit;
mod toward;

pub(crate) use hole::PittedContact;
pub(super) use hole::{Released, Yield};
pub(super) use pit::Pit;
pub(crate) use pit::{MOST_PITS, pits_at_once};
pub(crate) use toward::Toward;

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::{Motion, V2, wrapped};
use crate::scene::{Defect, Floor, Width};
use cap::{Cap, Lost, Rim};

/// How rotations of a ball move what is not its own along a slice: only about the ring's axis.
pub(super) const WITH_RING_AXIS: Vector3<f64> = Vector3::new(0.0, 0.0, 1.0);

/// Over the largest half-angle, how far a defect is looked for: a race's radius changes by films, by some ten-thousandths.
const MARGIN: f64 = 1.01;

/// A defect of a surface, compiled: places in the frame of its body.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceDefect {
    /// Angular place on the body \[rad\].
    pub angle: f64,
    /// Axial place of the middle, in the ring's frame or from the ball's centre \[m\].
    pub middle: f64,
    /// Axial length \[m\].
    pub length: f64,
    /// Radius R_f of the circles \[m\].
    pub edge_radius: f64,
    /// Thickness of the oil film on them \[m\].
    pub coat: f64,
    /// Depth and number of the recessed circles.
    pub floor: Option<(f64, usize)>,
    /// The largest half-angle, and a little more: a contact further away never sees the defect \[rad\]. Of a cap while its ball is as at
    /// the start.
    pub reach: f64,
    width: Width,
    cap: Option<Cap>,
    pub(super) pit: Option<Pit>,
}

/// Directions in the frame of the scene: those whose component along the middle, over their length, is above a bound.
pub(crate) struct Sight {
    pub middle: [f64; 2],
    pub bound: f64,
}

impl SurfaceDefect {
    /// A defect whose middle lies at `middle` on a surface whose least radius there is `radius` \[m\].
    pub fn new(defect: &Defect, middle: f64, radius: f64) -> Self {
        Self {
            angle: defect.angle,
            middle,
            length: defect.length,
            edge_radius: defect.edge_radius,
            coat: 0.0,
            floor: defect
                .floor
                .as_ref()
                .map(|&Floor { depth, elements }| (depth, elements)),
            reach: MARGIN * defect.width.largest() / (2.0 * radius),
            width: defect.width.clone(),
            cap: None,
            pit: None,
        }
    }

    /// A cap whose middle lies at `middle` along the axis, of a ball of a radius \[m\].
    pub fn cap(defect: &Defect, middle: f64, radius: f64) -> Self {
        let cap = Cap::new(defect.width.largest(), radius);
        Self {
            length: 0.0,
            reach: MARGIN * cap.widest(&cap.pole(defect.angle, middle)),
            cap: Some(cap),
            ..Self::new(defect, middle, radius)
        }
    }

    /// Its cap with the direction e of that in the frame in which the ball is seen; none of a patch.
    fn pole(&self, ball: &Motion) -> Option<(Cap, Vector3<f64>)> {
        let cap = self.cap?;
        Some((cap, ball.carried(&cap.pole(self.angle, self.middle))))
    }

    /// Whether another defect is this one's mirror image about the plane at half of `sum` along z, to a rounding
    /// \[m\].
    pub(crate) fn is_image(&self, other: &Self, sum: f64, rounding: f64) -> bool {
        let image = Self {
            middle: self.middle,
            reach: self.reach,
            width: other.width.reversed(),
            ..other.clone()
        };
        (self.middle + other.middle - sum).abs() <= rounding
            // Each found it on its own race.
            && (self.reach - other.reach).abs() <= 1e-12 * self.reach
            && *self == image
    }

    /// The directions of contacts that may see the defect, while its body is turned by an angle.
    pub(crate) fn sight(&self, turned: f64) -> Sight {
        let (sin, cos) = (self.angle + turned).sin_cos();
        Sight {
            middle: [cos, sin],
            // A little more than the reach, for rounding.
            bound: self.reach.min(PI).cos() - 1e-12,
        }
    }

    /// Whether a contact in this direction may see the defect.
    pub(crate) fn in_reach(&self, toward: &Toward) -> bool {
        match toward.pole(self) {
            None => toward.aside(self).abs() <= self.reach,
            Some((cap, e)) => cap.in_reach(&e, toward.n),
        }
    }

    /// Its two axial ends, in the ring's frame or from the ball's centre \[m\]; a cap has a rim all round.
    pub(super) fn ends(&self) -> impl Iterator<Item = f64> + Clone + use<> {
        let (middle, length) = (self.middle, self.length);
        let is_patch = self.cap.is_none() && self.pit.is_none();
        let sides = is_patch.then_some([-0.5, 0.5]);
        let ends = sides.into_iter().flatten();
        ends.map(move |share| middle + share * length)
    }

    /// Places ζ between which a cap of the ball has taken away what stands in a direction \[m\].
    pub(super) fn crossings(&self, ball: &Motion, n: V2) -> Option<[f64; 2]> {
        let (cap, e) = self.pole(ball)?;
        cap.crossings(&e, n)
    }

    /// Whether the surface is absent at an axial place where it has this radius, in a direction this far from the
    /// defect's own \[rad\]; `ball` is the orientation of the ball that has it.
    pub(crate) fn covers(&self, z: f64, radius: f64, aside: f64, ball: &Motion) -> bool {
        if let Some(pit) = &self.pit {
            return aside.abs() <= pit.span;
        }
        let at = Station {
            z,
            beside: 0.0,
            radius,
        };
        let arc = match self.pole(ball) {
            None => self.patch(&at, wrapped(self.angle - (self.angle + aside))),
            Some((cap, e)) => self.cut(&cap, &e, &at, -aside),
        };
        arc.is_some_and(|arc| arc.low.angle <= 0.0 && arc.high.angle >= 0.0)
    }

    /// The arc at an axial place, seen from a direction.
    fn arc(&self, at: &Station, toward: &Toward) -> Option<Arc> {
        if self.is_pit() {
            return None;
        }
        match toward.pole(self) {
            None => self.patch(at, wrapped(self.angle - toward.angle)),
            Some((cap, e)) => self.cut(&cap, &e, at, toward.aside_of(&e)),
        }
    }

    /// The arc of a patch, its middle at an angle from where it is seen \[rad\].
    fn patch(&self, at: &Station, middle: f64) -> Option<Arc> {
        let from_middle = at.z - self.middle;
        if (from_middle + at.beside).abs() > self.length / 2.0 {
            return None;
        }
        let (width, slope) = self.width.at(from_middle);
        (width > 0.0).then(|| {
            self.between(
                middle,
                width / (2.0 * at.radius),
                Form::Patch { width, slope },
            )
        })
    }

    /// The arc of a cap with its middle in the direction e, at an angle from where it is seen \[rad\].
    fn cut(&self, cap: &Cap, e: &Vector3<f64>, at: &Station, middle: f64) -> Option<Arc> {
        match cap.lost(e, at.z, at.radius) {
            Lost::Nothing => None,
            Lost::Arc(rim) => Some(self.between(middle, rim.half, Form::Cap(rim))),
            Lost::All => Some(self.between(
                middle,
                f64::INFINITY,
                Form::Patch {
                    width: 0.0,
                    slope: 0.0,
                },
            )),
        }
    }

    /// So far to both sides of a middle \[rad\].
    fn between(&self, middle: f64, half: f64, form: Form) -> Arc {
        let edge = |side: f64| Edge {
            angle: middle + side * half,
            side,
            radius: self.edge_radius + self.coat,
            form,
        };
        Arc {
            low: edge(-1.0),
            high: edge(1.0),
        }
    }
}

/// An axial place and the radius of the surface there \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// In the ring's frame or from the ball's centre.
    pub z: f64,
    /// Distance at which defects are looked for: a rounding error to either side of an end, else 0.
    pub beside: f64,
    /// Radius of the surface.
    pub radius: f64,
}

/// An end of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Angle from the direction that was asked about \[rad\].
    pub angle: f64,
    /// −1 at the low, +1 at the high end; in between for the circles of a floor.
    pub side: f64,
    /// Radius of the fault circle \[m\].
    pub radius: f64,
    /// How it moves along the axis, and with the ball.
    form: Form,
}

/// The defect that an edge belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    /// Its width \[m\] and the slope of that along z.
    Patch {
        width: f64,
        slope: f64,
    },
    Cap(Rim),
}

impl Edge {
    /// How its angle turns along the axis \[rad/m\], on a surface of some radius and slope of that radius.
    pub fn turn(&self, radius: f64, slope: f64) -> f64 {
        match &self.form {
            Form::Patch { width, slope: of } => {
                self.side * (of - width * slope / radius) / (2.0 * radius)
            }
            Form::Cap(rim) => self.side * rim.slope,
        }
    }

    /// How its angle turns by rotations of the ball that has it.
    pub(super) fn swing(&self) -> Vector3<f64> {
        match &self.form {
            Form::Patch { .. } => Vector3::z(),
            Form::Cap(rim) => rim.swing(self.side),
        }
    }
}

/// The connected part of the absent arcs that holds a direction; overlapping defects are one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Its lower end.
    pub low: Edge,
    /// Its upper end.
    pub high: Edge,
}

impl Arc {
    /// Whether nothing is left beside it, not even edges.
    pub fn is_all(&self) -> bool {
        self.high.angle == f64::INFINITY
    }
}

/// The absent arc around a direction at an axial place; none where the surface is whole.
pub fn absent(defects: &[SurfaceDefect], at: &Station, toward: &Toward) -> Option<Arc> {
    let mut around: Option<Arc> = None;
    loop {
        let mut grows = false;
        for arc in defects.iter().filter_map(|defect| defect.arc(at, toward)) {
            let (low, high) = around.map_or((0.0, 0.0), |a| (a.low.angle, a.high.angle));
            if arc.low.angle > high || arc.high.angle < low {
                continue;
            }
            grows |= around.is_none();
            let whole = around.get_or_insert(arc);
            if arc.low.angle < whole.low.angle {
                (whole.low, grows) = (arc.low, true);
            }
            if arc.high.angle > whole.high.angle {
                (whole.high, grows) = (arc.high, true);
            }
        }
        // What has grown may have reached others.
        if !grows || defects.len() == 1 {
            return around;
        }
    }
}

/// The recessed circles within an absent arc: edge data and depth of each.
pub fn floors<'a>(
    defects: &'a [SurfaceDefect],
    at: Station,
    toward: Toward<'a>,
    whole: &Arc,
) -> impl Iterator<Item = (Edge, f64)> + use<'a> {
    let (low, high) = (whole.low.angle, whole.high.angle);
    let floored = defects
        .iter()
        .filter_map(|defect| Some((defect, defect.floor?)));
    floored.flat_map(move |(defect, (depth, count))| {
        let arc = defect
            .arc(&at, &toward)
            .filter(|arc| arc.low.angle >= low && arc.high.angle <= high);
        arc.into_iter().flat_map(move |arc| {
            (1..=count).map(move |k| {
                let share = 2.0 * k as f64 / (count + 1) as f64 - 1.0;
                let half = (arc.high.angle - arc.low.angle) / 2.0;
                let edge = Edge {
                    angle: arc.low.angle + half * (1.0 + share),
                    side: share,
                    ..arc.low
                };
                (edge, depth)
            })
        })
    })
}
