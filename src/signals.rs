//! Probes read on a uniform grid from the dense output.

use serde::Serialize;

use crate::accuracy::Accuracy;
use crate::dynamics::{CONTRIBUTIONS, Dynamics, Energy};
use crate::integrate::{DenseStep, System};
use crate::model::{Model, Omission};
use crate::residual::Residual;
use crate::scene::{Component, ContactQuantity, Probe, RingName, Scene};

/// What a run gives.
#[derive(Debug, Clone)]
pub struct Signals {
    /// Sampling rate \[Hz\].
    pub fs: f64,
    /// Times k / fs from 0, the duration itself excluded \[s\].
    pub t: Vec<f64>,
    /// The signals, each as long as `t`.
    pub columns: Vec<Column>,
    /// Forces of single slices at the times that probes asked for.
    pub slices: Vec<SliceRow>,
    /// Effort of the integrator.
    pub stats: Statistics,
    /// What produced the signals.
    pub provenance: Provenance,
    /// The scene.
    pub scene: Scene,
}

impl Signals {
    /// The values of a column by its name, such as `outer.ay`.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.columns
            .iter()
            .find(|column| column.name == name)
            .map(|column| column.values.as_slice())
    }
}

/// Effort and mishaps of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Statistics {
    /// Steps accepted.
    pub accepted: usize,
    /// Steps rejected.
    pub rejected: usize,
    /// Evaluations of the right-hand side by the integrator; sampling adds one a sample.
    pub nfev: usize,
    /// Iterations of implicit stages; 0 for an explicit method.
    pub iterations: usize,
    /// Smallest accepted step \[s\], not counting steps shortened to land on a breakpoint; absent without any.
    pub smallest_step: Option<f64>,
    /// Where it began \[s\].
    pub smallest_step_time: Option<f64>,
    /// Largest accepted step \[s\].
    pub largest_step: f64,
    /// Share of the accepted steps at the stability limit (stiffness quotient above 3.25), 0 to 1.
    pub stiff_share: f64,
    /// Share of the accepted steps that were implicit in velocities, 0 to 1.
    pub implicit_share: f64,
    /// Share of the accepted steps that the step cap limited, 0 to 1.
    pub capped_share: f64,
    /// Slices at accepted steps whose damping wanted to pull and was clamped.
    pub clamped_pulls: usize,
    /// Contacts at accepted steps that reached beyond a shoulder.
    pub truncated_contacts: usize,
    /// Relative difference (root mean square over the samples) between the recorded accelerations of the outer ring,
    /// or of the inner one where that is held, and the derivative of its recorded velocities; absent without
    /// accelerations. A measure of their error: above 0.05 is warned of. Below 0.2 m/s² relative to that.
    pub acceleration_residual: Option<f64>,
    /// Wall time of the integration \[s\].
    pub wall_time: f64,
    /// Share of their orbit rate that the balls lost in a run in which nothing drives them, for want of friction; absent in
    /// any other. Above 0.005 is warned of.
    pub orbit_slowed: Option<f64>,
}

/// What produced the signals.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Provenance {
    /// Version of this crate.
    pub version: &'static str,
    /// Version of the scene document.
    pub schema: u32,
    /// Method; after `auto: ` the methods that were chosen, in their order.
    pub method: String,
    /// Largest stiffness quotient that `auto` met: rate of friction times step cap over the explicit method's
    /// limit; absent for any other method.
    pub stiffness: Option<f64>,
    /// Relative tolerance.
    pub rtol: f64,
    /// What a requested accuracy chose, where one was.
    pub accuracy: Option<Accuracy>,
    /// Step cap \[s\]; absent: none.
    pub max_step: Option<f64>,
    /// How it began.
    pub start: &'static str,
    /// Simulated time \[s\].
    pub duration: f64,
    /// Threads used.
    pub threads: usize,
    /// States that were integrated.
    pub states: usize,
    /// What was left out since it does not change the motion.
    pub left_out: Vec<Omission>,
    /// Level of vector instructions.
    pub simd: &'static str,
    /// Processor architecture.
    pub architecture: &'static str,
}

/// One signal.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// `<probe>.<quantity>`.
    pub name: String,
    /// Unit, such as `m/s^2`.
    pub unit: &'static str,
    /// A value a sample.
    pub values: Vec<f64>,
}

/// The force of one slice at one time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SliceRow {
    /// The probe that asked.
    pub probe: String,
    /// Time \[s\].
    pub time: f64,
    /// Row, from 0.
    pub row: usize,
    /// Ball of the row, from 0.
    pub ball: usize,
    /// The race.
    pub race: RingName,
    /// Place of the slice along the ball \[m\].
    pub zeta: f64,
    /// Axial place in the ring's frame \[m\].
    pub z: f64,
    /// Width of the slice \[m\].
    pub width: f64,
    /// Penetration \[m\].
    pub penetration: f64,
    /// Normal force \[N\].
    pub force: f64,
}

