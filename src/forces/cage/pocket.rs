//! A ball in its pocket of a cage that is a ring: the law of a wall, and its equations in [`super::ring`].

use crate::contact::{Motion, V2, cross};
use crate::model::{CageModel, Carried};

/// A cage in motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turning {
    pub centre: V2,
    pub velocity: V2,
    /// Direction of its angle.
    pub cos: f64,
    pub sin: f64,
    pub omega: f64,
}

impl Turning {
    pub fn new(cage: &Motion, centre: &Motion) -> Self {
        let (sin, cos) = cage.theta.sin_cos();
        Self {
            centre: centre.centre,
            velocity: centre.velocity,
            cos,
            sin,
            omega: cage.omega,
        }
    }

    /// Direction towards the cage's centre of mass where that is off its centre.
    pub fn direction(&self) -> V2 {
        V2::new(self.cos, self.sin)
    }
}

/// A body pressed against a wall of the cage.
pub(super) struct Wall {
    /// Direction from the body to the wall.
    pub normal: V2,
    /// N \[N\], and f along τ \[N\].
    pub force: f64,
    pub friction: f64,
    /// e × n and e·n + R \[m\].
    pub levers: [f64; 2],
    pub energy: f64,
    pub power: f64,
}

/// Spring, damper and friction of a wall.
pub(super) struct Laws {
    pub stiffness: f64,
    pub damping: f64,
    pub depth: f64,
    pub friction: f64,
    pub slip_speed: f64,
}

impl Laws {
    /// Normal force at a depth, whose damper sets in with it.
    #[inline]
    pub fn press(&self, depth: f64, closing: f64) -> f64 {
        let x = (depth / self.depth).min(1.0);
        let share = x * x * (3.0 - 2.0 * x);
        (self.stiffness * depth + self.damping * share * closing).max(0.0)
    }

    #[inline]
    pub fn rub(&self, force: f64, slip: f64) -> f64 {
        let faded = (slip * slip + self.slip_speed * self.slip_speed).sqrt();
        -(self.friction * force) * slip / faded
    }

    pub fn energy(&self, depth: f64) -> f64 {
        0.5 * self.stiffness * depth * depth
    }
}

/// A ball in its pocket.
#[derive(Debug, Clone, Copy)]
pub(super) struct InPocket {
    pub centre: V2,
    pub velocity: V2,
    pub spin: f64,
    pub radius: f64,
}

impl Laws {
    /// Pockets of a cage.
    pub fn of_pockets(cage: &CageModel) -> Self {
        Self {
            stiffness: cage.stiffness,
            damping: cage.damping,
            depth: cage.depth,
            friction: cage.friction,
            slip_speed: cage.slip_speed,
        }
    }
}

/// The direction of a pocket.
#[inline]
pub(super) fn towards(cage: &CageModel, turning: &Turning, pocket: usize) -> V2 {
    let (own, cos, sin) = (cage.pockets[pocket], turning.cos, turning.sin);
    V2::new(cos * own.x - sin * own.y, sin * own.x + cos * own.y)
}

/// Whether a ball at e from the cage's centre, with a pocket towards r, is beyond the clearance; numbers that are none are.
#[inline]
fn reaches(cage: &CageModel, r: V2, e: V2) -> bool {
    let within = match cage.carried {
        Carried::Balls => (e - r * cage.radius).norm_squared() <= cage.clearance * cage.clearance,
        Carried::Held | Carried::Spring(_) | Carried::Land(_) => {
            cage.clearance > 0.0 && cross(r, e).abs() <= cage.clearance
        }
    };
    !within
}

/// Force of a ball on the wall of its pocket; none within the clearance.
#[inline]
pub(super) fn wall(
    cage: &CageModel,
    turning: &Turning,
    pocket: usize,
    ball: &InPocket,
) -> Option<Wall> {
    let (r, e) = (towards(cage, turning, pocket), ball.centre - turning.centre);
    reaches(cage, r, e).then(|| pressed(cage, turning, r, e, ball))
}

/// Force of a ball beyond the clearance.
fn pressed(cage: &CageModel, turning: &Turning, r: V2, e: V2, ball: &InPocket) -> Wall {
    let (mut normal, mut depth) = match cage.carried {
        Carried::Balls => {
            let q = e - r * cage.radius;
            let length = q.norm();
            (q / length, length - cage.clearance)
        }
        Carried::Held | Carried::Spring(_) | Carried::Land(_) => {
            let lead = cross(r, e);
            (
                V2::new(-r.y, r.x) * 1_f64.copysign(lead),
                lead.abs() - cage.clearance,
            )
        }
    };
    let laws = Laws::of_pockets(cage);
    let along = ball.velocity - turning.velocity;
    let mut lever = cross(e, normal);
    let mut closing = along.dot(&normal) - turning.omega * lever;
    let force = if cage.clearance > 0.0 {
        laws.press(depth, closing)
    } else {
        let held = laws.stiffness * depth + laws.damping * closing;
        if held < 0.0 {
            // The wall on the other side presses.
            (normal, depth, lever, closing) = (-normal, -depth, -lever, -closing);
        }
        held.abs()
    };
    let tangent = V2::new(-normal.y, normal.x);
    let arm = e.dot(&normal) + ball.radius;
    let slip = along.dot(&tangent) + ball.radius * ball.spin - turning.omega * arm;
    let friction = laws.rub(force, slip);
    Wall {
        normal,
        force,
        friction,
        levers: [lever, arm],
        energy: laws.energy(depth),
        power: (force - laws.stiffness * depth) * closing - friction * slip,
    }
}

impl Wall {
    /// Force on the body.
    #[inline]
    pub fn on_body(&self) -> V2 {
        let tangent = V2::new(-self.normal.y, self.normal.x);
        tangent * self.friction - self.normal * self.force
    }

    /// Moment on the cage about its centre \[N m\].
    #[inline]
    pub fn on_cage(&self) -> f64 {
        let [lever, arm] = self.levers;
        self.force * lever - self.friction * arm
    }
}
