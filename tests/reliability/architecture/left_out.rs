//! Fields that a document leaves out where they are absent are set by their paths too.

use super::sources::{all, word};

/// Golden: the attributes in the sources. Every such field of the scene is named where `Scene::with` shows what is absent; that it is
/// shown in the right part is not checked here.
#[test]
fn fields_that_are_left_out_have_a_path() {
    let sources = all();
    let is_path = |path: &str| path == "scene/path.rs";
    let (_, paths) = sources.iter().find(|(path, _)| is_path(path)).unwrap();
    let shown = paths.split("fn show_absent").nth(1).unwrap();
    let shown = shown.split("\n}\n").next().unwrap();
    let (mut count, mut missing) = (0, Vec::new());
    for (path, text) in sources
        .iter()
        .filter(|(path, _)| path.starts_with("scene/"))
    {
        for after in text
            .split("skip_serializing_if = \"Option::is_none\")]")
            .skip(1)
        {
            let declared = after.trim_start().strip_prefix("pub ").unwrap_or(after);
            let name = word(declared);
            count += 1;
            if !shown.contains(&format!("\"{name}\"")) {
                missing.push(format!("{path}: {name}"));
            }
        }
    }
    assert!(
        count >= 17,
        "only {count} fields found: is the attribute written differently?"
    );
    assert!(
        missing.is_empty(),
        "add to `show_absent` of src/scene/path.rs: {missing:#?}"
    );
}
