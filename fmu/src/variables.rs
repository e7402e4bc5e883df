//! The variables of a scene: one table, from which the description is written and by which values are set and read.
//!
//! A variable's value reference is its place in the table.

use std::ops::Range;

use ballrace::bindings::layout_of;
use ballrace::scene::{Component, Drive, Load, Moment, Mount, Scene, TimeFunction};
use ballrace::{BodyId, Dof, Error, Race, Result};
use serde_json::Value;

use crate::checksum::checksum;

/// Longest list of numbers whose items are parameters; those of a table in time, a profile or a texture are none.
const LONGEST: usize = 8;

/// Names of forces and moments in these directions.
const WRENCH: [&str; 6] = ["fx", "fy", "fz", "mx", "my", "mz"];

/// A variable.
#[derive(Debug)]
pub struct Variable {
    pub name: String,
    pub about: String,
    /// Empty: that of the field of the scene, in SI.
    pub unit: &'static str,
    pub source: Source,
}

/// Origin of a variable's value.
#[derive(Debug)]
pub enum Source {
    Time,
    /// A field of the scene.
    Field {
        path: String,
        start: f64,
        role: Role,
    },
    /// The speed of a ring whose place is the variable before: what a motion that is given from outside has beside it.
    Rate,
    /// How a ring moves.
    Motion(BodyId, Component),
    /// Part of what the balls put on a ring.
    Wrench(Race, usize),
    /// Acceleration of a sensor of the structure along an axis.
    Sensor(String, usize),
    /// Force of the outer ring on the structure along an axis.
    Seat(usize),
    /// Loads of the contacts of balls with a race, one value a ball.
    Loads(Race, Range<usize>),
}

/// Role of a field for the one who couples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// An input that is set without compiling.
    Load,
    /// The speed of the drive, an input: the scene is compiled anew where it changes.
    Speed,
    /// The place of a ring whose motion is given, an input that is followed from step to step.
    Place,
    /// A tunable parameter: likewise.
    Parameter,
}

impl Variable {
    /// How many numbers it has.
    pub fn len(&self) -> usize {
        match &self.source {
            Source::Loads(_, balls) => balls.len(),
            _ => 1,
        }
    }

    /// Whether the bearing computes it.
    pub fn is_output(&self) -> bool {
        matches!(
            self.source,
            Source::Motion(..)
                | Source::Wrench(..)
                | Source::Sensor(..)
                | Source::Seat(..)
                | Source::Loads(..)
        )
    }
}

/// The variables of a scene.
#[derive(Debug)]
pub struct Table {
    /// The scene, with a load of 0 for each direction in which a ring may be pushed.
    pub scene: Scene,
    pub list: Vec<Variable>,
    /// Token by which an importer is sure that description and library belong together.
    pub token: String,
}

impl Table {
    /// The variables of a scene.
    pub fn of(mut scene: Scene) -> Result<Self> {
        // Outputs are points in time, and a tolerance that is a number is a parameter.
        scene.solver.rtol = scene.solver.rtol.or_exact().into();
        let token = token(&scene);
        let mut list = vec![Variable {
            name: "time".to_owned(),
            about: "time".to_owned(),
            unit: "s",
            source: Source::Time,
        }];
        list.extend(fields(&scene));
        let mut pushed = scene;
        for race in Race::BOTH {
            push(&mut pushed, race, &mut list)?;
        }
        outputs(&pushed, &mut list);
        Ok(Self {
            scene: pushed,
            list,
            token,
        })
    }
}

/// The instantiation token of a scene: a checksum of its document and of the version.
fn token(scene: &Scene) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let sum = checksum(version.bytes().chain(scene.to_json().bytes()));
    format!("ballrace {version} {sum:016x}")
}

