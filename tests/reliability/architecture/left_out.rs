//! Fields that a document leaves out where they are absent are set by their paths too.

use super::sources::all;

/// Golden: the attributes in the sources. The scene leaves out no field but by `absent`, which `Scene::with` writes out; forces of a
/// program's own are in no document.
#[test]
fn fields_are_left_out_by_what_scene_with_writes_out() {
    let sources = all();
    let scene = sources
        .iter()
        .filter(|(path, _)| path.starts_with("scene/"));
    let (mut count, mut others) = (0, Vec::new());
    for (path, text) in scene {
        for after in text.split("skip_serializing_if = \"").skip(1) {
            let by = after.split('"').next().unwrap();
            count += 1;
            if !by.starts_with("absent::") && by != "RingForces::is_empty" {
                others.push(format!("{path}: {by}"));
            }
        }
    }
    assert!(
        count >= 17,
        "only {count} fields found: is the attribute written differently?"
    );
    assert!(others.is_empty(), "leave out by `absent`: {others:#?}");
}
