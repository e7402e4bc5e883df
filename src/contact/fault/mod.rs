//! Arcs where a surface is absent, and the fault circles at their edges (model section 7).

mod circles;
mod depth;
mod elements;
pub(super) mod gradient;
mod pressing;
mod within;

pub(crate) use within::Sighted;

use std::f64::consts::PI;

use super::wrapped;
use crate::scene::{Defect, Width};

/// A defect of a surface, compiled: places in the frame of its body.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
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
    /// Twice the largest half-angle: a contact further away never sees the fault \[rad\].
    pub reach: f64,
    width: Width,
}

/// Directions in the frame of the scene: those whose component along the middle, over their length, is above a bound.
pub(crate) struct Sight {
    pub middle: [f64; 2],
    pub bound: f64,
}

impl Fault {
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
                .map(|floor| (floor.depth, floor.elements)),
            reach: defect.width.largest() / radius,
            width: defect.width.clone(),
        }
    }

    /// Whether another fault is this one's mirror image about the plane at half of `sum` along z, to a rounding
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

    /// The directions of contacts that may see the fault, while its body is turned by an angle.
    pub(crate) fn sight(&self, turned: f64) -> Sight {
        let (sin, cos) = (self.angle + turned).sin_cos();
        Sight {
            middle: [cos, sin],
            // A little more than the reach, for rounding.
            bound: self.reach.min(PI).cos() - 1e-12,
        }
    }

    /// Whether a contact in this direction of the body's frame may see the fault.
    pub fn in_reach(&self, direction: f64) -> bool {
        wrapped(self.angle - direction).abs() <= self.reach
    }

    /// Its two axial ends, in the ring's frame or from the ball's centre \[m\].
    pub(super) fn ends(&self) -> [f64; 2] {
        [-0.5, 0.5].map(|share| self.middle + share * self.length)
    }

    /// Whether the surface is absent at an axial place where it has this radius, in a direction this far from the
    /// fault's own \[rad\].
    pub(crate) fn covers(&self, z: f64, radius: f64, aside: f64) -> bool {
        let at = Station {
            z,
            beside: 0.0,
            radius,
        };
        self.arc(&at, self.angle + aside)
            .is_some_and(|arc| arc.low.angle <= 0.0 && arc.high.angle >= 0.0)
    }

    /// The arc at an axial place, seen from a direction.
    fn arc(&self, at: &Station, direction: f64) -> Option<Arc> {
        let from_middle = at.z - self.middle;
        if (from_middle + at.beside).abs() > self.length / 2.0 {
            return None;
        }
        let (width, slope) = self.width.at(from_middle);
        (width > 0.0).then(|| {
            let half = width / (2.0 * at.radius);
            let middle = wrapped(self.angle - direction);
            let edge = |angle: f64, side: f64| Edge {
                angle,
                side,
                radius: self.edge_radius + self.coat,
                width,
                slope,
            };
            Arc {
                low: edge(middle - half, -1.0),
                high: edge(middle + half, 1.0),
            }
        })
    }
}

/// An axial place and the radius of the surface there \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// In the ring's frame or from the ball's centre.
    pub z: f64,
    /// By how much beside it defects are looked for: a hair to either side of an end, else 0.
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
    /// Width of the defect it belongs to \[m\].
    pub width: f64,
    /// Slope of that width along z.
    pub slope: f64,
}

impl Edge {
    /// How its angle turns along the axis \[rad/m\], on a surface of some radius and slope of that radius.
    pub fn turn(&self, radius: f64, slope: f64) -> f64 {
        self.side * (self.slope - self.width * slope / radius) / (2.0 * radius)
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

/// The absent arc around a direction \[rad, frame of the body\] at an axial place; none where the surface is whole.
pub fn absent(faults: &[Fault], at: &Station, direction: f64) -> Option<Arc> {
    let mut around: Option<Arc> = None;
    loop {
        let before = around;
        for arc in faults.iter().filter_map(|fault| fault.arc(at, direction)) {
            let (low, high) = around.map_or((0.0, 0.0), |a| (a.low.angle, a.high.angle));
            if arc.low.angle <= high && arc.high.angle >= low {
                let whole = around.get_or_insert(arc);
                if arc.low.angle < whole.low.angle {
                    whole.low = arc.low;
                }
                if arc.high.angle > whole.high.angle {
                    whole.high = arc.high;
                }
            }
        }
        if around == before {
            return around;
        }
    }
}

/// The recessed circles within an absent arc: edge data and depth of each.
pub fn floors<'a>(
    faults: &'a [Fault],
    at: Station,
    direction: f64,
    whole: &Arc,
) -> impl Iterator<Item = (Edge, f64)> + use<'a> {
    let (low, high) = (whole.low.angle, whole.high.angle);
    faults.iter().flat_map(move |fault| {
        let arc = fault
            .arc(&at, direction)
            .filter(|arc| arc.low.angle >= low && arc.high.angle <= high);
        let floor = fault.floor.zip(arc);
        floor.into_iter().flat_map(|((depth, count), arc)| {
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
