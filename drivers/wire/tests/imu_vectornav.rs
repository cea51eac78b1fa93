//! VectorNav's binary messages: the one that its manuals print, and what becomes of the fields.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::GpsTime;
use insd_base::units::DEG;
use insd_wire::imu::ImuMotion;
use insd_wire::imu::vectornav::{VnDeltas, VnMessage};
use insd_wire::stream::{Look, Protocol};

/// Yaw, pitch and roll, as the user manuals of VN-100 and VN-300 print the message (example case 1).
const PUBLISHED: [u8; 18] = [
    0xFA, 0x01, 0x08, 0x00, 0x93, 0x50, 0x2E, 0x42, 0x83, 0x3E, 0xF1, 0x3F, 0x48, 0xB5, 0x04, 0xBB,
    0x92, 0x88,
];

/// Every field that is read.
fn whole() -> VnMessage {
    VnMessage {
        startup_nanos: Some(1_234_567_890_123),
        gps_nanos: Some(GpsTime::from_week(2445, 302_400_250_000_000).as_nanos() as u64),
        time_status: Some(7),
        attitude: Some([90.0, 2.5, -1.25].map(|own| own * DEG)),
        attitude_std: Some([0.25, 0.125, 0.125].map(|own| own * DEG)),
        rate: Some([0.5, -0.25, 0.125]),
        force: Some([0.5, -0.25, -9.75]),
        plain_rate: Some([0.75, -0.25, 0.125]),
        plain_force: Some([0.75, -0.25, -9.75]),
        deltas: Some(VnDeltas {
            interval: 0.25,
            theta: [1.0, -0.5, 0.25].map(|own| own * DEG),
            velocity: [0.125, -0.25, -2.5],
        }),
        temperature: Some(21.5),
        saturated: Some(0),
        ins_status: Some(0x0006),
    }
}

#[test]
fn the_published_message_has_its_published_values_and_is_written_to_the_byte() {
    let message = VnMessage::read(&PUBLISHED).unwrap();
    let printed = [43.578_686, 1.884_720_2, -2.024_965_6e-3];
    for (own, degrees) in message.attitude.unwrap().into_iter().zip(printed) {
        assert!((own / DEG - degrees).abs() < 1e-6, "{own} {degrees}");
    }
    assert_eq!(message.write(), PUBLISHED);
    assert_eq!((message.reading(), message.true_heading()), (None, None));
}

#[test]
fn what_is_written_is_read_and_a_flipped_bit_is_found() {
    let bytes = whole().write();
    assert_eq!(Protocol::VectorNav.look(&bytes), Look::Frame(bytes.len()));
    assert_eq!(VnMessage::read(&bytes), Ok(whole()));
    for bit in 0..bytes.len() * 8 {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        assert!(VnMessage::read(&flipped).is_err(), "bit {bit}");
    }
    for length in 0..bytes.len() {
        assert!(VnMessage::read(&bytes[..length]).is_err());
    }
}

#[test]
fn increments_come_before_rates_and_plain_rates_before_those_of_its_own_filter() {
    let told = whole().reading().unwrap();
    let ImuMotion::Increments { delta_velocity, .. } = told.motion else { panic!("{told:?}") };
    assert_eq!(delta_velocity, [0.125, -0.25, -2.5]);
    assert_eq!(told.device_time.unwrap().ticks.value, 1_234_567_890_123);
    assert_eq!(told.utc, whole().utc());
    let rates = VnMessage { deltas: None, ..whole() };
    let gyro = |message: &VnMessage| match message.reading().unwrap().motion {
        ImuMotion::Rates { gyro, .. } => gyro[0],
        ImuMotion::Increments { .. } => f64::NAN,
    };
    assert_eq!(gyro(&rates), 0.75);
    assert_eq!(gyro(&VnMessage { plain_force: None, ..rates }), 0.5);
}

#[test]
fn a_gyro_out_of_its_range_is_not_valid_and_a_time_that_it_does_not_know_is_none() {
    assert!(whole().reading().unwrap().valid);
    for bit in 0..10 {
        let message = VnMessage { saturated: Some(1 << bit), ..whole() };
        assert_eq!(message.reading().unwrap().valid, !(3..9).contains(&bit), "bit {bit}");
    }
    for status in [None, Some(0), Some(1), Some(2)] {
        assert_eq!(VnMessage { time_status: status, ..whole() }.utc(), None);
    }
}

#[test]
fn yaw_is_a_true_heading_only_while_the_ins_tracks() {
    assert!((whole().true_heading().unwrap() - 90.0 * DEG).abs() < 1e-12);
    for status in [None, Some(0), Some(1), Some(3)] {
        assert_eq!(VnMessage { ins_status: status, ..whole() }.true_heading(), None);
    }
}
