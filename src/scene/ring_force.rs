//! Forces on rings computed by the caller's code: magnetic pull, seals, squeeze films and others from outside of the bearing.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::sync::Arc;

use serde::{Serialize, Serializer};

use super::RingName;

/// Place and motion of a ring, in the scene's frame.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct RingMotion {
    /// Centre of mass \[m\].
    pub place: [f64; 3],
    /// Tilt about x and y, 0 where the ring stays parallel, and angle about its axis \[rad\].
    pub angles: [f64; 3],
    /// Velocity of the centre of mass \[m/s\].
    pub velocity: [f64; 3],
    /// Rates of the angles \[rad/s\].
    pub rates: [f64; 3],
}

/// A force on a ring that depends on time and on the ring's motion.
///
/// Runs, their start, equilibria, stiffness, energies and explanations include it like every force of the scene. It is added to
/// [`crate::Scene::ring_forces`].
///
/// ```
/// use std::sync::Arc;
/// use ballrace::equilibrium;
/// use ballrace::scene::{Mount, RingForce, RingMotion, RingName, presets};
///
/// /// Unbalanced magnetic pull along y: it grows with the displacement and softens the mount.
/// #[derive(Debug)]
/// struct Pull {
///     stiffness: f64, // N/m
/// }
///
/// impl RingForce for Pull {
///     fn ring(&self) -> RingName {
///         RingName::Outer
///     }
///
///     fn wrench(&self, _t: f64, ring: &RingMotion) -> [f64; 6] {
///         [0.0, self.stiffness * ring.place[1], 0.0, 0.0, 0.0, 0.0]
///     }
///
///     // For the length of a run's steps.
///     fn stiffness(&self) -> f64 {
///         self.stiffness
///     }
///
///     // A run may stay in the plane of the bearing.
///     fn keeps_plane(&self) -> bool {
///         true
///     }
/// }
///
/// let mut scene = presets::deep_groove_6205(800.0, 0.0, 1800.0);
/// scene.gravity = [0.0; 3];
/// scene.outer_ring.support.y = Some(Mount::Spring { stiffness: 3e7, damping: 300.0 });
/// scene.ring_forces.insert("pull", Arc::new(Pull { stiffness: 1e7 }));
/// let sunk = equilibrium(&scene)?.outer[1];
/// // F/(k − k_m), but for a part in a thousand along the orbit, which the cage holds.
/// assert!((sunk / (-800.0 / 2e7) - 1.0).abs() < 2e-3);
/// # Ok::<(), ballrace::Error>(())
/// ```
pub trait RingForce: Debug + Send + Sync {
    /// The ring it acts on.
    fn ring(&self) -> RingName;

    /// Force on the ring's centre of mass along x, y and z \[N\] and moment about it \[N m\], in the scene's frame, at a time \[s\].
    /// Moments about x and y have an effect where the ring may tilt. It has to be finite, and smooth in time and motion except at a
    /// few places.
    fn wrench(&self, t: f64, ring: &RingMotion) -> [f64; 6];

    /// Upper bound of its stiffness, which limits a run's step \[N/m\]; a moment counts as a force at half of the pitch diameter.
    fn stiffness(&self) -> f64 {
        0.0
    }

    /// Upper bound of its damping \[N s/m\], likewise.
    fn damping(&self) -> f64 {
        0.0
    }

    /// The energy that it stores \[J\], counted among that of supports.
    fn energy(&self, _ring: &RingMotion) -> f64 {
        0.0
    }

    /// Largest force in the plane of x and y, and along z \[N\], from which scales of the contacts are estimated.
    fn peak(&self) -> [f64; 2] {
        [0.0; 2]
    }

    /// Whether the force neither acts along z nor tilts the ring, so that a run may leave these directions out.
    fn keeps_plane(&self) -> bool {
        false
    }
}

/// Forces on rings by name, each with code of its own.
///
/// A scene is written with their names only. Such a document is refused when it is read; add forces to a scene after reading it.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct RingForces(BTreeMap<String, Arc<dyn RingForce>>);

impl RingForces {
    /// Adds a force, or replaces the one of this name.
    pub fn insert(&mut self, name: impl Into<String>, force: Arc<dyn RingForce>) {
        self.0.insert(name.into(), force);
    }

    /// The same as they are at t = 0, at any time.
    pub(crate) fn frozen(&self) -> Self {
        let still = |of: &Arc<dyn RingForce>| Arc::new(Frozen(Arc::clone(of)));
        let each = self.0.iter();
        Self(
            each.map(|(name, of)| (name.clone(), still(of) as _))
                .collect(),
        )
    }

    /// Whether there is no force.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Names and forces, in the order of the names.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &dyn RingForce)> {
        let each = self.0.iter();
        each.map(|(name, force)| (name.as_str(), force.as_ref()))
    }
}

/// A force as it is at t = 0.
#[derive(Debug)]
struct Frozen(Arc<dyn RingForce>);

impl RingForce for Frozen {
    fn ring(&self) -> RingName {
        self.0.ring()
    }

    fn wrench(&self, _: f64, ring: &RingMotion) -> [f64; 6] {
        self.0.wrench(0.0, ring)
    }

    fn stiffness(&self) -> f64 {
        self.0.stiffness()
    }

    fn damping(&self) -> f64 {
        self.0.damping()
    }

    fn energy(&self, ring: &RingMotion) -> f64 {
        self.0.energy(ring)
    }

    fn peak(&self) -> [f64; 2] {
        self.0.peak()
    }

    fn keeps_plane(&self) -> bool {
        self.0.keeps_plane()
    }
}

/// Equal are the same forces (by pointer), not ones that act alike.
impl PartialEq for RingForces {
    fn eq(&self, other: &Self) -> bool {
        let mut both = self.0.iter().zip(&other.0);
        self.0.len() == other.0.len()
            && both.all(|((name, force), (named, of))| name == named && Arc::ptr_eq(force, of))
    }
}

impl Serialize for RingForces {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.keys())
    }
}
