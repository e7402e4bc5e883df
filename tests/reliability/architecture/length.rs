//! How long functions and files are. A line of a function counts where it says something: blank lines, comments and lines of
//! closing brackets alone do not.

use super::sources::{Source, all, code};

const LONGEST_FUNCTION: usize = 80;
const SHORT_FUNCTION: usize = 20;
const LONGEST_FILE: usize = 450;
const MEDIAN_FILE: usize = 150;

/// Whether a line says something.
fn says(line: &str) -> bool {
    line.contains(|c: char| !c.is_whitespace() && !"})];,".contains(c))
}

/// Name of the function that a line begins, if it begins one.
fn begun(line: &str) -> Option<&str> {
    let (before, after) = line.trim_start().split_once("fn ")?;
    let is_declared = before.split_whitespace().all(|of| {
        of.starts_with("pub") || ["const", "unsafe", "(crate)"].contains(&of) || of.ends_with(')')
    });
    let name = super::word(after);
    (is_declared && !name.is_empty()).then_some(name)
}

/// Functions of formatted code with their lengths. A body ends at the bracket under the line that begins it.
fn functions(code: &str) -> Vec<(String, usize)> {
    let lines: Vec<&str> = code.lines().map(str::trim_end).collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let Some(name) = begun(line) else { continue };
        let signature = lines[at..]
            .iter()
            .take_while(|line| !line.ends_with(['{', ';', '}']))
            .count();
        match lines[at + signature].chars().last() {
            Some('{') => {}
            Some('}') => {
                found.push((name.to_owned(), 0));
                continue;
            }
            _ => continue,
        }
        let indent = line.len() - line.trim_start().len();
        let end = format!("{}}}", " ".repeat(indent));
        let body = lines[at + signature + 1..]
            .iter()
            .take_while(|line| **line != end);
        found.push((name.to_owned(), body.filter(|line| says(line)).count()));
    }
    found
}

/// What is longer than it should be, of so many functions.
fn too_long(sources: &[Source]) -> (Vec<String>, usize) {
    let (mut found, mut short, mut count) = (Vec::new(), 0, 0);
    let mut sizes = Vec::new();
    for (path, text) in sources {
        sizes.push(text.lines().count());
        if text.lines().count() >= LONGEST_FILE {
            found.push(format!("{path} has {} lines", text.lines().count()));
        }
        for (name, lines) in functions(&code(text)) {
            count += 1;
            short += usize::from(lines <= SHORT_FUNCTION);
            if lines > LONGEST_FUNCTION {
                found.push(format!("{path}: {name} has {lines} lines"));
            }
        }
    }
    if 10 * short < 9 * count {
        found.push(format!("{short} of {count} functions are short"));
    }
    sizes.sort_unstable();
    if sizes[sizes.len() / 2] >= MEDIAN_FILE {
        found.push(format!(
            "the median file has {} lines",
            sizes[sizes.len() / 2]
        ));
    }
    (found, count)
}

#[test]
fn functions_and_files_are_short() {
    let (found, count) = too_long(&all());
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(count > 1000, "the test looked at {count} functions only");
}

#[test]
fn long_ones_are_seen() {
    let function = |lines: usize| {
        let body =
            "        let x = [\n            1,\n        ];\n\n        // Why.\n".repeat(lines / 2);
        format!(
            "impl A {{\n    pub(crate) const fn f(\n        x: f64,\n    ) -> f64 {{\n{body}    }}\n}}\n"
        )
    };
    assert_eq!(functions(&code(&function(80))), [("f".to_owned(), 80)]);
    let declared = "trait T {\n    fn f(&self);\n    fn g() {}\n}\n";
    assert_eq!(functions(declared), [("g".to_owned(), 0)]);
    let look = |text: String| {
        let beside = |path: &str| (path.to_owned(), String::new());
        too_long(&[("a.rs".to_owned(), text), beside("b.rs"), beside("c.rs")]).0
    };
    let short = "fn g() {\n    f();\n}\n".repeat(9);
    assert_eq!(look(function(80) + &short), Vec::<String>::new());
    assert_eq!(look(function(82) + &short), ["a.rs: f has 82 lines"]);
    assert_eq!(look(function(22)), ["0 of 1 functions are short"]);
    assert_eq!(look("// a\n".repeat(450)), ["a.rs has 450 lines"]);
    let two = [1, 2].map(|i| (format!("{i}.rs"), "// a\n".repeat(150)));
    assert_eq!(too_long(&two).0, ["the median file has 150 lines"]);
}
