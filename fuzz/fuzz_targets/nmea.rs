//! Any bytes as a stream of NMEA 0183, and as the contents of good sentences.
#![no_main]

#[path = "../../drivers/wire/tests/checks/mod.rs"]
mod checks;

use insd_wire::stream::Protocol;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| checks::everything(Protocol::Nmea, bytes));
