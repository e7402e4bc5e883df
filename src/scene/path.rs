//! Dotted paths into the document: `loads.axial.force`, `rows[0].clearance`.

use std::borrow::Cow;

use serde_json::Value;

use super::expected;
use crate::base::error::{Error, Result};

/// A segment of a path that a reader took into a document.
#[derive(Debug)]
pub(super) enum Segment {
    Field(String),
    Item(usize),
}

/// Parts of a scene whose entries have names chosen by the user.
const NAMED: [&str; 6] = [
    "loads",
    "moments",
    "unbalances",
    "table_forces",
    "defects",
    "probes",
];

/// Replaces the value at `path`. The place must exist (`null` counts as existing), or be a new name among loads,
/// moments, unbalances, defects or probes.
pub(super) fn set(document: &mut Value, path: &str, value: Value) -> Result<()> {
    let steps = steps(path)?;
    if let ([Step::Key(part), Step::Key(name)], Some(root)) =
        (steps.as_slice(), document.as_object_mut())
        && NAMED.contains(part)
        && let Some(entries) = root.get_mut(*part).and_then(Value::as_object_mut)
    {
        entries.insert((*name).to_owned(), value);
        return Ok(());
    }
    let mut place = document;
    for step in steps {
        place = match (step, place) {
            (Step::Key(key), Value::Object(map)) => {
                if !map.contains_key(key) {
                    let known: Vec<&str> = map.keys().map(String::as_str).collect();
                    let new = a_new_one(path, key).unwrap_or_default();
                    let former = what_became(path).map(|of| format!("; {of}"));
                    let allowed =
                        expected::no_such_field(key, &known) + &former.unwrap_or_default() + &new;
                    return Err(Error::scene(path, key, allowed));
                }
                &mut map[key]
            }
            (Step::Index(index), Value::Array(items)) => {
                let count = items.len();
                items
                    .get_mut(index)
                    .ok_or_else(|| Error::scene(path, index, format!("an index below {count}")))?
            }
            (Step::Key(key), Value::Array(items)) => {
                let allowed = format!("an index into a list of {}, such as [0]", items.len());
                return Err(Error::scene(path, key, allowed));
            }
            (Step::Key(key), other) => {
                return Err(Error::scene(path, key, format!("{other} has no fields")));
            }
            (Step::Index(index), other) => {
                return Err(Error::scene(path, index, format!("{other} is not a list")));
            }
        };
    }
    *place = value;
    Ok(())
}

/// A path in a document, as a user writes it; empty: the whole document.
pub(super) fn place<'a>(steps: impl Iterator<Item = &'a Segment>) -> String {
    steps.fold(String::new(), |place, step| match step {
        Segment::Item(index) => format!("{place}[{index}]"),
        Segment::Field(name) => {
            let dot = if place.is_empty() { "" } else { "." };
            format!("{place}{dot}{}", shown(name))
        }
    })
}

/// The value at a place of a document, if there is one.
pub(super) fn at<'v, 'a>(
    document: &'v Value,
    mut steps: impl Iterator<Item = &'a Segment>,
) -> Option<&'v Value> {
    steps.try_fold(document, |place, step| match step {
        Segment::Item(index) => place.get(index),
        Segment::Field(name) => place.get(name),
    })
}

/// A name in a place: in quotes where a path could not hold it.
pub(in crate::scene) fn shown(name: &str) -> Cow<'_, str> {
    let is_plain = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.chars().all(is_plain) {
        Cow::Borrowed(name)
    } else {
        Cow::Owned(format!("{name:?}"))
    }
}

/// A value as text, cut where it is long.
pub(super) fn short(value: &Value) -> String {
    let text = value.to_string();
    match text.char_indices().nth(60) {
        Some((end, _)) => format!("{} …", &text[..end]),
        None => text,
    }
}

enum Step<'a> {
    Key(&'a str),
    Index(usize),
}

