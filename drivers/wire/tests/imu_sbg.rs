//! sbgECom: frames written by the maker's SDK, round trips, framing.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod frames;

use frames::{
    assert_frame_is_guarded, assert_splitting_does_not_matter, bytes_of_hex as hex, cut_all, stream,
};
use insd_base::UtcTime;
use insd_wire::binary::BinaryFault;
use insd_wire::imu::ImuMotion;
use insd_wire::imu::sbg::{
    ClockState, Euler, ImuData, ImuShort, SbgMessage, TimeReference, UtcStatus, look,
};
use insd_wire::nmea::CivilTime;
use insd_wire::stream::{Look, Protocol};
use proptest::prelude::*;

// Written by the functions of sbgECom 5.2.590 (MIT), each log by its own.
const SHORT: &str = "ff5a2c002000faffffffff03000002000000f8ff000063ff000040000000feff0000000680
    f301d733";
const SHORT_HIGH: &str = "ff5a2c002000faffffffff07000002000000f8ff000063ff40df551d6920a2ff2ebfbb
    0080f37ff933";
const DATA: &str = "ff5a03003a0015cd5b07ff020000003e000000bf00001dc10000803d000000bb0000c03f0000
    fa410000003e000000bf00001dc10000803d000000bb0000c03ff1d133";
const UTC: &str = "ff5a02002100404b4c00a700e0070c1f173b3c404b4c006d420000000080350000c07f000000b4
    a85c33";
const EULER: &str = "ff5a06002800070000000000803e000000be000040c06f12833a6f12033b0ad7233c34000000
    0000c07f0000803f078a33";

const ACCEL: [f64; 3] = [0.125, -0.5, -9.8125];
const GYRO: [f64; 3] = [0.0625, -0.001_953_125, 1.5];

fn read(frame: &[u8]) -> SbgMessage {
    SbgMessage::read(frame).unwrap_or_else(|fault| panic!("{frame:02x?}: {fault}"))
}

#[test]
fn imu_short_of_the_sdk_is_read_and_written() {
    let SbgMessage::ImuShort(short) = read(&hex(SHORT)) else { panic!() };
    let expected = ImuShort {
        time_stamp: 4_294_967_290,
        status: 0x03FF,
        accel: ACCEL,
        gyro: GYRO,
        temperature: -12.5,
    };
    assert_eq!(short, expected);
    assert_eq!(short.write(), hex(SHORT));
    let reading = short.reading();
    assert!(reading.valid);
    assert_eq!(reading.motion, ImuMotion::Rates { gyro: GYRO, accel: ACCEL });
    let time = reading.device_time.unwrap();
    assert_eq!((time.ticks.value, time.ticks.modulus, time.tick), (4_294_967_290, 1 << 32, 1e-6));
}

#[test]
fn a_fast_turn_goes_over_the_high_scale() {
    let SbgMessage::ImuShort(short) = read(&hex(SHORT_HIGH)) else { panic!() };
    assert_eq!(short.status, 0x07FF);
    for (found, expected) in short.gyro.into_iter().zip([40.0, -0.5, 1.0]) {
        // the SDK multiplies in single precision
        assert!((found - expected).abs() < 17.0 / 12_304_174.0);
    }
    assert_eq!(short.write(), hex(SHORT_HIGH));
    assert!(short.reading().valid);
}

#[test]
fn imu_data_of_the_sdk_is_read_and_written() {
    let SbgMessage::ImuData(data) = read(&hex(DATA)) else { panic!() };
    let expected = ImuData {
        time_stamp: 123_456_789,
        status: 0x02FF,
        accel: ACCEL,
        gyro: GYRO,
        temperature: 31.25,
    };
    assert_eq!(data, expected);
    assert_eq!(data.write(), hex(DATA));
    let reading = data.reading();
    assert!(!reading.valid, "the accelerometers are out of range");
    assert_eq!((reading.status, reading.temperature), (0x02FF, Some(31.25)));
}

#[test]
fn the_clock_log_of_the_sdk_is_read_and_written() {
    let SbgMessage::Time(time) = read(&hex(UTC)) else { panic!() };
    assert_eq!((time.time_stamp, time.gps_tow), (5_000_000, 17_005_000_000));
    assert_eq!((time.clock, time.utc_status), (ClockState::Valid, UtcStatus::Initialized));
    assert!(time.has_pps && time.accurate);
    let leap = UtcTime::from_civil((2016, 12, 31), (23, 59, 60), 5_000_000);
    assert_eq!(time.utc(), leap);
    assert_eq!(time.bias_std, Some(2.0_f64.powi(-20)));
    assert_eq!(time.scale_std, None);
    assert_eq!(time.residual, Some(-(2.0_f64.powi(-23))));
    assert_eq!(time.write(), hex(UTC));
    for utc_status in [UtcStatus::Invalid, UtcStatus::NoLeapSecond, UtcStatus::Other(9)] {
        assert_eq!(TimeReference { utc_status, ..time }.utc(), None);
    }
}

