//! Fields are replaced by any path, or refused with the path.
#![no_main]

use ballrace_fuzz::check::decided;
use ballrace_fuzz::seeds::changes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: ballrace_fuzz::begin("paths"), |text: &str| {
    let Some((scene, changes)) = changes(text) else { return };
    // One by one, so that what goes well is kept beside what does not.
    let mut changed = scene.clone();
    for change in &changes {
        if let Some(next) = decided(changed.with(std::slice::from_ref(change))) {
            assert_eq!(next.with(std::slice::from_ref(change)).as_ref(), Ok(&next));
            changed = next;
        }
    }
    let _ = decided(scene.with(&changes));
});
