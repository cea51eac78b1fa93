//! Telegrams of motion sensors: published and computed ones, signs, and unknown values.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

#[path = "checks/motion.rs"]
mod checks;
mod motion_samples;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use insd_base::UtcTime;
use insd_base::units::DEG;
use insd_wire::binary::BinaryFault;
use insd_wire::motion::em::{EmAttitude, EmStatus};
use insd_wire::motion::kmb::{Kmb, KmbSigma};
use insd_wire::motion::seapath::{Seapath23, Seapath26};
use insd_wire::motion::tss1::{Tss1, Tss1Aiding};
use insd_wire::motion::{SensorDelayedHeave, SensorPlace, Tilt, Vertical, roll_from_horizon};
use motion_samples::*;

fn bytes_of(hex: &str) -> Vec<u8> {
    let digits: Vec<u8> = hex.bytes().filter(u8::is_ascii_hexdigit).collect();
    let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).unwrap(), 16).unwrap();
    digits.chunks(2).map(byte).collect()
}

/// Made of the field table by another program, a script of ten lines.
const KMB: &str = "
    234B4D4284000100402AA46915CD5B07200008003EE8D9ACFAF44D40371AC05B208125C000003642
    000020400000A0BF00C0B343000040BF0000C03F000000BF000040400000A8400000C0BF0000003E
    0000003F0000203F000080BF0000803C0000003D0000803D0000803E0000003F000080BE0000003E
    000000000000000000000000";
const SEAPATH_23: &str = "
    AA5169A42A4004D32A9AFE1EF85A9F29000011C6FFB5020DFF6A000D01C7FF1CFFA50111FFA50222
    00046D47";
const SEAPATH_26: &str = "
    AA5569A42A4004D32A9AFE1EF85A9F29000011C6FFB5020DFF6A000D01C7FF1CFFA50111FFA50222
    69A42A3D2694FFC400042B6D";

#[test]
fn tss1_is_the_published_example_to_the_byte() {
    let published = b":1A4770 -0016H 0429 -0680\r\n";
    let telegram = Tss1::read(published).unwrap();
    assert!(near(telegram.horizontal_acceleration, 0.9971, 1e-9));
    assert!(near(telegram.vertical_acceleration, 11.43, 1e-9));
    assert!(near(telegram.heave, -0.16, 1e-12));
    assert!(near(telegram.roll, 4.29 * DEG, 1e-12) && near(telegram.pitch, -6.8 * DEG, 1e-12));
    assert_eq!((telegram.aiding, telegram.settled), (Tss1Aiding::Heading, true));
    let rounded = Tss1 {
        horizontal_acceleration: 0.997,
        vertical_acceleration: 11.43,
        heave: -0.16,
        roll: 4.29 * DEG,
        pitch: -6.8 * DEG,
        ..telegram
    };
    for written in [telegram, rounded] {
        assert_eq!(&written.write().unwrap(), published);
    }
}

#[test]
fn tss1_of_other_makers_is_read_and_written_to_the_byte() {
    let published = [
        ":00FFCA -0003F-0325  0319",
        ":053C22  0000f-0046 -0563",
        ":073D89  0000f-0052 -0562",
        ":000000 -0016f 0429 -0680",
    ];
    for line in published {
        let line = format!("{line}\r\n").into_bytes();
        let telegram = Tss1::read(&line).unwrap();
        assert_eq!(telegram.settled, line[13].is_ascii_uppercase());
        assert_eq!(telegram.write().unwrap().as_slice(), line);
    }
    let novatel = Tss1::read(b":00FFCA -0003F-0325  0319\r\n").unwrap();
    assert!(near(novatel.vertical_acceleration, -0.033_75, 1e-12));
}

#[test]
fn every_letter_of_tss1_is_told_apart() {
    let letters = b"UuGgHhFf";
    let all = [Tss1Aiding::Unaided, Tss1Aiding::Speed, Tss1Aiding::Heading, Tss1Aiding::Full];
    let states = all.into_iter().flat_map(|aiding| [(aiding, true), (aiding, false)]);
    for ((aiding, settled), letter) in states.zip(letters) {
        let written = Tss1 { aiding, settled, ..LEVEL }.write().unwrap();
        assert_eq!(written[13], *letter);
        let read = Tss1::read(&written).unwrap();
        assert_eq!((read.aiding, read.settled), (aiding, settled));
    }
}

