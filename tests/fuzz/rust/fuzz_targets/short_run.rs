//! Any valid scene runs for a few samples, or says why not.
#![no_main]

use ballrace_fuzz::short::Short;
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: ballrace_fuzz::begin("short_run"), |short: Short| short.check());
