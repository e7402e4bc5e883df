//! The public interface of the crate is the list in `tests/documents/interface_rust.txt`: exported names with their attributes, fields,
//! variants and methods. Golden: what is meant to change it is written anew by
//! `MINT=1 cargo test --test reliability architecture::interface`.

use std::collections::BTreeSet;
use std::path::Path;
use std::{env, fs};

use super::public::{after, items, public_name, signatures};
use super::sources::{Source, all, code, test_files, word};

const KINDS: [&str; 7] = ["struct", "enum", "trait", "type", "const", "fn", "const fn"];

/// Names that a `use` brings in, by the names under which it does so.
fn brought(path: &str) -> impl Iterator<Item = &str> {
    let names = path.split_once('{').map_or_else(
        || path.rsplit("::").next().unwrap_or(path),
        |(_, names)| names,
    );
    let names = names.split([',', '}', ';']).map(str::trim);
    let shown = names.map(|name| name.rsplit(" as ").next().unwrap_or(name));
    shown.filter(|name| !name.is_empty())
}

fn is_public(item: &str) -> bool {
    !item.contains("#[doc(hidden)]") && item.lines().any(|line| line.starts_with("pub "))
}

/// Names that a file shows to other crates: its public items, what it brings in, and what its public modules show.
fn shown(path: &str, sources: &[Source], found: &mut BTreeSet<String>) {
    let Some((_, text)) = sources.iter().find(|(of, _)| of == path) else {
        return;
    };
    let folder = path.trim_end_matches("mod.rs").trim_end_matches("lib.rs");
    for item in items(&code(text)).iter().filter(|item| is_public(item)) {
        let brings = after(item, "use ");
        let all_of = brings
            .and_then(|path| path.split_once("::*"))
            .map(|of| of.0);
        if let Some(path) = brings.filter(|_| all_of.is_none()) {
            found.extend(brought(path).map(str::to_owned));
        }
        found.extend(
            KINDS
                .iter()
                .filter_map(|kind| public_name(item, kind))
                .map(str::to_owned),
        );
        if let Some(module) = all_of.or(after(item, "mod ").map(word)) {
            shown(&format!("{folder}{module}/mod.rs"), sources, found);
            shown(&format!("{folder}{module}.rs"), sources, found);
        }
    }
}

/// On one line.
fn line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What an item shows, where it is one of the exported names or an implementation for one.
fn lines_of(item: &str, exported: &BTreeSet<String>) -> Vec<String> {
    let named = KINDS.iter().find_map(|kind| public_name(item, kind));
    if let Some(name) = named.filter(|name| exported.contains(*name)) {
        let head = line(item.split(['{', ';']).next().unwrap_or(""));
        let parts = signatures(item, exported)
            .into_iter()
            .map(|part| line(&part));
        let parts = parts.filter(|part| !head.ends_with(part.as_str()));
        return std::iter::once(head.clone())
            .chain(parts.map(|part| format!("{name}: {part}")))
            .collect();
    }
    let Some((of, _)) = after(item, "impl").and_then(|of| of.split_once('{')) else {
        return Vec::new();
    };
    let of = line(of);
    let target = of.rsplit(" for ").next().unwrap_or(&of).trim_start();
    let target = target.split_once("> ").map_or(target, |(_, rest)| rest);
    if !exported.contains(word(target)) {
        return Vec::new();
    }
    let parts = signatures(item, exported)
        .into_iter()
        .map(|part| line(&part));
    parts.map(|part| format!("impl {of}: {part}")).collect()
}

/// The list, in the order of the alphabet.
fn interface(sources: &[Source]) -> BTreeSet<String> {
    let mut exported = BTreeSet::new();
    shown("lib.rs", sources, &mut exported);
    let tests = test_files(sources);
    let crate_itself = sources
        .iter()
        .filter(|(path, _)| !tests.contains(path) && !path.starts_with("python/"));
    crate_itself
        .flat_map(|(_, text)| items(&code(text)))
        .flat_map(|item| lines_of(&item, &exported))
        .collect()
}

#[test]
fn the_interface_is_the_one_that_is_written_down() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/documents/interface_rust.txt");
    let found = interface(&all());
    assert!(
        found.len() > 900,
        "the test looked at {} lines only",
        found.len()
    );
    if env::var_os("MINT").is_some() {
        let lines: Vec<&str> = found.iter().map(String::as_str).collect();
        fs::write(&path, lines.join("\n") + "\n").unwrap();
    }
    let written = fs::read_to_string(&path).unwrap();
    let written: BTreeSet<String> = written.lines().map(str::to_owned).collect();
    let gone: Vec<&String> = written.difference(&found).collect();
    let new: Vec<&String> = found.difference(&written).collect();
    assert!(
        gone.is_empty() && new.is_empty(),
        "gone: {gone:#?}\nnew: {new:#?}"
    );
}

/// What is added to or taken from an exported name is seen; what is not exported is not.
#[test]
fn changes_are_seen() {
    let look = |planted: &str| {
        let root = "mod a;\npub mod b;\npub use a::{Open, run as go};\n#[doc(hidden)]\npub mod inside {\n}\n";
        let a = format!(
            "#[derive(Debug)]\npub struct Open {{\n    pub x: f64,\n}}\npub struct Hidden;\n{planted}"
        );
        let sources = [
            ("lib.rs", root.to_owned()),
            ("a.rs", a),
            ("b.rs", "pub fn known() -> f64 {\n    1.0\n}\n".to_owned()),
        ];
        interface(&sources.map(|(path, text)| (path.to_owned(), text)))
    };
    let bare = look("");
    let expected = [
        "#[derive(Debug)] pub struct Open",
        "Open: x: f64",
        "pub fn known() -> f64",
    ];
    assert_eq!(bare, expected.map(str::to_owned).into());
    let added = look("impl Open {\n    pub fn y(&self) -> f64 {\n        1.0\n    }\n}\n");
    assert!(added.contains("impl Open: fn y(&self) -> f64"), "{added:?}");
    let converted =
        look("impl From<f64> for Open {\n    fn from(x: f64) -> Self {\n        Self\n    }\n}\n");
    assert_eq!(converted.len(), bare.len() + 1, "{converted:?}");
    assert_eq!(
        look("impl Hidden {\n    pub fn y(&self) {\n    }\n}\n"),
        bare
    );
}
