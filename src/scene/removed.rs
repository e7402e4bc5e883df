//! Fields of documents of earlier versions.

use serde_json::Value;

use super::path;
use crate::base::error::{Error, Result};

/// Takes the table `approximations` of versions up to 0.3 out of a document; what it asks for is refused.
pub(super) fn take_approximations(document: &mut Value) -> Result<()> {
    let asked = |field: &str, value: &Value| {
        let allowed = format!("left out, or false: {}", path::NO_APPROXIMATIONS);
        Err(Error::scene(field, path::short(value), allowed))
    };
    let fields = document.as_object_mut();
    match fields.and_then(|fields| fields.remove("approximations")) {
        None => Ok(()),
        Some(Value::Object(table)) => match table.iter().find(|(_, value)| **value != false) {
            Some((name, value)) => asked(&format!("approximations.{name}"), value),
            None => Ok(()),
        },
        Some(other) => asked("approximations", &other),
    }
}

#[cfg(test)]
mod tests {
    use crate::Error;
    use crate::scene::{Scene, presets};

    #[test]
    fn approximations_are_read_where_none_is_asked_for() {
        let scene = presets::deep_groove_6205(500.0, 0.0, 1800.0);
        let read = |table: &str| {
            Scene::from_toml(&format!("{}\n[approximations]\n{table}", scene.to_toml()))
        };
        assert_eq!(
            read("rolling = false\nplane = false\none_row = false"),
            Ok(scene.clone())
        );
        let refused = |found| match found {
            Err(Error::Scene {
                path,
                value,
                allowed,
            }) if allowed.contains("removed") => (path, value),
            other => panic!("{other:?}"),
        };
        let asked = refused(read("rolling = false\nplane = true"));
        assert_eq!(
            asked,
            ("approximations.plane".to_owned(), "true".to_owned())
        );
        let set = refused(scene.with(&[("approximations.rolling", true.into())]));
        assert_eq!(set.0, "approximations.rolling");
    }
}
