//! Scenes that run, between them with every part that a scene may have.

use std::sync::OnceLock;

use ballrace::Scene;
use ballrace::scene::presets::{
    Arrangement, angular_contact_pair, cornering_wheel, deep_groove_6205, wheel_bearing,
};
use serde_json::{Value, json};

/// A document with what it is called.
pub struct Base {
    pub name: &'static str,
    pub scene: Scene,
    pub document: Value,
}

/// The scenes, made once.
pub fn all() -> &'static [Base] {
    static BASES: OnceLock<Vec<Base>> = OnceLock::new();
    BASES.get_or_init(|| {
        let scenes = presets().into_iter().chain(changed());
        let based = scenes.map(|(name, scene)| Base {
            name,
            document: serde_json::to_value(&scene).expect("a scene is a document"),
            scene,
        });
        based.collect()
    })
}

/// The scene of a name.
pub fn named(name: &str) -> Option<&'static Base> {
    all().iter().find(|base| base.name == name)
}

fn presets() -> Vec<(&'static str, Scene)> {
    let pair = |arrangement| angular_contact_pair(arrangement, 300.0, 100.0, 3000.0);
    let text = include_str!("../../../documents/schema_1.toml");
    vec![
        ("deep-groove-6205", deep_groove_6205(500.0, 100.0, 1800.0)),
        ("wheel-bearing", wheel_bearing(3000.0)),
        ("cornering-wheel", cornering_wheel(0.3)),
        ("back-to-back", pair(Arrangement::BackToBack)),
        ("face-to-face", pair(Arrangement::FaceToFace)),
        ("every-part", Scene::from_toml(text).expect("a scene")),
    ]
}

/// The deep-groove bearing with what the presets have not.
fn changed() -> Vec<(&'static str, Scene)> {
    let sine =
        json!({"sine": {"mean": 300.0, "amplitude": 50.0, "frequency": 500.0, "phase": 0.0}});
    let cap = json!({
        "on": "ball", "ball": 3, "shape": "cap", "angle": 0.3, "axial_offset": 1e-3, "width": 1e-3,
        "edge_radius": 1e-4,
    });
    let of = |changes: &[(&str, Value)]| {
        let scene = deep_groove_6205(300.0, 100.0, 1800.0);
        scene.with(changes).expect("a scene")
    };
    vec![
        (
            "oil",
            of(&[
                ("lubricant", json!({"oil": "vg68", "temperature": 330.0})),
                ("probes.oil", json!({"lubrication": {"row": 0}})),
            ]),
        ),
        (
            "free-spin",
            of(&[("spin", json!("free")), ("defects.cap", cap)]),
        ),
        (
            "driven",
            of(&[(
                "drive",
                json!({"torque": {"value": 0.1, "initial_speed": 150.0}}),
            )]),
        ),
        (
            "shaped",
            of(&[
                (
                    "rows[0].outer_arch",
                    json!({"shim_angle": 0.3, "conformities": [0.525, 0.525]}),
                ),
                ("rows[0].inner_profile", profile()),
                (
                    "rows[0].inner_waviness",
                    json!([{"order": 7, "amplitude": 1e-7, "phase": 0.1}]),
                ),
                (
                    "rows[0].diameter_errors",
                    json!([1e-6, -1e-6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2e-6]),
                ),
                ("contact.slices", json!({"fixed": 50})),
                ("contact.law", json!({"iso16281": {}})),
                ("loads.radial.force", sine),
            ]),
        ),
        (
            "probed",
            of(&[
                ("contact.law", json!({"iso16281": {}})),
                ("rows[0].outer_shoulders", json!([0.6, 0.6])),
                ("rows[0].outer_shoulder_radius", json!(1e-4)),
                (
                    "probes.contacts",
                    json!({"contacts": {"balls": [0, 4], "races": ["inner"]}}),
                ),
                ("probes.forces", json!({"forces": {"body": "row0.ball2"}})),
                ("probes.moments", json!({"moments": {}})),
                ("probes.slices", json!({"slices": {"times": [0.0, 1e-5]}})),
                (
                    "moments.bent",
                    json!({"ring": "inner", "direction": [1.0, 0.0, 0.0], "moment": 0.5}),
                ),
                ("inner_ring.tilt", json!([1e-3, 0.0])),
            ]),
        ),
        (
            "held",
            of(&[
                (
                    "inner_ring.support.tilt_x",
                    json!({"spring": {"stiffness": 1e4, "damping": 0.1}}),
                ),
                ("inner_ring.support.tilt_y", json!("free")),
                ("inner_ring.transverse_inertia", json!(1e-4)),
                ("inner_ring.centre_of_mass", json!(1e-3)),
                ("outer_ring.support.coupled", coupled()),
                ("loads.radial.at", json!([0.0, 0.0, 0.02])),
                ("solver.method", json!("dormand-prince")),
            ]),
        ),
        ("filled", of(&options())),
        (
            "traction",
            of(&[
                (
                    "materials.balls",
                    json!({"density": 3200.0, "youngs_modulus": 3.1e11, "poisson_ratio": 0.27}),
                ),
                (
                    "friction",
                    json!({"traction": {"a": 0.1, "b": 10.0, "c": 0.1, "d": 0.05, "slip_speed": 0.1}}),
                ),
            ]),
        ),
    ]
}

