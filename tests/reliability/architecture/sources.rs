//! The sources of the crate as text, as the tests of its architecture read them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Path below `src` and text.
pub type Source = (String, String);

fn sources(folder: &Path, found: &mut Vec<Source>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push((
                path.to_string_lossy().into_owned(),
                fs::read_to_string(&path).unwrap(),
            ));
        }
    }
}

pub fn all() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    sources(&root, &mut found);
    let prefix = root.to_string_lossy().into_owned() + "/";
    found
        .into_iter()
        // The bindings are a room that is a crate.
        .map(|(path, text)| {
            (
                path.replace(&prefix, "")
                    .replace("python/lib.rs", "python/mod.rs"),
                text,
            )
        })
        .collect()
}

/// The code of a file: without comments, and without its tests, which may use all.
pub fn code(text: &str) -> String {
    let before = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
    let lines = before.lines();
    lines
        .map(|line| line.split("//").next().unwrap_or("").to_owned() + "\n")
        .collect()
}

/// Files that are declared as tests, such as `#[cfg(test)] mod lost;`.
pub fn test_files(sources: &[Source]) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (path, text) in sources {
        let folder = path.strip_suffix("mod.rs").unwrap_or("");
        for part in text.split("#[cfg(test)]\nmod ").skip(1) {
            if let Some((name, _)) = part.split_once(';') {
                found.insert(format!("{folder}{name}.rs"));
            }
        }
    }
    found
}

pub fn word(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_');
    &text[..end.unwrap_or(text.len())]
}
