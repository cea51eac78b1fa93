//! MIP: packets of a device, round trips, framing.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod frames;

use frames::{
    assert_frame_is_guarded, assert_splitting_does_not_matter, bytes_of_hex as hex, cut_all, stream,
};
use insd_base::GpsTime;
use insd_wire::binary::BinaryFault;
use insd_wire::imu::ImuMotion;
use insd_wire::imu::mip::{GpsStamp, Packet, look};
use insd_wire::stream::{Look, Protocol};
use proptest::prelude::*;

// From the recording of a device in the maker's SDK (mip_sdk, MIT, test/data/mip_data.bin).
const RATES: &str = "756580300ad500000041d8bae0400ad600000000007a12000e043c8eaf72bbda6818bf7c52e8
    0e05bb469ccf39a34c8bbb8be12fd771";
const RATES_AND_EULER: &str = "7565804c0ad500000041da2916400ad600000000007a12000e043c896897bbd285
    44bf7c30f90e05bb4aa21f3a86a43abb8f03130e063d7affd63e919fe83e79ffd60e0cbccc20783cb6c513bf95119d
    7ac2";
const MAGNETOMETER: &str = "7565800e0e063d7affd63e919fe83e79ffd6eac9";
// From the tests of that SDK: an accelerometer alone, and a packet of another descriptor set.
const ACCEL: &str = "7565800e0e043f80000040000000c040000079ed";
const PING: &str = "756501020201e0c6";

const G: f64 = 9.806_65;

fn read(frame: &[u8]) -> Packet {
    Packet::read(frame).unwrap_or_else(|fault| panic!("{frame:02x?}: {fault}"))
}

/// A packet of sensor data with a good checksum of any payload.
fn frame(payload: &[u8]) -> Vec<u8> {
    let mut frame = [&[0x75, 0x65, 0x80, u8::try_from(payload.len()).unwrap()], payload].concat();
    let mut sums = (0_u8, 0_u8);
    for byte in &frame {
        sums.0 = sums.0.wrapping_add(*byte);
        sums.1 = sums.1.wrapping_add(sums.0);
    }
    frame.extend([sums.0, sums.1]);
    frame
}

#[test]
fn a_packet_of_a_device_is_a_sample() {
    let packet = read(&hex(RATES));
    assert_eq!(packet.reference_nanos, Some(282_809_000_000));
    assert_eq!(packet.reference_delta_nanos, Some(8_000_000));
    let reading = packet.reading().unwrap();
    let ImuMotion::Rates { gyro, accel } = reading.motion else { panic!() };
    assert_eq!(accel[2], f64::from(f32::from_bits(0xBF7C_52E8)) * G);
    assert!((accel[2] + 9.665).abs() < 1e-3 && accel[0].abs() < 0.2);
    assert_eq!(gyro[0], f64::from(f32::from_bits(0xBB46_9CCF)));
    let time = reading.device_time.unwrap();
    assert_eq!((time.ticks.value, time.tick), (282_809_000_000, 1e-9));
    assert!(reading.valid && reading.utc.is_none() && reading.temperature.is_none());
}

#[test]
fn a_packet_of_a_device_is_written_as_it_came() {
    assert_eq!(read(&hex(RATES)).write(), hex(RATES));
    assert_eq!(read(&hex(ACCEL)).write(), hex(ACCEL));
    let euler = read(&hex(RATES_AND_EULER)).euler.unwrap();
    assert!((euler[2] + 1.164_6).abs() < 1e-4);
}

#[test]
fn packets_without_both_sensors_are_no_samples() {
    assert_eq!(read(&hex(MAGNETOMETER)).reading(), None);
    let accel = read(&hex(ACCEL));
    assert_eq!(accel.accel, Some([G, 2.0 * G, -3.0 * G]));
    assert_eq!(accel.reading(), None);
}

