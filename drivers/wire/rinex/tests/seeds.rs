//! The seeds of the fuzz target `rinex`.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod checks;

use std::fs;
use std::path::Path;

#[test]
fn seeds_are_read_and_written_as_they_were() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../fuzz/corpus/rinex");
    let mut total = [0; 3];
    for entry in fs::read_dir(folder).unwrap() {
        let read = checks::everything(&fs::read(entry.unwrap().path()).unwrap());
        assert!(read.iter().any(|count| *count > 0));
        total.iter_mut().zip(read).for_each(|(sum, own)| *sum += own);
    }
    assert!(total.iter().all(|count| *count > 0), "{total:?}");
}
