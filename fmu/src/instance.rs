//! An instance: a simulation between communication steps, the values that were set, and its states.

use std::collections::{BTreeMap, BTreeSet};
use std::panic::resume_unwind;
use std::thread;

use ballrace::bindings::STACK;
use ballrace::dynamics::Dynamics;
use ballrace::inspect::{self, ContactSummary};
use ballrace::integrate::System;
use ballrace::scene::Scene;
use ballrace::{Bandwidth, Race, Result, Run, Simulation, Snapshot};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::checksum::checksum;
use crate::variables::{Role, Source, Table, Variable, direction};

/// Samples a second of the record, which nobody reads: the fewest that the crate takes.
const FS: f64 = 100.0;

/// Share of a communication step by which an importer's clock may differ from ours.
const CLOCK: f64 = 1e-6;

/// A result, or the message of what is refused or has failed.
pub type FmuResult<T> = std::result::Result<T, String>;

/// Phase of an instance's life (section 2.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
enum Phase {
    Instantiated,
    Initialization,
    Step,
    Terminated,
}

impl Phase {
    fn label(self) -> &'static str {
        match self {
            Phase::Instantiated => "before fmi3EnterInitializationMode",
            Phase::Initialization => "in initialization mode",
            Phase::Step => "after fmi3ExitInitializationMode",
            Phase::Terminated => "after fmi3Terminate",
        }
    }
}

/// A simulation between communication steps.
pub struct Instance {
    table: Table,
    phase: Phase,
    /// Values that were set, by their references.
    values: BTreeMap<usize, f64>,
    /// Inputs that the simulation does not know yet.
    new: BTreeSet<usize>,
    /// The importer's time at the simulation's t = 0 \[s\].
    start: f64,
    led: Led,
    simulation: Option<Simulation>,
    answers: Answers,
}

/// How rings whose motions are given were led.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct Led {
    /// Whether any of the rings has been moved.
    moves: bool,
    /// Speeds of the inputs at the beginning of the last step, by the references of their places, and its length \[s\].
    before: Option<(BTreeMap<usize, f64>, f64)>,
}

/// Answers computed of the state where the simulation stands.
#[derive(Default)]
struct Answers {
    /// Rates of all states.
    rates: Option<Vec<f64>>,
    wrenches: [Option<[f64; 6]>; 2],
    contacts: Option<Vec<[ContactSummary; 2]>>,
}

/// A state of an instance: a value, which any instance of the same FMU may take up.
#[derive(Clone, Serialize, Deserialize)]
pub struct State {
    token: String,
    phase: Phase,
    values: BTreeMap<usize, f64>,
    new: BTreeSet<usize>,
    start: f64,
    led: Led,
    snapshot: Option<Snapshot>,
}

impl State {
    /// The state as bytes: a document of JSON behind its checksum.
    pub fn to_bytes(&self) -> FmuResult<Vec<u8>> {
        let document = serde_json::to_vec(self).map_err(|e| e.to_string())?;
        let sum = checksum(document.iter().copied()).to_le_bytes();
        Ok([&sum[..], &document].concat())
    }

    /// The state of such bytes, none of them changed.
    pub fn from_bytes(bytes: &[u8]) -> FmuResult<Self> {
        let split = bytes.split_first_chunk();
        let (sum, document) = split.ok_or("no state of this FMU: shorter than its checksum")?;
        if checksum(document.iter().copied()) != u64::from_le_bytes(*sum) {
            return Err("no state of this FMU, or bytes of it were changed".to_owned());
        }
        serde_json::from_slice(document).map_err(|e| format!("no state of this FMU: {e}"))
    }
}

impl Instance {
    /// The instance of a scene, as text.
    pub fn new(scene: &str, token: &str) -> FmuResult<Self> {
        let table = Scene::from_toml(scene).and_then(Table::of);
        let table = table.map_err(|e| e.to_string())?;
        if table.token != token {
            let expected = &table.token;
            return Err(format!(
                "instantiation token {token:?}: {expected:?} is that of this library and scene"
            ));
        }
        Ok(Self {
            table,
            phase: Phase::Instantiated,
            values: BTreeMap::new(),
            new: BTreeSet::new(),
            start: 0.0,
            led: Led::default(),
            simulation: None,
            answers: Answers::default(),
        })
    }

