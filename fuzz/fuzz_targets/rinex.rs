//! Any bytes as files of observations, of navigation messages and of compact observations: no panic; what is
//! read, written and read again is the same.
#![no_main]

#[path = "../../drivers/wire/rinex/tests/checks/mod.rs"]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = checks::everything(bytes);
});
