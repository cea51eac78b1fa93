//! StdBin: telegrams of real systems, round trips, and any bytes.
//!
//! The logs are those of the maker's open decoder (`ixblue_stdbin_decoder`, copyright 2020 iXblue SAS,
//! MIT): one telegram of a system of version 2 and of version 4 at rest without UTC, and two telegrams
//! of version 3 with external blocks.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod frames;

use frames::{bytes_of_hex, cut_all, is_robust, is_split_anyhow};
use insd_base::LogReference;
use insd_base::units::DEG;
use insd_wire::binary::BinaryFault;
use insd_wire::imu::ImuMotion;
use insd_wire::imu::stdbin::{
    EmLog, External, LogSpeed, Navigation, Position, StdBinAttitude, StdBinHeave, Telegram,
    UtcSync, look,
};
use insd_wire::log::LogFrame;
use insd_wire::stream::{Look, Protocol};
use proptest::prelude::*;

const V2: &str = include_str!("data/stdbin_v2.hex");
const V3: &str = include_str!("data/stdbin_v3.hex");
const V4: &str = include_str!("data/stdbin_v4.hex");

fn is_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} instead of {expected}");
}

#[test]
fn a_system_without_utc_is_read_and_tells_no_utc() {
    let telegram = Telegram::read(&bytes_of_hex(V2)).unwrap();
    let navigation = telegram.navigation;
    assert_eq!((telegram.version, telegram.counter, telegram.validity), (2, 2, 9_215_311));
    let attitude = navigation.attitude.unwrap();
    is_near(attitude.heading, 209.982 * DEG, 1e-5);
    is_near(attitude.roll, 0.016 * DEG, 1e-6);
    is_near(attitude.pitch, -0.206 * DEG, 1e-6);
    let position = navigation.position.unwrap();
    is_near(position.latitude, 2.133 * DEG, 1e-3 * DEG);
    is_near(position.longitude, 48.0 * DEG, 1e-3 * DEG);
    assert_eq!(navigation.date, Some((2006, 1, 1)));
    assert_eq!(navigation.user_status, Some([0x4C00_0000]));
    is_near(navigation.temperatures.unwrap()[0], 26.16, 0.01);
    assert!(!telegram.is_synchronised());
    assert_eq!(telegram.reading(), None, "version 2 has no raw rotation rates");
}

#[test]
fn raw_blocks_of_version_4_are_found_behind_all_the_others() {
    let telegram = Telegram::read(&bytes_of_hex(V4)).unwrap();
    let reading = telegram.reading().unwrap();
    let ImuMotion::Rates { gyro, accel } = reading.motion else { unreachable!() };
    assert_eq!(gyro, [0.0; 3]);
    is_near(accel[2], 8.000_145, 1e-5);
    assert_eq!((reading.utc, reading.status), (None, 0x4C00_0000));
    assert!(!reading.valid, "a rotation of zeros");
    let device_time = reading.device_time.unwrap();
    assert_eq!((device_time.ticks.value, device_time.ticks.modulus), (8_715_306, 1 << 32));
    is_near(reading.temperature.unwrap(), 25.993, 1e-3);
}

#[test]
fn a_synchronised_system_tells_utc_and_what_its_logs_told_it() {
    let bytes = bytes_of_hex(V3);
    let telegrams = cut_all(Protocol::StdBin, &bytes);
    assert_eq!(telegrams.len(), 2);
    let telegram = Telegram::read(&telegrams[0]).unwrap();
    assert!(telegram.is_synchronised());
    let utc = telegram.reading().unwrap().utc.unwrap();
    let ((year, month, day), nanos) = utc.to_civil();
    assert_eq!((year, month, day, nanos), (2019, 3, 14, 56_698_353_500_000));
    assert_eq!(telegram.external.utc, Some(UtcSync { validity: 566_980_000, source: 0 }));
    let em_log = telegram.external.em_logs[0].unwrap();
    assert_eq!((em_log.validity, em_log.id, em_log.forward), (566_980_110, 0, 60.0));
    let logs = telegram.log_readings();
    let kinds: Vec<_> = logs.iter().map(|log| log.reference).collect();
    assert_eq!(kinds, [LogReference::Bottom, LogReference::Water, LogReference::Water]);
    assert_eq!(logs[0].velocity, [Some(39.0), Some(-39.0), Some(-39.0), None]);
    assert_eq!((logs[0].frame, logs[0].std), (LogFrame::Ship, Some(3.0)));
    is_near(logs[0].age.unwrap(), 0.3425, 1e-9);
}

