//! What is public: no type of a library beneath, and scenes that may grow.

use std::collections::BTreeSet;

use super::sources::{Source, all, code, test_files, word};

/// Libraries that are used inside only.
const INSIDE: [&str; 3] = ["nalgebra", "pulp", "rayon"];

/// Top-level items of formatted code, each with its attributes in front.
pub(super) fn items(code: &str) -> Vec<String> {
    let (mut found, mut item) = (Vec::new(), String::new());
    for line in code.lines() {
        item += line;
        item.push('\n');
        let ends = line.starts_with('}') || line.ends_with(['}', ';']);
        if ends && !line.starts_with(char::is_whitespace) {
            found.push(std::mem::take(&mut item));
        }
    }
    found
}

/// Words of a text, those of paths too.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
}

/// Name of an item that a keyword declares, if it is public without reserve.
pub(super) fn public_name<'a>(item: &'a str, keyword: &str) -> Option<&'a str> {
    let start = format!("pub {keyword} ");
    item.lines()
        .find_map(|line| line.strip_prefix(&start).map(word))
}

/// What follows a keyword that an item begins with, after its attributes and whatever its visibility.
pub(super) fn after<'a>(item: &'a str, keyword: &str) -> Option<&'a str> {
    let start = item
        .lines()
        .find(|line| !line.is_empty() && !line.starts_with("#["))?;
    let rest = &item[item.find(start)?..];
    let bare = rest.strip_prefix("pub").map_or(rest, |rest| {
        let end = if rest.starts_with('(') {
            rest.find(')').map_or(0, |end| end + 1)
        } else {
            0
        };
        rest[end..].trim_start()
    });
    bare.strip_prefix(keyword)
}

/// Names that stand for types of the libraries: what files import of them, and aliases of these.
fn foreign(files: &[(&str, Vec<String>)]) -> BTreeSet<String> {
    let items = || files.iter().flat_map(|(_, items)| items);
    let imported = items()
        .filter_map(|item| after(item, "use "))
        .filter(|path| INSIDE.contains(&word(path)))
        .flat_map(words);
    let mut names: BTreeSet<String> = imported.chain(INSIDE).map(str::to_owned).collect();
    names.remove("");
    loop {
        let aliases = items()
            .filter_map(|item| after(item, "type ")?.split_once('='))
            .filter(|(_, of)| words(of).any(|name| names.contains(name)))
            .map(|(alias, _)| word(alias).to_owned());
        let found: BTreeSet<String> = aliases.filter(|alias| !names.contains(alias)).collect();
        if found.is_empty() {
            return names;
        }
        names.extend(found);
    }
}

/// What others see of an item: public fields, variants, signatures; no bodies.
pub(super) fn signatures(item: &str, types: &BTreeSet<String>) -> Vec<String> {
    let head = |text: &str| text.split(['{', ';']).next().unwrap_or("").to_owned();
    for keyword in ["struct", "enum", "trait", "type", "const", "fn", "const fn"] {
        if public_name(item, keyword).is_none() {
            continue;
        }
        return match keyword {
            "fn" | "const fn" => vec![head(item)],
            "struct" if item.contains('{') => {
                let fields = item.split("\n    pub ").skip(1);
                fields
                    .map(|field| head(field.split(",\n").next().unwrap()))
                    .collect()
            }
            _ => vec![item.to_owned()],
        };
    }
    let Some((of, _)) = after(item, "impl").and_then(|of| of.split_once('{')) else {
        return Vec::new();
    };
    if !words(of).any(|name| types.contains(name)) {
        return Vec::new();
    }
    let methods = item.split("\n    pub ").skip(1).map(head);
    methods.chain([of.to_owned()]).collect()
}

/// Public signatures that name a type of a library that is used inside only, and how many were looked at.
fn leaks(sources: &[Source]) -> (Vec<String>, usize) {
    let tests = test_files(sources);
    let files: Vec<(&str, Vec<String>)> = sources
        .iter()
        .filter(|(path, _)| !tests.contains(path))
        .map(|(path, text)| (path.as_str(), items(&code(text))))
        .collect();
    let foreign = foreign(&files);
    let types: BTreeSet<String> = files
        .iter()
        .flat_map(|(_, items)| items)
        .flat_map(|item| ["struct", "enum", "trait"].map(|keyword| public_name(item, keyword)))
        .flatten()
        .map(str::to_owned)
        .collect();
    let (mut found, mut seen) = (Vec::new(), 0);
    for (path, items) in &files {
        for signature in items.iter().flat_map(|item| signatures(item, &types)) {
            seen += 1;
            if let Some(name) = words(&signature).find(|name| foreign.contains(*name)) {
                found.push(format!("{path} shows {name}: {}", signature.trim()));
            }
        }
    }
    (found, seen)
}

#[test]
fn public_signatures_name_no_library_beneath() {
    let (found, seen) = leaks(&all());
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(seen > 600, "the test looked at {seen} signatures only");
}

