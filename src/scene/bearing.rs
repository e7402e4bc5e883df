//! Rows of balls and their races.

use std::f64::consts::FRAC_PI_2;
use std::ops::Bound;

use serde::{Deserialize, Serialize};

use super::absent;
use super::numbers::{ANGLES, BoundedNumber, PLACES, POSITIVE};
use super::ring::Support;
use super::{Contact, Friction, Lubricant, Material, Texture, defaults};

/// The steepest contact angle \[rad\].
const STEEPEST: f64 = 80_f64.to_radians();

/// Conformities of grooves.
const CONFORMITIES: (Bound<f64>, Bound<f64>) = (Bound::Excluded(0.5), Bound::Included(1.0));

/// Row of balls between two grooves (geometry of [*Geometry of a row*](crate::equations#geometry-of-a-row)).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Row {
    /// Number of balls Z, 1 to 1000.
    pub ball_count: usize,
    /// Ball diameter D \[m\].
    pub ball_diameter: f64,
    /// Pitch diameter d_m \[m\].
    pub pitch_diameter: f64,
    /// Outer conformity f_o = r_o / D, above 0.5 and at most 1.
    pub outer_conformity: f64,
    /// Inner conformity f_i = r_i / D, above 0.5 and at most 1.
    pub inner_conformity: f64,
    /// Nominal contact angle α₀ at zero clearance \[rad\], 0 to 80°.
    #[serde(default)]
    pub contact_angle: f64,
    /// Sign of the axial part of the direction from ball to outer contact, +1 or −1; +1 takes thrust towards +z on the inner ring.
    #[serde(default = "defaults::side")]
    pub side: i8,
    /// Axial place of the row z_row \[m\].
    #[serde(default)]
    pub axial_position: f64,
    /// Diametral clearance P_d \[m\]; negative: interference.
    #[serde(default)]
    pub clearance: f64,
    /// Axial preload δ_p \[m\]; negative: an axial gap.
    #[serde(default)]
    pub axial_preload: f64,
    /// Start angle φ₀ of ball 0, counter-clockwise from +x \[rad\].
    #[serde(default)]
    pub start_angle: f64,
    /// Shoulder angles of the outer groove towards −z and +z, from the groove's centre \[rad\]; absent: none.
    #[serde(default)]
    pub outer_shoulders: Option<[f64; 2]>,
    /// Shoulder angles of the inner groove towards −z and +z, from the groove's centre \[rad\]; absent: none.
    #[serde(default)]
    pub inner_shoulders: Option<[f64; 2]>,
    /// Radius \[m\] by which the edges of the outer shoulders are rounded, so that the force of a contact that runs over one falls
    /// smoothly; absent: sharp edges. Only with shoulders and the law of ISO 16281.
    #[serde(default)]
    pub outer_shoulder_radius: Option<f64>,
    /// Radius \[m\] by which the edges of the inner shoulders are rounded; likewise.
    #[serde(default)]
    pub inner_shoulder_radius: Option<f64>,
    /// Outer race through points, in place of the groove of `outer_conformity`.
    #[serde(default)]
    pub outer_profile: Option<RaceProfile>,
    /// Inner race through points, in place of the groove of `inner_conformity`.
    #[serde(default)]
    pub inner_profile: Option<RaceProfile>,
    /// Outer race as a gothic arch, as in a four-point bearing.
    #[serde(default)]
    pub outer_arch: Option<GothicArch>,
    /// Inner race as a gothic arch, as in a four-point bearing.
    #[serde(default)]
    pub inner_arch: Option<GothicArch>,
    /// Waviness of the outer race; turns with the outer ring.
    #[serde(default)]
    pub outer_waviness: Vec<Waviness>,
    /// Waviness of the inner race; turns with the inner ring.
    #[serde(default)]
    pub inner_waviness: Vec<Waviness>,
    /// Texture of races and balls, added to `outer_waviness` and `inner_waviness`; absent: smooth.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub texture: Option<Texture>,
    /// Diameter error of each ball \[m\]; empty: none.
    #[serde(default)]
    pub diameter_errors: Vec<f64>,
    /// Mass of a ball \[kg\]; absent: from density and diameter.
    #[serde(default)]
    pub ball_mass: Option<f64>,
    /// Moment of inertia of a ball about z \[kg m²\]; absent: 2/5 m R².
    #[serde(default)]
    pub ball_inertia: Option<f64>,
    /// How every ball of the row is supported; by default free.
    #[serde(default)]
    pub ball_support: Support,
    /// Material of the row's balls; absent: that of the scene, `materials.balls`.
    #[serde(default)]
    pub ball_material: Option<Material>,
    /// Contact of the row's balls and races, in place of all of the scene's `contact`; absent: that of the scene.
    #[serde(default)]
    pub contact: Option<Contact>,
    /// Friction of the row's balls and races; absent: that of the scene.
    #[serde(default)]
    pub friction: Option<Friction>,
    /// Oil of the row's contacts, in place of all of the scene's `lubricant`; absent: that of the scene.
    #[serde(default, skip_serializing_if = "absent::none")]
    pub lubricant: Option<Lubricant>,
}

