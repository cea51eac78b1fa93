use std::fs;
use std::path::PathBuf;

use super::*;
use crate::key::{RecordKey, RunId};

const QUOTA: u64 = 1 << 20;
const MANY: (usize, usize) = (1000, 1 << 20);

fn record(sequence: u64) -> SpoolRecord {
    let key = RecordKey { run: RunId::of_number(7), sequence };
    let utc =
        Some(UtcTime::from_nanos(1_800_000_000_000_000_000 + sequence as i64 * 1_000_000_000));
    SpoolRecord { key, utc, text: format!("{{\"seq\":{sequence}}}") }
}

fn fill(spool: &mut Spool, class: SpoolClass, sequences: std::ops::Range<u64>) {
    sequences.for_each(|sequence| spool.append(class, &record(sequence)).unwrap());
}

/// Takes everything out, in batches of so many.
fn drain(spool: &mut Spool, class: SpoolClass, most: usize) -> Vec<u64> {
    let mut all = Vec::new();
    while let Some(batch) = spool.oldest(class, (most, MANY.1), None).unwrap() {
        all.extend(batch.records.iter().map(|own| own.key.sequence));
        spool.acknowledge(&batch).unwrap();
    }
    all
}

/// The segments of a class, oldest first.
fn segments(folder: &Path, class: SpoolClass) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder.join(class.name())).unwrap().map(|own| own.unwrap().path());
    let mut all: Vec<PathBuf> =
        entries.filter(|own| own.extension().is_some_and(|end| end == "spool")).collect();
    all.sort();
    all
}

#[test]
fn what_goes_in_comes_out_once_oldest_first() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    fill(&mut spool, SpoolClass::History, 1..501);
    assert_eq!(spool.waiting(SpoolClass::History), 500);
    assert_eq!(drain(&mut spool, SpoolClass::History, 60), (1..501).collect::<Vec<_>>());
    assert_eq!(spool.waiting(SpoolClass::History), 0);
    fill(&mut spool, SpoolClass::History, 501..503);
    assert_eq!(drain(&mut spool, SpoolClass::History, 60), [501, 502]);
}

#[test]
fn what_was_not_acknowledged_comes_again_after_a_restart() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    fill(&mut spool, SpoolClass::Alerts, 1..101);
    let batch = spool.oldest(SpoolClass::Alerts, (40, MANY.1), None).unwrap().unwrap();
    spool.acknowledge(&batch).unwrap();
    let _ = spool.oldest(SpoolClass::Alerts, (40, MANY.1), None).unwrap();
    // the process is gone without a word
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    assert_eq!(spool.waiting(SpoolClass::Alerts), 60);
    assert_eq!(drain(&mut spool, SpoolClass::Alerts, 7), (41..101).collect::<Vec<_>>());
}

#[test]
fn a_segment_that_is_cut_at_any_byte_gives_all_whole_records_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    fill(&mut spool, SpoolClass::History, 1..9);
    let segment = segments(folder.path(), SpoolClass::History).remove(0);
    let whole = fs::read(&segment).unwrap();
    let each = whole.len() / 8;
    for cut in 0..=whole.len() {
        fs::remove_dir_all(folder.path()).unwrap();
        fs::create_dir_all(segment.parent().unwrap()).unwrap();
        fs::write(&segment, &whole[..cut]).unwrap();
        let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
        fill(&mut spool, SpoolClass::History, 100..102);
        let kept = (cut / each) as u64;
        let expected: Vec<u64> = (1..=kept).chain(100..102).collect();
        assert_eq!(spool.losses().damaged_bytes as usize, cut % each, "cut at {cut}");
        assert_eq!(spool.waiting(SpoolClass::History), kept + 2, "cut at {cut}");
        assert_eq!(drain(&mut spool, SpoolClass::History, 3), expected, "cut at {cut}");
    }
}

#[test]
fn a_byte_that_is_turned_anywhere_costs_one_record() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    fill(&mut spool, SpoolClass::History, 1..5);
    let segment = segments(folder.path(), SpoolClass::History).remove(0);
    let whole = fs::read(&segment).unwrap();
    for at in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x10;
        fs::write(&segment, &bytes).unwrap();
        let _ = fs::remove_file(folder.path().join("log/acknowledged"));
        let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
        let left = drain(&mut spool, SpoolClass::History, 10);
        assert_eq!(left.len(), 3, "byte {at}: {left:?}");
    }
}

#[test]
fn a_torn_word_of_what_was_acknowledged_sends_twice_and_loses_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    fill(&mut spool, SpoolClass::History, 1..21);
    let batch = spool.oldest(SpoolClass::History, (10, MANY.1), None).unwrap().unwrap();
    spool.acknowledge(&batch).unwrap();
    fs::write(folder.path().join("log/acknowledged"), "1").unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    assert_eq!(drain(&mut spool, SpoolClass::History, 10), (1..21).collect::<Vec<_>>());
}

