//! The seeds of the fuzz targets `n2k` and `can_text`.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod checks;

use std::fs;
use std::path::Path;

/// The contents of all seeds of a target.
fn seeds(target: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../fuzz/corpus").join(target);
    let entries = fs::read_dir(folder).unwrap();
    entries.map(|entry| fs::read(entry.unwrap().path()).unwrap()).collect()
}

/// What all seeds brought together.
fn total<const N: usize>(target: &str, check: impl Fn(&[u8]) -> [u64; N]) -> [u64; N] {
    let mut total = [0; N];
    for seed in seeds(target) {
        total.iter_mut().zip(check(&seed)).for_each(|(sum, own)| *sum += own);
    }
    total
}

#[test]
fn storms_leave_the_node_alive_and_what_it_sends_whole() {
    let weathered = total("n2k", checks::everything);
    assert!(weathered.iter().all(|count| *count > 0), "{weathered:?}");
}

#[test]
fn lines_of_all_formats_are_written_as_they_are_read() {
    let read = total("can_text", checks::lines::everything);
    assert!(read.iter().all(|count| *count > 0), "{read:?}");
}
