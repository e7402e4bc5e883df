//! Documentation cites what is there: headings of the page on the model, in rustdoc as links to its copy in the crate
//! (`ballrace::equations`), and no file that the package does not contain. The copy is the page without what only the guide has: pictures, links to
//! other pages, Python, and marks of equations that rustdoc would print. It is written anew by
//! `MINT=1 cargo test --test reliability architecture::cites`.

use std::collections::BTreeSet;
use std::path::Path;
use std::{env, fs};

use super::sources::all;

/// Sections of the page that only the guide has.
const OF_THE_GUIDE: [&str; 1] = ["See it in numbers"];

fn read(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A line without links to other pages, and with equations as code.
fn plain(line: &str) -> String {
    let (mut found, mut rest) = (String::new(), line);
    while let Some(at) = rest.find(['[', '$']) {
        found += &rest[..at];
        let (mark, after) = (&rest[at..=at], &rest[at + 1..]);
        let link = after
            .split_once("](")
            .filter(|(text, _)| !text.contains('['));
        let link = link.and_then(|(text, after)| Some((text, after.split_once(')')?)));
        rest = match (mark, link, after.split_once('$')) {
            ("$", _, Some((equation, after))) => {
                found.extend(["`", equation, "`"]);
                after
            }
            ("[", Some((text, (target, after))), _) if target.starts_with('#') => {
                found.extend(["[", text, "](", target, ")"]);
                after
            }
            ("[", Some((text, (_, after))), _) => {
                found += text;
                after
            }
            _ => {
                found += mark;
                after
            }
        };
    }
    // Names of the crate are those of Python without its module.
    (found + rest).replace("`br.", "`")
}

/// The page as the crate has it.
fn copy(page: &str) -> String {
    let (mut found, mut is_in) = (String::new(), true);
    for paragraph in page.split("\n\n") {
        let paragraph = paragraph.trim_end();
        if let Some(heading) = paragraph.strip_prefix("## ") {
            is_in = !OF_THE_GUIDE.contains(&heading);
        }
        let of_pictures = paragraph.starts_with("![") || paragraph.contains("docs/figures");
        if !is_in || of_pictures {
            continue;
        }
        let equation = paragraph.strip_prefix("$$");
        match equation.and_then(|rest| rest.strip_suffix("$$")) {
            Some(equation) => found.extend(["```text\n", equation, "\n```\n"]),
            None => found.extend(paragraph.lines().map(|line| plain(line) + "\n")),
        }
        found.push('\n');
    }
    found.trim_end().to_owned() + "\n"
}

/// The part of an address that leads to a heading.
fn anchor(heading: &str) -> String {
    let letters = heading.to_lowercase();
    let letters = letters.chars().map(|c| if c == ' ' { '-' } else { c });
    letters
        .filter(|c| c.is_alphanumeric() || *c == '-')
        .collect()
}

fn headings(page: &str) -> Vec<&str> {
    page.lines()
        .filter_map(|line| line.strip_prefix("## "))
        .collect()
}

/// What stands between two marks, wherever both are in a text.
fn between<'a>(text: &'a str, begins: &str, ends: char) -> Vec<&'a str> {
    let parts = text.split(begins).skip(1);
    parts
        .filter_map(|part| part.split_once(ends))
        .map(|(found, _)| found)
        .collect()
}

/// Sources of the crate and of its tests, a name and a text each; documentation that goes on in another line on one.
fn texts() -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = all()
        .into_iter()
        .map(|(path, text)| (format!("src/{path}"), text))
        .collect();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") && !path.ends_with("cites.rs")
            {
                let name = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap();
                found.push((
                    name.display().to_string(),
                    fs::read_to_string(&path).unwrap(),
                ));
            }
        }
    }
    for (_, text) in &mut found {
        let lines = text.lines().map(str::trim_start);
        let lines = lines.map(|line| line.trim_start_matches('/').trim_start_matches('!'));
        *text = lines.collect::<Vec<_>>().join("\n").replace("\n ", " ");
    }
    found
}

/// Citations that lead nowhere.
fn astray(texts: &[(String, String)], headings: &[&str]) -> Vec<String> {
    let anchors: BTreeSet<String> = headings.iter().map(|heading| anchor(heading)).collect();
    let mut found = Vec::new();
    for (path, text) in texts {
        let cited = between(text, "crate::equations#", ')').into_iter();
        found.extend(
            cited
                .filter(|cited| !anchors.contains(*cited))
                .map(|cited| format!("{path}: #{cited}")),
        );
        let named = between(text, "`docs/model.md`, *", '*').into_iter();
        found.extend(
            named
                .filter(|named| !headings.contains(named))
                .map(|named| format!("{path}: {named}")),
        );
        if text.to_lowercase().contains("model section") {
            found.push(format!("{path}: a numbered section"));
        }
    }
    found
}

