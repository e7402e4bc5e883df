//! The user's input: the scene, a plain document in SI units.
//!
//! TOML is for users, JSON for the bindings of Python; both are the same serde document. Unknown
//! fields are refused. Nothing is computed here: [`Scene::validate`] refuses what is impossible, [`Scene::doubts`] reports what
//! is improbable, and [`crate::compile()`] makes a [`crate::Model`] of the rest.
//!
//! ```
//! use ballrace::Scene;
//! use ballrace::scene::{Defect, Patch, Surface};
//! let mut scene = ballrace::scene::presets::deep_groove_6205(500.0, 0.0, 1800.0);
//! let spall = Patch::of_width(1e-3).length(2e-3).edge_radius(0.3e-3); // m
//! scene.defects.insert("spall".to_owned(), Defect::of(spall, Surface::OuterRace, -1.57));
//! let text = scene.to_toml();
//! assert_eq!(Scene::from_toml(&text).unwrap(), scene);
//! let wide = scene.with(&[("rows[0].clearance", 20e-6.into())]).unwrap();
//! assert_eq!(wide.rows[0].clearance, 20e-6);
//! ```

mod absent;
mod antiderivative;
mod bearing;
mod cage;
#[cfg(feature = "catalogue")]
pub mod catalogue;
mod contact;
mod contact_quantity;
mod damage;
mod defaults;
mod defect;
mod document;
mod doubt;
mod expected;
mod fault_lines;
mod load;
mod lubricant;
mod material;
mod numbers;
mod oils;
mod path;
mod points;
pub mod presets;
mod probe;
mod ranges;
mod recorded;
mod removed;
mod ring;
mod ring_force;
mod solver;
mod spin;
mod structure;
mod surface;
mod table_force;
mod texture;
mod tilt;
mod time;
mod turning;
mod validate;
mod width;
mod word;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::base::error::{Error, Result};
use crate::base::memory;
use numbers::BoundedNumber;

pub(crate) use antiderivative::Antiderivative;
pub use bearing::{GothicArch, RaceProfile, Row, Waviness};
pub use cage::{Cage, CageGuidance, CageLinks, CageRing};
pub use contact::{Contact, Friction, NormalLaw, Slices, SqueezeFilm};
pub use contact_quantity::ContactQuantity;
pub use damage::*;
pub use defect::Defect;
pub(crate) use document::interpret;
pub(crate) use doubt::{AtSpeed, FilmJudged};
pub use doubt::{Doubt, STATIC_PRESSURE};
#[allow(deprecated)]
pub use fault_lines::kinematic_orders;
pub use fault_lines::{Orders, RowGeometry};
pub use load::{Drive, Load, Moment, Unbalance};
pub use lubricant::{Lubricant, OilLayer};
pub use material::{Material, Materials};
pub(crate) use oils::CENTISTOKE;
pub use oils::{Base, NAMED_OILS, NamedOil, OilSheet, OilSource, Sourced, named_oil};
pub use probe::{Component, ContactsProbe, MotionProbe, Probe, SlicesProbe};
pub use ranges::ranges;
pub use ring::{CoupledSupport, Mount, Ring, RingName, Support};
pub use ring_force::{RingForce, RingForces, RingMotion};
/// Value that [`Scene::with`] gives a field: a number, a text, a list or a document of JSON.
pub use serde_json::Value;
pub use solver::{Method, RelativeTolerance, Solver};
pub use spin::Spin;
pub use structure::{Compliance, Mode, Structure};
pub use surface::{AxialOffset, Surface};
pub use table_force::TableForce;
pub use texture::Texture;
pub use time::{Profile, TimeFunction};
pub use width::{Floor, Width, WidthProfile};

/// Version of the document this crate reads.
pub const SCHEMA: u32 = 1;