/// Options that other scenes leave absent.
fn options() -> Vec<(&'static str, Value)> {
    let contact = json!({"law": {"iso16281": {}}, "slices": {"accuracy": 1e-3}, "damping": 0.1, "clamp_pull": false});
    let material = json!({"density": 3200.0, "youngs_modulus": 3.1e11, "poisson_ratio": 0.27});
    let oil = json!({
        "viscosity_40": 6e-5, "viscosity_100": 9e-6, "density_15": 880.0, "temperature": 330.0, "base": "mineral",
        "pressure_viscosity": 2e-8, "limiting_stress": 0.05, "damping_frequency": 1000.0, "reference_speed": 180.0,
        "reference_load": 100.0, "oil_layer": "flooded", "fill": 0.1,
    });
    let unbalance = json!({"ring": "inner", "moment": 1e-5, "axial_position": 1e-3});
    vec![
        ("rows[0].outer_shoulders", json!([0.6, 0.6])),
        ("rows[0].inner_shoulders", json!([0.6, 0.6])),
        ("rows[0].ball_mass", json!(2e-3)),
        ("rows[0].ball_inertia", json!(1.3e-8)),
        ("rows[0].ball_material", material),
        ("rows[0].contact", contact),
        ("rows[0].friction", json!("none")),
        ("rows[0].lubricant", oil),
        (
            "rows[0].ball_support.z",
            json!({"spring": {"stiffness": 1e4, "damping": 1.0}}),
        ),
        ("outer_ring.inertia", json!(1e-4)),
        (
            "outer_ring.support.theta",
            json!({"spring": {"stiffness": 1e6, "damping": 1.0}}),
        ),
        ("unbalances.rotor", unbalance),
        ("solver.first_step", json!(1e-8)),
        ("solver.max_step", json!(1e-6)),
    ]
}

/// A groove by its points, of the deep-groove bearing's inner race.
fn profile() -> Value {
    let (groove, bottom) = (0.515 * 7.94e-3, (39.04e-3 - 7.94e-3) / 2.0);
    let z: Vec<f64> = (-6..=6).map(|i| 0.5e-3 * f64::from(i)).collect();
    let r: Vec<f64> = z
        .iter()
        .map(|z| bottom + groove - (groove * groove - z * z).sqrt())
        .collect();
    json!({"z": z, "r": r})
}

fn coupled() -> Value {
    let stiffness = [1e8, 1e8, 1e8, 1e4, 1e4, 1e4];
    let matrix: Vec<Vec<f64>> = (0..6)
        .map(|i| {
            (0..6)
                .map(|j| if i == j { stiffness[i] } else { 0.0 })
                .collect()
        })
        .collect();
    json!({"stiffness": matrix, "axial_position": 1e-3})
}
