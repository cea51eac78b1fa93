//! KVH: frames of a 1750, round trips, and any bytes.
//!
//! The frames are those of the tests of `ros_kvh1750`: one of a device that has just started and whose
//! gyroscopes are not yet valid, one of a device at rest, and one with a wrong CRC.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod frames;

use frames::{bytes_of_hex, is_robust, is_split_anyhow};
use insd_base::units::DEG;
use insd_wire::binary::BinaryFault;
use insd_wire::imu::ImuMotion;
use insd_wire::imu::kvh::{
    KvhFormat, KvhLinear, KvhMessage, KvhRest, KvhRotation, KvhTemperature, look,
};
use insd_wire::stream::{Look, Protocol};
use proptest::prelude::*;

const EARLY: &str =
    "FE81FF55 3B041F78 B9B96613 BA234B38 BB7C0410 B8DEF480 3F7F4B7B 701F001D F12FB6EE";
const AT_REST: &str =
    "FE81FF55 B3D0BBE7 32193EF4 30AC19A5 BA8F78D6 3A290594 3F7ECBD4 7768001D ADC5F651";
const WRONG_CRC: &str =
    "FE81FF55 B46B86C6 B44F5B83 B4106D09 BB713CB7 BBABD914 3F7E319A 7769001D 95BBDB4F";

#[test]
fn a_device_at_rest_feels_gravity_and_the_earth_turning() {
    let message = KvhMessage::read(&bytes_of_hex(AT_REST)).unwrap();
    assert_eq!((message.sequence, message.status), (104, 0x77));
    let reading = message.reading(&KvhFormat::default());
    let ImuMotion::Increments { delta_theta, delta_velocity } = reading.motion else {
        unreachable!()
    };
    assert!(delta_theta.iter().all(|angle| angle.abs() < 2e-7), "{delta_theta:?}");
    assert!((delta_velocity[2] - 9.806_65e-3 * 0.9953).abs() < 1e-6, "{delta_velocity:?}");
    assert_eq!(reading.temperature, Some(29.0));
    assert!(reading.valid);
    let counter = reading.counter.unwrap();
    assert_eq!((counter.value, counter.modulus), (104, 128));
}

#[test]
fn gyroscopes_that_are_not_ready_make_the_sample_invalid() {
    let message = KvhMessage::read(&bytes_of_hex(EARLY)).unwrap();
    assert_eq!((message.sequence, message.status), (31, 0x70));
    assert!(!message.reading(&KvhFormat::default()).valid);
}

#[test]
fn a_wrong_crc_is_damage() {
    let bytes = bytes_of_hex(WRONG_CRC);
    assert_eq!(look(&bytes), Look::Damaged);
    assert_eq!(KvhMessage::read(&bytes), Err(BinaryFault::Frame));
    assert_eq!(look(&bytes_of_hex("FE8100AA")), Look::Nothing, "built-in test");
    assert_eq!(look(&bytes[..3]), Look::More(4));
    assert_eq!(look(&bytes[..4]), Look::More(36));
}

fn message(rest: KvhRest) -> KvhMessage {
    KvhMessage { rotation: [0.5; 3], linear: [1.0; 3], status: 0x77, sequence: 8, rest }
}

#[test]
fn formats_have_the_lengths_of_the_manual() {
    let rests = [
        (KvhRest::A { temperature: 20 }, 36),
        (KvhRest::B { time: 7, temperature: 20 }, 40),
        (KvhRest::C { slow: 20.5 }, 38),
    ];
    for (rest, length) in rests {
        let frame = message(rest).write();
        assert_eq!(frame.len(), length);
        assert_eq!(KvhMessage::read(&frame), Ok(message(rest)));
    }
}

#[test]
fn format_c_tells_temperature_with_every_fourth_message() {
    let celsius = |sequence| {
        let message = KvhMessage { sequence, ..message(KvhRest::C { slow: 20.5 }) };
        message.reading(&KvhFormat::default()).temperature
    };
    assert_eq!([0, 1, 2, 3, 4].map(celsius), [Some(20.5), None, None, None, Some(20.5)]);
}

