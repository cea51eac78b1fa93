use super::*;
use insd_base::Span;

/// UTC at which the computer's monotonic clock reads zero, by both of its clocks.
fn start() -> UtcTime {
    UtcTime::from_civil((2026, 6, 3), (12, 0, 0), 0).unwrap()
}

fn stamp(seconds: f64) -> Stamp {
    let system = start().plus(Span::from_seconds(seconds));
    Stamp { monotonic: Time::from_seconds(seconds), system }
}

/// A message of source `index` at `seconds`, of an epoch that is late by 0.1 s and told off by `off`, s.
fn told(utc: &mut ShipUtc, index: usize, seconds: f64, off: f64) -> bool {
    let label = start().plus(Span::from_seconds(seconds - 0.1 + off));
    let epoch = utc.resolve(&EpochTime::Utc(label), &stamp(seconds), true).unwrap();
    utc.message((1 + index as u8, index), epoch, Time::from_seconds(seconds), Span::ZERO)
}

/// UTC by five messages a second of one source for ten seconds.
fn known() -> ShipUtc {
    let mut utc = ShipUtc::default();
    for k in 0..50 {
        assert!(told(&mut utc, 0, f64::from(k) * 0.2, 0.0));
    }
    assert_eq!(utc.take_changes(), [TimeChange::Quality(TimeQuality::Messages)]);
    utc
}

/// By how much UTC is off, s.
fn error(utc: &ShipUtc, seconds: f64) -> f64 {
    let now = utc.utc_at(Time::from_seconds(seconds)).unwrap();
    now.since(stamp(seconds).system).as_seconds() + 0.1
}

#[test]
fn messages_that_were_held_up_are_refused_and_make_no_step() {
    for rate in [1.0, 5.0, 20.0] {
        let mut utc = known();
        let held_up = (29.5 * rate) as u32;
        for k in 0..held_up {
            let epoch = stamp(10.0 + f64::from(k) / rate).system;
            let epoch = utc.resolve(&EpochTime::Utc(epoch), &stamp(40.0), true).unwrap();
            let believed = utc.message((1, 0), epoch, Time::from_seconds(40.0), Span::ZERO);
            let beyond = 30.0 - f64::from(k) / rate - 0.1 - LATEST;
            assert!(beyond.abs() < 0.01 || believed == (beyond < 0.0), "{k} of {rate} Hz");
        }
        let stepped = |change: &TimeChange| matches!(change, TimeChange::Stepped { .. });
        assert!(!utc.take_changes().iter().any(stepped), "{rate} Hz");
        assert!(error(&utc, 40.0).abs() < 2e-3, "{rate} Hz: {}", error(&utc, 40.0));
    }
}

#[test]
fn many_messages_of_one_epoch_are_one_reason_to_believe_it() {
    let mut utc = known();
    for _ in 0..10 {
        assert!(!told(&mut utc, 0, 10.0, 60.0));
    }
    assert!(told(&mut utc, 0, 10.2, 0.0));
    for k in 0..4 {
        assert!(!told(&mut utc, 0, 10.4 + f64::from(k) * 0.2, 60.0));
    }
    assert!(told(&mut utc, 0, 11.2, 60.0));
    let stepped = utc.take_changes().into_iter().find_map(|change| match change {
        TimeChange::Stepped { by } => Some(by),
        _ => None,
    });
    assert!((stepped.unwrap() - 60.0).abs() < 0.01, "{stepped:?}");
}

#[test]
fn another_source_that_says_something_else_is_refused_and_moves_nothing() {
    let mut utc = known();
    for k in 0..100 {
        let seconds = 10.0 + f64::from(k) * 0.2;
        assert!(told(&mut utc, 0, seconds, 0.0));
        for step in 0..8 {
            assert!(!told(&mut utc, 1, seconds + 0.02 * f64::from(step), -7.0));
        }
    }
    assert_eq!(utc.take_changes(), []);
    assert!(error(&utc, 30.0).abs() < 1e-3);
}

#[test]
fn another_source_takes_over_when_that_in_use_is_not_believed_any_more() {
    let mut utc = known();
    for k in 0..40 {
        let seconds = 10.0 + f64::from(k) * 0.2;
        // each time another one
        assert!(!told(&mut utc, 0, seconds, 1000.0 + 50.0 * f64::from(k)));
        assert!(told(&mut utc, 1, seconds, 0.0));
    }
    assert_eq!(utc.source.map(|(_, index, _)| index), Some(1));
}

#[test]
fn a_date_of_1024_weeks_ago_has_the_leap_seconds_of_today() {
    let mut utc = ShipUtc::default();
    let ago = start().plus(Span::from_nanos(-CYCLE));
    let gps = utc.resolve(&EpochTime::Utc(ago), &stamp(0.0), true);
    assert_eq!(gps, Some(start().to_gps()));
    assert_eq!(utc.take_changes(), [TimeChange::Rollover { weeks: 1024 }]);
    let by_week = GpsTime::from_nanos(start().to_gps().as_nanos() - CYCLE);
    assert_eq!(utc.resolve(&EpochTime::Gps(by_week), &stamp(0.0), true), Some(start().to_gps()));
    assert_eq!(utc.take_changes(), []);
}

/// A pulse at each second from one to another, `late` s after it, and a message 0.1 s after the second.
fn beaten(utc: &mut ShipUtc, seconds: std::ops::Range<u32>, late: f64) {
    for second in seconds.map(f64::from) {
        let (time, sequence) = (Time::from_seconds(second + late), second as u32);
        utc.pulse(Pulse { time, sequence });
        assert!(told(utc, 0, second + 0.1, 0.0));
        utc.tick(Time::from_seconds(second + 0.2));
    }
}

