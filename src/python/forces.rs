//! Forces on rings by callables of Python: called from the thread that works, one call an evaluation.

use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;

use ballrace::scene::{RingForce, RingMotion, RingName};
use ballrace::{Interrupt, Scene};

/// A force as it is passed: its name, ring, callable, bounds of stiffness \[N/m\] and damping \[N s/m\], the largest forces in the plane
/// and along z \[N\], and whether it stays in the plane.
pub(super) type Passed = (String, String, Py<PyAny>, f64, f64, [f64; 2], bool);

/// The first exception of any of a run's forces, which stops it.
#[derive(Debug, Clone, Default)]
pub(super) struct Raised(Arc<Mutex<First>>);

#[derive(Debug, Default)]
struct First {
    exception: Option<PyErr>,
    stop: Interrupt,
}

impl Raised {
    /// Gives a scene its forces by code.
    pub fn of_forces(scene: &mut Scene, forces: Vec<Passed>) -> Self {
        let raised = Self::default();
        for (name, ring, callable, stiffness, damping, peak, keeps_plane) in forces {
            let ring = if ring == "outer" {
                RingName::Outer
            } else {
                RingName::Inner
            };
            let called = Called {
                callable,
                ring,
                bounds: [stiffness, damping],
                peak,
                keeps_plane,
                raised: raised.clone(),
            };
            scene.ring_forces.insert(name, Arc::new(called));
        }
        raised
    }

    /// Interrupt by which work is stopped after an exception.
    pub fn stop(&self) -> Interrupt {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        first.stop = Interrupt::new();
        if first.exception.is_some() {
            first.stop.set();
        }
        first.stop.clone()
    }

    /// The exception, where there is one, before what came of the work.
    pub fn before<T>(&self, py: Python<'_>, result: PyResult<T>) -> PyResult<T> {
        let first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match &first.exception {
            Some(exception) => Err(exception.clone_ref(py)),
            None => result,
        }
    }

    fn is_set(&self) -> bool {
        let first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        first.exception.is_some()
    }

    fn keep(&self, exception: PyErr) {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        first.exception.get_or_insert(exception);
        first.stop.set();
    }
}

/// A force by a callable of time, place, angles, velocity and rates that returns six numbers.
#[derive(Debug)]
struct Called {
    callable: Py<PyAny>,
    ring: RingName,
    bounds: [f64; 2],
    peak: [f64; 2],
    keeps_plane: bool,
    raised: Raised,
}

impl RingForce for Called {
    fn ring(&self) -> RingName {
        self.ring
    }

    fn wrench(&self, t: f64, ring: &RingMotion) -> [f64; 6] {
        // Evaluations until the run ends are not used.
        if self.raised.is_set() {
            return [0.0; 6];
        }
        let motion = (t, ring.place, ring.angles, ring.velocity, ring.rates);
        let found = Python::attach(|py| self.callable.call1(py, motion)?.extract(py));
        found.unwrap_or_else(|exception| {
            self.raised.keep(exception);
            [0.0; 6]
        })
    }

    fn stiffness(&self) -> f64 {
        self.bounds[0]
    }

    fn damping(&self) -> f64 {
        self.bounds[1]
    }

    fn peak(&self) -> [f64; 2] {
        self.peak
    }

    fn keeps_plane(&self) -> bool {
        self.keeps_plane
    }
}