fn steps(path: &str) -> Result<Vec<Step<'_>>> {
    let malformed = || {
        let shown = if path.is_empty() { "\"\"" } else { path };
        let allowed = "names joined by dots, with [n] for a place in a list";
        Error::scene(shown, shown, allowed)
    };
    let mut steps = Vec::new();
    for part in path.split('.') {
        let (key, mut rest) = part.split_at(part.find('[').unwrap_or(part.len()));
        if key.is_empty() {
            return Err(malformed());
        }
        steps.push(Step::Key(key));
        while let Some(inner) = rest.strip_prefix('[') {
            let (digits, tail) = inner.split_once(']').ok_or_else(malformed)?;
            steps.push(Step::Index(digits.parse().map_err(|_| malformed())?));
            rest = tail;
        }
        if !rest.is_empty() {
            return Err(malformed());
        }
    }
    Ok(steps)
}

/// Words for what became of approximations.
pub(super) const NO_APPROXIMATIONS: &str =
    "approximations were removed with 0.4, since the full model is as fast";

/// What became of what versions up to 0.3 had.
fn what_became(path: &str) -> Option<&'static str> {
    if path.starts_with("defects.defect.") {
        Some("a defect given alone is named by its shape, such as defects.spall")
    } else {
        let is_removed = path.starts_with("approximations");
        is_removed.then_some(NO_APPROXIMATIONS)
    }
}

/// How to add an entry, where a path names only a field of one that is not there.
fn a_new_one(path: &str, key: &str) -> Option<String> {
    let (part, rest) = path.split_once('.')?;
    let field = rest.strip_prefix(key)?;
    (NAMED.contains(&part) && !field.is_empty())
        .then(|| format!("; to add one, set {part}.{key} as a whole"))
}

#[cfg(test)]
mod tests {
    use crate::Scene;
    use crate::base::error::Error;
    use crate::scene::{Defect, Patch, Pit, SteepPatch, Surface, presets};

    /// Path and value that a document is refused by.
    fn refused(toml: &str) -> (String, String) {
        match Scene::from_toml(toml) {
            Err(Error::Scene { path, value, .. }) => (path, value),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn names_that_no_path_can_say_are_quoted() {
        let place = |toml: &str| {
            let (path, value) = refused(toml);
            format!("{path} = {value}")
        };
        assert_eq!(place("'' = 1"), r#""" = 1"#);
        assert_eq!(place("'a.b' = 2"), r#""a.b" = 2"#);
        assert_eq!(place("[[rows]]\n'' = 3"), r#"rows[0]."" = 3"#);
        assert_eq!(place("[cage]\n'' = 4"), r#"cage."" = 4"#);
        assert_eq!(place("loads.'a[0]'.x = 5"), r#"loads."a[0]".x = 5"#);
        assert_eq!(place(r#""\u001b" = 6"#), r#""\u{1b}" = 6"#);
        assert_eq!(place("Größe-1 = 7"), "scene = not TOML");
    }

    /// Golden: the names of a defect's fields in a document.
    #[test]
    fn shape_and_walls_of_a_defect_are_set_by_their_paths() {
        let mut scene = presets::deep_groove_6205(500.0, 0.0, 1797.0);
        let defect = Defect::of(
            Patch::of_width(2e-3).length(1e-3).edge_radius(0.0),
            Surface::OuterRace,
            -1.57,
        );
        scene.defects.insert("spall".to_owned(), defect.clone());
        let walled = scene.with(&[("defects.spall.walls", "steep".into())]);
        let steep = SteepPatch::of_width(2e-3).length(1e-3);
        assert_eq!(walled.unwrap().defects["spall"].damage, steep.into());
        let round = [
            ("defects.spall.shape", "pit".into()),
            ("defects.spall.length", 0.0.into()),
        ];
        let pitted = scene.with(&round).unwrap();
        let pit = Pit::of_width(2e-3);
        assert_eq!(pitted.defects["spall"].damage, pit.into());
    }

    #[test]
    fn an_empty_path_is_refused() {
        let scene = crate::scene::presets::wheel_bearing(0.0);
        let Err(Error::Scene { path, value, .. }) = scene.with(&[("", 1.0.into())]) else {
            panic!("it leads nowhere");
        };
        assert_eq!([path, value], [r#""""#; 2]);
    }
}
