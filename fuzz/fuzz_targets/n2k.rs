//! Any bytes as what stands on an NMEA 2000 bus, and a node that also sends: no panic, whole messages, and
//! an answer after the storm.
#![no_main]

#[path = "../../drivers/wire/n2k/tests/checks/mod.rs"]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    checks::everything(bytes);
});
