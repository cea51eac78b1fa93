//! What was recorded comes back, whatever it was.

use insd_base::{Span, Time};
use insd_drivers::raw::{FLUSH_EVERY, RawHeader, RawReader, RawWriteError, RawWriter};
use proptest::collection::vec;
use proptest::prelude::*;
use tempfile::tempdir;

use crate::arrivals::{any_arrival, blocks, header, one_file, read, record};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn arrivals_come_back_to_the_nanosecond_and_the_byte(
        arrivals in vec(any_arrival(), 0..200),
        block in 1_usize..50,
    ) {
        let folder = tempdir().unwrap();
        let blocks: Vec<_> = arrivals.chunks(block).map(<[_]>::to_vec).collect();
        record(folder.path(), &one_file(), &blocks);
        if arrivals.is_empty() {
            prop_assert_eq!(folder.path().read_dir().unwrap().count(), 0);
            return Ok(());
        }
        let reader = RawReader::open(folder.path()).unwrap();
        let found = reader.header().unwrap();
        prop_assert_eq!(&found.config, &header().config);
        prop_assert_eq!(&found.program, &header().program);
        prop_assert_eq!((found.serial, found.run, found.first), (1, 1, arrivals[0].stamp));
        let (back, faults) = read(reader);
        prop_assert!(faults.is_empty(), "{:?}", faults);
        prop_assert_eq!(back, arrivals);
    }

    #[test]
    fn rotation_loses_nothing(
        arrivals in vec(any_arrival(), 1..60),
        block in 1_usize..20,
        rotate_bytes in 0_u64..5000,
        rotate_ms in 1_i64..20_000,
    ) {
        let folder = tempdir().unwrap();
        let mut config = one_file();
        config.rotate_bytes = rotate_bytes;
        config.rotate_span = Span::from_nanos(rotate_ms * 1_000_000);
        let blocks: Vec<_> = arrivals.chunks(block).map(<[_]>::to_vec).collect();
        record(folder.path(), &config, &blocks);
        let (back, faults) = read(RawReader::open(folder.path()).unwrap());
        prop_assert!(faults.is_empty(), "{:?}", faults);
        prop_assert_eq!(back, arrivals);
    }

    #[test]
    fn bytes_at_random_are_no_recording_and_do_no_harm(
        bytes in vec(any::<u8>(), 0..300),
        tail in any::<bool>(),
    ) {
        let bytes = if tail { [b"\x89INSDRAW".as_slice(), &bytes].concat() } else { bytes };
        if let Ok(reader) = RawReader::from_bytes("random", bytes) {
            let (arrivals, faults) = read(reader);
            prop_assert!(arrivals.is_empty() && !faults.is_empty());
        }
    }
}

#[test]
fn a_block_is_due_when_its_first_arrival_is_a_second_old() {
    let folder = tempdir().unwrap();
    let mut writer = RawWriter::create(folder.path(), one_file(), header()).unwrap();
    assert!(!writer.flush_due(Time::from_nanos(i64::MAX)));
    let arrival = blocks(1)[0][0].clone();
    writer.record(&arrival).unwrap();
    let due = arrival.stamp.monotonic + FLUSH_EVERY;
    assert!(writer.flush_due(due) && !writer.flush_due(due - Span::from_nanos(1)));
    writer.tick(due).unwrap();
    assert_eq!(writer.written().arrivals, 1);
    // on the disk without any flush or drop
    assert_eq!(read(RawReader::open(folder.path()).unwrap()).0, [arrival]);
}

#[test]
fn names_and_configurations_that_do_not_fit_are_refused() {
    let folder = tempdir().unwrap();
    let mut config = one_file();
    config.name = "../elsewhere".to_owned();
    let refused = RawWriter::create(folder.path(), config, header());
    assert!(matches!(refused, Err(RawWriteError::Name(_))));
    let long = RawHeader { config: "#".repeat(2_000_000), ..header() };
    let refused = RawWriter::create(folder.path(), one_file(), long);
    assert!(matches!(refused, Err(RawWriteError::Header { bytes: 2_000_010 })));
}
