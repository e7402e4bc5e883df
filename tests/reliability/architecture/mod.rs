//! The modules keep their order: who may use whom, by path, by group, by re-export or by an inherent impl; and `pyo3` only under
//! `src/python`. What is public has no type
//! of the libraries beneath (`public`), files of a room name each other one way (`circles`), and functions and
//! files are short (`length`). What documents leave out is found by its path (`left_out`). A type name is declared once (`names`).
//! Documentation cites what there is (`cites`).

mod circles;
mod cites;
mod interface;
mod left_out;
mod length;
mod names;
mod public;
mod sources;

use std::collections::{BTreeMap, BTreeSet};

use sources::{Source, all, code, test_files, word};

/// Rooms from the bottom to the top; a room may use those before it and itself.
const ORDER: [&str; 19] = [
    "base",
    "simd",
    "integrate",
    "scene",
    "tilt",
    "contact",
    "model",
    "forces",
    "inspect",
    "reduction",
    "dynamics",
    "velocities",
    "statics",
    "signals",
    "run",
    "explain",
    "features",
    "campaign",
    "python",
];

fn room(path: &str) -> &str {
    path.split(['/', '.']).next().unwrap()
}

/// The entries of a group `{a::{b, c}, d}` that a text begins with.
fn entries(text: &str) -> Vec<&str> {
    let (mut depth, mut found, mut from) = (0, Vec::new(), 1);
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 1 => {
                found.push(text[from..at].trim());
                break;
            }
            '}' => depth -= 1,
            ',' if depth == 1 => {
                found.push(text[from..at].trim());
                from = at + 1;
            }
            _ => {}
        }
    }
    found.retain(|entry| !entry.is_empty());
    found
}

/// What code names of the crate: the first part of every path, of groups too; in a file at the top `super` is the crate.
fn named(path: &str, code: &str) -> Vec<String> {
    let root = if path.contains('/') && !is_room_root(path) {
        &["crate::"][..]
    } else {
        &["crate::", "super::"]
    };
    let mut found = Vec::new();
    for part in root.iter().flat_map(|root| code.split(root).skip(1)) {
        found.extend(named_after(part));
    }
    found
}

/// The names that stand behind a path: one, or those of a group.
fn named_after(part: &str) -> Vec<String> {
    let names = if part.starts_with('{') {
        entries(part)
    } else {
        vec![part]
    };
    names
        .into_iter()
        .map(|name| word(name).to_owned())
        .collect()
}

/// Whether a file is the `mod.rs` of a room.
fn is_room_root(path: &str) -> bool {
    path.matches('/').count() == 1 && path.ends_with("/mod.rs")
}

/// The room of every name that `lib.rs` re-exports.
fn reexports(lib: &str) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for part in code(lib).split("pub use ").skip(1) {
        let (from, rest) = part.split_once("::").unwrap_or((part, ""));
        let names = if rest.starts_with('{') {
            entries(rest)
        } else {
            vec![word(rest)]
        };
        for name in names {
            let name = name.rsplit(" as ").next().unwrap_or(name);
            found.insert(word(name).to_owned(), from.to_owned());
        }
    }
    found
}

/// Types that code declares.
fn declared(code: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for keyword in ["struct ", "enum ", "trait ", "type "] {
        for part in code.split(keyword).skip(1) {
            found.insert(word(part).to_owned());
        }
    }
    found
}

/// Types that code has inherent impls for.
fn inherent(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for part in format!("\n{code}").split("\nimpl").skip(1) {
        let head = part.split('{').next().unwrap();
        if head.contains(" for ") {
            continue;
        }
        let mut depth = 0;
        let generics = head.starts_with('<');
        let end = head.find(|c| {
            depth += i32::from(c == '<') - i32::from(c == '>');
            generics && depth == 0
        });
        let rest = head[end.map_or(0, |end| end + 1)..].trim();
        found.push(word(rest.rsplit("::").next().unwrap()).to_owned());
    }
    found
}

