//! Sentences of receivers: what is written is read back.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod common;

use common::{angle, close, date, perhaps, position, read, same_angle, same_position, time_of_day};
use insd_base::units::KNOT;
use insd_wire::nmea::{
    Date, Datum, Dtm, FixDimension, Gll, Gns, Gsa, Gst, Gsv, MAX_USED, NavStatus, PositionMode,
    Rmc, SatelliteInView, Sentence, Talker,
};
use proptest::prelude::*;

fn mode() -> impl Strategy<Value = PositionMode> {
    prop::sample::select(b"ADEFMNPRS".to_vec())
        .prop_map(|letter| PositionMode::from_letter(letter).unwrap())
}

fn nav_status() -> impl Strategy<Value = NavStatus> {
    prop::sample::select(b"SCUV".to_vec())
        .prop_map(|letter| NavStatus::from_letter(letter).unwrap())
}

fn satellite() -> impl Strategy<Value = SatelliteInView> {
    (prop::option::of(1..=999_u16), perhaps(-1.5..1.5), angle(), perhaps(0.0..99.0)).prop_map(
        |(id, elevation, azimuth, noise_density)| SatelliteInView {
            id,
            elevation,
            azimuth,
            noise_density,
        },
    )
}

proptest! {
    #[test]
    fn fixes_of_several_systems_come_back(
        time in prop::option::of(time_of_day()), position in prop::option::of(position()),
        letters in prop::collection::vec(mode(), 1..=6),
        satellites in prop::option::of(0..=99_u8), hdop in perhaps(0.0..99.0),
        altitude in perhaps(-99.0..99.0), geoid_separation in perhaps(-110.0..90.0),
        age in perhaps(0.0..999.0), station in prop::option::of(0..=4095_u16),
        nav_status in nav_status(),
    ) {
        let mut gns = Gns {
            time, position, satellites, hdop, altitude, geoid_separation, age, station,
            nav_status: Some(nav_status), ..Gns::default()
        };
        gns.modes.iter_mut().zip(letters).for_each(|(mode, letter)| *mode = Some(letter));
        let Sentence::Gns(back) = read(&gns.write(Talker::GN)) else { panic!() };
        prop_assert!(same_position(position, back.position));
        prop_assert_eq!((time, gns.modes, satellites), (back.time, back.modes, back.satellites));
        prop_assert!(close(hdop, back.hdop, 0.05));
        prop_assert!(close(altitude, back.altitude, 0.005));
        prop_assert!(close(geoid_separation, back.geoid_separation, 0.005));
        prop_assert_eq!(gns.nav_status, back.nav_status);
        if back.station.is_some() || back.age.is_some() {
            prop_assert_eq!(station, back.station);
            prop_assert!(close(age, back.age, 0.05));
        }
    }

    #[test]
    fn geographic_positions_come_back(
        time in prop::option::of(time_of_day()), position in prop::option::of(position()),
        valid: bool, mode in mode(),
    ) {
        let gll = Gll { position, time, valid, mode: Some(mode) };
        let Sentence::Gll(back) = read(&gll.write(Talker::GP)) else { panic!() };
        prop_assert!(same_position(position, back.position));
        prop_assert_eq!((back.time, back.mode), (time, Some(mode)));
        prop_assert_eq!(back.valid, valid && position.is_some());
    }

    #[test]
    fn the_recommended_minimum_comes_back(
        time in prop::option::of(time_of_day()), position in prop::option::of(position()),
        valid: bool, speed in perhaps(0.0..50.0), course in angle(), date in date(),
        year in 1980..2080_u16, variation in perhaps(-3.1..3.1), mode in mode(),
        nav_status in nav_status(),
    ) {
        let date = Some(Date { year, ..date }).filter(|date| date.is_valid());
        let rmc = Rmc {
            time, valid, position, speed, course, date, variation,
            mode: Some(mode), nav_status: Some(nav_status),
        };
        let Sentence::Rmc(back) = read(&rmc.write(Talker::GP)) else { panic!() };
        prop_assert!(same_position(position, back.position));
        prop_assert_eq!((back.time, back.date, back.mode), (time, date, Some(mode)));
        prop_assert_eq!(back.nav_status, Some(nav_status));
        prop_assert_eq!(back.valid, valid && position.is_some());
        prop_assert!(close(speed, back.speed, 0.005 * KNOT));
        prop_assert!(same_angle(course, back.course, 0.005_f64.to_radians()));
        prop_assert!(close(variation, back.variation, 0.05_f64.to_radians()));
    }

    #[test]
    fn error_statistics_come_back(
        time in prop::option::of(time_of_day()), orientation in angle(),
        sigmas in prop::array::uniform6(perhaps(0.0..9999.0)),
    ) {
        let [range_rms, major_std, minor_std, latitude_std, longitude_std, altitude_std] = sigmas;
        let gst = Gst {
            time, range_rms, major_std, minor_std, orientation, latitude_std, longitude_std,
            altitude_std,
        };
        let Sentence::Gst(back) = read(&gst.write(Talker::GN)) else { panic!() };
        prop_assert_eq!(back.time, time);
        prop_assert!(same_angle(orientation, back.orientation, 0.005_f64.to_radians()));
        prop_assert!(close(range_rms, back.range_rms, 0.005));
        let sigmas_back = [back.major_std, back.minor_std, back.latitude_std, back.longitude_std,
            back.altitude_std];
        for (written, back) in sigmas.into_iter().skip(1).zip(sigmas_back) {
            prop_assert!(close(written, back, 0.000_5));
        }
    }

    #[test]
    fn satellites_used_come_back(
        automatic: bool, dimension in 0..3_usize, system in prop::option::of(0..16_u8),
        ids in prop::collection::vec(prop::option::of(1..=99_u16), 12),
        dops in prop::array::uniform3(perhaps(0.0..99.0)),
    ) {
        let dimension = [FixDimension::None, FixDimension::Two, FixDimension::Three][dimension];
        let [pdop, hdop, vdop] = dops;
        let mut satellites = [None; MAX_USED];
        satellites[..12].copy_from_slice(&ids);
        let gsa = Gsa { automatic: Some(automatic), dimension, satellites, pdop, hdop, vdop, system };
        let Sentence::Gsa(back) = read(&gsa.write(Talker::GN)) else { panic!() };
        prop_assert_eq!((back.automatic, back.dimension), (Some(automatic), dimension));
        prop_assert_eq!((back.satellites, back.system), (satellites, system));
        for (written, back) in dops.into_iter().zip([back.pdop, back.hdop, back.vdop]) {
            prop_assert!(close(written, back, 0.005));
        }
    }

    #[test]
    fn satellites_in_view_come_back(
        counts in (1..=9_u8, 1..=9_u8), in_view in prop::option::of(0..=36_u16),
        some in prop::collection::vec(satellite(), 0..=4), signal in prop::option::of(0..16_u8),
    ) {
        let mut satellites = [None; 4];
        satellites.iter_mut().zip(&some).for_each(|(place, one)| *place = Some(*one));
        let (sentences, number) = (counts.0.max(counts.1), counts.0.min(counts.1));
        let gsv = Gsv { sentences, number, in_view, satellites, signal };
        let Sentence::Gsv(back) = read(&gsv.write(Talker::GN)) else { panic!() };
        prop_assert_eq!((back.sentences, back.number, back.in_view), (sentences, number, in_view));
        prop_assert_eq!(back.signal, signal);
        let half_digit = 0.5_f64.to_radians();
        for (written, back) in satellites.into_iter().zip(back.satellites) {
            prop_assert_eq!(written.map(|s| s.id), back.map(|s| s.id));
            let (Some(written), Some(back)) = (written, back) else { continue };
            prop_assert!(close(written.elevation, back.elevation, half_digit));
            prop_assert!(same_angle(written.azimuth, back.azimuth, half_digit));
            prop_assert!(close(written.noise_density, back.noise_density, 0.5));
        }
    }

    #[test]
    fn datums_come_back(
        subdivision in prop::option::of(b'A'..=b'Z'), altitude_offset in perhaps(-999.0..999.0),
        offsets in (perhaps(-0.017..0.017), perhaps(-0.017..0.017)),
    ) {
        let (latitude_offset, longitude_offset) = offsets;
        let reference = Datum::new("W84");
        let datum = Datum::new("P90");
        let dtm = Dtm {
            datum, subdivision, latitude_offset, longitude_offset, altitude_offset, reference,
        };
        let Sentence::Dtm(back) = read(&dtm.write(Talker::GP)) else { panic!() };
        let half_digit = (0.000_05_f64 / 60.0).to_radians();
        prop_assert_eq!((back.datum, back.reference), (datum, Some(Datum::WGS84)));
        prop_assert_eq!(back.subdivision, subdivision);
        prop_assert!(close(latitude_offset, back.latitude_offset, half_digit));
        prop_assert!(close(longitude_offset, back.longitude_offset, half_digit));
        prop_assert!(close(altitude_offset, back.altitude_offset, 0.005));
    }
}