#[test]
fn pulses_take_over_are_lost_when_they_move_and_take_over_again() {
    let mut utc = ShipUtc::default();
    beaten(&mut utc, 0..10, 0.0);
    assert_eq!(utc.quality(), TimeQuality::Pulses);
    beaten(&mut utc, 10..15, 0.01);
    assert_eq!(utc.quality(), TimeQuality::Messages);
    let unlocked = TimeChange::Pulse(PulseFault::Unlocked);
    assert!(utc.take_changes().contains(&unlocked));
    beaten(&mut utc, 15..25, 0.01);
    assert_eq!(utc.quality(), TimeQuality::Pulses);
    let now = utc.utc_at(Time::from_seconds(25.0)).unwrap();
    assert!((now.since(stamp(25.0).system).as_seconds() + 0.01).abs() < 1e-5);
}

#[test]
fn a_latency_that_is_stated_too_great_does_not_keep_messages_from_naming_pulses() {
    let mut utc = ShipUtc::default();
    for second in 0..10 {
        let now = Time::from_seconds(f64::from(second));
        utc.pulse(Pulse { time: now, sequence: second });
        let epoch = stamp(f64::from(second)).system.to_gps();
        let (begun, latency) = (now + Span::from_seconds(0.1), Span::from_seconds(0.12));
        assert!(utc.message((1, 0), epoch, begun, latency));
    }
    assert_eq!(utc.quality(), TimeQuality::Pulses);
}

#[test]
fn pulses_that_messages_name_make_the_ships_utc() {
    let mut utc = ShipUtc::default();
    for second in 0..10 {
        let gps = GpsTime::from_nanos((1_400_000_000 + second) * SECOND);
        let time = Time::from_nanos(second * SECOND + 300_000_000);
        utc.pulse(Pulse { time, sequence: 0 });
        let received = time + Span::from_nanos(200_000_000);
        assert!(utc.message((0, 0), gps, received, Span::ZERO));
        utc.tick(received);
        let by_pulses = utc.time_of(gps) == Some(time);
        assert_eq!(by_pulses, second >= 3, "at {second} s");
    }
    assert_eq!(utc.quality(), TimeQuality::Pulses);
}

/// A date told by a message, and what becomes of it while the computer's clock says something.
fn dated(
    utc: &mut ShipUtc,
    told: (i32, u8, u8),
    clock: (i32, u8, u8),
    live: bool,
) -> (i32, u8, u8) {
    let noon = |day| UtcTime::from_civil(day, (12, 0, 0), 0).unwrap();
    let stamp = Stamp { monotonic: Time::from_seconds(1.0), system: noon(clock) };
    let gps = utc.resolve(&EpochTime::Utc(noon(told)), &stamp, live).unwrap();
    utc.utc_of(gps).to_civil().0
}

#[test]
fn the_date_of_a_recording_stands() {
    let fresh = ShipUtc::default;
    let (then, now) = ((2014, 8, 1), (2026, 11, 22));
    assert_eq!(dated(&mut fresh(), then, now, false), then, "a file");
    assert_eq!(dated(&mut fresh(), then, now, true), then, "a file that is played to a port");
    assert_eq!(dated(&mut fresh(), then, then, true), then, "with the clock of its time");
    // 1024 weeks ago to the day: a file has no clock that could speak against it
    assert_eq!(dated(&mut fresh(), (2007, 4, 8), now, false), (2007, 4, 8));
}

#[test]
fn the_date_of_a_receiver_at_work_that_has_rolled_over_is_put_right() {
    let fresh = ShipUtc::default;
    // the clock is right, or was not carried on while the computer was off
    for clock in [(2026, 11, 22), (2026, 1, 2), (2028, 5, 1)] {
        assert_eq!(dated(&mut fresh(), (2007, 4, 8), clock, true), (2026, 11, 22), "{clock:?}");
    }
    // it was never set: no receiver at work is older than the program
    for clock in [(1970, 1, 1), (2000, 1, 1), (2025, 12, 1)] {
        assert_eq!(dated(&mut fresh(), (2007, 4, 8), clock, true), (2026, 11, 22), "{clock:?}");
        assert_eq!(dated(&mut fresh(), (2030, 4, 8), clock, true), (2030, 4, 8), "{clock:?}");
    }
}

#[test]
fn a_receiver_that_has_rolled_over_is_put_right_by_another_one_in_the_same_file() {
    // the R/V Nathaniel B. Palmer on the 1st of August 2014 had one of either kind
    let (wrong, right) = ((1994, 12, 16), (2014, 8, 1));
    let mut utc = ShipUtc::default();
    assert_eq!(dated(&mut utc, wrong, (2026, 11, 22), false), wrong);
    assert_eq!(dated(&mut utc, right, (2026, 11, 22), false), right);
    assert_eq!(dated(&mut utc, wrong, (2026, 11, 22), false), right);
    assert_eq!(utc.take_changes(), [TimeChange::Rollover { weeks: 1024 }]);
}

#[test]
fn a_receiver_that_is_ahead_of_the_clock_by_whole_cycles_moves_nothing() {
    let mut utc = known();
    let ahead = start().plus(Span::from_nanos(CYCLE)).plus(Span::from_seconds(10.0));
    let epoch = utc.resolve(&EpochTime::Utc(ahead), &stamp(10.0), true).unwrap();
    assert!(!utc.message((2, 1), epoch, Time::from_seconds(10.0), Span::ZERO));
    assert_eq!(utc.quality(), TimeQuality::Messages);
    assert!(error(&utc, 10.0).abs() < 2e-3);
}
