//! What messages of receivers say of an epoch, and what they must not say.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{FixQuality, Geodetic, GpsTime};
use insd_wire::gnss::sbf::{
    self, AttCovEuler, AttEuler, PosCovGeodetic, PvtGeodetic, ReceiverTime, SbfMode, SbfSolution,
    SbfStamp, VelCovGeodetic, XppsOffset,
};
use insd_wire::gnss::ubx::{self, Carrier, FixType, NavCov, NavPvt, TimTp};
use insd_wire::gnss::{EpochTime, GnssEpoch, PulseOrder};
use insd_wire::nmea::TimeOfDay;

/// A ship under way south of Australia.
fn epoch(quality: FixQuality) -> GnssEpoch {
    GnssEpoch {
        time: GpsTime::from_week(2445, 302_400_250_000_000),
        leap_seconds: 18,
        time_std: 20e-9,
        position: Geodetic::from_degrees(-35.5, 139.25, 12.5),
        position_std: [0.75, 1.0, 2.5],
        undulation: -4.25,
        velocity: [-3.0, 4.0, 0.25],
        velocity_std: [0.03, 0.04, 0.12],
        satellites: 14,
        pdop: 1.75,
        hdop: 0.9,
        quality,
    }
}

fn pvt() -> NavPvt {
    NavPvt::of(&epoch(FixQuality::Autonomous))
}

fn close(known: [Option<f64>; 3], expected: [f64; 3], tolerance: f64) {
    for (known, expected) in known.into_iter().zip(expected) {
        assert!((known.unwrap() - expected).abs() <= tolerance, "{known:?} {expected}");
    }
}

#[test]
fn a_simulated_u_blox_says_what_the_simulator_knows() {
    let state = epoch(FixQuality::RtkFloat);
    let part = NavPvt::read(&NavPvt::of(&state).write()).unwrap().part();
    assert_eq!(part.epoch, Some(EpochTime::Utc(state.time.to_utc(Some(18)))));
    assert_eq!((part.quality, part.invalid), (Some(FixQuality::RtkFloat), false));
    close(part.velocity, state.velocity, 1e-12);
    close(part.velocity_std, [0.13; 3], 1e-12);
    close(part.position_std, [1.25 / 2.0_f64.sqrt(), 1.25 / 2.0_f64.sqrt(), 2.5], 1e-12);
    let position = part.position.unwrap();
    assert!((position.height - 12.5).abs() < 1e-12);
    assert!((position.latitude - state.position.latitude).abs() < 1e-15);
    let cov = ubx::UbxMessage::read(&NavCov::of(&state).write()).unwrap().part().unwrap();
    assert_eq!(cov.epoch, Some(EpochTime::TimeOfWeek(302_400_250_000_000)));
    close(cov.position_std, state.position_std, 1e-6);
    close(cov.velocity_std, state.velocity_std, 1e-8);
}

#[test]
fn a_simulated_septentrio_says_what_the_simulator_knows() {
    let state = epoch(FixQuality::RtkFixed);
    let part = PvtGeodetic::read(&PvtGeodetic::of(&state).write()).unwrap().part();
    assert_eq!(part.epoch, Some(EpochTime::Gps(state.time)));
    assert_eq!((part.quality, part.satellites), (Some(FixQuality::RtkFixed), Some(14)));
    assert_eq!(part.position, Some(state.position));
    close(part.velocity, state.velocity, 1e-6);
    close(part.position_std, [1.25 / 2.0_f64.sqrt(), 1.25 / 2.0_f64.sqrt(), 2.5], 1e-12);
    for part in [PosCovGeodetic::of(&state).part(), VelCovGeodetic::of(&state).part()] {
        assert_eq!(part.epoch, Some(EpochTime::Gps(state.time)));
    }
    close(PosCovGeodetic::of(&state).part().position_std, state.position_std, 1e-6);
    close(VelCovGeodetic::of(&state).part().velocity_std, state.velocity_std, 1e-8);
}

#[test]
fn without_a_fix_nothing_is_claimed() {
    for quality in [FixQuality::Invalid, FixQuality::Estimated] {
        let state = epoch(quality);
        let part = PvtGeodetic::read(&PvtGeodetic::of(&state).write()).unwrap().part();
        assert_eq!((part.position, part.velocity, part.invalid), (None, [None; 3], true));
        assert_eq!(PosCovGeodetic::of(&state).part().position_std, [None; 3]);
    }
    for fix in [FixType::None, FixType::TimeOnly, FixType::Other(9)] {
        let part = NavPvt { fix, ..pvt() }.part();
        assert_eq!((part.position, part.velocity, part.invalid), (None, [None; 3], true));
        assert_eq!((part.position_std, part.velocity_std), ([None; 3], [None; 3]));
        assert_eq!(part.quality, Some(FixQuality::Invalid));
    }
}