#[test]
fn tss1_of_the_wrong_shape_is_refused() {
    let wrong = [
        ":1A4770 -0016H 0429 -0680\n\n",
        ";1A4770 -0016H 0429 -0680\r\n",
        ":1G4770 -0016H 0429 -0680\r\n",
        ":1A4770--0016H 0429 -0680\r\n",
        ":1A4770 -0016X 0429 -0680\r\n",
        ":1A4770 -00 6H 0429 -0680\r\n",
        ":1A4770 +0016H 0429 -0680\r\n",
        ":1A+770 -0016H 0429 -0680\r\n",
        ":1A4770 -0016H 0429  0680\r\n\n",
    ];
    for line in wrong {
        assert_eq!(Tss1::read(line.as_bytes()), Err(BinaryFault::Frame), "{line:?}");
    }
    assert_eq!(Tss1::read(b":1A"), Err(BinaryFault::Short { needed: 27, found: 3 }));
}

#[test]
fn tss1_out_of_range_is_not_sent() {
    let wrong = [
        Tss1 { horizontal_acceleration: 9.81, ..LEVEL },
        Tss1 { vertical_acceleration: -20.5, ..LEVEL },
        Tss1 { heave: 99.995, ..LEVEL },
        Tss1 { roll: -100.0 * DEG, ..LEVEL },
        Tss1 { pitch: f64::NAN, ..LEVEL },
        Tss1 { heave: f64::NEG_INFINITY, ..LEVEL },
    ];
    for telegram in wrong {
        assert_eq!(telegram.write(), None, "{telegram:?}");
    }
    let port = Tss1 { horizontal_acceleration: -0.5, ..LEVEL }.write();
    let starboard = Tss1 { horizontal_acceleration: 0.5, ..LEVEL }.write();
    assert_eq!(port, starboard, "the field has no sign");
    let hardly = Tss1 { heave: -0.004, roll: -1e-9, ..LEVEL }.write().unwrap();
    assert_eq!(&hardly, b":000000  0000F 0000  0000\r\n", "no minus before a zero");
}

#[test]
fn em3000_of_a_ship_is_read_and_written_to_the_byte() {
    let of_a_ship = [0x90, 0x90, 56, 0, 252, 255, 0, 0, 74, 101];
    let telegram = EmAttitude::read(&of_a_ship).unwrap();
    assert_eq!(telegram.status, Some(EmStatus::Normal));
    assert!(near(telegram.roll.unwrap(), 0.56 * DEG, 1e-12));
    assert!(near(telegram.pitch.unwrap(), -0.04 * DEG, 1e-12));
    assert_eq!(telegram.heave, Some(0.0));
    assert!(near(telegram.heading.unwrap(), 259.3 * DEG, 1e-12));
    assert_eq!(telegram.write(), of_a_ship);
}

#[test]
fn the_first_byte_of_em_is_the_status_or_zero() {
    for (status, byte, also) in [
        (None, 0x00, 0x00),
        (Some(EmStatus::Normal), 0x90, 0x90),
        (Some(EmStatus::Reduced), 0x91, 0x99),
        (Some(EmStatus::Unsettled), 0x9A, 0x9F),
        (Some(EmStatus::Error), 0xA0, 0xAF),
    ] {
        let mut written = EmAttitude { status, ..EM }.write();
        assert_eq!(written[..2], [byte, 0x90]);
        written[0] = also;
        assert_eq!(EmAttitude::read(&written).unwrap().status, status);
    }
    for byte in [0x01, 0x8F, 0xB0, 0xFF] {
        let mut written = EM.write();
        written[0] = byte;
        assert_eq!(EmAttitude::read(&written), Err(BinaryFault::Frame));
        written[0] = 0;
        written[1] = byte;
        assert_eq!(EmAttitude::read(&written), Err(BinaryFault::Frame));
    }
}

#[test]
fn what_em_does_not_know_is_out_of_range() {
    let unknown = EmAttitude { roll: None, pitch: None, heave: None, heading: None, ..EM };
    assert_eq!(unknown.write()[2..], [0xFF, 0x7F, 0xFF, 0x7F, 0xFF, 0x7F, 0xFF, 0xFF]);
    assert_eq!(EmAttitude::read(&unknown.write()), Ok(unknown));
    let outside = EmAttitude {
        roll: Some(PI),
        pitch: Some(f64::NAN),
        heave: Some(-10.0),
        heading: Some(f64::INFINITY),
        ..EM
    };
    assert_eq!(outside.write(), unknown.write());
}