#[test]
fn beyond_the_quota_the_oldest_history_goes_before_any_alert() {
    let folder = tempfile::tempdir().unwrap();
    let quota = 64 * 1024;
    let mut spool = Spool::open(folder.path(), quota).unwrap();
    fill(&mut spool, SpoolClass::Alerts, 1..201);
    fill(&mut spool, SpoolClass::History, 1..5001);
    assert!(spool.bytes() <= quota);
    let lost = spool.losses().quota;
    assert!(lost > 1000, "{lost}");
    assert_eq!(drain(&mut spool, SpoolClass::Alerts, 50).len(), 200);
    assert_eq!(drain(&mut spool, SpoolClass::History, 50), (lost + 1..5001).collect::<Vec<_>>());
}

#[test]
fn segments_that_are_ashore_leave_the_disk() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), 64 * 1024).unwrap();
    fill(&mut spool, SpoolClass::History, 1..901);
    assert!(segments(folder.path(), SpoolClass::History).len() > 3);
    drain(&mut spool, SpoolClass::History, 100);
    assert!(segments(folder.path(), SpoolClass::History).len() <= 1);
    assert!(spool.bytes() < 8 * 1024);
}

#[test]
fn what_is_older_than_anybody_wants_to_know_is_left_out_and_counted() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    fill(&mut spool, SpoolClass::History, 1..101);
    let unknown = SpoolRecord { utc: None, ..record(101) };
    spool.append(SpoolClass::History, &unknown).unwrap();
    let mut left = Vec::new();
    while let Some(batch) = spool.oldest(SpoolClass::History, (10, MANY.1), record(95).utc).unwrap()
    {
        left.extend(batch.records.iter().map(|own| own.key.sequence));
        spool.acknowledge(&batch).unwrap();
    }
    // of one whose time is not known nobody can say that it is old
    assert_eq!(left, [95, 96, 97, 98, 99, 100, 101]);
    assert_eq!(spool.losses().expired, 94);
}

#[test]
fn steps_of_the_clock_lose_nothing_and_change_no_order() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    let stepped = |sequence: u64| {
        let own = record(sequence);
        let days = match sequence {
            31..=40 => -20 * 365,
            61..=70 => 1024 * 7,
            _ => 0,
        };
        let utc =
            own.utc.map(|utc| utc.plus(insd_base::Span::from_nanos(days * 86_400 * 1_000_000_000)));
        SpoolRecord { utc, ..own }
    };
    (1..101).for_each(|own| spool.append(SpoolClass::History, &stepped(own)).unwrap());
    let limit = record(1).utc;
    let mut all = Vec::new();
    while let Some(batch) = spool.oldest(SpoolClass::History, (7, MANY.1), limit).unwrap() {
        // what was sent and not acknowledged comes again as it was
        let again = spool.oldest(SpoolClass::History, (7, MANY.1), limit).unwrap().unwrap();
        assert_eq!(again, batch);
        all.extend(batch.records.iter().map(|own| own.key.sequence));
        spool.acknowledge(&batch).unwrap();
    }
    assert_eq!(all, (1..101).collect::<Vec<_>>());
    assert_eq!(spool.losses(), SpoolLosses::default());
}

#[test]
fn a_batch_holds_records_of_one_run() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    fill(&mut spool, SpoolClass::History, 1..4);
    let key = RecordKey { run: RunId::of_number(8), sequence: 1 };
    spool.append(SpoolClass::History, &SpoolRecord { key, ..record(1) }).unwrap();
    let batch = spool.oldest(SpoolClass::History, MANY, None).unwrap().unwrap();
    assert_eq!(batch.records.len(), 3);
    spool.acknowledge(&batch).unwrap();
    let batch = spool.oldest(SpoolClass::History, MANY, None).unwrap().unwrap();
    assert_eq!(batch.records[0].key, key);
}

#[test]
fn a_folder_that_is_gone_is_an_error_once_and_then_made_anew() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), 64 * 1024).unwrap();
    fill(&mut spool, SpoolClass::History, 1..3);
    fs::remove_dir_all(folder.path().join("log")).unwrap();
    // what is written into a file without a name is lost with it, until the next segment begins
    let outcomes: Vec<bool> =
        (3..2000).map(|own| spool.append(SpoolClass::History, &record(own)).is_ok()).collect();
    assert!(outcomes.last().unwrap());
    assert!(!drain(&mut spool, SpoolClass::History, 100).is_empty());
}

#[test]
fn a_disk_that_is_full_is_told_and_counted_and_does_no_harm() {
    let folder = tempfile::tempdir().unwrap();
    let mut spool = Spool::open(folder.path(), QUOTA).unwrap();
    // the folder of the class becomes a file: nothing can be begun there
    fs::remove_dir_all(folder.path().join("log")).unwrap();
    fs::write(folder.path().join("log"), "").unwrap();
    assert!(spool.append(SpoolClass::History, &record(1)).is_err());
    assert_eq!(spool.losses().unwritten, 1);
    fs::remove_file(folder.path().join("log")).unwrap();
    fill(&mut spool, SpoolClass::History, 2..4);
    assert_eq!(drain(&mut spool, SpoolClass::History, 10), [2, 3]);
}
