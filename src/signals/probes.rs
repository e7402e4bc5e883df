//! The probes of a scene with their indices looked up, and how their columns are sampled.

use nalgebra::Vector3;

use super::Column;
use super::filter::SampleKind;
use crate::base::error::Result;
use crate::dynamics::{Dynamics, contribution_names, contributions_with_films};
use crate::forces::cage::ring::carrier;
use crate::inspect::{self, Energy, Lubrication, MOMENTS};
use crate::model::{BodyId, Dof, Model, Race, StructureModel};
use crate::scene::{Component, ContactQuantity, Probe, RingName, Scene, Slices, Structure};
use crate::statics::compile;

/// Names and units of what a scene records.
///
/// # Errors
/// [`crate::Error::Scene`] for a scene that is not usable.
pub(crate) fn columns(scene: &Scene) -> Result<Vec<Column>> {
    scene.validate()?;
    // What is recorded depends neither on defects, nor on how contacts are cut, which may take seconds.
    let mut plain = scene.clone();
    plain.defects.clear();
    plain.contact.slices = Slices::Fitted(2);
    Ok(Probes::new(&compile(&plain)?).columns)
}

/// A probe with its indices looked up.
pub(super) enum ProbeReader {
    Motion {
        body: BodyId,
        components: Vec<Component>,
    },
    Contacts {
        contacts: Vec<(usize, Race)>,
        quantities: Vec<ContactQuantity>,
    },
    Cage {
        row: usize,
    },
    Structure {
        /// Shapes of each sensor, mode by mode.
        sensors: Vec<Vec<Vector3<f64>>>,
    },
    Seat,
    Energy,
    Torque,
    Moments,
    Lubrication {
        row: usize,
    },
    Forces {
        body: BodyId,
    },
}

/// Slices to list at a time.
pub(super) struct Listing {
    pub probe: String,
    pub time: f64,
    pub contacts: Vec<(usize, Race)>,
}

/// Readers of all probes of a scene.
#[derive(Default)]
pub(super) struct Probes {
    /// Readers, each with how many columns it has.
    pub readers: Vec<(ProbeReader, usize)>,
    pub columns: Vec<Column>,
    /// Latest first.
    pub listings: Vec<Listing>,
    /// How each column is decimated; absent for a reading of a state.
    pub kinds: Vec<Option<SampleKind>>,
    /// Whether accelerations or torques are read, for which the model has to be evaluated.
    pub needs_rhs: bool,
}

impl Probes {
    pub fn new(model: &Model) -> Self {
        let mut probes = Self::default();
        for (name, probe) in model.scene.recorded().iter() {
            probes.add(model, name, probe);
        }
        probes.listings.sort_by(|a, b| b.time.total_cmp(&a.time));
        probes
    }

    fn add(&mut self, model: &Model, name: &str, probe: &Probe) {
        // Validation has made sure that bodies exist.
        let body_of = |body: &str| BodyId::new(model.scene.body_index(body).unwrap_or(0));
        let before = self.columns.len();
        let reader = match probe {
            Probe::Motion(of) => {
                let components = of.components.as_deref();
                self.motion(model, name, body_of(&of.body), components)
            }
            Probe::Contacts(of) => {
                let contacts = contacts(model, of.row, of.balls.as_deref(), of.races.as_deref());
                self.contacts(model, name, contacts, of.quantities.as_deref())
            }
            Probe::Cage { row } => {
                if model.scene.cage_ring().is_some() {
                    for (label, unit) in
                        [("angle", "rad"), ("omega", "rad/s"), ("x", "m"), ("y", "m")]
                    {
                        self.column(format!("{name}.{label}"), unit, Some(SampleKind::Smooth));
                    }
                    for pocket in 0..model.rows[*row].count {
                        let column = format!("{name}.pocket{pocket}.force");
                        self.column(column, "N", Some(SampleKind::Smooth));
                    }
                } else if model.scene.cage.is_some() {
                    for link in 0..model.rows[*row].links().count() {
                        self.column(format!("{name}.link{link}"), "N", Some(SampleKind::Smooth));
                    }
                }
                ProbeReader::Cage { row: *row }
            }
            Probe::Structure { sensors } => self.sensors(model, name, sensors.as_deref()),
            Probe::Seat {} => {
                for label in SEAT {
                    self.column(format!("{name}.{label}"), "N", Some(SampleKind::Smooth));
                }
                ProbeReader::Seat
            }
            Probe::Energy {} => {
                for (label, unit, _) in Energy::default().entries() {
                    self.column(format!("{name}.{label}"), unit, None);
                }
                ProbeReader::Energy
            }
            Probe::Torque {} => {
                for race in Race::BOTH {
                    let column = format!("{name}.{}", race.name());
                    self.column(column, "N m", Some(SampleKind::Smooth));
                }
                self.needs_rhs = true;
                ProbeReader::Torque
            }
            Probe::Moments {} => {
                for label in MOMENTS {
                    self.column(format!("{name}.{label}"), "N m", None);
                }
                ProbeReader::Moments
            }
            Probe::Lubrication { row } => {
                for (label, unit) in Lubrication::LABELS {
                    self.column(format!("{name}.{label}"), unit, None);
                }
                ProbeReader::Lubrication { row: *row }
            }
            Probe::Forces { body } => self.forces(name, body_of(body)),
            Probe::Slices(of) => {
                let contacts = contacts(model, of.row, of.balls.as_deref(), of.races.as_deref());
                self.listings.extend(of.times.iter().map(|&time| Listing {
                    probe: name.to_owned(),
                    time,
                    contacts: contacts.clone(),
                }));
                return;
            }
        };
        self.readers.push((reader, self.columns.len() - before));
    }