/// Golden: the copy of the page in the crate.
#[test]
fn the_crate_has_the_page_on_the_model() {
    let written = copy(&read("docs/model.md"));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/equations.md");
    if env::var_os("MINT").is_some() {
        fs::write(&path, &written).unwrap();
    }
    assert_eq!(read("src/equations.md"), written);
    assert!(!written.contains(".md") && !written.contains("$$"));
}

#[test]
fn a_page_is_copied_without_what_only_the_guide_has() {
    let page = "# A\n\nOf [b](b.md#c), [below](#d), $x_1$ and `br.a[0]`.\n\n![p](p.svg)\n\n$$F = m a$$\n\n## See it in numbers\n\nNo.\n\n## D\n\nE.\n";
    let expected =
        "# A\n\nOf b, [below](#d), `x_1` and `a[0]`.\n\n```text\nF = m a\n```\n\n## D\n\nE.\n";
    assert_eq!(copy(page), expected);
}

#[test]
fn citations_name_headings_that_there_are() {
    let page = read("src/equations.md");
    let texts = texts();
    let found = astray(&texts, &headings(&page));
    assert!(found.is_empty(), "{}", found.join("\n"));
    let linked = texts
        .iter()
        .map(|(_, text)| between(text, "crate::equations#", ')').len());
    assert!(linked.sum::<usize>() > 30);
    let planted = |text: &str| astray(&[(String::new(), text.to_owned())], &["A b, c"]).len();
    for (text, count) in [
        ("([x](crate::equations#a-b-c))", 0),
        ("([x](crate::equations#a-b))", 1),
        ("(`docs/model.md`, *A b, c*)", 0),
        ("(`docs/model.md`, *A b*)", 1),
        ("Model section 7", 1),
    ] {
        assert_eq!(planted(text), count, "{text}");
    }
}

/// Files that documentation of the crate names and its package does not have.
fn outside<'a>(path: &str, text: &'a str, packed: &[&str]) -> Vec<String> {
    let is_word = |c: char| c.is_alphanumeric() || "_/.".contains(c);
    let documented = text.lines().map(str::trim_start);
    let documented = documented.filter(|line| line.starts_with("///") || line.starts_with("//!"));
    let words = documented.flat_map(|line| line.split(|c| !is_word(c)));
    let words = words.map(|word: &'a str| word.trim_matches('.'));
    let files = words.filter(|word| {
        let folders = [
            "benches/",
            "docs/",
            "examples/",
            "fmu/",
            "python/",
            "tests/",
        ];
        folders.iter().any(|folder| word.starts_with(folder)) && word.contains('.')
    });
    let is_packed = |file: &str| {
        let (folder, end) = (
            file.split('/').next().unwrap(),
            file.rsplit('.').next().unwrap(),
        );
        packed.contains(&format!("/{file}").as_str())
            || packed.contains(&format!("/{folder}/*.{end}").as_str())
            || packed.contains(&format!("/{folder}/**/*.{end}").as_str())
    };
    let found = files.filter(|file| !is_packed(file));
    found.map(|file| format!("{path}: {file}")).collect()
}

#[test]
fn documentation_names_no_file_outside_of_the_package() {
    let manifest = read("Cargo.toml");
    // On one line, or on several in the manifest of a package.
    let (_, include) = manifest.split_once("\ninclude = [").unwrap();
    let (names, _) = include.split_once(']').unwrap();
    let packed: Vec<&str> = names
        .split(',')
        .map(|name| name.trim().trim_matches('"'))
        .collect();
    // Tests and private notes may name what only the repository has; users read the documentation of what is public.
    let sources = all()
        .into_iter()
        .filter(|(path, _)| !path.starts_with("python/"));
    let found: Vec<String> = sources
        .flat_map(|(path, text)| outside(&path, &text, &packed))
        .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
    for (text, count) in [
        ("/// See `docs/model.md`, and `examples/own_ode.rs`.\n", 0),
        ("/// See `docs/defects.md`.\n", 1),
        ("    //! `benches/records.md`\n", 1),
        ("// `benches/records.md`\n", 0),
    ] {
        assert_eq!(outside("a.rs", text, &packed).len(), count, "{text}");
    }
}
