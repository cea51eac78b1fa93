//! Any bytes as a stream of a Signal K server, and as values of good deltas.
#![no_main]

#[path = "../../drivers/wire/tests/checks/mod.rs"]
mod checks;

use insd_wire::stream::Protocol;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| checks::everything(Protocol::SignalK, bytes));