    /// Resets the instance to what it was when it was made.
    pub fn reset(&mut self) {
        self.phase = Phase::Instantiated;
        self.values.clear();
        self.new.clear();
        self.led = Led::default();
        self.simulation = None;
        self.answers = Answers::default();
    }

    /// Ends a simulation that has been initialised; nothing goes on from here but a reset or another state.
    pub fn terminate(&mut self) -> FmuResult<()> {
        self.expect(Phase::Step, "fmi3Terminate")?;
        self.phase = Phase::Terminated;
        Ok(())
    }

    /// Stays between steps, where an instance without event mode always is once it is initialised.
    pub fn enter_step_mode(&self) -> FmuResult<()> {
        self.expect(Phase::Step, "fmi3EnterStepMode")
    }

    /// Begins to initialise for a time \[s\].
    pub fn enter_initialization(&mut self, start: f64) -> FmuResult<()> {
        self.expect(Phase::Instantiated, "fmi3EnterInitializationMode")?;
        self.start = start;
        self.phase = Phase::Initialization;
        Ok(())
    }

    /// Compiles the scene with its parameters, lets its start settle, and returns doubts about it.
    pub fn exit_initialization(&mut self) -> FmuResult<Vec<String>> {
        self.expect(Phase::Initialization, "fmi3ExitInitializationMode")?;
        let doubts = self.simulation()?.scene().doubts();
        self.phase = Phase::Step;
        Ok(doubts.iter().map(ToString::to_string).collect())
    }

    /// Goes on from a time by a step \[s\].
    pub fn do_step(&mut self, from: f64, step: f64) -> FmuResult<()> {
        self.expect(Phase::Step, "fmi3DoStep")?;
        let (start, simulation) = (self.start, self.simulation()?);
        let now = start + simulation.time();
        let slack = CLOCK * step + 4.0 * f64::EPSILON * now.abs();
        if !(step >= 0.0 && (from - now).abs() <= slack) {
            return Err(format!(
                "a step of {step} s from {from} s: the simulation stands at {now} s"
            ));
        }
        let until = (from - start + step).max(simulation.time());
        if step > 0.0 && self.led.moves {
            self.lead(step, until)?;
        }
        let simulation = self.simulation()?;
        let done = simulation.advance_to(until);
        // Nobody reads the record.
        simulation.take_block();
        self.answers = Answers::default();
        done.map_err(|e| e.to_string())
    }

    /// Leads rings whose motions are given over a step, to where their places and speeds at its beginning point: with the acceleration
    /// since the step before, as far as there was one.
    fn lead(&mut self, step: f64, until: f64) -> FmuResult<()> {
        let value = |at: usize| self.values.get(&at).copied();
        let places = self.table.list.iter().enumerate();
        let places = places.filter_map(|(at, variable)| match &variable.source {
            Source::Field {
                path,
                start,
                role: Role::Place,
            } => Some((at, path.clone(), *start)),
            _ => None,
        });
        let mut rates = BTreeMap::new();
        let mut motions = Vec::new();
        for (at, path, start) in places {
            let (place, rate) = (value(at).unwrap_or(start), value(at + 1).unwrap_or(0.0));
            let before = self.led.before.as_ref();
            let since = before.and_then(|(rates, step)| Some((rate - rates.get(&at)?) / step));
            let faster = since.unwrap_or(0.0) * step;
            motions.push((path, [place + step * (rate + 0.5 * faster), rate + faster]));
            rates.insert(at, rate);
        }
        let motions: Vec<_> = motions
            .iter()
            .map(|(path, to)| (path.as_str(), *to))
            .collect();
        let simulation = self.simulation()?;
        simulation
            .set_motions(&motions, until)
            .map_err(|e| e.to_string())?;
        self.led.before = Some((rates, step));
        Ok(())
    }

    /// The importer's time \[s\].
    pub fn time(&self) -> f64 {
        self.start + self.simulation.as_ref().map_or(0.0, Simulation::time)
    }

