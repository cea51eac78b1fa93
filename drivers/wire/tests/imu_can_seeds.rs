//! The seeds of the fuzz target `can_imu`.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod can_frames;

use std::fs;
use std::path::Path;

#[test]
fn samples_of_any_frames_are_finite_or_not_valid() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/can_imu");
    let mut made = [0; 3];
    for entry in fs::read_dir(folder).unwrap() {
        let own = can_frames::everything(&fs::read(entry.unwrap().path()).unwrap());
        made.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
    }
    assert!(made.iter().all(|count| *count > 0), "shipped, own, valid: {made:?}");
}