#[test]
fn units_are_those_of_the_configuration() {
    let format = KvhFormat { interval: 0.01, ..KvhFormat::default() };
    let motion = |format: KvhFormat| message(KvhRest::C { slow: 0.0 }).reading(&format).motion;
    let rates = KvhFormat { rotation: KvhRotation::Rate, degrees: true, ..format };
    let expected = ImuMotion::Rates { gyro: [0.5 * DEG; 3], accel: [9.806_65; 3] };
    assert_eq!(motion(rates), expected);
    let feet = KvhFormat { linear: KvhLinear::DeltaFeet, ..rates };
    let expected =
        ImuMotion::Increments { delta_theta: [0.5 * (DEG * 0.01); 3], delta_velocity: [0.3048; 3] };
    assert_eq!(motion(feet), expected);
    let warm = |temperature, unit| {
        let format = KvhFormat { temperature: unit, ..format };
        message(KvhRest::A { temperature }).reading(&format).temperature.unwrap()
    };
    assert_eq!(warm(2050, KvhTemperature::CentiCelsius), 20.5);
    assert_eq!(warm(50, KvhTemperature::Fahrenheit), 10.0);
    assert_eq!(warm(5000, KvhTemperature::CentiFahrenheit), 10.0);
}

fn rests() -> impl Strategy<Value = KvhRest> {
    prop_oneof![
        any::<i16>().prop_map(|temperature| KvhRest::A { temperature }),
        any::<(u32, i16)>().prop_map(|(time, temperature)| KvhRest::B { time, temperature }),
        (-1e6_f32..1e6).prop_map(|slow| KvhRest::C { slow }),
    ]
}

fn formats() -> impl Strategy<Value = KvhFormat> {
    let rotation = prop_oneof![Just(KvhRotation::Delta), Just(KvhRotation::Rate)];
    let linear = prop_oneof![
        Just(KvhLinear::Acceleration),
        Just(KvhLinear::DeltaMetres),
        Just(KvhLinear::DeltaFeet)
    ];
    (rotation, any::<bool>(), linear, 2e-4_f64..1.0).prop_map(
        |(rotation, degrees, linear, interval)| KvhFormat {
            rotation,
            degrees,
            linear,
            temperature: KvhTemperature::Celsius,
            interval,
        },
    )
}

proptest! {
    #[test]
    fn what_is_written_is_read(
        rotation in prop::array::uniform3(-500.0_f32..500.0),
        linear in prop::array::uniform3(-30.0_f32..30.0),
        status: u8, sequence in 0_u8..128, rest in rests(),
    ) {
        let message = KvhMessage { rotation, linear, status, sequence, rest };
        let frame = message.write();
        prop_assert_eq!(look(&frame), Look::Frame(frame.len()));
        prop_assert_eq!(KvhMessage::read(&frame), Ok(message));
    }

    #[test]
    fn a_motion_survives_the_wire_in_every_format(
        format in formats(), differences: bool,
        a in prop::array::uniform3(-8.0..8.0), b in prop::array::uniform3(-100.0..100.0),
    ) {
        let motion = if differences {
            ImuMotion::Increments { delta_theta: a, delta_velocity: b }
        } else {
            ImuMotion::Rates { gyro: a, accel: b }
        };
        let (rotation, linear) = format.numbers(&motion);
        let wire = KvhMessage { rotation, linear, ..message(KvhRest::A { temperature: 0 }) };
        let read = wire.reading(&format).motion;
        let (step, found) = match read {
            ImuMotion::Rates { gyro, accel } => {
                (if differences { format.interval } else { 1.0 }, [gyro, accel])
            }
            ImuMotion::Increments { delta_theta, delta_velocity } => {
                (if differences { 1.0 } else { 1.0 / format.interval }, [delta_theta, delta_velocity])
            }
        };
        for (found, written) in found.iter().flatten().zip([a, b].iter().flatten()) {
            prop_assert!((found * step - written).abs() <= 1e-7 * written.abs() + 1e-30);
        }
    }

    #[test]
    fn frames_are_the_same_in_any_splitting(rest in rests(), sizes in frames::sizes()) {
        let frame = message(rest).write();
        is_split_anyhow(Protocol::Kvh, &[&b"\xFE\xFE\x81\xFF"[..], &frame, &frame].concat(), &sizes);
    }

    #[test]
    fn no_bytes_make_it_panic(
        rest in rests(), flips in frames::flips(), noise in frames::noise(),
    ) {
        is_robust(Protocol::Kvh, &message(rest).write(), &flips, &noise, |bytes| {
            if let Ok(message) = KvhMessage::read(bytes) {
                let _ = message.reading(&KvhFormat::default());
            }
        });
    }
}
