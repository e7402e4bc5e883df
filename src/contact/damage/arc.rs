//! Arcs where a surface is absent, and the fault circles at their edges.

use nalgebra::Vector3;

use super::SurfaceDefect;
use super::direction::ContactDirection;
use crate::contact::V2;

/// How rotations of a ball move what is not its own along a slice: only about the ring's axis.
pub(in crate::contact) const WITH_RING_AXIS: Vector3<f64> = Vector3::new(0.0, 0.0, 1.0);

/// An axial place and the radius of the surface there \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Axial place in the ring's frame or from the ball's centre.
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
    /// Motion of the edge along the axis, and with the ball.
    course: EdgeCourse,
}

/// How the edges of an arc move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum EdgeCourse {
    /// An arc about the ring's axis: its width \[m\] and the slope of that along z.
    Width { width: f64, slope: f64 },
    /// An arc that is fixed in a ball.
    Rim(Rim),
}

/// The ends of the arc that a slice of a ball has lost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rim {
    /// h \[rad\].
    pub half: f64,
    /// dh/dζ \[rad/m\].
    pub slope: f64,
    /// Swing of the arc's middle and of its half-width, across the ring's axis.
    pub turn_axis: [V2; 2],
}

impl Rim {
    /// Swing of the upper end (side 1), of the lower (−1), or of what lies between at a share of h.
    fn turn_axis(&self, side: f64) -> Vector3<f64> {
        let across = self.turn_axis[0] + self.turn_axis[1] * side;
        Vector3::new(across.x, across.y, 1.0)
    }
}

impl Edge {
    /// Change of the edge's angle along the axis \[rad/m\], on a surface of some radius and slope of that radius.
    pub fn turn(&self, radius: f64, slope: f64) -> f64 {
        match &self.course {
            EdgeCourse::Width { width, slope: of } => {
                self.side * (of - width * slope / radius) / (2.0 * radius)
            }
            EdgeCourse::Rim(rim) => self.side * rim.slope,
        }
    }

    /// Change of the edge's angle by rotations of the ball that has it.
    pub(super) fn turn_axis(&self) -> Vector3<f64> {
        match &self.course {
            EdgeCourse::Width { .. } => Vector3::z(),
            EdgeCourse::Rim(rim) => rim.turn_axis(self.side),
        }
    }
}

/// The connected part of the absent arcs that holds a direction; overlapping defects are one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// The arc's lower end.
    pub low: Edge,
    /// The arc's upper end.
    pub high: Edge,
}

impl Arc {
    /// An arc so far to both sides of a middle \[rad\], with fault circles of a radius \[m\].
    pub(super) fn about(middle: f64, half: f64, radius: f64, course: EdgeCourse) -> Self {
        let edge = |side: f64| Edge {
            angle: middle + side * half,
            side,
            radius,
            course,
        };
        Self {
            low: edge(-1.0),
            high: edge(1.0),
        }
    }

    /// An arc all the way round, which leaves nothing beside it.
    pub(super) fn all(middle: f64, radius: f64) -> Self {
        let course = EdgeCourse::Width {
            width: 0.0,
            slope: 0.0,
        };
        Self::about(middle, f64::INFINITY, radius, course)
    }

    /// Whether nothing is left beside it, not even edges.
    pub fn is_all(&self) -> bool {
        self.high.angle == f64::INFINITY
    }
}

/// The absent arc around a direction at an axial place; none where the surface is whole.
pub fn absent(
    defects: &[SurfaceDefect],
    at: &Station,
    direction: &ContactDirection,
) -> Option<Arc> {
    let mut around: Option<Arc> = None;
    loop {
        let mut grows = false;
        for arc in defects
            .iter()
            .filter_map(|defect| defect.arc(at, direction))
        {
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
    direction: ContactDirection<'a>,
    whole: &Arc,
) -> impl Iterator<Item = (Edge, f64)> + use<'a> {
    let (low, high) = (whole.low.angle, whole.high.angle);
    let floored = defects
        .iter()
        .filter_map(|defect| Some((defect, defect.floor()?)));
    floored.flat_map(move |(defect, (depth, count))| {
        let arc = defect
            .arc(&at, &direction)
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
