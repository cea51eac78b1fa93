//! Any bytes as what arrives at a port with a sensor of every kind: no panic, and nothing passed on
//! that is not a number.
#![no_main]

#[path = "../../drivers/intake/tests/arrivals/mod.rs"]
mod arrivals;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    arrivals::everything(bytes);
});