#[test]
fn a_heading_just_below_the_full_turn_is_north() {
    let below = TAU - 1e-9;
    let em = EmAttitude { heading: Some(below), ..EM }.write();
    assert_eq!(em[8..], [0, 0]);
    let kmb = Kmb { heading: full(below), ..oslo_fjord() }.write().unwrap();
    assert_eq!(kmb[48..52], [0; 4]);
    let seapath = Seapath23 { heading: full(below), ..oslo_fjord_23() }.write().unwrap();
    assert_eq!(seapath[32..34], [0; 2]);
    let west = Seapath23 { heading: full(-FRAC_PI_2), ..oslo_fjord_23() }.write().unwrap();
    assert_eq!(west[32..34], [0xC0, 0x00]);
}

#[test]
fn km_binary_has_every_field_where_the_table_has_it() {
    assert_eq!(oslo_fjord().write().unwrap().as_slice(), bytes_of(KMB));
    let read = Kmb::read(&bytes_of(KMB)).unwrap();
    assert_eq!(read.time, oslo_fjord().time);
    assert_eq!(read.vertical, oslo_fjord().vertical);
    assert_eq!(read.acceleration, oslo_fjord().acceleration);
    assert_eq!((read.delayed_heave, read.sigma), (None, oslo_fjord().sigma));
    assert!(near(read.place.unwrap().value.longitude, -10.7522 * DEG, 1e-15));
    assert!(near(read.heading.unwrap().value, 359.5 * DEG, 1e-12));
}

#[test]
fn seapath_has_every_field_where_the_tables_have_it() {
    assert_eq!(oslo_fjord_23().write().unwrap().as_slice(), bytes_of(SEAPATH_23));
    assert_eq!(oslo_fjord_26().write().unwrap().as_slice(), bytes_of(SEAPATH_26));
    let read = Seapath26::read(&bytes_of(SEAPATH_26)).unwrap();
    assert_eq!(Seapath23::read(&bytes_of(SEAPATH_23)), Ok(read.motion));
    assert_eq!(read.motion.time, UtcTime::from_nanos(NOON * SECOND + 123_500_000));
    assert_eq!(read.delayed_heave, oslo_fjord_26().delayed_heave);
    let vertical = read.motion.vertical.unwrap();
    assert_eq!((vertical.value.heave, vertical.reduced), (0.75, true));
    assert!(near(read.motion.place.unwrap().value.latitude, 59.9139 * DEG, 1e-9));
    assert!(near(read.motion.rates[2], 3.0 * DEG, 5e-5));
}

/// A ship leaned to starboard, bow up, lifted and rising, and the same ship the other way round.
#[test]
fn a_ship_leaned_to_each_side_and_lifted_has_the_signs_of_each_format() {
    for sign in [1.0, -1.0] {
        let (roll, pitch, heave) = (sign * 5.0 * DEG, sign * 2.0 * DEG, sign * 1.5);
        let positive = sign > 0.0;
        let text = Tss1 { roll, pitch, heave, vertical_acceleration: sign, ..LEVEL }.write();
        let text = text.unwrap();
        for place in [8, 14, 20] {
            assert_eq!(text[place] == b' ', positive, "port up, bow up and heave up are positive");
        }
        assert_eq!(text[3] < b'8', positive, "upward acceleration is positive");
        let em = EmAttitude { roll: Some(roll), pitch: Some(pitch), heave: Some(heave), ..EM };
        let em = em.write();
        for place in [3, 5, 7] {
            assert_eq!(em[place] < 0x80, positive, "port up, bow up and heave up are positive");
        }
        let delayed = SensorDelayedHeave { time: UtcTime::from_nanos(0), heave };
        let kmb = Kmb {
            tilt: full(Tilt { roll, pitch }),
            vertical: full(Vertical { heave, down_velocity: -sign }),
            delayed_heave: full(delayed),
            ..oslo_fjord()
        };
        let kmb = kmb.write().unwrap();
        let single = |at: usize| f32::from_le_bytes(kmb[at..at + 4].try_into().unwrap());
        let signs = [40, 44, 52, 76, 128].map(|at| f64::from(single(at)).signum() * sign);
        assert_eq!(signs, [1.0, 1.0, -1.0, -1.0, -1.0], "port up, bow up; heave is down");
        let motion = Seapath23 {
            tilt: full(Tilt { roll, pitch }),
            vertical: full(Vertical { heave, down_velocity: -sign }),
            ..oslo_fjord_23()
        };
        let seapath = Seapath26 { motion, delayed_heave: Some(delayed) }.write().unwrap();
        let signs = [28, 30, 20, 26, 46].map(|at| (seapath[at] < 0x80) == positive);
        assert_eq!(signs, [true, true, false, false, false], "port up, bow up; heave is down");
    }
}