    /// A variable by its reference.
    pub fn variable(&self, reference: u32) -> FmuResult<&Variable> {
        let found = self.table.list.get(reference as usize);
        found.ok_or_else(|| format!("no variable has the value reference {reference}"))
    }

    /// Sets an input or a parameter.
    pub fn set(&mut self, reference: u32, value: f64) -> FmuResult<()> {
        let variable = self.variable(reference)?;
        let (start, leads, is_rate) = match &variable.source {
            Source::Field { start, role, .. } => (*start, *role == Role::Place, false),
            Source::Rate => (0.0, true, true),
            _ => return Err(format!("{} is neither input nor parameter", variable.name)),
        };
        if !value.is_finite() {
            return Err(format!("{} = {value}: a finite number", variable.name));
        }
        if self.phase == Phase::Terminated {
            return Err("nothing can be set after fmi3Terminate".to_owned());
        }
        let reference = reference as usize;
        let before = self.values.get(&reference).copied().unwrap_or(start);
        if before.to_bits() == value.to_bits() {
            return Ok(());
        }
        self.values.insert(reference, value);
        match self.phase {
            Phase::Step if leads => self.led.moves = true,
            Phase::Step => {
                self.new.insert(reference);
            }
            // At the start a ring stands where it is given to be, whatever its speed will be.
            _ if is_rate => self.led.moves = true,
            _ => self.simulation = None,
        }
        self.answers = Answers::default();
        Ok(())
    }

    /// Appends the numbers of a variable.
    pub fn get(&mut self, reference: u32, values: &mut Vec<f64>) -> FmuResult<()> {
        let time = self.time();
        match &self.variable(reference)?.source {
            Source::Time => values.push(time),
            Source::Field { start, .. } => {
                values.push(*self.values.get(&(reference as usize)).unwrap_or(start));
            }
            Source::Rate => {
                values.push(*self.values.get(&(reference as usize)).unwrap_or(&0.0));
            }
            Source::Motion(body, component) => {
                let (body, component) = (*body, *component);
                let layout = self.simulation()?.model().layout();
                let speed = layout.speed_at(body, direction(component));
                values.push(match component.derivative() {
                    0 => self.simulation()?.state()[layout.at(body, direction(component))],
                    1 => self.simulation()?.state()[speed],
                    _ => self.rates()?[speed],
                });
            }
            Source::Wrench(race, part) => {
                let (race, part) = (*race, *part);
                values.push(self.wrench(race)?[part]);
            }
            Source::Sensor(sensor, axis) => {
                let (sensor, axis) = (sensor.clone(), *axis);
                let rates = self.rates()?.to_vec();
                let found =
                    inspect::sensor_acceleration(self.simulation()?.model(), &rates, &sensor);
                values.push(found.map_err(|e| e.to_string())?[axis]);
            }
            Source::Seat(axis) => {
                let axis = *axis;
                let simulation = self.simulation()?;
                let force = inspect::seat_force(simulation.model(), simulation.state());
                values.push(force.map_err(|e| e.to_string())?[axis]);
            }
            Source::Loads(race, balls) => {
                let (race, balls) = (*race, balls.clone());
                let contacts = &self.contacts()?[balls];
                values.extend(contacts.iter().map(|of| of[race].load));
            }
        }
        Ok(())
    }

    fn rates(&mut self) -> FmuResult<&[f64]> {
        let rates = match self.answers.rates.take() {
            Some(known) => known,
            None => rates(self.simulation()?),
        };
        Ok(self.answers.rates.insert(rates))
    }

    fn wrench(&mut self, race: Race) -> FmuResult<[f64; 6]> {
        let wrench = match self.answers.wrenches[race] {
            Some(known) => known,
            None => self.simulation()?.wrench(race.into()),
        };
        self.answers.wrenches[race] = Some(wrench);
        Ok(wrench)
    }

    fn contacts(&mut self) -> FmuResult<&[[ContactSummary; 2]]> {
        let contacts = match self.answers.contacts.take() {
            Some(known) => known,
            None => self.simulation()?.contacts(),
        };
        Ok(self.answers.contacts.insert(contacts))
    }

