//! The cases of any sweep run, or say why not.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(init: ballrace_fuzz::begin("sweep"), |text: &str| ballrace_fuzz::sweep::check(text));
