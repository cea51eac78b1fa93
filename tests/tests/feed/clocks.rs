//! Faults of UTC: the computer's, the receiver's, and the calendar's own.

use insd_base::{Arrival, Span, Time, UtcTime};
use insd_intake::clock::TimeChange;
use insd_intake::event::Happening;
use insd_tests::feed::{Calendar, Encoding, FeedConfig};

use super::passage::{GNSS, Passage, Ship, usual};

/// A ship with a receiver, from a UTC on, the receiver's calendar changed.
fn ship_with(receiver: Encoding, start: &str, change: impl Fn(&mut Calendar)) -> Ship {
    let encodings = [Encoding::Sbg, receiver, Encoding::Vbw, Encoding::Ths];
    Ship::new(&encodings, |_, config: &mut FeedConfig| {
        config.sensors.iter_mut().for_each(|own| own.calendar = Calendar::new(start).unwrap());
        change(&mut config.sensors[usize::from(GNSS)].calendar);
    })
}

fn time_changes(passage: &Passage) -> Vec<TimeChange> {
    let changes = passage.events.iter().filter_map(|(_, own)| match own {
        Happening::Time(change) => Some(*change),
        _ => None,
    });
    changes.filter(|own| !matches!(own, TimeChange::Quality(_))).collect()
}

#[test]
fn a_step_of_the_system_clock_is_told_and_moves_nothing() {
    let ship = Ship::usual();
    let hour = Span::from_seconds(3600.0);
    let passage = ship
        .changed(|own| {
            let mut own = own.clone();
            if ship.when(&own) >= 90.0 {
                own.stamp.system = own.stamp.system.plus(hour);
            }
            vec![own]
        })
        .sail();
    let told = passage.events.iter().find_map(|(_, own)| match own {
        Happening::SystemClockStepped { by } => Some(by.as_seconds()),
        _ => None,
    });
    assert!((told.unwrap() - 3600.0).abs() < 1e-6);
    assert_eq!(passage.counts, usual().counts);
    assert_eq!(passage.solutions, usual().solutions);
}

#[test]
fn a_receiver_whose_week_has_rolled_over_is_put_right() {
    for receiver in [Encoding::NmeaGnss, Encoding::Sbf, Encoding::Ubx] {
        let start = "2026-06-03T12:00:00Z";
        let sound = ship_with(receiver, start, |_| {}).sail();
        let ship = ship_with(receiver, start, |own| own.weeks_back = 1024);
        let passage = ship.sail();
        assert_eq!(time_changes(&passage), [TimeChange::Rollover { weeks: 1024 }], "{receiver:?}");
        assert_eq!(passage.counts, sound.counts, "{receiver:?}");
        assert!(passage.utc_error(&ship, 140.0).abs() < 1e-3, "{receiver:?}");
        passage.does_not_step(&sound);
    }
}

#[test]
fn a_leap_second_that_no_table_knows_is_told_and_moves_nothing() {
    for receiver in [Encoding::NmeaGnss, Encoding::Ubx] {
        let start = "2026-12-31T23:58:30Z";
        let sound = ship_with(receiver, start, |_| {}).sail();
        let end = UtcTime::from_civil((2027, 1, 1), (0, 0, 0), 0);
        let ship = ship_with(receiver, start, |own| own.leap = end);
        let passage = ship.sail();
        assert_eq!(time_changes(&passage), [TimeChange::LeapSecond], "{receiver:?}");
        assert_eq!(passage.counts, sound.counts, "{receiver:?}");
        // after the leap second UTC is a second earlier than without
        assert!(passage.utc_error(&ship, 89.0).abs() < 1e-3);
        assert!((passage.utc_error(&ship, 140.0) + 1.0).abs() < 1e-3);
        passage.does_not_step(&sound);
    }
}

/// At the epoch of midnight and the four after it the date of ZDA and RMC is still that of the day
/// before, while GGA and GST have only a time.
#[test]
fn a_date_that_changes_after_midnight_costs_no_fix() {
    let start = "2026-06-03T23:58:30Z";
    let ship = ship_with(Encoding::NmeaGnss, start, |_| {});
    let sound = ship.sail();
    let late = ship.with_bytes(GNSS, (90.0, 91.05), |bytes| {
        let text = String::from_utf8(bytes.to_vec()).unwrap();
        let text = text.replace(",04,06,2026", ",03,06,2026").replace(",040626,", ",030626,");
        with_checksum(&text)
    });
    assert!(late.arrivals != ship.arrivals);
    let passage = late.sail();
    assert!(time_changes(&passage).iter().all(|own| matches!(own, TimeChange::Doubted { .. })));
    assert!(!time_changes(&passage).is_empty());
    assert_eq!(passage.counts, sound.counts);
    passage.does_not_step(&sound);
}

fn with_checksum(text: &str) -> Vec<u8> {
    let body = text.trim_end().split(['$', '*']).nth(1).unwrap();
    let sum = insd_wire::nmea::checksum(body.as_bytes());
    format!("${body}*{sum:02X}\r\n").into_bytes()
}

#[test]
fn a_receiver_whose_time_steps_back_for_good_is_doubted_and_then_followed() {
    for receiver in [Encoding::Ubx, Encoding::NmeaGnss, Encoding::Sbf] {
        let start = "2026-06-03T12:00:00Z";
        let sound = ship_with(receiver, start, |_| {}).sail();
        let from = Time::from_seconds(90.0);
        let ship = ship_with(receiver, start, |own| own.step = Some((from, -10.0)));
        let passage = ship.sail();
        let changes = time_changes(&passage);
        let [TimeChange::Doubted { late }, TimeChange::Stepped { by }] = changes[..] else {
            panic!("{receiver:?}: {changes:?}");
        };
        assert!((late - 10.0).abs() < 0.1 && (by + 10.0).abs() < 0.1, "{late} {by}");
        assert!((passage.utc_error(&ship, 140.0) + 10.0).abs() < 1e-3);
        assert!(sound.counts[1] - passage.counts[1] <= 5, "{:?}", passage.counts);
        passage.holds_against(&sound, GNSS);
    }
}

#[test]
fn a_single_epoch_with_a_wrong_time_is_refused() {
    let ship = ship_with(Encoding::NmeaGnss, "2026-06-03T12:00:00Z", |_| {});
    let wrong = ship_with(Encoding::NmeaGnss, "2026-06-03T12:00:07Z", |_| {});
    let sound = ship.sail();
    let mut others = wrong.arrivals.iter();
    let mixed = ship.changed(|own: &Arrival| {
        let other = others.next().unwrap();
        let hit = ship.is_of(own, GNSS, (90.0, 90.15));
        vec![Arrival { input: if hit { &other.input } else { &own.input }.clone(), ..own.clone() }]
    });
    let passage = mixed.sail();
    assert!(matches!(time_changes(&passage)[..], [TimeChange::Doubted { .. }]));
    assert_eq!(passage.counts[1], sound.counts[1] - 1);
    passage.holds_against(&sound, GNSS);
}
