//! Any bytes as lines of each text format of CAN: no panic, and what is read is written so that it reads
//! the same.
#![no_main]

#[path = "../../drivers/wire/n2k/tests/checks/mod.rs"]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    checks::lines::everything(bytes);
});