#[test]
fn roll_against_the_horizon_is_less_than_the_euler_angle() {
    let roll = |roll: f64, pitch: f64| roll_from_horizon(roll * DEG, pitch * DEG) / DEG;
    assert!(near(roll(10.0, 0.0), 10.0, 1e-12));
    assert!(near(roll(10.0, 5.0), 9.962, 1e-3));
    assert!(near(roll(-10.0, -5.0), -9.962, 1e-3));
}

#[test]
fn each_invalid_group_of_km_binary_has_its_bit_and_zeros() {
    let nothing = Kmb {
        place: None,
        tilt: None,
        heading: None,
        vertical: None,
        acceleration: None,
        delayed_heave: None,
        sigma: KmbSigma::default(),
        ..oslo_fjord()
    };
    let written = nothing.write().unwrap();
    assert_eq!(written[16..20], 0x3F_u32.to_le_bytes());
    assert!(written[20..56].iter().all(|byte| *byte == 0));
    assert!(written[80..108].chunks(4).all(|error| error == (-1.0_f32).to_le_bytes()));
    let read = Kmb::read(&written).unwrap();
    assert_eq!(Kmb { rates: nothing.rates, ..read }, nothing);
    let delayed = SensorDelayedHeave { time: nothing.time, heave: 1.0 };
    for (bit, known) in [
        (16, Kmb { place: reduced(oslo_fjord().place.unwrap().value), ..nothing }),
        (17, Kmb { tilt: reduced(oslo_fjord().tilt.unwrap().value), ..nothing }),
        (18, Kmb { heading: reduced(1.0), ..nothing }),
        (19, Kmb { vertical: reduced(oslo_fjord().vertical.unwrap().value), ..nothing }),
        (20, Kmb { acceleration: reduced([0.0; 3]), ..nothing }),
        (21, Kmb { delayed_heave: reduced(delayed), ..nothing }),
    ] {
        let status = 0x3F_u32 & !(1 << (bit - 16)) | 1 << bit;
        assert_eq!(known.write().unwrap()[16..20], status.to_le_bytes());
    }
}

#[test]
fn each_invalid_group_of_seapath_has_its_bit_and_zeros() {
    let motion =
        Seapath23 { place: None, tilt: None, heading: None, vertical: None, ..oslo_fjord_23() };
    let written = Seapath26 { motion, delayed_heave: None }.write().unwrap();
    assert_eq!(written[48..50], [0x01, 0xAA]);
    assert!(written[8..34].iter().chain(&written[40..48]).all(|byte| *byte == 0));
    assert_eq!(motion.write().unwrap()[40..42], [0x00, 0xAA], "what a Seapath sends at its start");
    let read = Seapath26::read(&written).unwrap();
    assert_eq!((read.motion.place, read.motion.tilt, read.motion.heading), (None, None, None));
    assert_eq!((read.motion.vertical, read.delayed_heave), (None, None));
    for (status, known) in [
        (0xA9, Seapath23 { place: reduced(oslo_fjord().place.unwrap().value), ..motion }),
        (0xA6, Seapath23 { vertical: reduced(oslo_fjord().vertical.unwrap().value), ..motion }),
        (0x9A, Seapath23 { tilt: reduced(oslo_fjord().tilt.unwrap().value), ..motion }),
        (0x6A, Seapath23 { heading: reduced(1.0), ..motion }),
    ] {
        assert_eq!(known.write().unwrap()[40..42], [0, status]);
    }
}

