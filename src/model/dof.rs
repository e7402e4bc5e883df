//! Directions in which bodies move.

use std::ops::{Index, IndexMut};

/// Number of directions of a body: [`Dof::ALL`].
pub const DOFS: usize = 4;

/// A direction in which a body moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Dof {
    /// Place along x \[m\].
    X,
    /// Place along y \[m\].
    Y,
    /// Place along the bearing's axis \[m\].
    Z,
    /// Angle about the bearing's axis \[rad\].
    Theta,
    /// Tilt of a ring about x \[rad\].
    TiltX,
    /// Tilt of a ring about y \[rad\].
    TiltY,
    /// Angular velocity about x of a ball that spins freely, which adds up to a place \[rad\] that nothing reads.
    TurnX,
    /// Angular velocity about y of a ball that spins freely, likewise.
    TurnY,
    /// First of the four Euler parameters of a ball that spins freely and has a cap.
    E0,
    /// Second of the Euler parameters.
    E1,
    /// Third of the Euler parameters.
    E2,
    /// Last of the Euler parameters.
    E3,
}

impl Dof {
    /// Directions that every body has, in their order.
    pub const ALL: [Self; DOFS] = [Self::X, Self::Y, Self::Z, Self::Theta];
    /// Directions along axes.
    pub const TRANSLATIONS: [Self; 3] = [Self::X, Self::Y, Self::Z];
    /// Directions in the plane of rotation.
    pub const SYMMETRIC: [Self; 2] = [Self::X, Self::Y];
    /// Directions by which rings tilt.
    pub const TILTS: [Self; 2] = [Self::TiltX, Self::TiltY];
    /// Directions in which balls spin freely, beside that about the bearing's axis.
    pub const TURNS: [Self; 2] = [Self::TurnX, Self::TurnY];
    /// Euler parameters of a ball.
    pub const ATTITUDE: [Self; 4] = [Self::E0, Self::E1, Self::E2, Self::E3];

    /// The direction's number among those of a body.
    #[inline]
    pub const fn index(self) -> usize {
        self as usize
    }

    /// `x`, `y`, `z`, `theta`, `tilt_x`, `tilt_y`, `turn_x`, `turn_y` or `e0` to `e3`: as in the names of states.
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::Theta => "theta",
            Self::TiltX => "tilt_x",
            Self::TiltY => "tilt_y",
            Self::TurnX => "turn_x",
            Self::TurnY => "turn_y",
            Self::E0 => "e0",
            Self::E1 => "e1",
            Self::E2 => "e2",
            Self::E3 => "e3",
        }
    }

    /// Whether the direction is an angle, its speed in rad/s and its force a moment.
    #[inline]
    pub const fn is_rotation(self) -> bool {
        !matches!(self, Self::X | Self::Y | Self::Z)
    }
}

/// Arrays with one entry a direction of a body are indexed by the direction.
impl<T> Index<Dof> for [T; DOFS] {
    type Output = T;

    #[inline]
    fn index(&self, dof: Dof) -> &T {
        &self[dof as usize]
    }
}

impl<T> IndexMut<Dof> for [T; DOFS] {
    #[inline]
    fn index_mut(&mut self, dof: Dof) -> &mut T {
        &mut self[dof as usize]
    }
}
