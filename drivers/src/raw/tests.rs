//! Writer and recorder on disks that fail or are slow.

use std::io;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard};

use insd_base::{Arrival, Input, PortId, Span, Stamp, Time, UtcTime};
use tempfile::{TempDir, tempdir};

use super::disk::{Disk, LocalDisk, Output};
use super::*;

/// What the disk does at present.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mood {
    Good,
    /// Takes half of what it is given.
    Full,
    /// Takes nothing, and no new file either.
    ReadOnly,
}

/// The folder of a test on a disk with moods. Who holds the lock stops the disk.
#[derive(Clone, Debug)]
struct MoodyDisk(Arc<Mutex<Mood>>);

#[derive(Debug)]
struct MoodyFile(MoodyDisk, Box<dyn Output>);

impl MoodyDisk {
    fn mood(&self) -> MutexGuard<'_, Mood> {
        self.0.lock().unwrap()
    }
}

impl Disk for MoodyDisk {
    fn create(&self, path: &Path) -> io::Result<Box<dyn Output>> {
        if *self.mood() == Mood::ReadOnly {
            return Err(io::ErrorKind::ReadOnlyFilesystem.into());
        }
        Ok(Box::new(MoodyFile(self.clone(), LocalDisk.create(path)?)))
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        LocalDisk.remove(path)
    }
}

impl Output for MoodyFile {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mood = *self.0.mood();
        match mood {
            Mood::Good => self.1.append(bytes),
            Mood::Full => {
                self.1.append(&bytes[..bytes.len() / 2])?;
                Err(io::ErrorKind::StorageFull.into())
            }
            Mood::ReadOnly => Err(io::ErrorKind::ReadOnlyFilesystem.into()),
        }
    }

    fn cut(&mut self, _: u64) -> io::Result<()> {
        // what stands there stays: the reader has to cope
        Err(io::ErrorKind::ReadOnlyFilesystem.into())
    }

    fn is_there(&self) -> bool {
        self.1.is_there()
    }
}

fn writer() -> (TempDir, MoodyDisk, RawWriter) {
    let folder = tempdir().unwrap();
    let disk = MoodyDisk(Arc::new(Mutex::new(Mood::Good)));
    let config = RecordingConfig {
        name: "insd".to_owned(),
        rotate_bytes: 1 << 20,
        rotate_span: Span::from_seconds(3600.0),
        quota_bytes: None,
    };
    let writer = RawWriter::on_disk(
        Box::new(disk.clone()),
        folder.path(),
        config,
        RawHeader { program: "insd 0.1.0".to_owned(), config: "rate_hz = 1".to_owned() },
    );
    (folder, disk, writer.unwrap())
}

/// The arrival number `index`, a tenth of a second after the one before.
fn arrival(index: u64) -> Arrival {
    let nanos = index as i64 * 100_000_000;
    let stamp = Stamp {
        monotonic: Time::from_nanos(nanos),
        system: UtcTime::from_nanos(1_795_000_000_000_000_000 + nanos),
    };
    Arrival { stamp, port: PortId(3), input: Input::Bytes(index.to_le_bytes().to_vec()) }
}

/// The numbers of the arrivals in a folder; a negative number stands for so many not recorded.
fn numbers(folder: &Path) -> Vec<i64> {
    let reader = RawReader::open(folder).unwrap();
    let items = reader.filter_map(|item| match item {
        Ok(arrival) => match arrival.input {
            Input::Bytes(bytes) => Some(i64::from_le_bytes(bytes.try_into().unwrap())),
            other => panic!("{other:?}"),
        },
        Err(RawFault::NotRecorded { arrivals, .. }) => Some(-(arrivals as i64)),
        Err(RawFault::CutShort { .. } | RawFault::FilesMissing { .. }) => None,
        Err(RawFault::Missing { .. }) => None,
        Err(fault) => panic!("{fault}"),
    });
    items.collect()
}

#[test]
fn a_full_disk_costs_what_was_waiting_and_the_recording_tells() {
    let (folder, disk, mut writer) = writer();
    (0..4).for_each(|index| writer.record(&arrival(index)).unwrap());
    writer.flush().unwrap();
    *disk.mood() = Mood::Full;
    (4..9).for_each(|index| writer.record(&arrival(index)).unwrap());
    for _ in 0..3 {
        let fault = writer.flush().unwrap_err();
        assert!(matches!(fault, RawWriteError::Full { .. }), "{fault}");
    }
    writer.drop_arrivals(2);
    *disk.mood() = Mood::Good;
    (11..13).for_each(|index| writer.record(&arrival(index)).unwrap());
    writer.flush().unwrap();
    assert_eq!(numbers(folder.path()), [0, 1, 2, 3, -7, 11, 12]);
    let written = writer.written();
    assert_eq!((written.arrivals, written.dropped, written.files), (6, 7, 2));
}