#[test]
fn pitch_is_positive_bow_up_here_and_bow_down_on_the_wire() {
    let attitude = StdBinAttitude { heading: 1.0, roll: 0.1, pitch: 10.0 * DEG };
    let navigation = Navigation { attitude: Some(attitude), ..Navigation::default() };
    let frame = Telegram { version: 3, navigation, ..Telegram::default() }.write();
    assert_eq!(frame[33..37], (-10.0_f32).to_be_bytes());
}

#[test]
fn raw_blocks_that_nobody_fills_are_not_valid_whatever_the_status_says() {
    // the telegram of version 4 once more, with a rotation: 8.00 m/s^2 beside 9.81 in its other blocks
    let mut telegram = Telegram::read(&bytes_of_hex(V4)).unwrap();
    telegram.navigation.raw_rotation = Some([1e-5, 0.0, 4e-5]);
    assert!(!telegram.reading().unwrap().valid);
    telegram.navigation.raw_acceleration = Some([-0.035, 0.01, 9.80]);
    assert!(telegram.reading().unwrap().valid);
    telegram.navigation.raw_acceleration = Some([0.0; 3]);
    assert!(!telegram.reading().unwrap().valid);
    // without the other blocks there is nothing to hold them against but zero
    let raw = |gyro, accel| {
        let navigation = Navigation {
            raw_rotation: Some(gyro),
            raw_acceleration: Some(accel),
            ..Navigation::default()
        };
        Telegram { version: 5, navigation, ..Telegram::default() }.reading().unwrap().valid
    };
    assert!(raw([1e-5, 0.0, 4e-5], [0.0, 0.0, 8.0]));
    assert!(!raw([0.0; 3], [0.0, 0.0, 9.81]) && !raw([1e-5, 0.0, 4e-5], [0.0; 3]));
}

#[test]
fn an_anomaly_of_a_sensor_makes_the_sample_invalid() {
    let navigation = Navigation {
        raw_rotation: Some([0.1; 3]),
        raw_acceleration: Some([9.8; 3]),
        user_status: Some([1 << 9]),
        ..Navigation::default()
    };
    let telegram = Telegram { version: 5, navigation, ..Telegram::default() };
    assert!(!telegram.reading().unwrap().valid);
}

#[test]
fn a_block_that_is_not_known_ends_the_search_but_not_the_telegram() {
    let navigation = Navigation { temperatures: Some([20.0; 3]), ..Navigation::default() };
    let external =
        External { utc: Some(UtcSync { validity: 7, source: 1 }), ..External::default() };
    for (version, utc) in [(3, None), (4, external.utc)] {
        let telegram = Telegram { version, navigation, external, ..Telegram::default() };
        let mut frame = telegram.write();
        frame[3] |= 0x80;
        let length = frame.len();
        let sum: u32 = frame[..length - 4].iter().map(|byte| u32::from(*byte)).sum();
        frame[length - 4..].copy_from_slice(&sum.to_be_bytes());
        let read = Telegram::read(&frame).unwrap();
        assert_eq!((read.navigation, read.external.utc), (navigation, utc));
    }
}

#[test]
fn other_versions_lengths_and_sums_are_refused() {
    let bytes = bytes_of_hex(V4);
    assert_eq!(look(b"IX\x06"), Look::Nothing);
    assert_eq!(look(b"IY"), Look::Nothing);
    assert_eq!(look(&bytes[..10]), Look::More(27));
    assert_eq!(look(&bytes[..30]), Look::More(392));
    assert_eq!(look(&bytes), Look::Frame(392));
    let mut damaged = bytes.clone();
    damaged[40] ^= 1;
    assert_eq!(look(&damaged), Look::Damaged);
    assert_eq!(Telegram::read(&damaged), Err(BinaryFault::Frame));
    let mut endless = bytes;
    (endless[17], endless[18]) = (0xFF, 0xFF);
    assert_eq!(look(&endless), Look::Nothing);
}

fn triple(limit: f64) -> impl Strategy<Value = Option<[f64; 3]>> {
    prop::option::of(prop::array::uniform3(-limit..limit))
}