impl Row {
    /// Whether both races are grooves with sharp shoulders or none: neither profiles nor arches.
    pub(crate) fn has_plain_grooves(&self) -> bool {
        let profiles = self.outer_profile.is_some() || self.inner_profile.is_some();
        let arches = self.outer_arch.is_some() || self.inner_arch.is_some();
        let rounded = self.outer_shoulder_radius.is_some() || self.inner_shoulder_radius.is_some();
        !(profiles || arches || rounded)
    }

    /// Whether the row's races have waves, or races or balls a texture.
    pub(crate) fn is_wavy(&self) -> bool {
        let listed = !(self.outer_waviness.is_empty() && self.inner_waviness.is_empty());
        listed || self.texture.is_some()
    }

    /// Numbers of the row whose range depends on no other.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        let angles = (Bound::Excluded(0.0), Bound::Excluded(FRAC_PI_2));
        let shoulders = |field, shoulders: Option<[f64; 2]>| {
            let unit = "rad, which is 90°";
            BoundedNumber::each(field, shoulders.as_slice().as_flattened(), angles, unit)
        };
        let [outer, inner] = [self.outer_conformity, self.inner_conformity];
        let own = [
            BoundedNumber::new("ball_count", self.ball_count as f64, 1.0..=1e3, ""),
            BoundedNumber::new("ball_diameter", self.ball_diameter, 1e-6..=10.0, "m"),
            BoundedNumber::new("pitch_diameter", self.pitch_diameter, 1e-6..=100.0, "m"),
            BoundedNumber::new("outer_conformity", outer, CONFORMITIES, ""),
            BoundedNumber::new("inner_conformity", inner, CONFORMITIES, ""),
            BoundedNumber::new(
                "contact_angle",
                self.contact_angle,
                0.0..=STEEPEST,
                "rad, which is 80°",
            ),
            BoundedNumber::new("axial_position", self.axial_position, PLACES, "m"),
            BoundedNumber::new("start_angle", self.start_angle, ANGLES, "rad"),
            BoundedNumber::new("ball_mass", self.ball_mass, POSITIVE, "kg"),
            BoundedNumber::new("ball_inertia", self.ball_inertia, POSITIVE, "kg m²"),
        ];
        let both = [
            shoulders("outer_shoulders", self.outer_shoulders),
            shoulders("inner_shoulders", self.inner_shoulders),
        ];
        own.into_iter().chain(both.into_iter().flatten()).collect()
    }

    /// A healthy row in the plane z = 0, without contact angle and clearance; the arguments are the fields of the same names.
    pub fn new(
        ball_count: usize,
        ball_diameter: f64,
        pitch_diameter: f64,
        outer_conformity: f64,
        inner_conformity: f64,
    ) -> Self {
        Self {
            ball_count,
            ball_diameter,
            pitch_diameter,
            outer_conformity,
            inner_conformity,
            contact_angle: 0.0,
            side: defaults::side(),
            axial_position: 0.0,
            clearance: 0.0,
            axial_preload: 0.0,
            start_angle: 0.0,
            outer_shoulders: None,
            inner_shoulders: None,
            outer_shoulder_radius: None,
            inner_shoulder_radius: None,
            outer_profile: None,
            inner_profile: None,
            outer_arch: None,
            inner_arch: None,
            outer_waviness: Vec::new(),
            inner_waviness: Vec::new(),
            texture: None,
            diameter_errors: Vec::new(),
            ball_mass: None,
            ball_inertia: None,
            ball_support: Support::default(),
            ball_material: None,
            contact: None,
            friction: None,
            lubricant: None,
        }
    }
}

