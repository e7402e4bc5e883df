//! Any text is read as TOML and as JSON, or refused with a place.
#![no_main]

use ballrace::Scene;
use ballrace_fuzz::check::decided;
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: ballrace_fuzz::begin("scene_text"), |text: &str| {
    for scene in [Scene::from_toml(text), Scene::from_json(text)] {
        let Some(scene) = decided(scene) else { continue };
        assert_eq!(Scene::from_toml(&scene.to_toml()).as_ref(), Ok(&scene));
        assert_eq!(Scene::from_json(&scene.to_json()).as_ref(), Ok(&scene));
        for doubt in scene.doubts() {
            assert!(!doubt.to_string().is_empty());
        }
    }
});