    fn motion(
        &mut self,
        model: &Model,
        name: &str,
        body: BodyId,
        components: Option<&[Component]>,
    ) -> ProbeReader {
        let all = model.scene.components_of(&model.bodies[body].name);
        let components = components.map_or(all, <[_]>::to_vec);
        for component in &components {
            let (label, unit) = component.label();
            let derived = component.derivative() == 2;
            let kind = if derived {
                SampleKind::Slope
            } else {
                SampleKind::Smooth
            };
            self.column(format!("{name}.{label}"), unit, Some(kind));
            self.needs_rhs |= derived;
        }
        ProbeReader::Motion { body, components }
    }

    fn sensors(&mut self, model: &Model, name: &str, asked: Option<&[String]>) -> ProbeReader {
        let all = model.scene.structure.iter().flat_map(Structure::sensors);
        let asked = asked.map(|of| of.iter().map(String::as_str).collect());
        let names: Vec<&str> = asked.unwrap_or_else(|| all.collect());
        for sensor in &names {
            for label in SENSOR {
                let column = format!("{name}.{sensor}.{label}");
                self.column(column, "m/s^2", Some(SampleKind::Slope));
            }
        }
        self.needs_rhs |= !names.is_empty();
        let shapes = |structure: &StructureModel| {
            names
                .iter()
                .map(|sensor| structure.shapes(sensor))
                .collect()
        };
        ProbeReader::Structure {
            sensors: model.structure.as_ref().map(shapes).unwrap_or_default(),
        }
    }

    fn contacts(
        &mut self,
        model: &Model,
        name: &str,
        contacts: Vec<(usize, Race)>,
        quantities: Option<&[ContactQuantity]>,
    ) -> ProbeReader {
        let quantities = quantities.unwrap_or(&ContactQuantity::ALL).to_vec();
        for (j, race) in &contacts {
            let ball = model.balls[*j].index;
            for quantity in &quantities {
                let (label, unit) = quantity.label();
                let race = race.name();
                self.column(format!("{name}.ball{ball}.{race}.{label}"), unit, None);
            }
        }
        ProbeReader::Contacts {
            contacts,
            quantities,
        }
    }

    fn forces(&mut self, name: &str, body: BodyId) -> ProbeReader {
        for part in contribution_names() {
            for dof in Dof::ALL {
                let unit = if dof.is_rotation() { "N m" } else { "N" };
                self.column(format!("{name}.{part}.{}", dof.name()), unit, None);
            }
        }
        ProbeReader::Forces { body }
    }

    fn column(&mut self, name: String, unit: &'static str, kind: Option<SampleKind>) {
        self.columns.push(Column {
            name,
            unit: unit.into(),
            values: Vec::new(),
        });
        self.kinds.push(kind);
    }
}

impl ProbeReader {
    /// Whether the probe's columns are signals, which are filtered, rather than readings of a state.
    pub fn is_signal(&self) -> bool {
        match self {
            Self::Motion { .. }
            | Self::Cage { .. }
            | Self::Torque
            | Self::Structure { .. }
            | Self::Seat => true,
            Self::Contacts { .. }
            | Self::Energy
            | Self::Moments
            | Self::Lubrication { .. }
            | Self::Forces { .. } => false,
        }
    }

