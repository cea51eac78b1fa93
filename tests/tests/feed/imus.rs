//! Faults of an IMU's own clock and counter.

use insd_intake::event::Happening;
use insd_tests::feed::{Encoding, arrivals, feed};

use super::passage::{IMU, Ship, usual};

/// The usual ship with another IMU.
fn ship_with(encoding: Encoding) -> Ship {
    Ship::new(&[encoding, Encoding::Ubx, Encoding::Vbw, Encoding::Ths], |_, _| {})
}

/// From an instant on, s, the IMU's clock and count are off by so many seconds and samples.
fn set_anew(ship: &Ship, from: f64, offset: f64, count: u64) -> Ship {
    let mut config = ship.feed.clone();
    config.sensors[0].clock.offset += offset;
    config.sensors[0].clock.count += count;
    let later = arrivals(&feed(&ship.voyage, &config), &ship.reception);
    let keep = |own: &&insd_base::Arrival, after: bool| (ship.when(own) >= from) == after;
    let mut all: Vec<_> = ship.arrivals.iter().filter(|own| keep(own, false)).cloned().collect();
    all.extend(later.iter().filter(|own| keep(own, true)).cloned());
    Ship { arrivals: all, ..ship.clone() }
}

fn clock_stepped(own: &Happening) -> bool {
    matches!(own, Happening::DeviceClockStepped { sensor: 0, .. })
}

fn lost(own: &Happening) -> bool {
    matches!(own, Happening::SamplesLost { sensor: 0, .. })
}

#[test]
fn an_imu_whose_clock_starts_again_is_tied_anew_and_loses_nothing() {
    let mut ship = Ship::usual().clone();
    // it has run for an hour; after a short break it starts at zero
    ship.feed.sensors[0].clock.offset = 3600.0;
    ship.arrivals = arrivals(&feed(&ship.voyage, &ship.feed), &ship.reception);
    for offset in [-3690.0, 1000.0, -0.3, 0.03] {
        let passage = set_anew(&ship, 90.0, offset, 0).sail();
        assert_eq!(passage.has(clock_stepped), offset.abs() > 0.1, "{offset}");
        assert_eq!(passage.counts, usual().counts, "{offset}");
        passage.holds_against(usual(), IMU);
    }
}

#[test]
fn a_count_that_jumps_is_told_and_the_samples_keep_their_times() {
    for encoding in
        [Encoding::Kvh { stamped: false }, Encoding::Stim, Encoding::Kvh { stamped: true }]
    {
        let ship = ship_with(encoding);
        let sound = ship.sail();
        for jump in [5, 50] {
            let passage = set_anew(&ship, 90.0, 0.0, jump).sail();
            assert!(passage.has(lost), "{encoding:?} {jump}");
            assert_eq!(passage.counts, sound.counts, "{encoding:?} {jump}");
            passage.holds_against(&sound, IMU);
        }
    }
}

#[test]
fn a_short_count_that_goes_round_unseen_is_made_good_by_the_receipts() {
    for encoding in [Encoding::Kvh { stamped: false }, Encoding::Stim] {
        let ship = ship_with(encoding);
        let sound = ship.sail();
        let span = (90.0, 95.0);
        let cut =
            ship.changed(|own| if ship.is_of(own, IMU, span) { vec![] } else { vec![own.clone()] });
        let passage = cut.sail();
        let told = passage.news().into_iter().find_map(|own| match own {
            Happening::SamplesLost { count, .. } => Some(*count),
            _ => None,
        });
        assert_eq!(told, Some(500), "{encoding:?}");
        assert!(!passage.has(clock_stepped), "{encoding:?}");
        // the samples after the gap are where they are without it, and so are the solutions
        assert_eq!(passage.solutions.len(), sound.solutions.len(), "{encoding:?}");
        assert_eq!(passage.noted.imu_gaps, 1, "{encoding:?}");
        passage.loses_nothing_beside(&sound, IMU);
    }
}