/// A probe with its indices looked up.
enum Reader {
    Motion {
        body: usize,
        components: Vec<Component>,
    },
    Contacts {
        contacts: Vec<(usize, usize)>,
        quantities: Vec<ContactQuantity>,
    },
    Cage {
        row: usize,
    },
    Energy,
    Torque,
    Forces {
        body: usize,
    },
}

/// Slices to list at a time.
struct Listing {
    probe: String,
    time: f64,
    contacts: Vec<(usize, usize)>,
}

/// Reads the probes of a scene along a run.
pub(crate) struct Recorder {
    fs: f64,
    count: usize,
    readers: Vec<Reader>,
    listings: Vec<Listing>,
    needs_rhs: bool,
    /// The run's own states at a sample, and their rates.
    own: (Vec<f64>, Vec<f64>),
    /// Those of all bodies.
    y: Vec<f64>,
    dy: Vec<f64>,
    values: Vec<f64>,
    pub residual: Residual,
    pub t: Vec<f64>,
    pub columns: Vec<Column>,
    pub slices: Vec<SliceRow>,
}

impl Recorder {
    /// For `count` samples at `fs`.
    pub fn new(model: &Model, fs: f64, count: usize) -> Self {
        let mut recorder = Self {
            fs,
            count,
            readers: Vec::new(),
            listings: Vec::new(),
            needs_rhs: false,
            own: (Vec::new(), Vec::new()),
            y: Vec::new(),
            dy: Vec::new(),
            values: Vec::new(),
            residual: Residual::default(),
            t: Vec::new(),
            columns: Vec::new(),
            slices: Vec::new(),
        };
        let outer = Probe::Motion {
            body: "outer".to_owned(),
            components: None,
        };
        if model.scene.probes.is_empty() {
            recorder.add(model, "outer", &outer);
        }
        for (name, probe) in &model.scene.probes {
            recorder.add(model, name, probe);
        }
        recorder.listings.sort_by(|a, b| b.time.total_cmp(&a.time));
        recorder
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// Sets memory aside for all samples of a run from a state of all bodies.
    pub fn prepare(&mut self, dynamics: &Dynamics<'_>, start: &[f64]) {
        let zeros = vec![0.0; dynamics.dim()];
        self.own = (zeros.clone(), zeros);
        (self.y, self.dy) = (start.to_vec(), vec![0.0; start.len()]);
        self.residual = Residual::new(dynamics);
        self.t.reserve_exact(self.count);
        for column in &mut self.columns {
            column.values.reserve_exact(self.count);
        }
    }

    fn add(&mut self, model: &Model, name: &str, probe: &Probe) {
        // Validation has made sure that bodies exist.
        let body_of = |body: &str| model.scene.body_index(body).unwrap_or(0);
        let reader = match probe {
            Probe::Motion { body, components } => {
                let components = components
                    .clone()
                    .unwrap_or_else(|| Component::ALL.to_vec());
                for component in &components {
                    let (label, unit) = component.label();
                    self.column(format!("{name}.{label}"), unit);
                    self.needs_rhs |= *component as usize >= 8;
                }
                Reader::Motion {
                    body: body_of(body),
                    components,
                }
            }
            Probe::Contacts {
                row,
                balls,
                races,
                quantities,
            } => {
                let contacts = contacts(model, *row, balls.as_deref(), races.as_deref());
                let quantities = quantities
                    .clone()
                    .unwrap_or_else(|| ContactQuantity::ALL.to_vec());
                for (j, race) in &contacts {
                    let ball = model.balls[*j].index;
                    for quantity in &quantities {
                        let (label, unit) = quantity.label();
                        let race = ["outer", "inner"][*race];
                        self.column(format!("{name}.ball{ball}.{race}.{label}"), unit);
                    }
                }
                Reader::Contacts {
                    contacts,
                    quantities,
                }
            }
            Probe::Cage { row } => {
                if model.scene.cage.is_some() {
                    for link in 0..model.rows[*row].links().count() {
                        self.column(format!("{name}.link{link}"), "N");
                    }
                }
                Reader::Cage { row: *row }
            }
            Probe::Energy {} => {
                for (label, unit, _) in Energy::default().entries() {
                    self.column(format!("{name}.{label}"), unit);
                }
                Reader::Energy
            }
            Probe::Torque {} => {
                for ring in ["outer", "inner"] {
                    self.column(format!("{name}.{ring}"), "N m");
                }
                self.needs_rhs = true;
                Reader::Torque
            }
            Probe::Forces { body } => {
                for part in CONTRIBUTIONS {
                    for (direction, unit) in [("x", "N"), ("y", "N"), ("z", "N"), ("theta", "N m")]
                    {
                        self.column(format!("{name}.{part}.{direction}"), unit);
                    }
                }
                Reader::Forces {
                    body: body_of(body),
                }
            }
            Probe::Slices {
                row,
                balls,
                races,
                times,
            } => {
                let contacts = contacts(model, *row, balls.as_deref(), races.as_deref());
                self.listings.extend(times.iter().map(|&time| Listing {
                    probe: name.to_owned(),
                    time,
                    contacts: contacts.clone(),
                }));
                return;
            }
        };
        self.readers.push(reader);
    }

    fn column(&mut self, name: String, unit: &'static str) {
        self.columns.push(Column {
            name,
            unit,
            values: Vec::new(),
        });
    }

    /// The run's states at t = 0.
    pub fn first(&mut self, dynamics: &mut Dynamics<'_>, y: &[f64]) {
        self.own.0.copy_from_slice(y);
        self.sample(dynamics, 0.0);
        self.list(dynamics, 0.0, |_, _| {});
    }

    /// All samples within an accepted step.
    pub fn step(&mut self, dynamics: &mut Dynamics<'_>, step: &DenseStep<'_>) {
        while self.t.len() < self.count {
            let t = self.t.len() as f64 / self.fs;
            if t > step.t1() {
                break;
            }
            step.interpolate(t, &mut self.own.0);
            self.sample(dynamics, t);
            if self.needs_rhs {
                self.residual.add(step, t, &self.own.1);
            }
        }
        self.list(dynamics, step.t1(), |t, y| step.interpolate(t, y));
    }

    /// The accelerations are the model's at the interpolated state.
    fn sample(&mut self, dynamics: &mut Dynamics<'_>, t: f64) {
        let (y, dy) = &mut self.own;
        dynamics.expand(t, y, &mut self.y);
        if self.needs_rhs {
            dynamics.rhs(t, y, dy);
            dynamics.expand_rates(t, y, dy, &mut self.dy);
        }
        self.values.clear();
        for reader in &self.readers {
            reader.read(dynamics, t, &self.y, &self.dy, &mut self.values);
        }
        self.t.push(t);
        for (column, value) in self.columns.iter_mut().zip(&self.values) {
            column.values.push(*value);
        }
    }

    fn list(&mut self, dynamics: &Dynamics<'_>, until: f64, interpolate: impl Fn(f64, &mut [f64])) {
        let model = dynamics.model();
        while let Some(listing) = self.listings.pop_if(|listing| listing.time <= until) {
            interpolate(listing.time, &mut self.own.0);
            dynamics.expand(listing.time, &self.own.0, &mut self.y);
            for (j, race) in listing.contacts {
                let ball = &model.balls[j];
                for slice in model.slice_forces(&self.y, j, race) {
                    self.slices.push(SliceRow {
                        probe: listing.probe.clone(),
                        time: listing.time,
                        row: ball.row,
                        ball: ball.index,
                        race: if race == 0 {
                            RingName::Outer
                        } else {
                            RingName::Inner
                        },
                        zeta: slice.zeta,
                        z: slice.z,
                        width: slice.width,
                        penetration: slice.penetration,
                        force: slice.force,
                    });
                }
            }
        }
    }
}

impl Reader {
    /// Pushes one value a column.
    fn read(&self, dynamics: &Dynamics<'_>, t: f64, y: &[f64], dy: &[f64], values: &mut Vec<f64>) {
        let model = dynamics.model();
        let half = y.len() / 2;
        match self {
            Self::Motion { body, components } => {
                values.extend(components.iter().map(|component| {
                    let i = *component as usize;
                    let at = 4 * body + i % 4;
                    match i / 4 {
                        0 => y[at],
                        1 => y[half + at],
                        _ => dy[half + at],
                    }
                }));
            }
            Self::Contacts {
                contacts,
                quantities,
            } => {
                for (j, race) in contacts {
                    let contact = model.contact(y, *j, *race);
                    values.extend(quantities.iter().map(|quantity| match quantity {
                        ContactQuantity::Load => contact.load,
                        ContactQuantity::Angle => contact.angle,
                        ContactQuantity::ZoneCentre => contact.zone_centre,
                        ContactQuantity::ZoneWidth => contact.zone_width,
                        ContactQuantity::Slip => contact.slip,
                    }));
                }
            }
            Self::Cage { row } => values.extend(model.cage_forces(y, *row)),
            Self::Energy => values.extend(model.energy(y).entries().map(|(_, _, value)| value)),
            Self::Torque => values.extend(dynamics.ring_torques()),
            Self::Forces { body } => {
                for (_, forces) in Dynamics::contributions(model, t, y) {
                    values.extend(&forces[4 * body..4 * body + 4]);
                }
            }
        }
    }
}

/// Pairs (ball among all balls, race), ball by ball.
fn contacts(
    model: &Model,
    row: usize,
    balls: Option<&[usize]>,
    races: Option<&[RingName]>,
) -> Vec<(usize, usize)> {
    let compiled = &model.rows[row];
    let all: Vec<usize> = (0..compiled.count).collect();
    let races = races.unwrap_or(&[RingName::Outer, RingName::Inner]);
    balls
        .unwrap_or(&all)
        .iter()
        .flat_map(|ball| {
            races
                .iter()
                .map(move |race| (compiled.first + ball, *race as usize))
        })
        .collect()
}
