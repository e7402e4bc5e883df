//! The rooms keep their order: who may import whom, and `pyo3` only under `src/python`.

use std::fs;
use std::path::Path;

/// Rooms from the bottom to the top; a room may use those before it and itself.
const ORDER: [&str; 35] = [
    "told",
    "error",
    "memory",
    "interrupt",
    "simd",
    "scene",
    "contact",
    "integrate",
    "model",
    "dynamics",
    "pool",
    "equilibrium",
    "start",
    "accuracy",
    "selftest",
    "residual",
    "touched",
    "step_limit",
    "method",
    "signals",
    "run",
    "warning",
    "collapse",
    "budget",
    "runaway",
    "orbit",
    "escape",
    "ending",
    "follow",
    "settle",
    "simulate",
    "explain",
    "features",
    "campaign",
    "python",
];
fn sources(folder: &Path, found: &mut Vec<(String, String)>) {
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

fn all() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    sources(&root, &mut found);
    let prefix = root.to_string_lossy().into_owned() + "/";
    found
        .into_iter()
        .map(|(path, text)| (path.replace(&prefix, ""), text))
        .collect()
}

#[test]
fn rooms_import_downwards() {
    let place = |room: &str| ORDER.iter().position(|r| *r == room);
    let mut seen = 0;
    for (path, text) in all() {
        let room = path.split(['/', '.']).next().unwrap();
        let Some(own) = place(room) else { continue };
        for line in text.lines().filter(|l| !l.trim_start().starts_with("//")) {
            for part in line.split("crate::").skip(1) {
                let used: String = part
                    .chars()
                    .take_while(|c| c.is_alphanumeric() || *c == '_')
                    .collect();
                let Some(other) = place(&used) else { continue };
                seen += 1;
                assert!(other <= own, "{path} uses {used}: {line}");
            }
        }
    }
    assert!(seen > 30, "the test looked at {seen} imports only");
}

#[test]
fn python_stays_in_its_room() {
    for (path, text) in all() {
        if !path.starts_with("python/") {
            assert!(!text.contains("pyo3"), "{path} says pyo3");
        }
    }
}
