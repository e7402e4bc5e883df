//! The lubricant of a scene: a document by name or by data sheet, what is refused of it and what is doubted.

use ballrace::Error;
use ballrace::contact::film::Oil;
use ballrace::scene::{
    Base, Drive, Lubricant, NAMED_OILS, OilLayer, OilSource, Probe, Scene, named_oil, presets,
};
use serde_json::{Value, json};

/// A number of a lubricant.
type Field = fn(&mut Lubricant) -> &mut f64;

/// A 6205 with a lubricant given as JSON.
fn with(lubricant: Value) -> Result<Scene, Error> {
    presets::deep_groove_6205(500.0, 0.0, 1797.0).with(&[("lubricant", lubricant)])
}

/// VG 68 at 55 °C with other fields.
fn vg68(fields: &Value) -> Value {
    let mut whole = json!({"oil": "vg68", "temperature": 328.15});
    for (field, value) in fields.as_object().unwrap() {
        whole[field] = value.clone();
    }
    whole
}

/// Path, value and what is allowed of a refusal.
#[track_caller]
fn refused(scene: Result<Scene, Error>) -> [String; 3] {
    match scene {
        Err(Error::Scene {
            path,
            value,
            allowed,
            ..
        }) => [path, value, allowed],
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_name_and_a_temperature_are_enough() {
    let scene = with(json!({"oil": "vg68", "temperature_c": 55})).unwrap();
    let lubricant = scene.lubricant_of(&scene.rows[0]).unwrap();
    assert_eq!(*lubricant, Lubricant::named("vg68", 55.0 + 273.15));
    assert_eq!(scene.lubricant_of(&scene.rows[0]), scene.lubricant.as_ref());
}

/// Dry scenes keep their text; lubricated ones come back from both kinds of it, their temperature in kelvins.
#[test]
fn documents_come_back() {
    let dry = presets::deep_groove_6205(500.0, 0.0, 1797.0);
    assert!(!dry.to_json().contains("lubricant") && !dry.to_toml().contains("lubricant"));
    let layers = [json!("flooded"), json!(2e-6), json!(1)];
    let expected = [
        OilLayer::Flooded,
        OilLayer::Thickness(2e-6),
        OilLayer::Thickness(1.0),
    ];
    for (layer, expected) in layers.into_iter().zip(expected) {
        let fields = json!({"temperature": null, "temperature_c": 55.0, "oil_layer": layer});
        let mut whole = vg68(&fields);
        whole.as_object_mut().unwrap().remove("temperature");
        let mut scene = with(whole).unwrap();
        scene.rows[0].lubricant = Some(Lubricant::named("fva3", 350.0));
        assert_eq!(scene.lubricant.as_ref().unwrap().oil_layer, expected);
        assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
        assert_eq!(Scene::from_json(&scene.to_json()).unwrap(), scene);
        assert!(!scene.to_json().contains("temperature_c"));
    }
}

/// A row's own oil is its own; fields of both are reached by path, and taken away again.
#[test]
fn a_row_may_have_its_own_oil() {
    let scene = with(vg68(&json!({}))).unwrap();
    let own = json!({"oil": "vg32", "temperature": 300.0});
    let scene = scene.with(&[("rows[0].lubricant", own)]).unwrap();
    let scene = scene
        .with(&[
            ("lubricant.oil", json!("vg220")),
            ("rows[0].lubricant.base", json!("pao")),
        ])
        .unwrap();
    let row = scene.lubricant_of(&scene.rows[0]).unwrap();
    assert_eq!(
        (row.oil.as_deref(), row.base),
        (Some("vg32"), Some(Base::Pao))
    );
    let dry = scene.with(&[
        ("rows[0].lubricant", Value::Null),
        ("lubricant", Value::Null),
    ]);
    let dry = dry.unwrap();
    assert_eq!(dry.lubricant_of(&dry.rows[0]), None);
}

/// What is given comes before what a name stands for, and that before the base oil.
#[test]
fn numbers_know_their_source() {
    let sheet = Lubricant::named("fva3", 330.0).sheet().unwrap();
    assert_eq!(sheet.density_15.value, 882.0);
    assert_eq!(sheet.viscosity_40.source, OilSource::NamedOil);
    assert_eq!(sheet.limiting_stress.source, OilSource::Base);
    assert_eq!(sheet.pressure_viscosity_source(), OilSource::Gold);
    let mut own = Lubricant::new(30e-6, 6e-6, 330.0);
    own.base = Some(Base::Pag);
    own.pressure_viscosity = Some(1.5e-8);
    let sheet = own.sheet().unwrap();
    assert_eq!(sheet.density_15.source, OilSource::Default);
    assert_eq!(sheet.viscosity_100.source, OilSource::Given);
    assert_eq!(sheet.limiting_stress.value, 0.044);
    assert_eq!(sheet.pressure_viscosity_source(), OilSource::Given);
    assert_eq!(Oil::new(&own).unwrap().pressure_viscosity, 1.5e-8);
    for oil in NAMED_OILS {
        assert_eq!(named_oil(oil.name), Some(&oil));
        let sheet = Lubricant::named(oil.name, 313.15).sheet().unwrap();
        let [viscosity, slope] = sheet.kinematic_viscosity(313.15);
        assert!((viscosity / oil.viscosity_40 - 1.0).abs() < 1e-12 && slope > 0.0);
        let [viscosity, _] = sheet.kinematic_viscosity(373.15);
        assert!((viscosity / oil.viscosity_100 - 1.0).abs() < 1e-12);
    }
}

/// Every number that cannot be is refused by its path.
#[test]
fn unusable_numbers_are_refused_by_name() {
    let cases = [
        ("temperature", json!(55.0), "from 233 to 473 K"),
        ("temperature", json!(473.5), "200 °C"),
        ("viscosity_40", json!(-1.0), "m²/s"),
        ("viscosity_40", json!(68.0), "68 mm²/s is 68e-6"),
        ("viscosity_100", json!(0.0), "m²/s"),
        ("viscosity_100", json!(68e-6), "below viscosity_40"),
        ("density_15", json!(0.88), "100"),
        ("pressure_viscosity", json!(16.0), "from 1e-10"),
        ("limiting_stress", json!(0.5), "below 0.5"),
        ("limiting_stress", json!(0.0), "above 0"),
        ("boundary_friction", json!(-0.1), "above 0"),
        ("boundary_friction", json!(0.6), "below 0.5"),
        ("conductivity", json!(0.0), "0.001"),
        ("roughness", json!(0.0), "above 0"),
        ("roughness", json!(-1e-7), "above 0"),
        ("oil_layer", json!(0.0), "above 0"),
        ("oil_layer", json!("plenty"), "flooded"),
        ("hysteresis", json!(-0.1), "from 0"),
        ("slip_floor", json!(0.0), "from 1e-9"),
        ("damping_frequency", json!(0.0), "above 0"),
        ("reference_speed", json!(0.0), "above 0"),
        ("reference_load", json!(-5.0), "above 0"),
        ("fill", json!(1.1), "from 0 to 1"),
        ("film", json!(1), "true or false"),
        ("base", json!("water"), "ester"),
        ("oil", json!("vg46"), "vg32, vg68, vg100, vg220, fva3"),
    ];
    for (field, value, allowed) in cases {
        let [path, value, why] = refused(with(vg68(&json!({field: value}))));
        assert_eq!(path, format!("lubricant.{field}"), "{value}: {why}");
        assert!(why.contains(allowed), "{field}: {why}");
    }
    let [path, ..] = refused(with(vg68(&json!({"viscosity": 68e-6}))));
    assert_eq!(path, "lubricant.viscosity");
}

/// Numbers that are not finite, which JSON has none of.
#[test]
fn what_is_not_finite_is_refused() {
    let cases: [(&str, Field); 6] = [
        ("temperature", |oil| &mut oil.temperature),
        ("viscosity_40", |oil| oil.viscosity_40.insert(0.0)),
        ("roughness", |oil| &mut oil.roughness),
        ("boundary_friction", |oil| &mut oil.boundary_friction),
        ("reference_load", |oil| oil.reference_load.insert(0.0)),
        ("hysteresis", |oil| &mut oil.hysteresis),
    ];
    for (field, of) in cases {
        for value in [f64::NAN, f64::INFINITY] {
            let mut scene = with(vg68(&json!({}))).unwrap();
            *of(scene.lubricant.as_mut().unwrap()) = value;
            let [path, ..] = refused(scene.validate().map(|()| scene));
            assert_eq!(path, format!("lubricant.{field}"));
        }
    }
}

/// What is missing, or given twice.
#[test]
fn half_a_lubricant_is_refused() {
    let [path, _, why] = refused(with(json!({"oil": "vg68"})));
    assert_eq!(path, "lubricant");
    assert!(
        why.contains(r#""temperature" [K] or "temperature_c" [°C]"#),
        "{why}"
    );
    let [path, _, why] = refused(with(vg68(&json!({"temperature_c": 55.0}))));
    assert_eq!(path, "lubricant");
    assert!(why.contains("give one"), "{why}");
    let [path, ..] = refused(with(json!({"viscosity_40": 68e-6, "temperature": 330.0})));
    assert_eq!(path, "lubricant.viscosity_100");
    for (given, missing) in [
        (json!({"base": "ester"}), "pressure_viscosity"),
        (
            json!({"base": "ester", "pressure_viscosity": 1e-8}),
            "limiting_stress",
        ),
    ] {
        let [path, ..] = refused(with(vg68(&given)));
        assert_eq!(path, format!("lubricant.{missing}"));
    }
    let ester = json!({"base": "ester", "pressure_viscosity": 1e-8, "limiting_stress": 0.04});
    with(vg68(&ester)).unwrap();
    // At −40 °C this would be a stone.
    let steep = json!({"viscosity_40": 0.05, "viscosity_100": 1e-6, "temperature": 250.0});
    let [path, _, why] = refused(with(steep));
    assert_eq!(path, "lubricant.temperature");
    assert!(why.contains("flow"), "{why}");
}

/// Films need a speed: the drive's, or one that is given; of a row as well.
#[test]
fn a_bearing_at_rest_needs_a_reference_speed() {
    let mut scene = with(vg68(&json!({}))).unwrap();
    let lubricant = scene.lubricant.clone().unwrap();
    assert!((scene.reference_speed_of(&lubricant) - 188.18).abs() < 0.01);
    scene.drive = Drive::Speed(0.0.into());
    let [path, _, why] = refused(scene.validate().map(|()| scene.clone()));
    assert_eq!(path, "lubricant.reference_speed");
    assert!(why.contains("a relative speed of the rings"), "{why}");
    scene.lubricant.as_mut().unwrap().reference_speed = Some(100.0);
    scene.validate().unwrap();
    scene.rows[0].lubricant = Some(lubricant);
    let [path, ..] = refused(scene.validate().map(|()| scene));
    assert_eq!(path, "rows[0].lubricant.reference_speed");
}

/// A lubricant alone is read as that of a scene is.
#[test]
fn a_lubricant_may_be_read_alone() {
    let read = |value: Value| Lubricant::from_json(&value.to_string());
    assert_eq!(
        read(vg68(&json!({}))).unwrap(),
        Lubricant::named("vg68", 328.15)
    );
    for (value, expected) in [
        (vg68(&json!({"fill": 2.0})), "lubricant.fill"),
        (vg68(&json!({"fill": "full"})), "lubricant.fill"),
        (json!({"oil": "vg68"}), "lubricant"),
    ] {
        let Err(Error::Scene { path, .. }) = read(value) else {
            panic!("{expected}");
        };
        assert_eq!(path, expected);
    }
}

/// A raised slip scale is what the guide recommends where vibration alone is asked: doubted where torque is recorded or drives.
#[test]
fn a_raised_slip_floor_is_doubted_where_torque_counts() {
    let raised = with(vg68(&json!({"slip_floor": 0.05}))).unwrap();
    assert_eq!(raised.doubts(), []);
    for probe in [Probe::torque(), Probe::lubrication(0), Probe::energy()] {
        let mut scene = raised.clone();
        scene.probes.insert("torque".to_owned(), probe);
        assert_eq!(scene.doubts()[0].path, "lubricant.slip_floor");
    }
    let mut driven = raised.clone();
    driven.drive = Drive::Torque {
        value: 0.1.into(),
        initial_speed: 100.0,
    };
    assert_eq!(driven.doubts()[0].path, "lubricant.slip_floor");
}

/// What no oil of a bearing has is doubted, and an ordinary one is not.
#[test]
fn unusual_oil_is_doubted() {
    assert_eq!(with(vg68(&json!({}))).unwrap().doubts(), []);
    assert_eq!(
        with(vg68(&json!({"oil_layer": "flooded"})))
            .unwrap()
            .doubts(),
        []
    );
    for (field, value) in [
        ("temperature", 470.0),
        ("roughness", 1e-4),
        ("oil_layer", 0.5),
        ("slip_floor", 0.1),
    ] {
        let mut scene = with(vg68(&json!({field: value}))).unwrap();
        let found = scene.doubts();
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].path, format!("lubricant.{field}"));
        scene.rows[0].lubricant = scene.lubricant.take();
        assert_eq!(scene.doubts()[0].path, format!("rows[0].lubricant.{field}"));
    }
}