#[test]
fn euler_angles_of_the_sdk_are_read_and_written() {
    let SbgMessage::Euler(euler) = read(&hex(EULER)) else { panic!() };
    assert_eq!(euler.angles, [0.25, -0.125, -3.0]);
    assert_eq!((euler.declination, euler.inclination), (None, Some(1.0)));
    assert!(euler.is_attitude_valid() && euler.is_heading_valid());
    assert_eq!(euler.write(), hex(EULER));
}

/// A frame with a good checksum of any content. The checksum is the plain loop of the maker's
/// document.
fn frame(class: u8, id: u8, data: &[u8]) -> Vec<u8> {
    let length = u16::try_from(data.len()).unwrap().to_le_bytes();
    let covered = [&[id, class, length[0], length[1]], data].concat();
    let crc = covered.iter().fold(0_u16, |crc, byte| {
        (0..8)
            .fold(crc ^ u16::from(*byte), |crc, _| crc >> 1 ^ if crc & 1 == 1 { 0x8408 } else { 0 })
    });
    [&[0xFF, 0x5A], &covered[..], &crc.to_le_bytes(), &[0x33]].concat()
}

#[test]
fn pages_and_unknown_logs_are_good_frames_of_something_else() {
    let page = frame(0x90, 46, &[7; 4086]);
    assert_eq!(look(&page), Look::Frame(4095));
    assert_eq!(read(&page), SbgMessage::Other { class: 0x90, id: 46 });
    let raw = frame(0x00, 31, &[1, 2, 3]);
    assert_eq!(read(&raw), SbgMessage::Other { class: 0, id: 31 });
    assert_eq!(read(&raw).reading(), None);
}

#[test]
fn impossible_headers_are_refused_at_their_first_wrong_byte() {
    for wrong in [
        &[0x5A][..],
        &[0xFF, 0xFF],
        &[0xFF, 0x5A, 44, 0x06],
        &[0xFF, 0x5A, 44, 0x7F],
        &[0xFF, 0x5A, 44, 0x00, 0x81, 0x00],
        &[0xFF, 0x5A, 31, 0x00, 0xF7, 0x0F],
        &[0xFF, 0x5A, 31, 0x90, 0x04, 0x00],
    ] {
        assert_eq!(look(wrong), Look::Nothing, "{wrong:02x?}");
    }
}

#[test]
fn later_versions_may_append_fields_and_older_ones_lack_some() {
    let short = hex(SHORT);
    let longer = [&short[6..38], &[9; 8]].concat();
    assert_eq!(read(&frame(0, 44, &longer)), read(&short));
    let utc = hex(UTC);
    let SbgMessage::Time(old) = read(&frame(0, 2, &utc[6..27])) else { panic!() };
    assert_eq!((old.bias_std, old.residual), (None, None));
    let cut_short = SbgMessage::read(&frame(0, 44, &short[6..37]));
    assert_eq!(cut_short, Err(BinaryFault::Short { needed: 32, found: 31 }));
}

#[test]
fn any_wrong_bit_is_found_and_no_reader_panics() {
    for golden in [SHORT, SHORT_HIGH, DATA, UTC, EULER] {
        assert_frame_is_guarded(Protocol::Sbg, &hex(golden), |bytes| {
            assert!(SbgMessage::read(bytes).is_err());
        });
    }
}

#[test]
fn each_status_bit_and_nan_make_a_sample_invalid() {
    let good =
        ImuData { time_stamp: 0, status: 0x3FF, accel: ACCEL, gyro: GYRO, temperature: 20.0 };
    assert!(good.reading().valid);
    for bit in 0..10 {
        assert!(!ImuData { status: 0x3FF & !(1 << bit), ..good }.reading().valid, "bit {bit}");
    }
    assert!(!ImuData { gyro: [0.0, f64::NAN, 0.0], ..good }.reading().valid);
    assert_eq!(ImuData { temperature: f64::NAN, ..good }.reading().temperature, None);
}

#[test]
fn values_beyond_the_range_are_saturated() {
    let short =
        ImuShort { time_stamp: 0, status: 0, accel: [1e9; 3], gyro: [-1e9; 3], temperature: -1e9 };
    let SbgMessage::ImuShort(back) = read(&short.write()) else { panic!() };
    assert_eq!(back.temperature, -128.0);
    assert!(back.accel.iter().all(|push| (push - 2048.0).abs() < 1e-5));
    assert!(back.gyro.iter().all(|rate| (rate + 10_000_f64.to_radians()).abs() < 1e-4));
}

