//! Directions in which bodies move.

use std::ops::{Index, IndexMut};

/// Number of directions of a body: [`Dof::ALL`].
pub const DOFS: usize = 4;

/// A direction in which a body moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Dof {
    /// Along x \[m\].
    X,
    /// Along y \[m\].
    Y,
    /// Along the bearing's axis \[m\].
    Z,
    /// About the bearing's axis \[rad\].
    Theta,
    /// Of a ring, its tilt about x \[rad\].
    TiltX,
    /// Of a ring, its tilt about y \[rad\].
    TiltY,
    /// Of a ball that spins freely, its angular velocity about x, which adds up to a place \[rad\] that nothing reads.
    TurnX,
    /// Of a ball that spins freely, the same about y.
    TurnY,
    /// Of a ball that spins freely and has a cap, the first of its four Euler parameters.
    E0,
    /// The second of these.
    E1,
    /// The third of these.
    E2,
    /// The last of these.
    E3,
}

impl Dof {
    /// All that every body has, in their order.
    pub const ALL: [Self; DOFS] = [Self::X, Self::Y, Self::Z, Self::Theta];
    /// Those along axes.
    pub const TRANSLATIONS: [Self; 3] = [Self::X, Self::Y, Self::Z];
    /// Those in the plane of rotation.
    pub const SYMMETRIC: [Self; 2] = [Self::X, Self::Y];
    /// Those by which rings tilt.
    pub const TILTS: [Self; 2] = [Self::TiltX, Self::TiltY];
    /// Those in which balls spin freely, beside that about the bearing's axis.
    pub const TURNS: [Self; 2] = [Self::TurnX, Self::TurnY];
    /// Euler parameters of a ball.
    pub const ATTITUDE: [Self; 4] = [Self::E0, Self::E1, Self::E2, Self::E3];

    /// Its number among those of a body.
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

    /// Whether it is an angle, its speed in rad/s and its force a moment.
    #[inline]
    pub const fn is_rotation(self) -> bool {
        !matches!(self, Self::X | Self::Y | Self::Z)
    }
}

/// What has one entry a direction of a body is indexed by the direction.
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
