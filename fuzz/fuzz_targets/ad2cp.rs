//! Any bytes as a stream of records of AD2CP instruments, and as the contents of good frames.
#![no_main]

#[path = "../../drivers/wire/tests/checks/mod.rs"]
mod checks;

use insd_wire::stream::Protocol;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| checks::everything(Protocol::Ad2cp, bytes));
