//! Loads and moments compiled, and a model under other loads.

use nalgebra::Vector3;

use super::given::GivenMotions;
use super::{Model, Race, RingModel};
use crate::scene::{Moment, Scene, TimeFunction};

/// A load compiled.
#[derive(Debug, Clone)]
pub(crate) struct LoadModel {
    pub ring: Race,
    pub direction: [f64; 3],
    pub force: TimeFunction,
    /// Place at which the load acts, from the ring's centre of mass in its frame \[m\]; none at the ring's origin where that is all there is.
    pub arm: Option<Vector3<f64>>,
}

/// A moment compiled.
#[derive(Debug, Clone)]
pub(crate) struct MomentModel {
    pub ring: Race,
    pub direction: [f64; 3],
    pub moment: TimeFunction,
}

impl Model {
    /// The same bearing with the sizes of loads, moments and drive and the given motions of a scene that differs in nothing else. Scales, films and what
    /// follows from loads at rest stay those of the loads that it was compiled with.
    #[must_use]
    pub(crate) fn loaded(&self, scene: &Scene) -> Self {
        let mut model = self.clone();
        model.scene.loads.clone_from(&scene.loads);
        model.scene.moments.clone_from(&scene.moments);
        model.scene.drive.clone_from(&scene.drive);
        for (race, ring) in [
            (Race::Outer, &scene.outer_ring),
            (Race::Inner, &scene.inner_ring),
        ] {
            model.rings[race].given = GivenMotions::new(ring);
        }
        model.scene.outer_ring.clone_from(&scene.outer_ring);
        model.scene.inner_ring.clone_from(&scene.inner_ring);
        model.loads = loads(scene, &model.rings);
        model.moments = moments(scene);
        model
    }
}

/// The loads of a scene.
pub(super) fn loads(scene: &Scene, rings: &[RingModel; 2]) -> Vec<LoadModel> {
    scene
        .loads
        .values()
        .map(|load| {
            let ring = &rings[Race::from(load.ring)];
            let at = load.at.unwrap_or_default();
            let is_off = at != [0.0; 3] || ring.centre_of_mass != 0.0;
            LoadModel {
                ring: load.ring.into(),
                direction: unit(load.direction),
                force: load.force.clone(),
                arm: is_off.then(|| ring.arm(at)),
            }
        })
        .collect()
}

/// The moments of a scene.
pub(super) fn moments(scene: &Scene) -> Vec<MomentModel> {
    let moments = scene.moments.values();
    let of = |moment: &Moment| MomentModel {
        ring: moment.ring.into(),
        direction: unit(moment.direction),
        moment: moment.moment.clone(),
    };
    moments.map(of).collect()
}

fn unit(direction: [f64; 3]) -> [f64; 3] {
    let size = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    direction.map(|x| x / size)
}