    /// The simulation with all values that were set; begins it where it has not.
    fn simulation(&mut self) -> FmuResult<&mut Simulation> {
        if self.phase == Phase::Instantiated {
            return Err("before fmi3EnterInitializationMode there is no state".to_owned());
        }
        if self.simulation.is_none() {
            let begun = begin(&self.table.scene, &self.changes(self.values.keys()));
            self.simulation = Some(begun.map_err(|e| e.to_string())?);
        }
        if !self.new.is_empty() {
            let changes = self.changes(&self.new);
            if let Some(simulation) = &mut self.simulation {
                // Refused values leave it as it was.
                take_up(simulation, &changes).map_err(|e| e.to_string())?;
            }
            self.new.clear();
        }
        self.simulation
            .as_mut()
            .ok_or_else(|| "no simulation".to_owned())
    }

    /// Values that were set, as changes of the scene.
    fn changes<'a>(&self, of: impl IntoIterator<Item = &'a usize>) -> Vec<Change> {
        let change = |at: &usize| match &self.table.list[*at].source {
            Source::Field { path, role, .. } => Some(Change {
                path: path.clone(),
                role: *role,
                value: self.values[at],
            }),
            _ => None,
        };
        of.into_iter().filter_map(change).collect()
    }

    /// State of the instance.
    pub fn state(&mut self) -> State {
        State {
            token: self.table.token.clone(),
            phase: self.phase,
            values: self.values.clone(),
            new: self.new.clone(),
            start: self.start,
            led: self.led.clone(),
            snapshot: self.simulation.as_mut().map(Simulation::snapshot),
        }
    }

    /// Takes up a state.
    pub fn set_state(&mut self, state: &State) -> FmuResult<()> {
        if state.token != self.table.token {
            return Err("a state of another FMU".to_owned());
        }
        let restored = state.snapshot.as_ref();
        let restored = restored.map(|of| apart(|| Simulation::restore(of)));
        self.simulation = restored.transpose().map_err(|e| e.to_string())?;
        (self.phase, self.start) = (state.phase, state.start);
        self.values.clone_from(&state.values);
        self.new.clone_from(&state.new);
        self.led.clone_from(&state.led);
        self.answers = Answers::default();
        Ok(())
    }

    fn expect(&self, phase: Phase, function: &str) -> FmuResult<()> {
        if self.phase == phase {
            return Ok(());
        }
        let phase = self.phase.label();
        Err(format!("{function} may not be called {phase}"))
    }
}

/// A field of the scene with the value that it is given.
struct Change {
    path: String,
    role: Role,
    value: f64,
}

fn fields(changes: &[Change]) -> Vec<(&str, Value)> {
    let each = changes.iter();
    each.map(|of| (of.path.as_str(), of.value.into())).collect()
}

/// A simulation from t = 0.
fn begin(scene: &Scene, changes: &[Change]) -> Result<Simulation> {
    let run = Run {
        duration: Run::OPEN,
        fs: FS,
        bandwidth: Bandwidth::Raw,
        ..Run::default()
    };
    let scene = scene.with(&fields(changes))?;
    apart(|| Simulation::begin(&scene, &run))
}

/// Gives a simulation new values: loads alone without compiling.
fn take_up(simulation: &mut Simulation, changes: &[Change]) -> Result<()> {
    if changes.iter().all(|of| of.role == Role::Load) {
        let loads = changes.iter().map(|of| (of.path.as_str(), of.value));
        return simulation.set_loads(&loads.collect::<Vec<_>>());
    }
    apart(|| simulation.change(&fields(changes)))
}

/// Rates of all states where a simulation stands.
fn rates(simulation: &Simulation) -> Vec<f64> {
    let (t, y) = (simulation.time(), simulation.state());
    let mut rates = vec![0.0; y.len()];
    Dynamics::new(simulation.model()).rhs(t, y, &mut rates);
    rates
}

/// Compiles on a thread with a stack that is large enough, whatever thread the importer calls from.
fn apart<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    thread::scope(|scope| {
        let builder = thread::Builder::new().stack_size(STACK);
        let spawned = builder.spawn_scoped(scope, work).expect("a thread");
        spawned.join().unwrap_or_else(|panic| resume_unwind(panic))
    })
}
