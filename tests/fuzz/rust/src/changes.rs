//! Documents with some places changed: to values of their own size, to the ends of what is allowed, and to what is not.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use arbitrary::{Result, Unstructured};
use ballrace::{Error, Scene};
use serde_json::{Value, json};

use crate::bases;

/// Items of a list that are changed one by one.
const ITEMS: usize = 4;

const EDGES: [f64; 12] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    2.3e-308,
    5e-324,
    1e-300,
    1e-12,
    1e12,
    1e300,
    f64::MAX,
    -1e300,
];
const WHOLE: [u64; 10] = [0, 1, 2, 3, 12, 255, 1000, 1001, 1_000_000, u64::MAX];

/// A place of a document: where, and the name of the field that it is or is an item of.
pub struct Place {
    pub pointer: String,
    pub path: String,
    pub name: String,
}

/// All places of a document but the whole.
pub fn places(document: &Value) -> Vec<Place> {
    let mut found = Vec::new();
    let root = Place {
        pointer: String::new(),
        path: String::new(),
        name: String::new(),
    };
    add_places(document, &root, &mut found);
    found
}

fn add_places(value: &Value, place: &Place, found: &mut Vec<Place>) {
    let inner: Vec<(Place, &Value)> = match value {
        Value::Object(map) => map
            .iter()
            .map(|(key, value)| (field(place, key), value))
            .collect(),
        Value::Array(items) => {
            let items = items.iter().take(ITEMS).enumerate();
            items.map(|(i, value)| (item(place, i), value)).collect()
        }
        _ => Vec::new(),
    };
    for (place, value) in inner {
        add_places(value, &place, found);
        found.push(place);
    }
}

fn field(of: &Place, key: &str) -> Place {
    let dot = if of.path.is_empty() { "" } else { "." };
    Place {
        pointer: format!(
            "{}/{}",
            of.pointer,
            key.replace('~', "~0").replace('/', "~1")
        ),
        path: format!("{}{dot}{key}", of.path),
        name: key.to_owned(),
    }
}

fn item(of: &Place, index: usize) -> Place {
    Place {
        pointer: format!("{}/{index}", of.pointer),
        path: format!("{}[{index}]", of.path),
        name: of.name.clone(),
    }
}

/// Changes one place of a document.
pub fn change(u: &mut Unstructured<'_>, document: &mut Value) -> Result<()> {
    let places = places(document);
    if places.is_empty() {
        return Ok(());
    }
    let place = &places[usize::from(u.arbitrary::<u16>()?) % places.len()];
    let value = new_value(u, document, place)?;
    if let Some(there) = document.pointer_mut(&place.pointer) {
        *there = value;
    }
    Ok(())
}

fn new_value(u: &mut Unstructured<'_>, document: &Value, place: &Place) -> Result<Value> {
    let there = document.pointer(&place.pointer).unwrap_or(&Value::Null);
    let kind = u.arbitrary::<u8>()? % 16;
    match there {
        _ if kind == 15 => Ok(u.choose(&wrong())?.clone()),
        Value::Number(_) => some_number(u, document, place, kind),
        Value::Null if kind < 4 => some_number(u, document, place, kind),
        Value::Bool(yes) => Ok(json!(!yes)),
        Value::String(_) if kind < 8 => offered(u, document, place),
        Value::Array(_) | Value::Object(_) if kind < 8 => reshaped(u, there, &place.name),
        _ => pooled(u, &place.name),
    }
}

/// A number, of a kind from 0 to 14.
fn some_number(
    u: &mut Unstructured<'_>,
    document: &Value,
    place: &Place,
    kind: u8,
) -> Result<Value> {
    let there = document.pointer(&place.pointer).unwrap_or(&Value::Null);
    match kind {
        0..=7 => scaled(u, there, &place.name),
        8..=10 => bound(u, document, place),
        11 => Ok(json!(u.choose(&EDGES)?)),
        12 => Ok(json!(u.arbitrary::<f64>()?)),
        13 => Ok(json!(u.choose(&WHOLE)?)),
        _ => pooled(u, &place.name),
    }
}

/// A number of the size of what is there, or of what is elsewhere under that name.
fn scaled(u: &mut Unstructured<'_>, there: &Value, name: &str) -> Result<Value> {
    let size = match there.as_f64() {
        Some(value) if value != 0.0 => value,
        _ => typical(name),
    };
    let power = f64::from(u.arbitrary::<i8>()?) / 32.0;
    let sign = if u.ratio(1, 8)? { -1.0 } else { 1.0 };
    let value = sign * size * 10_f64.powf(power);
    if there.is_i64() || there.is_u64() {
        Ok(json!(value.round() as i64))
    } else {
        Ok(json!(value))
    }
}

