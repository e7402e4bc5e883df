//! What the fuzzer begins with, made from the scenes of the crate and the examples of `tests/fuzz/corpus`, and the names that it
//! tries.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

use ballrace::{Error, Scene};
use serde_json::{Value, json};

use crate::bases::{self, Base};
use crate::changes::{Place, places};

/// Places of a scene in a seed.
const A_SEED: usize = 6;
/// Longest entry of a dictionary \[bytes\].
const LONGEST: usize = 60;

const TOKENS: [&str; 24] = [
    "[[rows]]\n",
    "[rows]",
    "[grid]",
    "[0]",
    "[99999999999999999999]",
    " = ",
    "1e999",
    "nan",
    "-inf",
    "-0.0",
    "0x1f",
    "1_000",
    "1979-05-27",
    "true",
    "null",
    "\\u0000",
    "\\ud800",
    "'''",
    "{}",
    "[]",
    "5e-324",
    "1.8e308",
    "18446744073709551616",
    "\"\"",
];

/// Writes seeds and names for a target into the folder that `BALLRACE_FUZZ_FOLDER` names, if there is one.
pub fn write(target: &str) {
    let Ok(folder) = env::var("BALLRACE_FUZZ_FOLDER") else {
        return;
    };
    let folder = PathBuf::from(folder);
    let seeds = folder.join("seeds");
    fs::create_dir_all(&seeds).expect("a folder");
    for (number, seed) in of(target).into_iter().enumerate() {
        fs::write(seeds.join(format!("{number:04}")), seed).expect("a seed");
    }
    fs::write(folder.join("names.dict"), dictionary()).expect("a dictionary");
}

fn of(target: &str) -> Vec<Vec<u8>> {
    match target {
        "scene_text" => scenes(),
        "paths" => bases::all().iter().flat_map(paths).collect(),
        "short_run" => short_runs(),
        _ => sweeps(),
    }
}

fn scenes() -> Vec<Vec<u8>> {
    let bases = bases::all().iter();
    let written = bases.flat_map(|base| [base.scene.to_toml(), base.scene.to_json()]);
    let people = include_str!("../../../documents/schema_1.toml").to_owned();
    let written = written.chain([people]).map(String::into_bytes);
    written.chain(corpus("scenes")).collect()
}

/// Files of the corpus.
fn corpus(kind: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../corpus")
        .join(kind);
    let files = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<_> = files.map(|file| file.path()).collect();
    files.sort();
    files
        .iter()
        .filter_map(|file| fs::read(file).ok())
        .collect()
}

/// The values of a scene, some in a seed, by their paths.
fn paths(base: &Base) -> Vec<Vec<u8>> {
    let lines = places(&base.document)
        .into_iter()
        .map(|Place { pointer, path, .. }| {
            let value = base.document.pointer(&pointer).expect("it is there");
            format!("{path} = {value}\n")
        });
    let lines: Vec<String> = lines.collect();
    let seeds = lines
        .chunks(A_SEED)
        .map(|some| format!("{}\n{}", base.name, some.concat()));
    seeds.map(String::into_bytes).collect()
}

/// Every scene by every method, from both starts, unchanged and with its first place changed.
fn short_runs() -> Vec<Vec<u8>> {
    let mut seeds = Vec::new();
    for base in 0..bases::all().len() {
        for method in 0..10 {
            let (base, method) = (u8::try_from(base).expect("few"), method);
            let start = method % 2;
            seeds.push(vec![
                base,
                method,
                0,
                9,
                start,
                0,
                0,
                start,
                0,
                0,
                method % 3,
                7,
                0,
                method,
                3,
                200,
                1,
                5,
            ]);
        }
    }
    seeds
}

fn sweeps() -> Vec<Vec<u8>> {
    let run = "duration = 2e-5\nfs = 1e6\nsettle = 0.0\n";
    let mut seeds = corpus("sweeps");
    for base in bases::all() {
        for some in places(&base.document).chunks(A_SEED) {
            let mut text = format!("scene = {:?}\n{run}[grid]\n", base.name);
            for Place { pointer, path, .. } in some {
                let value = base.document.pointer(pointer).expect("it is there");
                if !value.is_null() {
                    let _ = writeln!(text, "{path:?} = {}", in_toml(&json!([value])));
                }
            }
            seeds.push(text.into_bytes());
        }
    }
    seeds
}

/// A value on one line, without what is absent.
fn in_toml(value: &Value) -> String {
    match value {
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(in_toml).collect();
            format!("[{}]", items.join(", "))
        }
        Value::Object(map) => {
            let there = map.iter().filter(|(_, value)| !value.is_null());
            let entries: Vec<String> = there
                .map(|(key, value)| format!("{key:?} = {}", in_toml(value)))
                .collect();
            format!("{{ {} }}", entries.join(", "))
        }
        other => other.to_string(),
    }
}

/// Names of fields, of their values, and what people write between them, as libFuzzer reads them.
fn dictionary() -> String {
    let mut words: BTreeSet<String> = TOKENS.map(str::to_owned).into();
    for base in bases::all() {
        for place in places(&base.document) {
            words.extend(offered(base, &place));
            words.extend([place.name, place.path]);
        }
    }
    let words = words
        .into_iter()
        .filter(|word| (1..LONGEST).contains(&word.len()));
    words
        .map(|word| format!("\"{}\"\n", escaped(&word)))
        .collect()
}

/// The names that the crate allows in a place, by its message about one that it does not know.
fn offered(base: &Base, place: &Place) -> Vec<String> {
    let is_text = base
        .document
        .pointer(&place.pointer)
        .is_some_and(|value| value.is_string() || value.is_object());
    if !is_text {
        return Vec::new();
    }
    let unknown = [json!("?"), json!({"?": 1})];
    let allowed = unknown.map(|value| match base.scene.with(&[(&place.path, value)]) {
        Err(Error::Scene { allowed, .. }) => allowed,
        _ => String::new(),
    });
    let names = allowed
        .iter()
        .flat_map(|text| text.split('"').skip(1).step_by(2));
    names.map(str::to_owned).collect()
}

fn escaped(word: &str) -> String {
    word.bytes().fold(String::new(), |mut text, byte| {
        let is_plain = (byte.is_ascii_graphic() || byte == b' ') && byte != b'"' && byte != b'\\';
        if is_plain {
            text.push(char::from(byte));
        } else {
            let _ = write!(text, "\\x{byte:02X}");
        }
        text
    })
}

/// The scene and the changes that a seed of `paths` says: a name, and a path and a value a line.
pub fn changes(text: &str) -> Option<(&'static Scene, Vec<(&str, Value)>)> {
    let (name, lines) = text.split_once('\n').unwrap_or((text, ""));
    let base = bases::named(name)?;
    let changes = lines.lines().map(|line| {
        let (path, value) = line.split_once(" = ").unwrap_or((line, "null"));
        let value = serde_json::from_str(value).unwrap_or_else(|_| json!(value));
        (path, value)
    });
    Some((&base.scene, changes.collect()))
}
