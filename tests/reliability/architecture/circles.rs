//! Files of one folder name each other in one direction only.

use std::collections::{BTreeMap, BTreeSet};

use super::sources::{Source, all, code, test_files, word};
use super::{entries, named_after};

/// Who of a folder names whom.
type Graph<'a> = BTreeMap<&'a str, BTreeSet<&'a str>>;

/// The part of a folder that a path below it belongs to: `a` of `a.rs`, of `a/mod.rs` and of `a/b.rs`.
fn part(below: &str) -> &str {
    word(below)
}

/// The part that declares each name which the folder's `mod.rs` brings in or re-exports.
fn brought<'a>(root: &'a str, parts: &BTreeSet<&'a str>) -> BTreeMap<&'a str, &'a str> {
    let mut found = BTreeMap::new();
    for rest in root.split("use ").skip(1) {
        let Some((from, names)) = rest.split_once("::") else {
            continue;
        };
        let Some(from) = parts.get(from) else {
            continue;
        };
        let names = if names.starts_with('{') {
            entries(names)
        } else {
            vec![word(names)]
        };
        let shown = names
            .iter()
            .map(|name| name.rsplit(" as ").next().unwrap_or(name));
        found.extend(shown.map(|name| (word(name), *from)));
    }
    found
}

/// What a file, by its path below a folder, names of the folder.
fn of_folder(folder: &str, below: &str, code: &str) -> Vec<String> {
    let up = below.matches('/').count() + usize::from(!below.ends_with("/mod.rs"));
    let relative = "super::".repeat(up);
    let absolute = format!("crate::{}::", folder.replace('/', "::"));
    // One `super` less than asked for is another folder, one more a higher one.
    let relative = code
        .split(&relative)
        .collect::<Vec<_>>()
        .windows(2)
        .filter(|pair| !pair[0].ends_with("super::") && !pair[1].starts_with("super::"))
        .map(|pair| pair[1])
        .collect::<Vec<_>>();
    let absolute = code.split(&absolute).skip(1);
    relative
        .into_iter()
        .chain(absolute)
        .flat_map(named_after)
        .collect()
}

fn graph<'a>(folder: &str, files: &'a BTreeMap<String, String>) -> Graph<'a> {
    let prefix = format!("{folder}/");
    let inside = || {
        files
            .iter()
            .filter_map(|(path, code)| Some((path.strip_prefix(&prefix)?, code)))
    };
    let parts: BTreeSet<&str> = inside()
        .map(|(below, _)| part(below))
        .filter(|of| *of != "mod")
        .collect();
    let brought = brought(&files[&format!("{prefix}mod.rs")], &parts);
    let mut graph = Graph::new();
    for (below, code) in inside().filter(|(below, _)| *below != "mod.rs") {
        let from = part(below);
        for name in of_folder(folder, below, code) {
            let to = parts
                .get(name.as_str())
                .or_else(|| brought.get(name.as_str()));
            graph
                .entry(from)
                .or_default()
                .extend(to.filter(|to| **to != from));
        }
    }
    graph
}

/// All that can be reached from a part.
fn reached<'a>(graph: &Graph<'a>, from: &str) -> BTreeSet<&'a str> {
    let (mut found, mut next) = (BTreeSet::new(), vec![from]);
    while let Some(of) = next.pop() {
        for to in graph.get(of).into_iter().flatten() {
            if found.insert(*to) {
                next.push(to);
            }
        }
    }
    found
}

/// Circles of all folders, and how many uses were looked at.
fn circles(sources: &[Source]) -> (BTreeSet<String>, usize) {
    let tests = test_files(sources);
    let files: BTreeMap<String, String> = sources
        .iter()
        .filter(|(path, _)| !tests.contains(path))
        .map(|(path, text)| (path.clone(), code(text)))
        .collect();
    let (mut found, mut seen) = (BTreeSet::new(), 0);
    for folder in files.keys().filter_map(|path| path.strip_suffix("/mod.rs")) {
        let graph = graph(folder, &files);
        seen += graph.values().map(BTreeSet::len).sum::<usize>();
        for from in graph.keys() {
            let there = reached(&graph, from);
            if there.contains(from) {
                let back = there.iter().filter(|to| reached(&graph, to).contains(from));
                let circle: Vec<&str> = back.copied().collect();
                found.insert(format!("{folder}: {}", circle.join(", ")));
            }
        }
    }
    (found, seen)
}

#[test]
fn files_of_a_folder_name_each_other_one_way() {
    let (found, seen) = circles(&all());
    assert!(found.is_empty(), "{found:?}");
    assert!(seen > 150, "the test looked at {seen} uses only");
}

/// A circle by path, by group, by what `mod.rs` re-exports, and from a folder below is found; a parent is no circle.
#[test]
fn circles_are_seen() {
    let look = |first: (&str, &str), second: (&str, &str)| {
        let root = (
            "room/mod.rs",
            "mod a;\nmod b;\npub use b::{Thing as Alias, Other};\npub struct Root;\n",
        );
        let sources = [root, first, second].map(|(path, text)| (path.to_owned(), text.to_owned()));
        circles(&sources).0.into_iter().collect::<Vec<_>>()
    };
    let b = ("room/b.rs", "use super::a::A;\n");
    for planted in [
        ("room/a.rs", "use super::b::Thing;\n"),
        ("room/a.rs", "use super::{Root, b};\n"),
        ("room/a.rs", "use super::Alias;\n"),
        ("room/a.rs", "use crate::room::Other;\n"),
        ("room/a/deep.rs", "use super::super::Other;\n"),
    ] {
        assert_eq!(look(planted, b), ["room: a, b"], "{planted:?}");
    }
    for allowed in [
        ("room/a.rs", "use super::Root;\n"),
        ("room/a.rs", "// super::b\n"),
        ("room/a/deep.rs", "use super::b;\n"),
    ] {
        assert!(look(allowed, b).is_empty(), "{allowed:?}");
    }
}