/// A race through points: the cubic spline R(z), twice continuously differentiable, whose end conditions are "not a knot". It ends
/// with its points: shoulders are part of it.
///
/// The points are those of zero clearance and preload, which shift it as they shift a groove: R(z) by P_d/4 away from the
/// balls, an inner race along z by δ_p.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct RaceProfile {
    /// Axial places of the points from the row's plane \[m\], strictly increasing; 4 to 10 000.
    pub z: Vec<f64>,
    /// Radius of the race there, from the ring's axis \[m\].
    pub r: Vec<f64>,
}

impl RaceProfile {
    /// Numbers of the profile whose range depends on no other.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        BoundedNumber::each("r", &self.r, 1e-6..=100.0, "m")
    }

    /// The profile through points at axial places `z` with radii `r` \[m\].
    pub fn new(z: Vec<f64>, r: Vec<f64>) -> Self {
        Self { z, r }
    }
}

/// A race of two grooves whose centres lie apart along the axis, so that a ball that rests in it touches both: a groove from whose
/// middle a shim of width (2 r − D) sin α_s was ground away.
///
/// The clearance P_d is the play of a ball that touches both flanks at the shim angle. That of the groove before grinding is
/// larger by (2 r − D)(1 − cos α_s) for each such race (T. A. Harris, *Rolling Bearing Analysis*, ch. 2).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct GothicArch {
    /// Shim angle α_s, between the plane and the normals of a resting ball \[rad\]; above 0, at most 80°.
    pub shim_angle: f64,
    /// Conformities of the flanks towards −z and +z, above 0.5 and at most 1; absent: both that of the race.
    #[serde(default)]
    pub conformities: Option<[f64; 2]>,
}

impl GothicArch {
    /// Numbers of the arch.
    pub(super) fn numbers(&self) -> Vec<BoundedNumber> {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            shim_angle,
            conformities,
        } = self;
        let angles = (Bound::Excluded(0.0), Bound::Included(STEEPEST));
        let given = conformities.as_slice().as_flattened();
        let mut all = BoundedNumber::each("conformities", given, CONFORMITIES, "");
        all.push(BoundedNumber::new(
            "shim_angle",
            *shim_angle,
            angles,
            "rad, which is 80°",
        ));
        all
    }

    /// Flanks of the race's own conformity.
    pub fn new(shim_angle: f64) -> Self {
        Self {
            shim_angle,
            conformities: None,
        }
    }
}

/// Harmonic of a race's radius: ΔR(φ) = amplitude · cos(order · φ + phase), φ from the ring's own x axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Waviness {
    /// Waves around the circumference, 1 to 1000.
    pub order: u32,
    /// Amplitude of the radius \[m\].
    pub amplitude: f64,
    /// Phase \[rad\].
    #[serde(default)]
    pub phase: f64,
}

impl Waviness {
    /// Numbers of the wave whose range depends on no other.
    pub(super) fn numbers(&self) -> [BoundedNumber; 2] {
        // Named one by one, so that the compiler asks about a new field.
        let Self {
            order,
            amplitude: _,
            phase,
        } = *self;
        [
            BoundedNumber::new("order", f64::from(order), 1.0..=1e3, ""),
            BoundedNumber::new("phase", phase, ANGLES, "rad"),
        ]
    }

    /// Waves around the circumference, amplitude \[m\] and phase \[rad\].
    pub fn new(order: u32, amplitude: f64, phase: f64) -> Self {
        Self {
            order,
            amplitude,
            phase,
        }
    }
}