#[test]
fn a_folder_that_is_deleted_is_told_and_recording_goes_on_when_it_is_there_again() {
    let (folder, _, writer) = writer();
    let mut recorder = Recorder::start(writer).unwrap();
    let mut next = 0;
    let mut until = |recorder: &mut Recorder, wanted: &dyn Fn(&RecorderState) -> bool| {
        while !wanted(&recorder.state()) {
            recorder.record(&arrival(next));
            next += 1;
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
    };
    until(&mut recorder, &|state| state.written.records > 0);
    assert!(!recorder.state().is_failing());
    std::fs::remove_dir_all(folder.path()).unwrap();
    until(&mut recorder, &RecorderState::is_failing);
    let fault = recorder.state().fault.unwrap();
    assert!(matches!(*fault, RawWriteError::Gone { .. }), "{fault}");
    assert!(!folder.path().exists(), "it is not made anew");
    std::fs::create_dir(folder.path()).unwrap();
    until(&mut recorder, &|state| !state.is_failing());
    assert!(recorder.finish().written.dropped > 0);
    assert!(numbers(folder.path())[0] < 0, "what was not recorded is counted");
}

#[test]
fn a_file_that_is_deleted_is_followed_by_another() {
    let (folder, _, mut writer) = writer();
    writer.record(&arrival(0)).unwrap();
    writer.flush().unwrap();
    for file in std::fs::read_dir(folder.path()).unwrap() {
        std::fs::remove_file(file.unwrap().path()).unwrap();
    }
    writer.record(&arrival(1)).unwrap();
    writer.flush().unwrap();
    assert_eq!(writer.written().files, 2);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_folder_that_can_not_be_written_is_told_and_tried_again() {
    let (folder, disk, mut writer) = writer();
    *disk.mood() = Mood::ReadOnly;
    writer.record(&arrival(0)).unwrap();
    assert!(matches!(writer.flush(), Err(RawWriteError::ReadOnly { .. })));
    // a second later the block is due, whoever calls
    writer.record(&arrival(1)).unwrap();
    assert!(matches!(writer.record(&arrival(12)), Err(RawWriteError::ReadOnly { .. })));
    *disk.mood() = Mood::Good;
    writer.tick(arrival(22).stamp.monotonic).unwrap();
    assert_eq!(numbers(folder.path()), [-2, 12]);
}

#[test]
fn an_arrival_that_is_too_long_is_left_out_and_told() {
    let (folder, _, mut writer) = writer();
    let mut long = arrival(0);
    long.input = Input::Bytes(vec![0; 5_000_000]);
    assert!(matches!(writer.record(&long), Err(RawWriteError::TooLong { bytes: 5_000_000 })));
    writer.record(&arrival(1)).unwrap();
    writer.flush().unwrap();
    assert_eq!(numbers(folder.path()), [-1, 1]);
}

#[test]
fn a_disk_that_stands_still_delays_nobody_and_the_recording_tells_what_is_left_out() {
    let (folder, disk, writer) = writer();
    let mut recorder = Recorder::with_queue(writer, 8).unwrap();
    let stopped = disk.mood();
    (0..200).for_each(|index| recorder.record(&arrival(index)));
    drop(stopped);
    let state = recorder.finish();
    assert!(state.fault.is_none());
    assert!(state.written.dropped > 100, "{state:?}");
    assert_eq!(state.written.arrivals + state.written.dropped, 200);
    let mut next = 0;
    for number in numbers(folder.path()) {
        if number < 0 {
            next -= number;
        } else {
            assert_eq!(number, next);
            next += 1;
        }
    }
    assert_eq!(next, 200);
}

#[test]
fn after_a_failure_the_recorder_leaves_the_disk_alone_for_five_seconds() {
    let (folder, disk, writer) = writer();
    *disk.mood() = Mood::Full;
    let mut recorder = Recorder::start(writer).unwrap();
    (0..40).for_each(|index| recorder.record(&arrival(index)));
    while recorder.state().fault.is_none() {
        std::thread::yield_now();
    }
    while recorder.state().written.dropped < 39 {
        std::thread::yield_now();
    }
    *disk.mood() = Mood::Good;
    (40..80).for_each(|index| recorder.record(&arrival(index)));
    recorder.tick(arrival(90).stamp.monotonic);
    let state = recorder.finish();
    assert!(state.fault.is_none(), "{state:?}");
    // the first second fails at 10; 10 waits, and at 60 the disk is tried again
    assert_eq!(numbers(folder.path())[..4], [-10, 10, -49, 60]);
    assert_eq!(state.written.arrivals, 21);
}

#[test]
fn quiet_ports_are_on_the_disk_after_a_second() {
    let (folder, _, writer) = writer();
    let mut recorder = Recorder::start(writer).unwrap();
    recorder.record(&arrival(0));
    recorder.tick(arrival(5).stamp.monotonic);
    assert_eq!(recorder.state().written.arrivals, 0);
    recorder.tick(arrival(10).stamp.monotonic);
    while recorder.state().written.arrivals == 0 {
        std::thread::yield_now();
    }
    assert_eq!(numbers(folder.path()), [0]);
}
