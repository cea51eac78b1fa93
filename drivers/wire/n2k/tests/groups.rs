//! Groups written and read back, over the whole range of their fields.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod parts;

use insd_n2k::pgn::{
    Attitude, CourseSpeed, DistanceLog, Dops, GnssPosition, Group, Heading, Heave, Known,
    MagneticVariation, PositionRapid, PseudorangeNoise, RateOfTurn, SetDrift, Short, Speed,
    SpeedComponents, SystemTime, TimeDate,
};
use parts::{any_known, parts};
use proptest::prelude::*;

/// Bits that say nothing, from and to.
fn reserved(pgn: u32) -> &'static [(usize, usize)] {
    match pgn {
        126_992 => &[(12, 16)],
        127_250 => &[(58, 64)],
        127_251 => &[(40, 64)],
        127_252 => &[(24, 64)],
        127_257 => &[(56, 64)],
        127_258 => &[(12, 16), (48, 64)],
        128_259 => &[(52, 64)],
        129_026 | 129_291 => &[(10, 16), (48, 64)],
        129_029 => &[(258, 264)],
        129_539 => &[(14, 16)],
        _ => &[],
    }
}

fn read(pgn: u32, data: &[u8]) -> Known {
    Known::read(pgn, data).unwrap().unwrap()
}

fn assert_near(meant: &Known, got: &Known) {
    let (meant_parts, got_parts) = (parts(meant), parts(got));
    assert_eq!(meant_parts.rest, got_parts.rest);
    assert_eq!(meant_parts.numbers.len(), got_parts.numbers.len());
    for (meant_number, number) in meant_parts.numbers.iter().zip(&got_parts.numbers) {
        assert!(meant_number.near(number), "{meant_number:?} {number:?} in {got:?}");
    }
}

fn any_bytes() -> impl Strategy<Value = (u32, Vec<u8>)> {
    let bytes = prop_oneof![
        proptest::collection::vec(any::<u8>(), 0..60),
        proptest::collection::vec(prop_oneof![Just(0xFF), Just(0x7F), Just(0x80), Just(0)], 0..240),
    ];
    (prop::sample::select(Known::PGNS.to_vec()), bytes)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn what_is_written_is_read_to_half_a_step(meant in any_known()) {
        assert_near(&meant, &read(meant.pgn(), &meant.write()));
    }

    #[test]
    fn reserved_bits_are_written_as_ones_and_ignored(meant in any_known(), noise in any::<u64>()) {
        let mut data = meant.write();
        let before = read(meant.pgn(), &data);
        for bit in reserved(meant.pgn()).iter().flat_map(|(from, to)| *from..*to) {
            prop_assert!(data[bit / 8] >> (bit % 8) & 1 == 1, "bit {}", bit);
            data[bit / 8] ^= ((noise >> (bit % 64) & 1) as u8) << (bit % 8);
        }
        prop_assert_eq!(read(meant.pgn(), &data), before);
    }

    #[test]
    fn missing_bytes_at_the_end_are_not_available(meant in any_known(), cut in 0.0..1.0_f64) {
        let data = meant.write();
        let shorter = &data[..(data.len() as f64 * cut) as usize];
        let Ok(got) = Known::read(meant.pgn(), shorter).unwrap() else { return Ok(()) };
        let whole = parts(&read(meant.pgn(), &data)).numbers;
        for number in parts(&got).numbers {
            let among = whole.iter().any(|other| other.value == number.value);
            prop_assert!(number.value.is_none() || among, "{:?} in {:?}", number, got);
        }
    }

    #[test]
    fn any_bytes_are_read_without_panic_and_are_stable((pgn, data) in any_bytes()) {
        let Ok(first) = Known::read(pgn, &data).unwrap() else { return Ok(()) };
        let again = read(pgn, &first.write());
        assert_near(&again, &read(pgn, &again.write()));
        // an integrity that the bytes do not reach is written as not checked
        if pgn != GnssPosition::PGN {
            assert_near(&first, &again);
        }
    }
}

