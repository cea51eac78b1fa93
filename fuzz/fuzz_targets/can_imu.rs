//! Any frames for the reader of CAN IMUs, with shipped tables and with any: no panic, and numbers that
//! are finite, or no valid sample.
#![no_main]

#[path = "../../drivers/wire/tests/can_frames/mod.rs"]
mod can_frames;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    can_frames::everything(bytes);
});