#[test]
fn other_descriptor_sets_are_good_frames_of_something_else() {
    assert_eq!(look(&hex(PING)), Look::Frame(8));
    assert_eq!(Packet::read(&hex(PING)), Err(BinaryFault::OtherMessage));
}

#[test]
fn integrals_are_preferred_to_rates() {
    let packet = Packet {
        accel: Some([1.0; 3]),
        gyro: Some([2.0; 3]),
        delta_theta: Some([0.5; 3]),
        delta_velocity: Some([0.25; 3]),
        ..Packet::default()
    };
    let motion = packet.reading().unwrap().motion;
    assert_eq!(motion, ImuMotion::Increments { delta_theta: [0.5; 3], delta_velocity: [0.25; 3] });
    let one_of_each = Packet { accel: None, delta_theta: None, ..packet };
    assert_eq!(one_of_each.reading(), None);
}

#[test]
fn an_overrange_accelerometer_or_gyro_makes_the_sample_invalid() {
    let packet = Packet { accel: Some([0.0; 3]), gyro: Some([0.0; 3]), ..Packet::default() };
    for bit in 0..16 {
        let sample = Packet { overrange: Some(1 << bit), ..packet }.reading().unwrap();
        assert_eq!(sample.valid, ![0, 1, 2, 4, 5, 6].contains(&bit), "bit {bit}");
        assert_eq!(sample.status, 1 << bit);
    }
    let nan = Packet { gyro: Some([f64::NAN; 3]), ..packet };
    assert!(!nan.reading().unwrap().valid);
}

#[test]
fn gps_time_is_believed_only_with_its_flags() {
    let stamp = |descriptor: u8, flags: u8| {
        let tow = 345_600.125_f64.to_be_bytes();
        let field = [&[14, descriptor], &tow[..], &[0x08, 0xCD, 0x00, flags]].concat();
        let sample = Packet {
            accel: Some([0.0; 3]),
            gyro: Some([0.0; 3]),
            gps: read(&frame(&field)).gps,
            ..Packet::default()
        };
        sample.reading().unwrap()
    };
    let utc = GpsTime::from_week(2253, 345_600_125_000_000).to_utc(None);
    for (descriptor, flags, expected) in [
        (0x12, 0x1F, Some(utc)),
        (0x12, 0x19, Some(utc)),
        (0x12, 0x1E, None),
        (0x12, 0x0D, None),
        (0xD3, 0x03, Some(utc)),
        (0xD3, 0x01, None),
        (0xD3, 0x00, None),
    ] {
        let reading = stamp(descriptor, flags);
        assert_eq!(reading.utc, expected, "{descriptor:02x} {flags:02x}");
        let ticks = reading.device_time.unwrap().ticks;
        assert_eq!((ticks.value, ticks.modulus), (345_600_125_000_000, 604_800_000_000_000));
    }
}

#[test]
fn a_time_outside_the_week_is_no_time() {
    for tow in [-1.0, 604_800.0, f64::NAN, f64::INFINITY] {
        assert_eq!(GpsStamp { tow, week: 2253, valid: true }.utc(), None);
    }
}

#[test]
fn impossible_headers_are_refused_at_their_first_wrong_byte() {
    for wrong in [
        &[0x65][..],
        &[0x75, 0x75],
        &[0x75, 0x65, 0x00],
        &[0x75, 0x65, 0x80, 0x0E, 0x01],
        &[0x75, 0x65, 0x80, 0x0E, 0x0F],
        &[0x75, 0x65, 0x80, 0x0E, 0x0D, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2],
    ] {
        assert_eq!(look(wrong), Look::Nothing, "{wrong:02x?}");
    }
    assert_eq!(look(&[0x75, 0x65, 0x80, 0x0E, 0x04]), Look::More(4 + 5));
}

#[test]
fn any_wrong_bit_is_found_and_no_reader_panics() {
    for golden in [RATES, RATES_AND_EULER, MAGNETOMETER, ACCEL, PING] {
        assert_frame_is_guarded(Protocol::Mip, &hex(golden), |bytes| {
            assert!(Packet::read(bytes).is_err());
        });
    }
}