/// Has all groups written that hold nothing but this number.
fn all_of(value: Option<f64>) -> Vec<Known> {
    let fix = GnssPosition {
        sid: None,
        date: None,
        time: value,
        latitude: value,
        longitude: value,
        altitude: value,
        system: None,
        method: None,
        integrity: Some(insd_n2k::pgn::Integrity::Safe),
        satellites: None,
        hdop: value,
        pdop: value,
        geoid: value,
        stations: Vec::new(),
    };
    let speed = Speed { sid: None, water: value, ground: value, kind: None, direction: None };
    let noise = PseudorangeNoise {
        sid: None,
        range_rms: value,
        major: value,
        minor: value,
        orientation: value,
        latitude_std: value,
        longitude_std: value,
        altitude_std: value,
    };
    let components = SpeedComponents {
        forward_water: value,
        starboard_water: value,
        forward_ground: value,
        starboard_ground: value,
        stern_starboard_water: value,
        stern_starboard_ground: value,
    };
    vec![
        SystemTime { sid: None, source: None, date: None, time: value }.into(),
        Heading { sid: None, heading: value, deviation: value, variation: value, reference: None }
            .into(),
        RateOfTurn { sid: None, rate: value }.into(),
        Heave { sid: None, heave: value }.into(),
        Attitude { sid: None, yaw: value, pitch: value, roll: value }.into(),
        MagneticVariation { sid: None, source: None, date: None, variation: value }.into(),
        speed.into(),
        DistanceLog { date: None, time: value, log: value, trip: value }.into(),
        PositionRapid { latitude: value, longitude: value }.into(),
        CourseSpeed { sid: None, reference: None, course: value, speed: value }.into(),
        fix.into(),
        TimeDate { date: None, time: value, local_offset: None }.into(),
        SetDrift { sid: None, reference: None, set: value, drift: value }.into(),
        Dops { sid: None, desired: None, actual: None, hdop: value, vdop: value, tdop: value }
            .into(),
        noise.into(),
        components.into(),
    ]
}

#[test]
fn not_available_survives_and_is_all_ones() {
    for empty in all_of(None) {
        let data = empty.write();
        assert_eq!(read(empty.pgn(), &data), empty);
        for byte in &data {
            assert!(matches!(byte, 0xFF | 0x7F) || empty.pgn() == GnssPosition::PGN, "{empty:?}");
        }
    }
    assert_eq!(all_of(None).iter().map(Known::pgn).collect::<Vec<_>>(), Known::PGNS);
}

#[test]
fn what_is_not_finite_or_out_of_range_is_not_available() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e14, -1e14] {
        for wrong in all_of(Some(value)) {
            for part in parts(&read(wrong.pgn(), &wrong.write())).numbers {
                assert!(part.value.is_none() || part.turns && value.is_finite(), "{wrong:?}");
            }
        }
    }
}

#[test]
fn an_integrity_that_is_not_known_is_written_as_not_checked() {
    let Some(Known::GnssPosition(fix)) = all_of(None).into_iter().find(|k| k.pgn() == 129_029)
    else {
        panic!("no position")
    };
    let data = GnssPosition { integrity: None, ..fix }.write();
    let integrity = GnssPosition::read(&data).unwrap().integrity;
    assert_eq!(integrity, Some(insd_n2k::pgn::Integrity::NoChecking));
}

#[test]
fn contents_without_the_first_value_are_too_short() {
    assert_eq!(Heading::read(&[0xFF, 1]), Err(Short { length: 2, least: 3 }));
    for pgn in Known::PGNS {
        assert!(Known::read(*pgn, &[]).unwrap().is_err());
    }
    assert!(Known::read(60_928, &[0; 8]).is_none());
}

#[test]
fn stations_beyond_what_fits_a_fast_packet_are_left_out() {
    let Some(Known::GnssPosition(fix)) = all_of(None).into_iter().find(|k| k.pgn() == 129_029)
    else {
        panic!("no position")
    };
    let station = insd_n2k::pgn::Station { system: None, id: Some(7), age: Some(1.5) };
    let data = GnssPosition { stations: vec![station; 60], ..fix }.write();
    assert_eq!(data.len(), 223);
    assert_eq!(GnssPosition::read(&data).unwrap().stations, [station; 45]);
}
