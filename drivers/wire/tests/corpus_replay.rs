//! Streams of bytes from files: the seeds of the fuzz targets, `fuzz/corpus/PROTOCOL`, and whatever
//! lies below the folder that `INSD_CORPORA` names. Whole, in chunks, cut short and with wrong bits,
//! they must give the same frames for any chunks, and no panic.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod checks;

use std::fs;
use std::path::{Path, PathBuf};

use checks::{any_splitting, everything, everything_mixed};
use insd_wire::stream::Protocol;

/// A small generator (xorshift64): the same chunks and errors every time.
struct Random(u64);

impl Random {
    /// A number below a limit.
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 16) % limit.max(1) as u64) as usize
    }
}

/// All files below a folder, in a fixed order.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    files
}

fn corpus(protocol: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(protocol)
}

/// The checks on one file; gives the number of frames in it as it is.
fn replay(protocols: &[Protocol], path: &Path) -> usize {
    let bytes = fs::read(path).unwrap();
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let frames = any_splitting(protocols, &bytes, 1).0.len();
    for _ in 0..4 {
        any_splitting(protocols, &bytes, 1 + random.below(300));
        let end = random.below(bytes.len());
        any_splitting(protocols, &bytes[..end], 1 + random.below(300));
        any_splitting(protocols, &bytes[end..], 1 + random.below(300));
        let mut flipped = bytes.clone();
        for _ in 0..=bytes.len() / 200 {
            let at = random.below(bytes.len());
            if let Some(byte) = flipped.get_mut(at) {
                *byte ^= 1 << random.below(8);
            }
        }
        any_splitting(protocols, &flipped, 1 + random.below(300));
    }
    frames
}

#[test]
fn the_seeds_of_each_protocol_give_frames_whatever_the_chunks() {
    for protocol in Protocol::ALL {
        let files = files_below(&corpus(protocol.name()));
        let alone: usize = files.iter().map(|path| replay(&[protocol], path)).sum();
        let among_all: usize = files.iter().map(|path| replay(&Protocol::ALL, path)).sum();
        assert!(files.is_empty() || alone > 0 && among_all > 0, "{}: no frame", protocol.name());
    }
    for protocol in Protocol::ASKED_FOR {
        let files = files_below(&corpus(protocol.name()));
        let alone: usize = files.iter().map(|path| replay(&[protocol], path)).sum();
        assert!(alone > 0, "{}: no frame", protocol.name());
    }
}

#[test]
fn the_seeds_pass_the_checks_of_the_fuzz_targets() {
    for protocol in Protocol::ALL.into_iter().chain(Protocol::ASKED_FOR) {
        let files = files_below(&corpus(protocol.name()));
        assert!(!files.is_empty(), "{}: no seeds", protocol.name());
        files.iter().for_each(|path| everything(protocol, &fs::read(path).unwrap()));
    }
    for path in files_below(&corpus("mixed")) {
        everything_mixed(&fs::read(path).unwrap());
    }
}

#[test]
fn foreign_corpora_give_the_same_frames_whatever_the_chunks() {
    let Some(folder) = std::env::var_os("INSD_CORPORA") else { return };
    let files = files_below(Path::new(&folder));
    assert!(!files.is_empty(), "no files below INSD_CORPORA");
    let frames: usize = files.iter().map(|path| replay(&Protocol::ALL, path)).sum();
    println!("{} files, {frames} frames", files.len());
}