fn near(a: [f64; 3], b: [f64; 3], half_step: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= half_step * (1.0 + 1e-6))
}

proptest! {
    #[test]
    fn imu_short_comes_back_within_half_a_step(
        time_stamp: u32,
        status in 0..0x400_u16,
        accel in prop::array::uniform3(-2047.9..2047.9_f64),
        slow in prop::array::uniform3(-31.9..31.9_f64),
        fast in prop::array::uniform3(32.1..174.5_f64),
        temperature in -127.9..127.9_f64,
    ) {
        for (gyro, scale, flag) in [(slow, 67_108_864.0, 0), (fast, 12_304_174.0, 0x400)] {
            let short = ImuShort { time_stamp, status, accel, gyro, temperature };
            let SbgMessage::ImuShort(back) = read(&short.write()) else { panic!() };
            prop_assert_eq!((back.time_stamp, back.status), (time_stamp, status | flag));
            prop_assert!(near(back.accel, accel, 0.5 / 1_048_576.0));
            prop_assert!(near(back.gyro, gyro, 0.5 / scale));
            prop_assert!((back.temperature - temperature).abs() <= 0.5 / 256.0);
        }
    }

    #[test]
    fn floats_come_back_as_they_are(
        time_stamp: u32,
        status: u16,
        vectors in prop::array::uniform3(prop::array::uniform3(-1e6..1e6_f32)),
        temperature in -273.0..1e3_f32,
    ) {
        let [accel, gyro, std] = vectors.map(|vector| vector.map(f64::from));
        let temperature = f64::from(temperature);
        let data = ImuData { time_stamp, status, accel, gyro, temperature };
        prop_assert_eq!(read(&data.write()), SbgMessage::ImuData(data));
        let euler = Euler {
            time_stamp,
            angles: accel,
            std,
            status: status.into(),
            declination: Some(temperature),
            inclination: None,
        };
        prop_assert_eq!(read(&euler.write()), SbgMessage::Euler(euler));
    }

    #[test]
    fn the_clock_log_comes_back(
        time_stamp: u32,
        flags: (bool, bool),
        states in (0..16_u8, 0..16_u8),
        nanos in 0..4_000_000_000_000_000_000_i64,
        tow in 0..604_800_000_i64,
        bias in prop::option::of(0.0..1.0_f32),
    ) {
        let clock = match states.0 {
            0 => ClockState::Error,
            1 => ClockState::FreeRunning,
            2 => ClockState::Steering,
            3 => ClockState::Valid,
            other => ClockState::Other(other),
        };
        let utc_status = match states.1 {
            0 => UtcStatus::Invalid,
            1 => UtcStatus::NoLeapSecond,
            2 => UtcStatus::Initialized,
            other => UtcStatus::Other(other),
        };
        let utc = UtcTime::from_nanos(nanos);
        let time = TimeReference {
            time_stamp,
            has_pps: flags.0,
            clock,
            accurate: flags.1,
            utc_status,
            civil: CivilTime::from_utc(utc).unwrap(),
            gps_tow: tow * 1_000_000,
            bias_std: bias.map(f64::from),
            scale_std: None,
            residual: bias.map(f64::from),
        };
        let SbgMessage::Time(back) = read(&time.write()) else { panic!() };
        prop_assert_eq!(back, time);
        let known = states.1 == 2 && states.0 != 0;
        prop_assert_eq!(back.utc(), known.then_some(utc));
    }

    #[test]
    fn the_frames_are_the_same_in_any_splitting(
        (bytes, places) in stream([SHORT, SHORT_HIGH, DATA, UTC, EULER].map(hex).to_vec()),
    ) {
        assert_splitting_does_not_matter(Protocol::Sbg, &bytes, &places);
    }

    #[test]
    fn no_bytes_make_a_reader_panic(
        id in prop::sample::select(vec![2_u8, 3, 6, 44, 31]),
        data in prop::collection::vec(prop::num::u8::ANY, 0..129),
        noise in prop::collection::vec(prop::num::u8::ANY, 1..200),
    ) {
        let _ = SbgMessage::read(&noise);
        let _ = cut_all(Protocol::Sbg, &noise[..]);
        let whole = frame(0, id, &data);
        prop_assert_eq!(look(&whole), Look::Frame(whole.len()));
        if let Ok(message) = SbgMessage::read(&whole) {
            let _ = message.reading();
            if let SbgMessage::Time(time) = message {
                let _ = time.utc();
            }
        }
    }
}
