//! A type name of the crate is declared once. Bindings are a crate of their own: their classes wrap types of the same name.

use std::collections::BTreeMap;

use super::sources::{Source, all, code, test_files, word};

/// The type that a line declares at the top of a file.
fn declared(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("pub").map_or(line, |rest| {
        let visible = rest.strip_prefix('(').and_then(|rest| rest.split_once(')'));
        visible.map_or(rest, |(_, rest)| rest).trim_start()
    });
    let (keyword, name) = rest.split_once(' ')?;
    ["struct", "enum", "trait", "type"]
        .contains(&keyword)
        .then(|| word(name))
}

fn declared_twice(sources: &[Source]) -> Vec<String> {
    let tests = test_files(sources);
    let mut found: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (path, text) in sources {
        if tests.contains(path) || path.contains("/tests") || path.starts_with("python/") {
            continue;
        }
        for line in code(text).lines() {
            if let Some(name) = declared(line) {
                found.entry(name.to_owned()).or_default().push(path);
            }
        }
    }
    let twice = found.into_iter().filter(|(_, paths)| paths.len() > 1);
    twice
        .map(|(name, paths)| format!("{name}: {}", paths.join(", ")))
        .collect()
}

#[test]
fn a_type_name_is_declared_once() {
    let twice = declared_twice(&all());
    assert!(twice.is_empty(), "{twice:#?}");
}

#[test]
fn a_second_declaration_is_found() {
    let file = |path: &str, text: &str| (path.to_owned(), text.to_owned());
    let twice = declared_twice(&[
        file("a.rs", "pub(crate) struct Force(f64);\n// enum Slope\n"),
        file("b/mod.rs", "type Force<T> = [T; 3];\nenum Slope {}\n"),
    ]);
    assert_eq!(twice, ["Force: a.rs, b/mod.rs"]);
}
