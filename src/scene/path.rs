//! Dotted paths into the document: `loads.axial.force`, `rows[0].clearance`.

use serde_json::{Map, Value, json};

use crate::error::{Error, Result};

/// Parts of a scene whose entries have names that people choose.
const NAMED: [&str; 5] = ["loads", "moments", "unbalances", "defects", "probes"];

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
                let known = map.keys().cloned().collect::<Vec<_>>().join(", ");
                map.get_mut(key).ok_or_else(|| {
                    let new = a_new_one(path, key).unwrap_or_default();
                    Error::scene(path, key, format!("no such field; there are: {known}{new}"))
                })?
            }
            (Step::Index(index), Value::Array(items)) => {
                let count = items.len();
                items
                    .get_mut(index)
                    .ok_or_else(|| Error::scene(path, index, format!("an index below {count}")))?
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

/// Names what a scene does not write where it is absent, so that [`set`] finds its place.
pub(super) fn show_absent(scene: &mut Value) {
    let mut show = |parts: &[&str], fields: &[&str]| {
        for part in all_of(scene, parts) {
            for field in fields {
                part.entry(*field).or_insert(Value::Null);
            }
        }
    };
    show(&[], &["lubricant", "spin"]);
    show(&["rows", ALL], &["lubricant"]);
    for ring in ["outer_ring", "inner_ring"] {
        show(&[ring], &["tilt", "transverse_inertia", "centre_of_mass"]);
        show(&[ring, "support"], &["tilt_x", "tilt_y", "coupled"]);
    }
    show(&["loads", ALL], &["at"]);
    show(&["unbalances", ALL], &["axial_position"]);
    if let Some(scene) = scene.as_object_mut() {
        scene.entry("moments").or_insert_with(|| json!({}));
    }
}

/// Stands for all entries of a list or of named parts.
const ALL: &str = "*";

/// The parts of a document under some keys.
fn all_of<'v>(document: &'v mut Value, keys: &[&str]) -> Vec<&'v mut Map<String, Value>> {
    let mut parts = vec![document];
    for key in keys {
        parts = parts
            .into_iter()
            .flat_map(|part| -> Vec<&mut Value> {
                match (part, *key) {
                    (Value::Object(map), ALL) => map.values_mut().collect(),
                    (Value::Array(items), ALL) => items.iter_mut().collect(),
                    (Value::Object(map), key) => map.get_mut(key).into_iter().collect(),
                    _ => Vec::new(),
                }
            })
            .collect();
    }
    let maps = parts.into_iter().filter_map(Value::as_object_mut);
    maps.collect()
}

/// The value at `path`, if there is one.
pub(super) fn get<'v>(document: &'v Value, path: &str) -> Option<&'v Value> {
    steps(path)
        .ok()?
        .into_iter()
        .try_fold(document, |place, step| match step {
            Step::Key(key) => place.get(key),
            Step::Index(index) => place.get(index),
        })
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
        Error::scene(
            path,
            path,
            "names joined by dots, with [n] for a place in a list",
        )
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
/// How to give a new entry, of which a path names but a field.
fn a_new_one(path: &str, key: &str) -> Option<String> {
    let (part, rest) = path.split_once('.')?;
    let field = rest.strip_prefix(key)?;
    (NAMED.contains(&part) && !field.is_empty())
        .then(|| format!("; a new one is given whole, as {part}.{key}"))
}