    /// Pushes one value a column at a state of all bodies, of whose velocities `accelerations` are the derivatives.
    #[inline]
    pub fn read(
        &self,
        dynamics: &Dynamics<'_>,
        t: f64,
        y: &[f64],
        accelerations: &[f64],
        values: &mut Vec<f64>,
    ) {
        let model = dynamics.current_model();
        let layout = model.layout();
        match self {
            Self::Motion { body, components } => {
                values.extend(components.iter().map(|component| {
                    let dof = DIRECTIONS[component.direction()];
                    if !layout.has(*body, dof) {
                        return held(model, *body, *component);
                    }
                    let at = layout.at(*body, dof);
                    match component.derivative() {
                        0 => y[at],
                        1 => y[layout.speed_at(*body, dof)],
                        _ => accelerations[at],
                    }
                }));
            }
            Self::Contacts {
                contacts,
                quantities,
            } => {
                for (j, race) in contacts {
                    let contact = inspect::raw::contact(model, y, *j, *race);
                    values.extend(quantities.iter().map(|quantity| contact.get(*quantity)));
                }
            }
            Self::Cage { row } => {
                if model.rows[*row].cage.is_some() {
                    let turning = layout.motion(y, layout.cage(*row));
                    let centre = layout.motion(y, carrier(model, *row)).centre;
                    values.extend([turning.theta, turning.omega, centre.x, centre.y]);
                }
                values.extend(inspect::raw::cage_forces(model, y, *row));
            }
            Self::Structure { sensors } => {
                for shapes in sensors {
                    let sensed = StructureModel::at_sensor(layout, shapes, accelerations);
                    values.extend(sensed.iter());
                }
            }
            Self::Seat => {
                let force =
                    |structure: &StructureModel| structure.force(structure.stretch(layout, y));
                values.extend(
                    model
                        .structure
                        .as_ref()
                        .map(force)
                        .unwrap_or_default()
                        .iter(),
                );
            }
            Self::Energy => values.extend(
                inspect::raw::energy(model, y)
                    .entries()
                    .map(|(_, _, value)| value),
            ),
            Self::Torque => values.extend(dynamics.ring_torques()),
            Self::Moments => values.extend(inspect::raw::moments(model, t, y).as_flattened()),
            Self::Lubrication { row } => {
                values.extend(inspect::raw::lubrication(model, y, *row).values());
            }
            Self::Forces { body } => {
                for (_, forces) in contributions_with_films(model, t, y) {
                    values.extend(layout.of(&forces, *body));
                }
            }
        }
    }
}

/// Columns of a sensor of the structure, and of its seat.
pub(super) const SENSOR: [&str; 3] = ["ax", "ay", "az"];
pub(super) const SEAT: [&str; 3] = ["fx", "fy", "fz"];

/// Directions of a motion's components, by [`Component::direction`].
const DIRECTIONS: [Dof; 8] = [
    Dof::X,
    Dof::Y,
    Dof::Z,
    Dof::Theta,
    Dof::TiltX,
    Dof::TiltY,
    Dof::TurnX,
    Dof::TurnY,
];

/// A component of a tilt that does not move.
fn held(model: &Model, body: BodyId, component: Component) -> f64 {
    let ring = Race::BOTH.into_iter().find(|race| race.ring() == body);
    match (ring, component) {
        (Some(race), Component::TiltX) => model.rings[race].tilt[0],
        (Some(race), Component::TiltY) => model.rings[race].tilt[1],
        _ => 0.0,
    }
}

/// Pairs (ball among all balls, race), ball by ball.
fn contacts(
    model: &Model,
    row: usize,
    balls: Option<&[usize]>,
    races: Option<&[RingName]>,
) -> Vec<(usize, Race)> {
    let compiled = &model.rows[row];
    let all: Vec<usize> = (0..compiled.count).collect();
    let races = races.unwrap_or(&[RingName::Outer, RingName::Inner]);
    balls
        .unwrap_or(&all)
        .iter()
        .flat_map(|ball| {
            races
                .iter()
                .map(move |race| (compiled.first + ball, Race::from(*race)))
        })
        .collect()
}