/// The numbers of a scene by their paths.
fn fields(scene: &Scene) -> Vec<Variable> {
    let document = serde_json::from_str(&scene.to_json()).unwrap_or_default();
    let mut numbers = Vec::new();
    collect(&document, String::new(), &mut numbers);
    let inputs = inputs(scene);
    let of = |(path, start): (String, f64)| {
        let known = inputs.iter().find(|(input, ..)| *input == path);
        let (role, unit) = known.map_or((Role::Parameter, ""), |(_, role, unit)| (*role, *unit));
        Variable {
            name: path.clone(),
            about: "field of the scene, in SI".to_owned(),
            unit,
            source: Source::Field { path, start, role },
        }
    };
    let fields = numbers.into_iter().map(of);
    fields.flat_map(with_rate).collect()
}

/// A field, and behind the place of a ring whose motion is given its speed.
fn with_rate(field: Variable) -> Vec<Variable> {
    let rate = match field.source {
        Source::Field {
            role: Role::Place, ..
        } => Some(Variable {
            name: format!("{}.rate", field.name),
            about: "speed of the ring whose place is given".to_owned(),
            unit: if field.unit == "m" { "m/s" } else { "rad/s" },
            source: Source::Rate,
        }),
        _ => None,
    };
    [Some(field), rate].into_iter().flatten().collect()
}

fn collect(value: &Value, path: String, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(number) if number.is_f64() => {
            found.extend(number.as_f64().map(|number| (path, number)));
        }
        Value::Object(fields) => {
            let dot = if path.is_empty() { "" } else { "." };
            for (name, value) in fields {
                collect(value, format!("{path}{dot}{name}"), found);
            }
        }
        Value::Array(items) if items.len() <= LONGEST || !items[0].is_number() => {
            for (i, value) in items.iter().enumerate() {
                collect(value, format!("{path}[{i}]"), found);
            }
        }
        _ => {}
    }
}

/// Fields that are inputs, as they stay the same in time: sizes of loads and moments, the drive, and places that rings are given.
fn inputs(scene: &Scene) -> Vec<(String, Role, &'static str)> {
    let constant = |size: &TimeFunction| matches!(size, TimeFunction::Constant(_));
    let loads = scene.loads.iter().filter(|(_, load)| constant(&load.force));
    let loads = loads.map(|(name, _)| (format!("loads.{name}.force"), Role::Load, "N"));
    let moments = scene.moments.iter();
    let moments = moments.filter(|(_, moment)| constant(&moment.moment));
    let moments = moments.map(|(name, _)| (format!("moments.{name}.moment"), Role::Load, "N.m"));
    let drive = match &scene.drive {
        Drive::Speed(_) => ("drive.speed".to_owned(), Role::Speed, "rad/s"),
        _ => ("drive.torque.value".to_owned(), Role::Load, "N.m"),
    };
    let rings = [
        ("outer_ring", &scene.outer_ring.support),
        ("inner_ring", &scene.inner_ring.support),
    ];
    let places = rings.into_iter().flat_map(|(ring, support)| {
        let mounts = [
            ("x", &support.x, "m"),
            ("y", &support.y, "m"),
            ("z", &support.z, "m"),
            ("tilt_x", &support.tilt_x, "rad"),
            ("tilt_y", &support.tilt_y, "rad"),
        ];
        mounts
            .into_iter()
            .filter_map(move |(field, mount, unit)| match mount {
                Some(Mount::Given(place)) if constant(place) => {
                    Some((format!("{ring}.support.{field}.given"), Role::Place, unit))
                }
                _ => None,
            })
    });
    loads.chain(moments).chain([drive]).chain(places).collect()
}

/// The directions in which forces move a ring.
fn moves(scene: &Scene, race: Race) -> [bool; 6] {
    let (support, absent) = match race {
        Race::Outer => (&scene.outer_ring.support, Mount::Fixed),
        Race::Inner => (&scene.inner_ring.support, Mount::Free),
    };
    let ([x, y, z, theta], [about_x, about_y]) = (support.mounts(absent), support.tilt_mounts());
    let is_moved = |mount| matches!(mount, Mount::Free | Mount::Spring { .. });
    let mut moves = [x, y, z, about_x, about_y, theta].map(is_moved);
    moves[5] &= race == Race::Outer || !matches!(scene.drive, Drive::Speed(_));
    moves
}

