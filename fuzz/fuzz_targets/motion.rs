//! Any bytes as telegrams of motion sensors, and as the contents of good ones: no panic, and what is read
//! is written so that it reads the same.
#![no_main]

#[path = "../../drivers/wire/tests/checks/motion.rs"]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| checks::everything(bytes));
