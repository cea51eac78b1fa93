//! Excerpts of real files, whose origin `data/README.md` tells.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod checks;

use insd_base::satellites::MessageKind;
use insd_base::{BroadcastRecord, Constellation, GpsTime, SatelliteEpoch};
use insd_rinex::{ObservationReader, expand, is_compact, read_navigation};

const MOVING: &str = include_str!("data/moving.obs");
const MOVING_NAV: &str = include_str!("data/moving.nav");
const PAIR: &str = include_str!("data/pair.obs");
const PAIR_COMPACT: &str = include_str!("data/pair.crx");
const GEONET: &str = include_str!("data/geonet.05o");
const GEONET_COMPACT: &str = include_str!("data/geonet.05d");
const GEONET_NAV: &str = include_str!("data/geonet.05n");
const ESBJERG: &str = include_str!("data/esbjerg.nav");
const ESBJERG_GLONASS: &str = include_str!("data/esbjerg-glonass.nav");

fn epochs(text: &str) -> Vec<SatelliteEpoch> {
    ObservationReader::new(text).unwrap().map(Result::unwrap).collect()
}

#[test]
fn version_three_of_a_moving_receiver() {
    let reader = ObservationReader::new(MOVING).unwrap();
    let header = reader.header();
    assert_eq!((header.version, header.interval), (304, Some(1.0)));
    assert_eq!(header.position, Some([-3_962_108.225_8, 3_381_309.027_1, 3_668_678.524_1]));
    assert_eq!(header.receiver.kind, "SEPT MOSAIC-X5");
    let epochs = epochs(MOVING);
    assert_eq!(epochs.len(), 3);
    let first = &epochs[0];
    assert_eq!(first.tag, GpsTime::from_week(2176, (3 * 86_400 + 23_400) * 1_000_000_000));
    let own = first.signals.iter().find(|own| own.satellite.to_string() == "E07").unwrap();
    assert_eq!((own.code, own.phase), (Some(24_441_483.004), Some(128_440_856.815)));
    assert_eq!((own.cn0, own.doppler, own.slip), (Some(45.344), None, false));
}

#[test]
fn a_channel_before_the_observations_is_passed_over_and_glonass_has_its_frequencies() {
    let epochs = epochs(PAIR);
    assert_eq!(epochs.len(), 6);
    assert!(epochs.iter().all(|epoch| epoch.leap_seconds == Some(18)));
    let signals = &epochs[0].signals;
    let first = &signals[0];
    assert_eq!((first.satellite.to_string(), first.code), ("C01".to_owned(), Some(36_689_218.704)));
    assert_eq!((first.signal.to_string(), first.doppler), ("2I".to_owned(), Some(305.142)));
    let glonass: Vec<_> = signals
        .iter()
        .filter(|own| own.satellite.constellation == Constellation::Glonass)
        .collect();
    assert!(!glonass.is_empty() && glonass.iter().all(|own| own.wavelength().is_some()));
}

#[test]
fn version_two_has_the_signals_of_its_codes() {
    let epochs = epochs(GEONET);
    assert_eq!(epochs.len(), 26);
    let first = &epochs[0].signals[..2];
    let names: Vec<_> =
        first.iter().map(|own| format!("{} {}", own.satellite, own.signal)).collect();
    assert_eq!(names, ["G03 1C", "G03 2W"]);
    assert_eq!((first[1].code, first[1].phase), (Some(25_278_777.010), Some(45_740_211.652)));
    // the receiver was steered by a millisecond, and its tags say so
    assert_eq!(epochs[1].tag.since(epochs[0].tag).as_nanos(), 30_001_000_000);
}

#[test]
fn compact_files_become_those_they_were_made_of() {
    for (compact, plain) in [(PAIR_COMPACT, PAIR), (GEONET_COMPACT, GEONET)] {
        assert!(is_compact(compact) && !is_compact(plain));
        let expanded = expand(compact).unwrap();
        assert_eq!(expanded.flaws.total, 0);
        assert_eq!(expanded.text, plain);
    }
}

#[test]
fn messages_of_all_constellations_are_read() {
    let count = |text: &str| {
        let navigation = read_navigation(text).unwrap();
        assert_eq!((navigation.flaws.total, navigation.skipped), (0, 0));
        let kind = |record: &BroadcastRecord| match record {
            BroadcastRecord::Kepler(record) => record.kind,
            BroadcastRecord::Glonass(_) => MessageKind::Fdma,
        };
        let names =
            navigation.records.iter().map(|own| format!("{} {:?}", own.satellite(), kind(own)));
        (names.collect::<Vec<_>>().join(", "), navigation.ionosphere.len(), navigation.leap_seconds)
    };
    assert_eq!(
        count(MOVING_NAV),
        ("G06 Lnav, E08 Inav, E03 Inav, J07 Lnav".to_owned(), 2, Some(18))
    );
    assert_eq!(count(ESBJERG), ("C05 D2, E01 Fnav, E01 Inav, G01 Lnav".to_owned(), 2, Some(18)));
    assert_eq!(count(ESBJERG_GLONASS), ("R01 Fdma, R01 Fdma".to_owned(), 2, Some(18)));
    assert_eq!(count(GEONET_NAV), ("G01 Lnav, G03 Lnav".to_owned(), 1, Some(13)));
}

#[test]
fn what_is_read_and_written_and_read_again_is_the_same() {
    for text in [MOVING, PAIR, GEONET] {
        let (header, epochs, _) = checks::observations(text.as_bytes()).unwrap();
        checks::observations_come_back(&header, &epochs);
    }
    for text in [MOVING_NAV, ESBJERG, ESBJERG_GLONASS, GEONET_NAV] {
        let first = read_navigation(text).unwrap();
        let written =
            insd_rinex::write_navigation(&first.records, &first.ionosphere, first.leap_seconds);
        let second = read_navigation(&written).unwrap();
        assert_eq!(second.records, first.records);
        assert_eq!(second.ionosphere, first.ionosphere);
    }
}
