//! `modelDescription.xml` (section 2.4).

use std::fmt::Write;

use crate::variables::{Role, Source, Table, Variable};

/// Name of the library in `binaries/`, without its ending.
pub const MODEL_IDENTIFIER: &str = "ballrace_fmu";

/// Units and their base units.
const UNITS: [(&str, &str); 9] = [
    ("s", r#"s="1""#),
    ("N", r#"kg="1" m="1" s="-2""#),
    ("N.m", r#"kg="1" m="2" s="-2""#),
    ("m", r#"m="1""#),
    ("m/s", r#"m="1" s="-1""#),
    ("m/s^2", r#"m="1" s="-2""#),
    ("rad", r#"rad="1""#),
    ("rad/s", r#"rad="1" s="-1""#),
    ("rad/s^2", r#"rad="1" s="-2""#),
];

/// The description of an FMU with these variables.
pub fn description(table: &Table) -> String {
    let scene = &table.scene;
    let title = if scene.name.is_empty() {
        "ball bearing"
    } else {
        &scene.name
    };
    let mut xml = format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="{}" instantiationToken="{}" generationTool="ballrace {}" variableNamingConvention="flat">
  <CoSimulation modelIdentifier="{MODEL_IDENTIFIER}" canHandleVariableCommunicationStepSize="true" canGetAndSetFMUState="true" canSerializeFMUState="true"/>
  <UnitDefinitions>
"#,
        escaped(title),
        table.token,
        env!("CARGO_PKG_VERSION")
    );
    for (unit, base) in UNITS {
        line(
            &mut xml,
            &format!(r#"    <Unit name="{unit}"><BaseUnit {base}/></Unit>"#),
        );
    }
    xml.push_str(
        r#"  </UnitDefinitions>
  <LogCategories>
    <Category name="logStatusWarning" description="doubts about the scene"/>
    <Category name="logStatusError" description="what was refused or failed"/>
  </LogCategories>
  <DefaultExperiment startTime="0" stopTime="0.01" stepSize="1e-5"/>
  <ModelVariables>
"#,
    );
    for (reference, variable) in table.list.iter().enumerate() {
        line(&mut xml, &of(reference, variable));
    }
    xml.push_str("  </ModelVariables>\n  <ModelStructure>\n");
    for kind in ["Output", "InitialUnknown"] {
        let outputs = table.list.iter().enumerate();
        for (reference, _) in outputs.filter(|(_, variable)| variable.is_output()) {
            line(
                &mut xml,
                &format!(r#"    <{kind} valueReference="{reference}"/>"#),
            );
        }
    }
    xml.push_str("  </ModelStructure>\n</fmiModelDescription>\n");
    xml
}

fn line(xml: &mut String, text: &str) {
    // Writing to a text does not fail.
    let _ = writeln!(xml, "{text}");
}

/// The element of a variable.
fn of(reference: usize, variable: &Variable) -> String {
    let (causality, start) = match &variable.source {
        Source::Time => (r#"causality="independent" variability="continuous""#, None),
        Source::Field {
            role: Role::Load | Role::Speed | Role::Place,
            start,
            ..
        } => (
            r#"causality="input" variability="continuous""#,
            Some(*start),
        ),
        Source::Rate => (r#"causality="input" variability="continuous""#, Some(0.0)),
        Source::Field {
            role: Role::Parameter,
            start,
            ..
        } => (
            r#"causality="parameter" variability="tunable""#,
            Some(*start),
        ),
        _ => (r#"causality="output" variability="continuous""#, None),
    };
    let start = start.map_or_else(String::new, |start| format!(r#" start="{start:e}""#));
    let unit = match variable.unit {
        "" => String::new(),
        unit => format!(r#" unit="{unit}""#),
    };
    let head = format!(
        r#"    <Float64 name="{}" valueReference="{reference}" description="{}" {causality}{start}{unit}"#,
        escaped(&variable.name),
        escaped(&variable.about)
    );
    match &variable.source {
        Source::Loads(..) => format!(
            r#"{head}><Dimension start="{}"/></Float64>"#,
            variable.len()
        ),
        _ => format!("{head}/>"),
    }
}

/// A text within quotes.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}