/// A whole bearing, its loads, its defects and what to record of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Scene {
    /// Version of the document, 1.
    #[serde(default = "defaults::schema")]
    pub schema: u32,
    /// A title.
    #[serde(default)]
    pub name: String,
    /// The rows of balls, at least one.
    pub rows: Vec<Row>,
    /// Outer ring.
    #[serde(default)]
    pub outer_ring: Ring,
    /// Inner ring.
    #[serde(default)]
    pub inner_ring: Ring,
    /// Structure on which the outer ring stands; absent: its support ends on the ground.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub structure: Option<Structure>,
    /// Materials.
    #[serde(default)]
    pub materials: Materials,
    /// Contact of balls and races.
    #[serde(default)]
    pub contact: Contact,
    /// Friction of balls and races; none by default.
    #[serde(default)]
    pub friction: Friction,
    /// Oil between balls and races, whose traction replaces `friction`; absent: dry.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub lubricant: Option<Lubricant>,
    /// How balls spin; absent: about the bearing's axis.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub spin: Option<Spin>,
    /// Cage, links between neighbouring balls or a ring with pockets; absent: nothing keeps the balls apart.
    #[serde(default)]
    pub cage: Option<Cage>,
    /// Drive of the inner ring.
    pub drive: Drive,
    /// Given speed of the outer ring Ω_o(t) \[rad/s\], counter-clockwise about z; must not jump. Its waviness, texture and defects turn
    /// with it; loads, gravity and its support do not. Absent: it stands, or turns as its support lets it.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub outer_speed: Option<TimeFunction>,
    /// Gravity \[m/s²\]; 9.81 along −y by default.
    #[serde(default = "defaults::gravity")]
    pub gravity: [f64; 3],
    /// Loads by name.
    #[serde(default)]
    pub loads: BTreeMap<String, Load>,
    /// Moments by name.
    #[serde(default, skip_serializing_if = "absent::empty")]
    pub moments: BTreeMap<String, Moment>,
    /// Unbalances by name.
    #[serde(default)]
    pub unbalances: BTreeMap<String, Unbalance>,
    /// Forces on rings that depend on their places, by name.
    #[serde(default, skip_serializing_if = "absent::empty")]
    pub table_forces: BTreeMap<String, TableForce>,
    /// Forces on rings computed by the caller's code, by name; a document has none.
    #[serde(skip_deserializing, skip_serializing_if = "RingForces::is_empty")]
    pub ring_forces: RingForces,
    /// Defects by name.
    #[serde(default)]
    pub defects: BTreeMap<String, Defect>,
    /// Probes by name; none: those of [`Scene::recorded`].
    #[serde(default)]
    pub probes: BTreeMap<String, Probe>,
    /// Options of the integrator.
    #[serde(default = "Solver::unsaid")]
    pub solver: Solver,
}

/// Memory that reading takes over the length of the text, where it is a list of one-digit numbers: of TOML its tokens and
/// the document, of JSON the document.
const TOML: f64 = 50.0;
const JSON: f64 = 40.0;

/// Characters of a text that fits into any memory.
const SHORT: usize = 50_000;

/// Refuses to read a text that does not fit into memory.
fn check_length(text: &str, factor: f64) -> Result<()> {
    if text.len() < SHORT {
        return Ok(());
    }
    memory::check(factor * text.len() as f64, || {
        format!("a scene of {} characters; give it fewer", text.len())
    })
}

impl Scene {
    /// A bearing of rows and what turns its inner ring, all else by default: the outer ring held, the inner ring free,
    /// bearing steel, Hertz's law, no friction, no cage, gravity, no loads and no defects.
    ///
    /// ```
    /// use ballrace::scene::{Drive, Load, RingName, Row, Scene};
    /// let row = Row::new(9, 7.94e-3, 39.04e-3, 0.525, 0.515);
    /// let mut scene = Scene::new(vec![row], Drive::Speed(188.5.into()));
    /// scene.inner_ring.mass = Some(1.0);
    /// scene.loads.insert("radial".into(), Load::new(RingName::Inner, [0.0, -1.0, 0.0], 500.0));
    /// assert!(scene.validate().is_ok());
    /// ```
    pub fn new(rows: Vec<Row>, drive: Drive) -> Self {
        Self {
            schema: SCHEMA,
            name: String::new(),
            rows,
            outer_ring: Ring::default(),
            inner_ring: Ring::default(),
            structure: None,
            materials: Materials::default(),
            contact: Contact::default(),
            friction: Friction::default(),
            lubricant: None,
            spin: None,
            cage: None,
            drive,
            outer_speed: None,
            gravity: defaults::gravity(),
            loads: BTreeMap::new(),
            moments: BTreeMap::new(),
            unbalances: BTreeMap::new(),
            table_forces: BTreeMap::new(),
            ring_forces: RingForces::default(),
            defects: BTreeMap::new(),
            probes: BTreeMap::new(),
            solver: Solver::default(),
        }
    }

    /// Numbers of the scene itself.
    fn numbers(&self) -> Vec<BoundedNumber> {
        BoundedNumber::each("gravity", &self.gravity, -1e6..=1e6, "m/s²")
    }

    /// Forces on rings that depend on their motion, by tables and by code, each with its path in the scene.
    pub(crate) fn forces_of_motion(&self) -> impl Iterator<Item = (String, &dyn RingForce)> {
        let tables = self.table_forces.iter();
        let tables =
            tables.map(|(name, of)| (format!("table_forces.{name}"), of as &dyn RingForce));
        let coded = self.ring_forces.iter();
        tables.chain(coded.map(|(name, of)| (format!("ring_forces.{name}"), of)))
    }

    /// The links of the cage, if it has some.
    pub(crate) fn cage_links(&self) -> Option<&CageLinks> {
        self.cage.as_ref()?.links()
    }

    /// The cage, if it is a rigid ring.
    pub(crate) fn cage_ring(&self) -> Option<&CageRing> {
        self.cage.as_ref()?.as_ring()
    }

    /// Contact of a row's balls and races: its own, or that of the scene.
    pub fn contact_of<'a>(&'a self, row: &'a Row) -> &'a Contact {
        row.contact.as_ref().unwrap_or(&self.contact)
    }