#[test]
fn the_flags_of_nav_pvt_make_its_quality() {
    let quality = |fix, fix_ok, differential, carrier| {
        NavPvt { fix, fix_ok, differential, carrier, ..pvt() }.quality()
    };
    let three = FixType::ThreeDimensional;
    assert_eq!(quality(three, false, true, Carrier::Fixed), FixQuality::Invalid);
    assert_eq!(quality(three, true, false, Carrier::None), FixQuality::Autonomous);
    assert_eq!(quality(three, true, true, Carrier::None), FixQuality::Differential);
    assert_eq!(quality(three, true, true, Carrier::Float), FixQuality::RtkFloat);
    assert_eq!(quality(FixType::Combined, true, true, Carrier::Fixed), FixQuality::RtkFixed);
    assert_eq!(quality(three, true, true, Carrier::Reserved), FixQuality::Differential);
    let reckoned = quality(FixType::DeadReckoning, true, true, Carrier::Fixed);
    assert_eq!(reckoned, FixQuality::Estimated);
    assert!(!reckoned.is_measured());
}

#[test]
fn utc_is_told_only_if_date_time_and_whole_seconds_are_certain() {
    let certain = pvt();
    let tow = Some(EpochTime::TimeOfWeek(certain.time_of_week));
    for doubt in 0..4 {
        let mut pvt = certain;
        match doubt {
            0 => pvt.time.date_valid = false,
            1 => pvt.time.clock_valid = false,
            2 => pvt.time.resolved = false,
            _ => pvt.time.nanosecond = i32::MIN,
        }
        assert_eq!(pvt.part().epoch, tow);
    }
    assert_eq!(NavPvt { time_of_week: -1, ..certain }.time.utc(), certain.time.utc());
    let mut leap = certain;
    (leap.time.clock, leap.time.nanosecond) = ((23, 59, 60), 0);
    let told = TimeOfDay { hour: 23, minute: 59, second: 60, nanosecond: 0 };
    assert_eq!(leap.part().epoch, Some(EpochTime::TimeOfDay(told)));
}

#[test]
fn a_position_that_is_marked_invalid_is_not_told() {
    let lost = NavPvt { position: None, ..pvt() };
    let back = NavPvt::read(&lost.write()).unwrap();
    assert_eq!((back.position, back.part().position), (None, None));
    let flat = NavPvt { fix: FixType::TwoDimensional, ..pvt() }.part();
    assert!(flat.velocity[0].is_some() && flat.velocity[2].is_none());
}

#[test]
fn a_latitude_beyond_the_pole_is_refused() {
    let mut payload = pvt().write()[6..98].to_vec();
    payload[28..32].copy_from_slice(&900_000_001_i32.to_le_bytes());
    let frame = ubx::Frame { class: 1, id: 7, payload: &payload }.write();
    let fault = NavPvt::read(&frame).unwrap_err();
    assert_eq!(fault.to_string(), "lat is out of its range");
}

#[test]
fn the_modes_of_sbf_make_its_quality() {
    let quality = |solution, error| {
        SbfMode { solution, determining: false, two_dimensional: false, error }.quality()
    };
    for (solution, expected) in [
        (SbfSolution::None, Some(FixQuality::Invalid)),
        (SbfSolution::StandAlone, Some(FixQuality::Autonomous)),
        (SbfSolution::Differential, Some(FixQuality::Differential)),
        (SbfSolution::FixedLocation, Some(FixQuality::Manual)),
        (SbfSolution::RtkFixed, Some(FixQuality::RtkFixed)),
        (SbfSolution::RtkFloat, Some(FixQuality::RtkFloat)),
        (SbfSolution::Sbas, Some(FixQuality::Differential)),
        (SbfSolution::MovingBaseFixed, Some(FixQuality::Differential)),
        (SbfSolution::PrecisePoint, Some(FixQuality::Differential)),
        (SbfSolution::Reserved(12), None),
    ] {
        assert_eq!(quality(solution, 0), expected);
        assert_eq!(quality(solution, 7), Some(FixQuality::Invalid));
    }
}

