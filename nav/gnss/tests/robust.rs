//! Any epochs and any records: no panic, and nothing that is not finite.

#![allow(clippy::unwrap_used)]

mod checks;

use std::fs;
use std::path::Path;

use checks::everything;

/// Bytes that look random and are always the same (SplitMix64; Steele, Lea and Flood 2014).
fn bytes(seed: u64, count: usize) -> Vec<u8> {
    let mut state = seed;
    let mut word = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let word = (state ^ state >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let word = (word ^ word >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        (word ^ word >> 31) as u8
    };
    (0..count).map(|_| word()).collect()
}

#[test]
fn a_sound_sky_gives_a_range_of_every_satellite() {
    // no damage, one epoch
    assert!(everything(&[0, 0, 1]) > 20);
}

#[test]
fn a_sky_of_wrong_numbers_makes_nothing_panic_and_nothing_that_is_not_finite() {
    let counted: usize = (0..400).map(|seed| everything(&bytes(seed, 1500))).sum();
    assert!(counted > 1000, "{counted}");
}

#[test]
fn the_seeds_of_the_fuzz_target_make_nothing_panic() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/gnss");
    let seeds: Vec<_> = fs::read_dir(folder).unwrap().map(Result::unwrap).collect();
    assert!(seeds.len() > 3);
    for seed in seeds {
        everything(&fs::read(seed.path()).unwrap());
    }
}