/// What stands against an order of rooms, and how many uses were looked at.
fn violations(sources: &[Source], order: &[&str]) -> (Vec<String>, usize) {
    let tests = test_files(sources);
    let lib = sources.iter().find(|(path, _)| path == "lib.rs");
    let reexports = lib.map(|(_, text)| reexports(text)).unwrap_or_default();
    let rooms: Vec<(&str, String)> = sources
        .iter()
        .filter(|(path, _)| path != "lib.rs" && !tests.contains(path))
        .map(|(path, text)| (path.as_str(), code(text)))
        .collect();
    let mut own: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    for (path, code) in &rooms {
        own.entry(room(path)).or_default().extend(declared(code));
    }
    let (mut found, mut seen) = (Vec::new(), 0);
    for (path, code) in &rooms {
        let place = |room: &str| order.iter().position(|other| *other == room);
        let Some(here) = place(room(path)) else {
            found.push(format!("{path} belongs to no room of the order"));
            continue;
        };
        for name in named(path, code) {
            let other = reexports.get(&name).unwrap_or(&name);
            seen += 1;
            if place(other).is_some_and(|other| other > here) {
                found.push(format!("{path} uses {name} of {other}"));
            }
        }
        for name in inherent(code) {
            if !own[room(path)].contains(&name) {
                found.push(format!(
                    "{path} has an inherent impl of {name}, which is not its own"
                ));
            }
        }
    }
    (found, seen)
}

#[test]
fn rooms_import_downwards() {
    let (found, seen) = violations(&all(), &ORDER);
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(seen > 300, "the test looked at {seen} uses only");
}

/// A planted violation of each kind is found, and nothing else.
#[test]
fn violations_are_seen() {
    let look = |low: &str| {
        let sources = [
            (
                "lib.rs",
                "pub use high::{Thing, other as Alias};\npub use low::Small;\n",
            ),
            ("low/mod.rs", low),
            ("low/deep.rs", "pub struct Small;\nimpl<'a> Small<'a> {}\n"),
            (
                "high.rs",
                "use crate::low::Small;\npub struct Thing;\nimpl Thing {}\n",
            ),
        ];
        let sources = sources.map(|(path, text)| (path.to_owned(), text.to_owned()));
        violations(&sources, &["low", "high"]).0
    };
    for (planted, expected) in [
        ("use crate::high::Thing;", "low/mod.rs uses high of high"),
        (
            "use crate::{low::deep, high};",
            "low/mod.rs uses high of high",
        ),
        (
            "use crate::{\n    low::{a, b},\n    Thing,\n};",
            "low/mod.rs uses Thing of high",
        ),
        ("fn f() { crate::Alias() }", "low/mod.rs uses Alias of high"),
        ("use super::high;", "low/mod.rs uses high of high"),
        (
            "impl<T: Into<f64>> Thing<T> {\n}",
            "low/mod.rs has an inherent impl of Thing, which is not its own",
        ),
    ] {
        assert_eq!(look(planted), [expected], "{planted}");
    }
    for allowed in [
        "// crate::high",
        "use crate::Small;",
        "impl Small {}",
        "impl Clone for Thing {}",
        "#[cfg(test)]\nmod tests {\n    use crate::Thing;\n}",
    ] {
        assert!(look(allowed).is_empty(), "{allowed}: {:?}", look(allowed));
    }
    let stray = [("stray.rs".to_owned(), String::new())];
    assert_eq!(
        violations(&stray, &["low"]).0,
        ["stray.rs belongs to no room of the order"]
    );
}

#[test]
fn python_stays_in_its_room() {
    for (path, text) in all() {
        if !path.starts_with("python/") {
            assert!(!text.contains("pyo3"), "{path} says pyo3");
        }
    }
}

/// Some systems have neither threads nor a clock: each is asked for in one place.
#[test]
fn threads_and_clock_have_one_place() {
    for (what, place) in [
        ("rayon::", "base/pool.rs"),
        ("Instant::now", "base/clock.rs"),
    ] {
        let sources = all().into_iter();
        let users = sources
            .filter(|(path, text)| !path.starts_with("python/") && code(text).contains(what));
        let users: Vec<String> = users.map(|(path, _)| path).collect();
        assert_eq!(users, [place], "{what}");
    }
}