#[test]
fn weeks_are_whole_and_a_senseless_one_is_no_time() {
    let tow = 1_000_000_000;
    let stamp = |week| SbfStamp { time_of_week: Some(tow), week };
    let gps = EpochTime::Gps(GpsTime::from_week(2445, tow));
    assert_eq!(stamp(Some(2445)).epoch(), Some(gps));
    assert_eq!(stamp(None).epoch(), Some(EpochTime::TimeOfWeek(tow)));
    assert_eq!(stamp(Some(65_534)).gps(), None);
    assert_eq!(SbfStamp { time_of_week: None, week: Some(2445) }.epoch(), None);
}

#[test]
fn the_heading_of_several_antennas_is_told_if_there_is_an_attitude() {
    let stamp = SbfStamp::of(epoch(FixQuality::RtkFixed).time);
    let (heading, pitch, roll) = (Some(-0.5), Some(0.01), None);
    let attitude = AttEuler {
        stamp,
        satellites: None,
        error: 0,
        mode: 2,
        heading,
        pitch,
        roll,
        rates: [None; 3],
    };
    let told = |attitude: AttEuler| attitude.part().heading;
    assert!((told(attitude).unwrap() - (std::f64::consts::TAU - 0.5)).abs() < 1e-12);
    assert_eq!(told(AttEuler { mode: 0, ..attitude }), None);
    assert_eq!(told(AttEuler { error: 1, ..attitude }), None);
    assert_eq!(told(AttEuler { error: 0x80, ..attitude }), None);
    let variances = [Some(1e-4), None, None];
    let cov = AttCovEuler { stamp, error: 0, variances, covariances: [None; 3] };
    assert!((cov.part().heading_std.unwrap() - 0.01).abs() < 1e-12);
    assert_eq!(AttCovEuler { error: 4, ..cov }.part().heading_std, None);
}

#[test]
fn pulses_are_told_in_scales_that_are_certain() {
    let base = TimTp {
        time_of_week: 302_401_000_000_000,
        fraction: 0.0,
        quantization: None,
        week: 2445,
        utc_base: false,
        utc_available: false,
        raim: 0,
        system: 0,
        utc_standard: 0,
    };
    let instant = |pulse: TimTp| pulse.pulse().map(|told| told.instant);
    let gps = GpsTime::from_week(2445, base.time_of_week);
    assert_eq!(instant(base), Some(EpochTime::Gps(gps)));
    assert_eq!(instant(TimTp { system: 3, ..base }), None);
    assert_eq!(instant(TimTp { utc_base: true, ..base }), None);
    assert_eq!(instant(TimTp { week: u16::MAX, ..base }), None);
    assert_eq!(instant(TimTp { time_of_week: i64::MAX, ..base }), None);
    let stamp = SbfStamp::of(gps);
    let last = XppsOffset { stamp, age: 1, scale: 2, offset: Some(-3e-9) }.pulse().unwrap();
    assert_eq!((last.instant, last.order), (EpochTime::Gps(gps), PulseOrder::Last));
}

#[test]
fn time_before_synchronization_is_not_told() {
    let stamp = SbfStamp::of(epoch(FixQuality::Autonomous).time);
    let time = ReceiverTime { stamp, utc: None, leap_seconds: Some(18), sync: 0b111 };
    assert_eq!(time.part().epoch, stamp.epoch());
    assert_eq!(ReceiverTime { sync: 0b010, ..time }.part().epoch, None);
}

#[test]
fn longer_blocks_of_later_revisions_are_accepted() {
    let block = PvtGeodetic::of(&epoch(FixQuality::Autonomous)).write();
    let payload = [&block[8..], &[0xAA; 12]].concat();
    let later = sbf::Frame { id: 4007, revision: 5, payload: &payload }.write();
    assert_eq!(PvtGeodetic::read(&later).unwrap(), PvtGeodetic::read(&block).unwrap());
}

#[test]
fn blocks_before_revision_2_tell_no_accuracy() {
    let known = PvtGeodetic::of(&epoch(FixQuality::Autonomous));
    let oldest = PvtGeodetic { extra: None, ..known }.write();
    for revision in [0, 1] {
        // both take 88 bytes: padding of one is a field of the other
        let block = sbf::Frame { id: 4007, revision, payload: &known.write()[8..88] }.write();
        assert_eq!(block.len(), 88);
        assert_eq!(PvtGeodetic::read(&block), PvtGeodetic::read(&oldest));
    }
}
