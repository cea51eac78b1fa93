//! Recordings of several files.

use std::fs;
use std::path::{Path, PathBuf};

use insd_drivers::raw::{RawFault, RawReader, RecordingConfig};
use tempfile::tempdir;

use crate::arrivals::{blocks, one_file, read, record};

fn small_files() -> RecordingConfig {
    RecordingConfig { rotate_bytes: 0, ..one_file() }
}

fn file(folder: &Path, serial: u32) -> PathBuf {
    folder.join(format!("ship-{serial:06}.insdraw"))
}

fn texts(folder: &Path, faults: &[RawFault]) -> Vec<String> {
    let folder = format!("{}/", folder.display());
    faults.iter().map(|fault| fault.to_string().replace(&folder, "")).collect()
}

#[test]
fn a_file_that_is_missing_is_told_with_what_it_held() {
    let folder = tempdir().unwrap();
    let blocks = blocks(5);
    record(folder.path(), &small_files(), &blocks);
    fs::remove_file(file(folder.path(), 3)).unwrap();
    fs::write(file(folder.path(), 4), b"").unwrap();
    let mut reader = RawReader::open(folder.path()).unwrap();
    let (arrivals, faults) = read(RawReader::open(folder.path()).unwrap());
    assert_eq!(arrivals, [&blocks[0][..], &blocks[1], &blocks[4]].concat());
    let told = texts(folder.path(), &faults);
    assert_eq!(told[0], "ship-000004.insdraw: files 3 to 3 of the series are missing before it");
    assert_eq!(told[1], "ship-000004.insdraw: empty");
    assert!(told[2].starts_with("ship-000005.insdraw: 20 records are missing before byte "));
    assert_eq!(told.len(), 3);
    reader.by_ref().for_each(drop);
    assert_eq!((reader.counts().arrivals, reader.counts().missing), (30, 20));
}

#[test]
fn beyond_the_quota_the_oldest_files_are_deleted_and_never_the_current_one() {
    let folder = tempdir().unwrap();
    let blocks = blocks(6);
    record(folder.path(), &small_files(), &blocks);
    let length = fs::metadata(file(folder.path(), 1)).unwrap().len();
    let config = RecordingConfig { quota_bytes: Some(length * 3 + length / 2), ..small_files() };
    record(folder.path(), &config, &blocks[..1]);
    let left: Vec<bool> = (1..=7).map(|serial| file(folder.path(), serial).exists()).collect();
    assert_eq!(left, [false, false, false, false, true, true, true]);
    let (arrivals, faults) = read(RawReader::open(folder.path()).unwrap());
    assert_eq!(arrivals, [&blocks[4][..], &blocks[5], &blocks[0]].concat());
    let told = texts(folder.path(), &faults);
    assert_eq!(told[0], "ship-000005.insdraw: files 1 to 4 of the series are missing before it");
    assert!(told[1].starts_with("ship-000005.insdraw: 40 records are missing before byte "));
    assert_eq!(told[2..], ["ship-000007.insdraw: the program started anew"]);

    let tight = RecordingConfig { quota_bytes: Some(1), ..small_files() };
    record(folder.path(), &tight, &blocks);
    let serials = (1..=20).filter(|serial| file(folder.path(), *serial).exists());
    assert_eq!(serials.collect::<Vec<_>>(), [13]);
}

#[test]
fn a_second_run_goes_on_with_new_numbers_and_is_told() {
    let folder = tempdir().unwrap();
    let blocks = blocks(3);
    record(folder.path(), &one_file(), &blocks);
    record(folder.path(), &one_file(), &blocks[1..]);
    let (arrivals, faults) = read(RawReader::open(folder.path()).unwrap());
    assert_eq!(arrivals, [blocks.concat(), blocks[1..].concat()].concat());
    assert_eq!(texts(folder.path(), &faults), ["ship-000002.insdraw: the program started anew"]);
    // a file by itself is complete
    let (arrivals, faults) = read(RawReader::open(&file(folder.path(), 2)).unwrap());
    assert_eq!(arrivals, blocks[1..].concat());
    assert!(faults.is_empty());
}

#[test]
fn folders_without_one_recording_are_refused() {
    let folder = tempdir().unwrap();
    let open = |path: &Path| RawReader::open(path).unwrap_err();
    assert!(matches!(open(&folder.path().join("none")), RawFault::Unreadable { .. }));
    fs::write(folder.path().join("notes.txt"), "x").unwrap();
    assert!(matches!(open(folder.path()), RawFault::NoFiles { .. }));
    record(folder.path(), &one_file(), &blocks(1));
    record(folder.path(), &RecordingConfig { name: "boat".to_owned(), ..one_file() }, &blocks(1));
    match open(folder.path()) {
        RawFault::SeveralSeries { names, .. } => assert_eq!(names, ["boat", "ship"]),
        other => panic!("{other}"),
    }
}
