//! Messages of u-blox receivers that have no NAV-PVT, and the line from a base that moves: what is written is read back, what they say
//! of an epoch, and what they must not say.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::units::DEG;
use insd_base::{FixQuality, Geodetic, GpsTime, UtcTime, earth};
use insd_wire::gnss::EpochTime;
use insd_wire::gnss::ubx::{
    Carrier, FixType, NavPosLlh, NavRelPosNed, NavSol, NavStatus, NavTimeUtc, NavVelNed, UbxMessage,
};
use proptest::prelude::*;

/// Ns of the week.
const EPOCH: i64 = 302_400_250_000_000;

fn sol() -> NavSol {
    let place = Geodetic::from_degrees(-35.5, 139.25, 12.5);
    NavSol {
        time_of_week: EPOCH,
        fraction: -321,
        week: 2445,
        fix: FixType::ThreeDimensional,
        fix_ok: true,
        differential: true,
        week_valid: true,
        time_of_week_valid: true,
        position: earth::ecef(&place).0.into(),
        position_accuracy: Some(2.5),
        velocity: [1.0, -2.0, 3.0],
        speed_accuracy: Some(0.25),
        pdop: 1.5,
        satellites: 9,
    }
}

fn line() -> NavRelPosNed {
    NavRelPosNed {
        version: 1,
        station: 17,
        time_of_week: EPOCH,
        relative: [-1.5, 0.25, 0.03],
        length: 1.52,
        heading: -0.5,
        finer: [0.0012, -0.0007, 0.0],
        finer_length: 0.0099,
        accuracy: [Some(0.01), Some(0.0123), None],
        length_accuracy: Some(0.002),
        heading_accuracy: Some(0.25 * DEG),
        fix_ok: true,
        differential: true,
        valid: true,
        carrier: Carrier::Fixed,
        moving: true,
        position_missing: false,
        measurements_missing: false,
        heading_valid: true,
        normalized: false,
    }
}

#[test]
fn an_older_receiver_tells_place_and_velocity_along_the_axes_of_the_earth() {
    let part = NavSol::read(&sol().write()).unwrap().part();
    assert_eq!(part.epoch, Some(EpochTime::Gps(GpsTime::from_week(2445, EPOCH - 321))));
    assert_eq!((part.quality, part.satellites), (Some(FixQuality::Differential), Some(9)));
    let place = part.position.unwrap();
    assert!((place.latitude.to_degrees() + 35.5).abs() < 1e-7);
    assert!((place.longitude.to_degrees() - 139.25).abs() < 1e-7);
    assert!((place.height - 12.5).abs() < 0.01);
    let speed: f64 = part.velocity.iter().map(|own| own.unwrap().powi(2)).sum();
    assert!((speed.sqrt() - 14.0_f64.sqrt()).abs() < 1e-9);
    assert_eq!((part.position_std, part.velocity_std), ([Some(2.5); 3], [Some(0.25); 3]));
}

#[test]
fn a_receiver_that_has_no_fix_says_so_and_tells_no_place() {
    let none = NavSol { fix: FixType::TimeOnly, position: [0.0; 3], ..sol() };
    let part = none.part();
    assert_eq!((part.position, part.velocity, part.invalid), (None, [None; 3], true));
    let zeros = NavSol { position: [0.0; 3], ..sol() };
    assert_eq!(zeros.part().position, None);
    let status = NavStatus {
        time_of_week: EPOCH,
        fix: FixType::ThreeDimensional,
        fix_ok: false,
        differential: false,
        week_valid: true,
        time_of_week_valid: true,
        spoofing: 2,
        carrier: Carrier::None,
        to_first_fix: 30_123_000_000,
        since_start: 1_000_000,
    };
    assert_eq!(NavStatus::read(&status.write()), Ok(status));
    assert_eq!((status.part().quality, status.part().invalid), (Some(FixQuality::Invalid), true));
}

#[test]
fn a_place_whose_accuracy_is_not_known_is_none() {
    let llh = NavPosLlh {
        time_of_week: EPOCH,
        longitude: 180.0 * DEG,
        latitude: -90.0 * DEG,
        height: -3.0,
        height_msl: 4.0,
        horizontal_accuracy: None,
        vertical_accuracy: Some(1.0),
    };
    assert_eq!(NavPosLlh::read(&llh.write()), Ok(llh));
    assert_eq!(llh.part().position, None);
    assert!(NavPosLlh { horizontal_accuracy: Some(1.0), ..llh }.part().position.is_some());
}

#[test]
fn utc_is_told_once_the_receiver_knows_its_leap_seconds() {
    let time = NavTimeUtc {
        time_of_week: EPOCH,
        accuracy: Some(1e-7),
        nanosecond: -250,
        year: 2026,
        month_day: [11, 28],
        clock: [1, 2, 3],
        time_of_week_valid: true,
        week_valid: true,
        valid: true,
        standard: 3,
    };
    let utc = UtcTime::from_civil((2026, 11, 28), (1, 2, 2), 999_999_750).unwrap();
    assert_eq!(NavTimeUtc::read(&time.write()).unwrap().part().epoch, Some(EpochTime::Utc(utc)));
    let unsure = NavTimeUtc { valid: false, ..time };
    assert_eq!(unsure.part().epoch, Some(EpochTime::TimeOfWeek(EPOCH)));
}

#[test]
fn only_a_fixed_line_from_a_base_that_moves_is_a_heading() {
    let read = NavRelPosNed::read(&line().write()).unwrap();
    let part = read.part();
    assert!((part.heading.unwrap() - (std::f64::consts::TAU - 0.5)).abs() < 1e-5 * DEG);
    assert!((part.heading_std.unwrap() - 0.25 * DEG).abs() < 1e-9);
    let [north, east, _] = read.baseline().unwrap();
    assert!((north + 1.4988).abs() < 1e-12 && (east - 0.2493).abs() < 1e-12);
    for other in [
        NavRelPosNed { moving: false, ..line() },
        NavRelPosNed { carrier: Carrier::Float, ..line() },
        NavRelPosNed { heading_valid: false, ..line() },
        NavRelPosNed { valid: false, ..line() },
        NavRelPosNed { fix_ok: false, ..line() },
    ] {
        assert_eq!((other.part().heading, other.part().heading_std), (None, None));
    }
    // the older version has neither length nor heading
    let older = [0; 40];
    let frame = insd_wire::gnss::ubx::Frame { class: 1, id: 0x3C, payload: &older }.write();
    assert_eq!(UbxMessage::read(&frame), Ok(UbxMessage::Other { class: 1, id: 0x3C }));
}

proptest! {
    #[test]
    fn velocities_come_back(
        steps in prop::array::uniform3(any::<i32>()), speeds in any::<(u32, u32)>(), course: i32,
        accuracies in prop::option::of((0..u32::MAX, 0..u32::MAX)),
    ) {
        let (speed, ground) = speeds;
        let (own, along) = accuracies.unzip();
        let told = NavVelNed {
            time_of_week: EPOCH,
            velocity: steps.map(|step| f64::from(step) * 0.01),
            speed: f64::from(speed) * 0.01,
            ground_speed: f64::from(ground) * 0.01,
            course: f64::from(course) * 1e-5 * DEG,
            speed_accuracy: own.map(|own| f64::from(own) * 0.01),
            course_accuracy: along.map(|own| f64::from(own) * 1e-5 * DEG),
        };
        let back = NavVelNed::read(&told.write()).unwrap();
        prop_assert_eq!(back.write(), told.write());
        prop_assert_eq!(back.velocity, told.velocity);
        prop_assert_eq!(back.part().velocity[0].is_some(), own.is_some());
    }
}
