//! Any records and any epochs of a receiver, a sound sky damaged as the bytes order: no panic, and nothing comes out that is not finite.
#![no_main]

#[path = "../../nav/gnss/tests/checks/mod.rs"]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let _ = checks::everything(bytes);
});