/// Size of a field by its name.
fn typical(name: &str) -> f64 {
    let sizes = pool().get(name).into_iter().flatten();
    let sizes = sizes.filter_map(Value::as_f64);
    sizes.map(f64::abs).find(|size| *size > 0.0).unwrap_or(1e-3)
}

/// A value that some scene has under that name.
fn pooled(u: &mut Unstructured<'_>, name: &str) -> Result<Value> {
    match pool().get(name) {
        Some(values) if !values.is_empty() => Ok(u.choose(values)?.clone()),
        _ => Ok(Value::Null),
    }
}

/// The values of all scenes by the names of their fields.
fn pool() -> &'static BTreeMap<String, Vec<Value>> {
    static POOL: OnceLock<BTreeMap<String, Vec<Value>>> = OnceLock::new();
    POOL.get_or_init(|| {
        let mut pool: BTreeMap<String, Vec<Value>> = BTreeMap::new();
        for base in bases::all() {
            for place in places(&base.document) {
                let value = base.document.pointer(&place.pointer).expect("it is there");
                let values = pool.entry(place.name).or_default();
                if !value.is_null() && !values.contains(value) {
                    values.push(value.clone());
                }
            }
        }
        pool
    })
}

/// An end of what is allowed, or what is next to it, as the crate reports it of what is far beyond.
fn bound(u: &mut Unstructured<'_>, document: &Value, place: &Place) -> Result<Value> {
    let far = if u.arbitrary()? { 1e300 } else { -1e300 };
    let mut bounds = Vec::new();
    for word in refusal(document, place, json!(far)).split(" to ") {
        bounds.extend(number(word.trim_start_matches("from ")));
    }
    if bounds.is_empty() {
        return Ok(json!(far));
    }
    let end = *u.choose(&bounds)?;
    let factor = *u.choose(&[1.0, 1.0 - 1e-3, 1.0 + 1e-3, 1.0 - 1e-15, 1.0 + 1e-15])?;
    Ok(json!(end * factor))
}

/// The number that a text begins with, in SI units.
fn number(text: &str) -> Option<f64> {
    let mut words = text.split([' ', ',', ';']);
    let value: f64 = words.next()?.parse().ok()?;
    let unit = match words.next() {
        Some("nm") => 1e-9,
        Some("µm") => 1e-6,
        Some("mm") => 1e-3,
        Some("km") => 1e3,
        _ => 1.0,
    };
    Some(value * unit)
}

/// A name that the crate offers in that place.
fn offered(u: &mut Unstructured<'_>, document: &Value, place: &Place) -> Result<Value> {
    let allowed = refusal(document, place, json!("?"));
    let names: Vec<&str> = allowed.split('"').skip(1).step_by(2).collect();
    match names.is_empty() {
        true => Ok(json!("?")),
        false => Ok(json!(u.choose(&names)?)),
    }
}

/// What is allowed in a place, as reported where it has another value.
fn refusal(document: &Value, place: &Place, value: Value) -> String {
    let mut document = document.clone();
    if let Some(there) = document.pointer_mut(&place.pointer) {
        *there = value;
    }
    match Scene::from_json(&document.to_string()) {
        Err(Error::Scene { allowed, .. }) => allowed,
        _ => String::new(),
    }
}

/// Lists and tables with an entry more or less.
fn reshaped(u: &mut Unstructured<'_>, there: &Value, name: &str) -> Result<Value> {
    let mut value = there.clone();
    let at = usize::from(u.arbitrary::<u8>()?);
    match &mut value {
        Value::Array(items) if !items.is_empty() => {
            let at = at % items.len();
            match u.arbitrary::<u8>()? % 4 {
                0 => drop(items.remove(at)),
                1 => items.reverse(),
                2 => items.push(items[at].clone()),
                _ => items.extend(vec![items[at].clone(); 20]),
            }
        }
        Value::Object(map) if !map.is_empty() => {
            let key = map.keys().nth(at % map.len()).expect("a key").clone();
            let entry = map.remove(&key).expect("an entry");
            if u.arbitrary()? {
                map.insert("another".to_owned(), entry);
            }
        }
        _ => return pooled(u, name),
    }
    Ok(value)
}

fn wrong() -> [Value; 8] {
    [
        Value::Null,
        json!(true),
        json!("x"),
        json!(""),
        json!([]),
        json!({}),
        json!([1.0, 2.0]),
        json!({"a": 1}),
    ]
}