    /// Friction of a row's contacts: its own, or that of the scene.
    pub fn friction_of<'a>(&'a self, row: &'a Row) -> &'a Friction {
        row.friction.as_ref().unwrap_or(&self.friction)
    }

    /// Oil of a row's contacts: its own, or that of the scene; none: dry.
    pub fn lubricant_of<'a>(&'a self, row: &'a Row) -> Option<&'a Lubricant> {
        row.lubricant.as_ref().or(self.lubricant.as_ref())
    }

    /// Path of the oil of a row in the document.
    pub(crate) fn lubricant_path(&self, row: usize) -> String {
        match self.rows[row].lubricant {
            Some(_) => format!("rows[{row}].lubricant"),
            None => "lubricant".to_owned(),
        }
    }

    /// Relative speed of the rings for which a lubricant's films are computed, Ω_ref \[rad/s\]: its own, or the largest that is
    /// given.
    pub fn reference_speed_of(&self, lubricant: &Lubricant) -> f64 {
        lubricant
            .reference_speed
            .unwrap_or_else(|| self.peak_relative_speed())
    }

    /// Material of a row's balls: its own, or that of the scene.
    pub fn ball_material_of<'a>(&'a self, row: &'a Row) -> &'a Material {
        row.ball_material.as_ref().unwrap_or(&self.materials.balls)
    }

    /// The contacts that the document gives: the scene's and the rows' own.
    pub(crate) fn contacts_mut(&mut self) -> impl Iterator<Item = &mut Contact> {
        let own = self.rows.iter_mut().filter_map(|row| row.contact.as_mut());
        std::iter::once(&mut self.contact).chain(own)
    }

    /// Leaves all rows without friction, and without what oil puts in its place.
    pub(crate) fn remove_friction(&mut self) {
        self.friction = Friction::None;
        self.rows.iter_mut().for_each(|row| row.friction = None);
        for oil in self.lubricants_mut() {
            (oil.traction, oil.rolling) = (false, false);
        }
    }

    /// The lubricants that the document gives: the scene's and the rows' own.
    pub(crate) fn lubricants_mut(&mut self) -> impl Iterator<Item = &mut Lubricant> {
        let own = self
            .rows
            .iter_mut()
            .filter_map(|row| row.lubricant.as_mut());
        self.lubricant.iter_mut().chain(own)
    }

    /// Leaves all rows without oil, and the probes without those that read it.
    pub(crate) fn remove_lubricants(&mut self) {
        self.lubricant = None;
        self.rows.iter_mut().for_each(|row| row.lubricant = None);
        self.probes
            .retain(|_, probe| !matches!(probe, Probe::Lubrication { .. }));
    }

    /// Reads a scene from TOML and checks it.
    ///
    /// # Errors
    /// [`Error::Scene`] names the first field that is unknown, missing or not usable.
    pub fn from_toml(text: &str) -> Result<Self> {
        check_length(text, TOML)?;
        let document = toml::from_str(text)
            .map_err(|e| Error::scene("scene", "not TOML", e.to_string().trim_end()))?;
        let scene = Self::read(document)?;
        scene.validate()?;
        Ok(scene)
    }

    /// Reads a scene from JSON and checks it.
    ///
    /// # Errors
    /// [`Error::Scene`] names the first field that is unknown, missing or not usable.
    pub fn from_json(text: &str) -> Result<Self> {
        let scene = Self::from_json_unchecked(text)?;
        scene.validate()?;
        Ok(scene)
    }

    /// Reads a scene from JSON for [`crate::compile()`], which checks it.
    #[doc(hidden)]
    pub fn from_json_unchecked(text: &str) -> Result<Self> {
        check_length(text, JSON)?;
        let document = serde_json::from_str(text)
            .map_err(|e| Error::scene("scene", "not JSON", e.to_string()))?;
        Self::read(document)
    }

    /// The scene as TOML.
    ///
    /// # Panics
    /// Never: every scene has a TOML form.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a scene is a TOML document")
    }

    /// The scene as JSON on one line, every field written out.
    ///
    /// # Panics
    /// Never: every scene has a JSON form.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("a scene is a JSON document")
    }

    /// A copy with some fields replaced, each by its dotted path: `loads.axial.force`, `rows[0].clearance`.
    ///
    /// # Errors
    /// [`Error::Scene`] if a path does not exist or the new scene is not usable.
    ///
    /// # Panics
    /// Never: every scene has a JSON form.
    pub fn with(&self, changes: &[(&str, Value)]) -> Result<Self> {
        // The copy has the same forces of its program.
        let bare = Self {
            ring_forces: RingForces::default(),
            ..self.clone()
        };
        let document = absent::written_out(|| serde_json::to_value(bare));
        let mut document = document.expect("a scene is a JSON document");
        for (path, value) in changes {
            path::set(&mut document, path, value.clone())?;
        }
        let mut scene = Self::read(document)?;
        scene.validate()?;
        scene.ring_forces.clone_from(&self.ring_forces);
        Ok(scene)
    }

    fn read(mut document: Value) -> Result<Self> {
        removed::take_approximations(&mut document)?;
        interpret(&document, "scene")
    }
}