#[test]
fn short_fields_are_refused() {
    assert_eq!(
        Packet::read(&frame(&[6, 4, 0, 0, 0, 0])),
        Err(BinaryFault::Short { needed: 8, found: 4 })
    );
}

/// An optional vector of numbers that a float carries exactly, times the unit of the field.
fn vector(unit: f64) -> impl Strategy<Value = Option<[f64; 3]>> {
    let vector = prop::array::uniform3(-1e4..1e4_f32);
    prop::option::of(vector.prop_map(move |vector| vector.map(|part| f64::from(part) * unit)))
}

fn packet() -> impl Strategy<Value = Packet> {
    let gps = (0.0..604_799.0_f64, prop::num::u16::ANY, prop::bool::ANY)
        .prop_map(|(tow, week, valid)| GpsStamp { tow, week, valid });
    let times =
        (prop::option::of(gps), prop::option::of(0..u64::MAX), prop::option::of(0..u64::MAX));
    let vectors = (vector(G), vector(1.0), vector(1.0), vector(G), vector(1.0));
    let health = (prop::option::of(-50.0..90.0_f32), prop::option::of(prop::num::u16::ANY));
    (times, vectors, health).prop_map(|(times, vectors, (temperature, overrange))| {
        let (gps, reference_nanos, reference_delta_nanos) = times;
        let (accel, gyro, delta_theta, delta_velocity, euler) = vectors;
        Packet {
            gps,
            reference_nanos,
            reference_delta_nanos,
            accel,
            gyro,
            delta_theta,
            delta_velocity,
            temperature: temperature.map(f64::from),
            overrange,
            euler,
        }
    })
}

proptest! {
    #[test]
    fn what_is_written_is_read_back(packet in packet()) {
        prop_assert_eq!(read(&packet.write()), packet);
    }

    #[test]
    fn any_value_comes_back_to_the_last_digit_of_a_float(
        accel in prop::array::uniform3(-400.0..400.0_f64),
        delta_velocity in prop::array::uniform3(-4.0..4.0_f64),
    ) {
        let packet = Packet {
            accel: Some(accel),
            delta_velocity: Some(delta_velocity),
            ..Packet::default()
        };
        let back = read(&packet.write());
        let pairs = back.accel.unwrap().into_iter().zip(accel);
        let more = back.delta_velocity.unwrap().into_iter().zip(delta_velocity);
        for (found, written) in pairs.chain(more) {
            let half_digit = f64::from(f32::EPSILON) / 2.0 * written.abs();
            prop_assert!((found - written).abs() <= half_digit * (1.0 + 1e-6));
        }
    }

    #[test]
    fn the_frames_are_the_same_in_any_splitting(
        (bytes, places) in stream([RATES, RATES_AND_EULER, ACCEL, PING].map(hex).to_vec()),
    ) {
        assert_splitting_does_not_matter(Protocol::Mip, &bytes, &places);
    }

    #[test]
    fn no_bytes_make_a_reader_panic(
        fields in prop::collection::vec(
            (prop::num::u8::ANY, prop::collection::vec(prop::num::u8::ANY, 0..24)), 0..8),
        noise in prop::collection::vec(prop::num::u8::ANY, 1..200),
    ) {
        let _ = Packet::read(&noise);
        let _ = cut_all(Protocol::Mip, &noise[..]);
        let field = |(descriptor, data): (u8, Vec<u8>)| {
            [&[u8::try_from(data.len()).unwrap() + 2, descriptor], &data[..]].concat()
        };
        let whole = frame(&fields.into_iter().flat_map(field).collect::<Vec<_>>());
        prop_assert_eq!(look(&whole), Look::Frame(whole.len()));
        if let Ok(packet) = Packet::read(&whole) {
            let _ = packet.reading();
        }
    }
}
