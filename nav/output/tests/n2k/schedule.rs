//! Which messages leave, when, and what ties them together.

use std::collections::BTreeMap;

use insd_base::{Span, Time};
use insd_n2k::node::Transmit;
use insd_n2k::pgn::{
    Attitude, CourseSpeed, GnssPosition, Group, Heading, PositionRapid, SpeedComponents,
    SystemTime, TimeDate,
};
use insd_output::n2k::{PgnSchedule, default_transmit};
use insd_output::{Manner, OutputEpoch};

use crate::ship::{all, epoch};

fn voice() -> PgnSchedule {
    PgnSchedule::new(Manner::default())
}

fn at(ms: i64) -> OutputEpoch {
    OutputEpoch { time: Time::from_nanos(ms * 1_000_000), utc: None, ..epoch() }
}

/// One group of the default table at another interval.
fn only<G: Group>(ms: i64) -> Vec<Transmit> {
    let interval = Span::from_nanos(ms * 1_000_000);
    vec![Transmit { pgn: G::PGN, priority: G::PRIORITY, interval, enabled: true }]
}

/// At which of some instants a table of one group has a message, ms.
fn sent(
    voice: &mut PgnSchedule,
    table: &[Transmit],
    instants: impl Iterator<Item = i64>,
) -> Vec<i64> {
    instants.filter(|ms| !voice.messages(&at(*ms), table).is_empty()).collect()
}

#[test]
fn a_minute_holds_as_many_messages_as_the_intervals_say() {
    for step in [100, 20] {
        let mut counts: BTreeMap<u32, i64> = BTreeMap::new();
        let mut voice = voice();
        for ms in (0..60_000).step_by(step) {
            for (pgn, _) in voice.messages(&at(ms), &default_transmit()) {
                *counts.entry(pgn).or_default() += 1;
            }
        }
        for line in default_transmit() {
            let expected = if line.enabled { 60_000_000_000 / line.interval.as_nanos() } else { 0 };
            assert_eq!(counts.get(&line.pgn).copied().unwrap_or(0), expected, "{}", line.pgn);
        }
    }
}

#[test]
fn the_default_table_is_that_of_the_documentation() {
    let table: Vec<_> = default_transmit()
        .into_iter()
        .map(|line| (line.pgn, line.interval.as_nanos() / 1_000_000, line.priority, line.enabled))
        .collect();
    let expected = [
        (127_250, 100, 2, true),
        (127_251, 100, 2, true),
        (129_025, 100, 2, true),
        (129_026, 250, 2, true),
        (130_578, 250, 2, true),
        (128_259, 1000, 2, true),
        (127_252, 100, 3, true),
        (127_257, 1000, 3, true),
        (129_029, 1000, 3, true),
        (126_992, 1000, 3, true),
        (129_033, 1000, 3, true),
        (129_291, 1000, 3, false),
        (129_542, 1000, 6, true),
        (129_539, 1000, 6, false),
        (127_258, 1000, 7, true),
    ];
    assert_eq!(table, expected);
}

#[test]
fn messages_leave_in_the_order_of_the_table() {
    let mut table = default_transmit();
    let order = |messages: Vec<(u32, Vec<u8>)>| -> Vec<u32> {
        messages.into_iter().map(|(pgn, _)| pgn).collect()
    };
    let enabled = |table: &[Transmit]| -> Vec<u32> {
        table.iter().filter(|line| line.enabled).map(|line| line.pgn).collect()
    };
    assert_eq!(order(voice().messages(&at(0), &table)), enabled(&table));
    table.reverse();
    assert_eq!(order(voice().messages(&at(0), &table)), enabled(&table));
}

#[test]
fn all_groups_of_an_epoch_carry_its_number_and_252_is_the_last() {
    let mut voice = voice();
    let without = [PositionRapid::PGN, TimeDate::PGN, SpeedComponents::PGN];
    for second in 0..300 {
        let mut messages = voice.messages(&at(second * 1000), &default_transmit());
        messages.retain(|(pgn, _)| !without.contains(pgn));
        assert_eq!(messages.len(), 10);
        for (pgn, contents) in messages {
            assert_eq!(i64::from(contents[0]), second % 253, "{pgn}");
        }
    }
}

#[test]
fn slow_groups_have_the_number_of_the_fast_ones_beside_them() {
    let mut voice = voice();
    for ms in (0..30_000).step_by(100) {
        let messages = voice.messages(&at(ms), &default_transmit());
        let sid = |wanted: u32| {
            let found = messages.iter().find(|(pgn, _)| *pgn == wanted);
            found.map(|(_, contents)| contents[0])
        };
        let heading = sid(Heading::PGN);
        assert_eq!(heading, Some(u8::try_from(ms / 100 % 253).unwrap()));
        for slow in [CourseSpeed::PGN, GnssPosition::PGN, Attitude::PGN, SystemTime::PGN] {
            assert!(sid(slow).is_none_or(|sid| Some(sid) == heading), "{slow} at {ms}");
        }
    }
}

#[test]
fn an_epoch_at_which_nothing_leaves_takes_no_number() {
    let mut voice = voice();
    let table = only::<Heading>(1000);
    let mut sids = Vec::new();
    for ms in (0..3000).step_by(100) {
        sids.extend(voice.messages(&at(ms), &table).into_iter().map(|(_, contents)| contents[0]));
    }
    assert_eq!(sids, [0, 1, 2]);
}

#[test]
fn intervals_do_not_drift_where_epochs_do_not_meet_them() {
    let instants = || (0..2000).step_by(100);
    assert_eq!(
        sent(&mut voice(), &only::<CourseSpeed>(250), instants()),
        [0, 300, 500, 800, 1000, 1300, 1500, 1800]
    );
    let gap = instants().filter(|ms| !(400..1100).contains(ms));
    assert_eq!(
        sent(&mut voice(), &only::<CourseSpeed>(250), gap),
        [0, 300, 1100, 1300, 1500, 1800]
    );
}

#[test]
fn what_is_not_enabled_or_not_known_is_not_sent() {
    let off: Vec<Transmit> =
        all().into_iter().map(|line| Transmit { enabled: false, ..line }).collect();
    assert_eq!(voice().messages(&at(0), &off), []);
    let heartbeat = Transmit { pgn: 126_993, ..only::<Heading>(1000)[0] };
    assert_eq!(voice().messages(&at(0), &[heartbeat]), []);
    assert_eq!(voice().messages(&at(0), &[]), []);
}

#[test]
fn an_interval_may_change_while_the_voice_speaks() {
    let mut voice = voice();
    let (slow, fast) = (only::<Heading>(1000), only::<Heading>(200));
    assert_eq!(sent(&mut voice, &slow, (0..1500).step_by(100)), [0, 1000]);
    assert_eq!(sent(&mut voice, &fast, (1500..2100).step_by(100)), [1500, 1600, 1800, 2000]);
    assert_eq!(sent(&mut voice, &slow, (2100..4100).step_by(100)), [3000, 4000]);
    let nothing = Transmit { interval: Span::ZERO, ..fast[0] };
    assert_eq!(sent(&mut voice, &[nothing], (4100..4400).step_by(100)), [4100, 4200, 4300]);
}