#[test]
fn a_group_that_its_fields_cannot_hold_is_invalid() {
    let place = oslo_fjord().place.unwrap().value;
    let fast = full(SensorPlace { north_velocity: 328.0, ..place });
    let beyond = full(SensorPlace { latitude: 91.0 * DEG, ..place });
    let nowhere = full(SensorPlace { longitude: f64::NAN, ..place });
    let deep = full(Vertical { heave: -328.0, down_velocity: 0.0 });
    for group in [fast, beyond, nowhere] {
        let written = Seapath23 { place: group, ..oslo_fjord_23() }.write().unwrap();
        assert_eq!(Seapath23::read(&written).unwrap().place, None);
    }
    for group in [beyond, nowhere] {
        let written = Kmb { place: group, ..oslo_fjord() }.write().unwrap();
        assert_eq!(Kmb::read(&written).unwrap().place, None);
    }
    let written = Seapath23 { vertical: deep, ..oslo_fjord_23() }.write().unwrap();
    assert_eq!(Seapath23::read(&written).unwrap().vertical, None);
    let huge = full(Vertical { heave: 1e300, down_velocity: 0.0 });
    let written = Kmb { vertical: huge, ..oslo_fjord() }.write().unwrap();
    assert_eq!(Kmb::read(&written).unwrap().vertical, None);
}

#[test]
fn what_nothing_can_mark_is_not_sent() {
    let spinning = [0.0, 0.0, PI];
    assert_eq!(Seapath23 { rates: spinning, ..oslo_fjord_23() }.write(), None);
    assert_eq!(Kmb { rates: [f64::NAN, 0.0, 0.0], ..oslo_fjord() }.write(), None);
    for nanos in [i64::MIN, -1, 4_294_967_296 * SECOND, i64::MAX] {
        let time = UtcTime::from_nanos(nanos);
        assert_eq!(Kmb { time, ..oslo_fjord() }.write(), None);
    }
    let last = UtcTime::from_nanos(4_294_967_296 * SECOND - 1);
    let written = Kmb { time: last, ..oslo_fjord() }.write().unwrap();
    assert_eq!(Kmb::read(&written).unwrap().time, last);
    let too_late = UtcTime::from_nanos((i64::from(i32::MAX) + 1) * SECOND);
    assert_eq!(Seapath23 { time: too_late, ..oslo_fjord_23() }.write(), None);
}

#[test]
fn numbers_out_of_range_are_refused_if_they_are_said_to_be_valid() {
    let set = |at: usize, value: &[u8]| {
        let mut frame = bytes_of(KMB);
        frame[at..at + value.len()].copy_from_slice(value);
        Kmb::read(&frame)
    };
    let range = |field| Err(BinaryFault::Range { field });
    let nan = f32::NAN.to_le_bytes();
    assert_eq!(set(0, b"#KMA"), Err(BinaryFault::Frame));
    assert_eq!(set(4, &[120]), Err(BinaryFault::Frame));
    assert_eq!(set(6, &[2]), Err(BinaryFault::OtherMessage));
    assert_eq!(set(12, &1_000_000_000_u32.to_le_bytes()), range("fraction of a second"));
    assert_eq!(set(20, &90.1_f64.to_le_bytes()), range("latitude"));
    assert_eq!(set(28, &f64::NAN.to_le_bytes()), range("longitude"));
    assert_eq!(set(44, &91.0_f32.to_le_bytes()), range("pitch"));
    assert_eq!(set(48, &(-1.0_f32).to_le_bytes()), range("heading"));
    assert_eq!(set(52, &nan), range("heave or down velocity"));
    assert_eq!(set(64, &nan), range("rate"));
    assert_eq!(set(104, &nan), range("error"));
    assert!(set(128, &nan).is_ok(), "the delayed heave is said to be invalid");
    for (at, field) in [(6, "fraction of a second"), (8, "latitude")] {
        let mut frame = [0; 44];
        frame[at] = 0x41;
        let frame = checks::seapath_frame::<44>([0xAA, 0x51], &frame);
        assert_eq!(Seapath23::read(&frame), Err(BinaryFault::Range { field }));
    }
}

#[test]
fn every_flipped_bit_of_seapath_is_noticed() {
    let whole = oslo_fjord_26().write().unwrap();
    for bit in 0..whole.len() * 8 {
        let mut flipped = whole;
        flipped[bit / 8] ^= 1 << (bit % 8);
        assert_eq!(Seapath26::read(&flipped), Err(BinaryFault::Frame));
    }
    assert_eq!(Seapath23::read(&whole), Err(BinaryFault::Frame));
    assert_eq!(
        Seapath26::read(&bytes_of(SEAPATH_23)),
        Err(BinaryFault::Short { needed: 52, found: 44 })
    );
}
