//! The derivative of a contact's wrench on its ball by the relative twist.

// Loops over matrices read as their formulae do.
#![allow(clippy::needless_range_loop)]

use crate::contact::profile::Inclination;
use crate::simd::Lanes;

/// Directions in the plane.
pub(crate) type PlaneVector = [Lanes; 2];

/// Numbers of a twist of a ball that spins about the axis, and of one that spins freely.
pub(crate) const AXIAL: usize = 4;
pub(crate) const FREE: usize = 6;

/// Derivative of the wrench on the ball about its centre, (n_e, t_e, z, about z) or (x, y, z, about z), by the relative twist. Of a ball
/// that spins freely the moments about n_e and t_e, or x and y, stand behind.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HeldSlope<const N: usize> {
    pub by: [[Lanes; N]; N],
}

impl<const N: usize> Default for HeldSlope<N> {
    fn default() -> Self {
        Self {
            by: [[Lanes::ZERO; N]; N],
        }
    }
}

/// How a node's force on the ring changes with the velocity there.
pub(super) struct Slope {
    /// Slope of the force by the velocity along n_e, t_e and z.
    pub force: [[Lanes; 3]; 3],
    /// Friction along the meridian by the same.
    pub meridian: [Lanes; 3],
    /// Friction along t_e by slip along it, by slip along the meridian, and friction there by slip there.
    pub slip: [Lanes; 3],
}

impl<const N: usize> HeldSlope<N> {
    /// Subtracts the slope of a force at a point with those levers by the velocity of the point.
    #[inline(always)]
    pub(super) fn subtract<const FMA: bool>(
        &mut self,
        slope: &[[Lanes; 3]; 3],
        levers: PlaneVector,
    ) {
        for i in 0..3 {
            for j in 0..3 {
                self.by[i][j] = self.by[i][j] - slope[i][j];
            }
            let turning = moment::<FMA>(slope[i][0], slope[i][1], levers);
            self.by[i][3] = self.by[i][3] - turning;
        }
        let mut turning = [Lanes::ZERO; 3];
        for j in 0..3 {
            turning[j] = moment::<FMA>(slope[0][j], slope[1][j], levers);
            self.by[3][j] = self.by[3][j] - turning[j];
        }
        self.by[3][3] = self.by[3][3] - moment::<FMA>(turning[0], turning[1], levers);
    }

    /// Subtracts what a slope does by turning about n_e and t_e, which adds so much to slip along t_e and the meridian, and to the
    /// moments about these.
    #[inline(always)]
    pub(super) fn subtract_turning<const FMA: bool>(
        &mut self,
        of: &Slope,
        levers: PlaneVector,
        turns: [Lanes; 2],
        Inclination { cos, sin }: Inclination<Lanes>,
    ) {
        let [tt, tm, mm] = of.slip;
        let by_slip = [(tt, tm), (tm, mm)];
        let friction = [of.force[1], of.meridian];
        for k in 0..2 {
            let at = AXIAL + k;
            let (along, across) = by_slip[k];
            let column = [-(across * sin), along, across * cos];
            for i in 0..3 {
                self.by[i][at] = self.by[i][at] - turns[k] * column[i];
                self.by[at][i] = self.by[at][i] - turns[k] * friction[k][i];
            }
            let about = moment::<FMA>(column[0], column[1], levers);
            self.by[3][at] = self.by[3][at] - turns[k] * about;
            let about = moment::<FMA>(friction[k][0], friction[k][1], levers);
            self.by[at][3] = self.by[at][3] - turns[k] * about;
            for (l, by) in [along, across].into_iter().enumerate() {
                let to = &mut self.by[AXIAL + l][at];
                *to = *to - turns[l] * by * turns[k];
            }
        }
    }

    /// Turns it from the contact's frame into (x, y, z, about z).
    #[inline(always)]
    pub(crate) fn turn(&mut self, n_e: PlaneVector) {
        let turn = |n: Lanes, t: Lanes| (n * n_e[0] - t * n_e[1], n * n_e[1] + t * n_e[0]);
        // Where components along n_e stand, with those along t_e behind.
        for n in (0..N).step_by(AXIAL) {
            let t = n + 1;
            let slope = &mut self.by;
            for j in 0..N {
                (slope[n][j], slope[t][j]) = turn(slope[n][j], slope[t][j]);
            }
            for row in slope {
                (row[n], row[t]) = turn(row[n], row[t]);
            }
        }
    }

    /// Adds one lane of another, whose lanes are alike, to that lane.
    pub(crate) fn add_lane(&mut self, lane: usize, other: &Self) {
        for i in 0..N {
            for j in 0..N {
                self.by[i][j][lane] += other.by[i][j][lane];
            }
        }
    }

    /// Adds all lanes of another to one lane.
    pub(crate) fn gather(&mut self, lane: usize, other: &Self) {
        for i in 0..N {
            for j in 0..N {
                self.by[i][j][lane] += other.by[i][j].sum();
            }
        }
    }
}

/// Moment about z of components along n_e and t_e.
#[inline(always)]
pub(super) fn moment<const FMA: bool>(n: Lanes, t: Lanes, levers: PlaneVector) -> Lanes {
    levers[0].mul_add::<FMA>(n, levers[1] * t)
}

/// A relative twist (x, y, z, about z …) in the frame (n_e, t_e, z, about z …).
#[inline(always)]
pub(crate) fn in_contact<const N: usize>(twist: &[Lanes; N], n_e: PlaneVector) -> [Lanes; N] {
    let mut local = *twist;
    for n in (0..N).step_by(AXIAL) {
        let (x, y) = (twist[n], twist[n + 1]);
        (local[n], local[n + 1]) = (x * n_e[0] + y * n_e[1], y * n_e[0] - x * n_e[1]);
    }
    local
}