prop_compose! {
    fn navigation()(
        attitude in triple(3.0), attitude_std in triple(1.0), heave in triple(20.0),
        attitude_rates in triple(2.0), rotation in triple(2.0), acceleration in triple(50.0),
        position in prop::option::of((-1.57..1.57, 0.0..6.0, -100.0..5000.0, any::<bool>())),
        velocity in triple(30.0), velocity_std in triple(3.0),
        rest in (triple(30.0), triple(80.0), triple(100.0), triple(5.0)),
        date in prop::option::of((any::<u16>(), any::<u8>(), any::<u8>())),
        status in (any::<Option<[u32; 4]>>(), any::<Option<[u32; 3]>>(), any::<Option<[u32; 1]>>()),
    ) -> Navigation {
        let (vessel_velocity, temperatures, raw_acceleration, raw_rotation) = rest;
        let (algorithm_status, system_status, user_status) = status;
        Navigation {
            attitude: attitude.map(|[heading, roll, pitch]| StdBinAttitude { heading, roll, pitch }),
            heave: heave.map(|[heave, lever_heave, lever_surge]| StdBinHeave {
                heave, lever_heave, lever_surge, lever_sway: -heave,
            }),
            position: position.map(|(latitude, longitude, altitude, above_ellipsoid)| Position {
                latitude, longitude, altitude, above_ellipsoid,
            }),
            attitude_std, attitude_rates, rotation, acceleration, velocity, velocity_std, date,
            algorithm_status, system_status, user_status, vessel_velocity, temperatures,
            raw_acceleration, raw_rotation,
        }
    }
}

prop_compose! {
    fn external()(
        utc in prop::option::of((any::<u32>(), any::<u8>())),
        em_logs in prop::array::uniform2(prop::option::of((any::<u32>(), -30.0..30.0, 0.0..3.0))),
        dvls in prop::array::uniform4(triple(30.0)),
        validity in any::<u32>(),
    ) -> External {
        let dvl = |velocity: [f64; 3], altitude: Option<f64>| LogSpeed {
            validity, id: 1, velocity, sound: 1500.0, altitude, std: [0.5; 3],
        };
        External {
            utc: utc.map(|(validity, source)| UtcSync { validity, source }),
            em_logs: em_logs.map(|log| {
                log.map(|(validity, forward, std)| EmLog { validity, id: 0, forward, std })
            }),
            ground: [dvls[0], dvls[1]].map(|d| d.map(|velocity| dvl(velocity, Some(87.5)))),
            water: [dvls[2], dvls[3]].map(|d| d.map(|velocity| dvl(velocity, None))),
        }
    }
}

/// Every number of both, as the debug form gives them, with the precision of a float.
fn is_same(written: &Telegram, read: &Telegram) {
    let numbers = |telegram: &Telegram| -> Vec<f64> {
        let text = format!("{telegram:?}");
        let separators = |c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | 'e'));
        text.split(separators).filter_map(|word| word.parse().ok()).collect()
    };
    let (written, read) = (numbers(written), numbers(read));
    assert_eq!(written.len(), read.len());
    for (a, b) in written.iter().zip(read) {
        is_near(b, *a, 1e-7 * a.abs() + 1e-12);
    }
}

proptest! {
    #[test]
    fn what_is_written_is_read(
        version in 3_u8..=5, validity: u32, counter: u32,
        navigation in navigation(), external in external(),
    ) {
        let telegram = Telegram { version, validity, counter, navigation, external };
        let frame = telegram.write();
        prop_assert_eq!(look(&frame), Look::Frame(frame.len()));
        is_same(&telegram, &Telegram::read(&frame).unwrap());
    }

    #[test]
    fn frames_are_the_same_in_any_splitting(
        navigation in navigation(), external in external(), sizes in frames::sizes(),
    ) {
        let frame = Telegram { version: 4, validity: 1, counter: 2, navigation, external }.write();
        is_split_anyhow(Protocol::StdBin, &[&b"IIXX\x04"[..], &frame, b"IX", &frame].concat(), &sizes);
    }

    #[test]
    fn no_bytes_make_it_panic(
        external in external(), flips in frames::flips(), noise in frames::noise(),
    ) {
        let navigation = Navigation::default();
        let frame = Telegram { version: 3, validity: 1, counter: 2, navigation, external }.write();
        is_robust(Protocol::StdBin, &frame, &flips, &noise, |bytes| {
            if let Ok(telegram) = Telegram::read(bytes) {
                let _ = (telegram.reading(), telegram.log_readings(), telegram.write());
            }
        });
    }
}