/// A planted leak of each kind is found, and nothing else.
#[test]
fn leaks_are_seen() {
    let look = |planted: &str| {
        let text = format!(
            "use nalgebra::{{Matrix2, Vector2}};\npub(crate) type V2 = Vector2<f64>;\npub struct Open;\nstruct Hidden;\n{planted}"
        );
        leaks(&[("low.rs".to_owned(), text)]).0
    };
    for planted in [
        "pub fn f(at: V2) {\n}\n",
        "pub const fn f() -> nalgebra::Point2<f64> {\n    loop {}\n}\n",
        "pub type Place = V2;\n",
        "pub struct S {\n    pub at: V2,\n}\n",
        "pub struct S(pub V2);\n",
        "pub enum E {\n    At(pulp::x86::V3),\n}\n",
        "pub trait T {\n    fn at(&self) -> Matrix2<f64>;\n}\n",
        "impl Open {\n    pub fn at(&self) -> V2 {\n        loop {}\n    }\n}\n",
        "impl From<V2> for Open {\n    fn from(at: [f64; 2]) -> Self {\n        Self\n    }\n}\n",
    ] {
        assert_eq!(look(planted).len(), 1, "{planted}: {:?}", look(planted));
    }
    for allowed in [
        "pub struct S {\n    pub(crate) at: V2,\n    pub x: f64,\n}\n",
        "pub fn f() -> f64 {\n    V2::zeros().x\n}\n",
        "pub(crate) fn f(at: V2) {\n}\n",
        "impl Hidden {\n    pub fn at(&self) -> V2 {\n        loop {}\n    }\n}\n",
        "impl Open {\n    fn at(&self) -> V2 {\n        loop {}\n    }\n}\n",
    ] {
        assert!(look(allowed).is_empty(), "{allowed}: {:?}", look(allowed));
    }
}

/// Enums that are complete: nobody will name a third ring without rewriting the model.
const CLOSED: [&str; 4] = ["Race", "BodyKind", "Degree", "ZoneSlices"];

/// A struct of a scene's room that is complete, all that rolling depends on: outside it is written by the names of its fields.
const GEOMETRY: &str = "RowGeometry";

/// Enums whose variants have all that their formula has: another law or function is another variant, and outside they are written by the
/// names of their fields.
const FORMULAE: [&str; 7] = [
    "Cage",
    "Cut",
    "Drive",
    "Friction",
    "Mount",
    "NormalLaw",
    "Profile",
];

/// Variants with fields that could not have another one later.
fn frozen_variants<'a>(item: &'a str, name: &str) -> Vec<&'a str> {
    if FORMULAE.contains(&name) || CLOSED.contains(&name) {
        return Vec::new();
    }
    let lines: Vec<&str> = item.lines().collect();
    let is_frozen = |pair: &&[&str]| {
        let variant = pair[1].strip_prefix("    ").unwrap_or("");
        let begins = variant.starts_with(char::is_uppercase) && variant.contains(" {");
        begins && pair[0].trim() != "#[non_exhaustive]"
    };
    let frozen = lines.windows(2).filter(is_frozen);
    frozen.map(|pair| word(pair[1].trim())).collect()
}

/// Public structs and enums of scenes, and enums of all rooms with their variants, that a later version could not extend.
fn frozen(sources: &[Source]) -> (Vec<String>, usize) {
    let (mut found, mut seen) = (Vec::new(), 0);
    for (path, text) in sources {
        for item in items(&code(text)) {
            let of_scene = path.starts_with("scene/");
            let name = public_name(&item, "enum")
                .filter(|name| of_scene || !CLOSED.contains(name))
                .or_else(|| public_name(&item, "struct").filter(|_| of_scene));
            let Some(name) = name.filter(|name| *name != GEOMETRY) else {
                continue;
            };
            seen += 1;
            if !item.contains("#[non_exhaustive]\npub ") {
                found.push(format!("{path}: {name} is not #[non_exhaustive]"));
            }
            if public_name(&item, "enum").is_some() {
                let variants = frozen_variants(&item, name).into_iter();
                found.extend(
                    variants.map(|variant| {
                        format!("{path}: {name}::{variant} is not #[non_exhaustive]")
                    }),
                );
            }
        }
    }
    (found, seen)
}

#[test]
fn scenes_may_grow() {
    let (found, seen) = frozen(&all());
    assert!(found.is_empty(), "{}", found.join("\n"));
    assert!(seen > 35, "the test looked at {seen} types only");
    let planted = |path: &str, text: &str| {
        let sources = [(path.to_owned(), text.to_owned())];
        frozen(&sources).0.len()
    };
    for (path, text, count) in [
        (
            "scene/a.rs",
            "#[derive(Debug)]\npub struct A {\n    pub a: f64,\n}\n",
            1,
        ),
        (
            "scene/a.rs",
            "#[non_exhaustive]\npub enum A {\n    B,\n}\n",
            0,
        ),
        (
            "run/a.rs",
            "#[non_exhaustive]\npub enum A {\n    B {\n        a: f64,\n    },\n    #[non_exhaustive]\n    C {},\n}\n",
            1,
        ),
        ("run/a.rs", "pub enum A {\n    B,\n}\n", 1),
        ("run/a.rs", "pub struct A {\n    pub a: f64,\n}\n", 0),
    ] {
        assert_eq!(planted(path, text), count, "{text}");
    }
}

/// Words of Python, and of the commands of its package, in texts of the crate.
fn of_python(sources: &[Source]) -> Vec<String> {
    let words = [
        "br.",
        "`ballrace ",
        "= None",
        "True",
        "False",
        "numpy",
        "keyword",
    ];
    let mut found = Vec::new();
    for (path, text) in sources
        .iter()
        .filter(|(path, _)| !path.starts_with("python/"))
    {
        let code = code(text);
        let texts = code.split('"').skip(1).step_by(2);
        for text in texts {
            let word = words.iter().find(|word| text.contains(**word));
            found.extend(word.map(|word| format!("{path}: {word} in {text}")));
        }
    }
    found
}

/// What the crate says is read by users of both languages.
#[test]
fn messages_have_no_words_of_python() {
    let found = of_python(&all());
    assert!(found.is_empty(), "{}", found.join("\n"));
    let planted = |text: &str| of_python(&[("a.rs".to_owned(), text.to_owned())]).len();
    assert_eq!(planted("fn f() { g(\"bandwidth = None\") }"), 1);
    assert_eq!(planted("// br.simulate\nfn f() { g(None, \"none\") }"), 0);
}
