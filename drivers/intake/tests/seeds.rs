//! The seeds of the fuzz target `intake`.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod arrivals;

use std::fs;
use std::path::Path;

#[test]
fn the_seeds_pass_the_checks_of_the_fuzz_target() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/intake");
    let mut passed = [0; 4];
    for entry in fs::read_dir(folder).unwrap() {
        let own = arrivals::everything(&fs::read(entry.unwrap().path()).unwrap());
        passed.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
    }
    assert!(passed.iter().all(|count| *count > 0), "IMU, GNSS, log, reference: {passed:?}");
}