/// Gives a ring a load or moment of 0 in each direction in which it moves, and the table an input for each.
fn push(scene: &mut Scene, race: Race, list: &mut Vec<Variable>) -> Result<()> {
    let (ring, name, moves) = (race.into(), race.name(), moves(scene, race));
    for (direction, _) in moves.into_iter().enumerate().filter(|(_, moves)| *moves) {
        let axis = direction % 3;
        let mut along = [0.0; 3];
        along[axis] = 1.0;
        let entry = format!("fmu_{name}_{}", WRENCH[direction]);
        let (path, kind, unit) = if direction < 3 {
            let load = Load::new(ring, along, 0.0);
            let taken = scene.loads.insert(entry.clone(), load).is_some();
            (format!("loads.{entry}.force"), taken, "N")
        } else {
            let moment = Moment::new(ring, along, 0.0);
            let taken = scene.moments.insert(entry.clone(), moment).is_some();
            (format!("moments.{entry}.moment"), taken, "N.m")
        };
        if kind {
            let allowed = "another name: an input of the FMU has this one";
            return Err(Error::scene(path, entry, allowed));
        }
        list.push(Variable {
            name: format!("{name}.load.{}", WRENCH[direction]),
            about: format!(
                "{} the {name} ring from outside, {} {}",
                if direction < 3 {
                    "force on"
                } else {
                    "moment on"
                },
                if direction < 3 { "along" } else { "about" },
                ["x", "y", "z"][axis]
            ),
            unit,
            source: Source::Field {
                path,
                start: 0.0,
                role: Role::Load,
            },
        });
    }
    Ok(())
}

fn outputs(scene: &Scene, list: &mut Vec<Variable>) {
    let layout = layout_of(scene);
    for race in Race::BOTH {
        let name = race.name();
        let tilts = Component::OF_TILTS.into_iter();
        let tilts = tilts.filter(|of| layout.has(race.ring(), direction(*of)));
        for component in Component::ALL.into_iter().chain(tilts) {
            let (label, unit) = component.label();
            let kind = ["place", "speed", "acceleration"][component.derivative()];
            list.push(Variable {
                name: format!("{name}.{label}"),
                about: format!("{kind} of the {name} ring"),
                unit,
                source: Source::Motion(race.ring(), component),
            });
        }
        for (i, part) in WRENCH.into_iter().enumerate() {
            let kind = if i < 3 { "force" } else { "moment" };
            list.push(Variable {
                name: format!("{name}.wrench.{part}"),
                about: format!("{kind} of the balls on the {name} ring"),
                unit: if i < 3 { "N" } else { "N.m" },
                source: Source::Wrench(race, i),
            });
        }
    }
    structure(scene, list);
    let mut first = 0;
    for (i, row) in scene.rows.iter().enumerate() {
        let balls = first..first + row.ball_count;
        first = balls.end;
        for race in Race::BOTH {
            let race_name = race.name();
            list.push(Variable {
                name: format!("row{i}.{race_name}.load"),
                about: format!("load of each ball's contact with the {race_name} race"),
                unit: "N",
                source: Source::Loads(race, balls.clone()),
            });
        }
    }
}

/// The outputs of a structure: what its sensors measure, and the force on its seat.
fn structure(scene: &Scene, list: &mut Vec<Variable>) {
    let Some(structure) = &scene.structure else {
        return;
    };
    for sensor in structure.sensors() {
        for (axis, label) in ["ax", "ay", "az"].into_iter().enumerate() {
            list.push(Variable {
                name: format!("housing.{sensor}.{label}"),
                about: format!("acceleration of the sensor {sensor}"),
                unit: "m/s^2",
                source: Source::Sensor(sensor.to_owned(), axis),
            });
        }
    }
    for (axis, part) in WRENCH[..3].iter().enumerate() {
        list.push(Variable {
            name: format!("seat.{part}"),
            about: "force of the outer ring on the structure".to_owned(),
            unit: "N",
            source: Source::Seat(axis),
        });
    }
}

/// The direction that a component of a ring's motion is of.
pub fn direction(component: Component) -> Dof {
    let directions = [Dof::X, Dof::Y, Dof::Z, Dof::Theta, Dof::TiltX, Dof::TiltY];
    directions[component.direction()]
}
