//! Bottom track records of Nortek's AD2CP: records of two instruments, and what becomes of good ones.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::LogReference;
use insd_wire::binary::BinaryFault;
use insd_wire::log::LogFrame;
use insd_wire::log::ad2cp::{Ad2cpBottomTrack, BOTTOM_TRACK};
use insd_wire::stream::{Cutter, Protocol};

/// Six records of bottom track and one other of two Signatures, which had not found the bottom: `VelEchoBT01.ad2cp` and
/// `Sig500_dp_ice.ad2cp` of `MHKiT-Software/MHKiT-Python` (BSD-3-Clause, `data/LICENSE.mhkit`).
const RECORDED: &[u8] = include_bytes!("../../../fuzz/corpus/ad2cp/recorded.ad2cp");

fn frames(stream: &[u8]) -> (Vec<Vec<u8>>, u64) {
    let mut cutter = Cutter::new(&Protocol::ALL);
    cutter.push(stream);
    let mut frames = Vec::new();
    while let Some(cut) = cutter.cut() {
        assert_eq!(cut.protocol, Protocol::Ad2cp);
        frames.push(cut.bytes.to_vec());
    }
    (frames, cutter.skipped())
}

fn tracks() -> Vec<Ad2cpBottomTrack> {
    let read = |frame: &Vec<u8>| Ad2cpBottomTrack::read(frame).ok();
    frames(RECORDED).0.iter().filter_map(read).collect()
}

#[test]
fn recorded_records_have_the_values_of_an_independent_reader() {
    let (frames, skipped) = frames(RECORDED);
    assert_eq!((frames.len(), skipped), (7, 0));
    assert_eq!(Ad2cpBottomTrack::read(&frames[1]), Err(BinaryFault::OtherMessage));
    let first = tracks()[0];
    assert_eq!((first.head.serial, first.head.exponent), (101_654, -5));
    assert_eq!(first.head.clock, [0x78, 0x00, 0x16, 0x04, 0x0A, 0x21]);
    assert!((first.head.sound_speed - 1532.9).abs() < 1e-9);
    assert!((first.head.temperature - 24.35).abs() < 1e-9);
    assert!((first.head.pressure - 8.086).abs() < 1e-9);
    assert!((first.head.heading.to_degrees() - 272.76).abs() < 1e-9);
    assert!((first.head.tilt[0].to_degrees() + 51.10).abs() < 1e-9);
    assert_eq!(first.frame(), Some(LogFrame::Beam));
}

#[test]
fn what_the_instrument_marks_as_bad_is_not_known() {
    for track in tracks() {
        assert_eq!(
            (track.velocity, track.distance, track.merit),
            ([None; 4], [None; 4], [None; 4])
        );
        assert_eq!(track.reading(), None);
    }
}

#[test]
fn a_good_record_in_the_instruments_axes_is_a_velocity_over_ground() {
    let mut track = tracks()[0];
    track.head.beams = 0x4400;
    track.velocity = [Some(1.25), Some(-0.5), Some(0.125), Some(0.375)];
    track.distance = [Some(20.5), Some(20.25), Some(20.75), None];
    track.merit = [Some(12), Some(13), Some(14), Some(15)];
    let read = Ad2cpBottomTrack::read(&track.write()).unwrap();
    assert_eq!(read.distance, track.distance);
    let reading = read.reading().unwrap();
    assert_eq!((reading.frame, reading.reference), (LogFrame::Instrument, LogReference::Bottom));
    let near = reading.velocity.map(|own| own.map(|own| (own * 1e5).round() / 1e5));
    assert_eq!(near, [Some(1.25), Some(-0.5), Some(0.25), None]);
    let lost = Ad2cpBottomTrack { merit: [Some(12), None, Some(14), Some(15)], ..track };
    assert_eq!(Ad2cpBottomTrack::read(&lost.write()).unwrap().reading(), None);
}

#[test]
fn a_flipped_bit_and_a_record_cut_short_are_found() {
    let bytes = tracks()[0].write();
    assert_eq!(bytes[2], BOTTOM_TRACK);
    for bit in 0..bytes.len() * 8 {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        assert!(Ad2cpBottomTrack::read(&flipped).is_err(), "bit {bit}");
    }
    for length in 0..bytes.len() {
        assert!(Ad2cpBottomTrack::read(&bytes[..length]).is_err());
    }
}

#[test]
fn a_scale_that_no_instrument_has_is_refused_whatever_its_sign() {
    for exponent in [i8::MIN, -10, 10, i8::MAX] {
        let mut track = tracks()[0];
        track.head.exponent = exponent;
        assert!(matches!(Ad2cpBottomTrack::read(&track.write()), Err(BinaryFault::Range { .. })));
    }
}
