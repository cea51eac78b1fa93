//! Any bytes as a stream of all protocols in one cutter, and good frames of all of them mixed.
#![no_main]

#[path = "../../drivers/wire/tests/checks/mod.rs"]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| checks::everything_mixed(bytes));
