//! Frames of real receivers and what they say. The UBX and RTCM3 bytes are from gpsd's device logs
//! (`ublox-zed-f9p-sfrbx`, `ublox-neo-f9v`, `ublox-neo-m8n`, `u-blox-m8t-time`,
//! `ublox-zed-f9t-rtcm3`), the values as pyubx2 and pyrtcm read them.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::{FixQuality, GpsTime, UtcTime};
use insd_wire::gnss::ubx::{self, Carrier, FixType, NavPvt, UbxMessage};
use insd_wire::gnss::{EpochTime, PulseOrder, rtcm, sbf};

fn hex(text: &str) -> Vec<u8> {
    text.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
}

const F9P: &str = "b5 62 01 07 5c 00 50 8d 0e 14 e4 07 06 0a 15 1c 00 37 10 00 00 00 94 86 01 00 \
    03 01 ea 12 0b f0 b0 b7 ff 5f 44 1a f0 eb 10 00 56 3f 11 00 6e 14 00 00 f0 1b 00 00 cd ff ff \
    ff a1 ff ff ff 0a 00 00 00 6c 00 00 00 93 cb b7 00 b9 01 00 00 2e 79 6b 00 98 00 00 00 ba 65 \
    43 2c 00 00 00 00 00 00 00 00 12 b6";

const F9V: &str = "b5 62 01 07 5c 00 00 f9 92 00 e9 07 09 0e 02 28 0e 3f 1b 00 00 00 76 cf fe ff \
    03 03 ea 1e ce f0 b0 b7 3a 5e 44 1a 25 e0 10 00 8b 33 11 00 60 04 00 00 c3 06 00 00 00 00 00 \
    00 fe ff ff ff 0b 00 00 00 02 00 00 00 00 00 00 00 ac 00 00 00 80 a8 12 01 61 00 00 00 b2 a2 \
    4b 35 00 00 00 00 56 05 46 00 c9 5a";

const M8N: &str = "b5 62 01 07 5c 00 38 9f 58 11 e1 07 07 13 08 32 02 37 03 00 00 00 00 c1 c1 23 \
    03 03 0a 0e b7 eb 9d 52 6d bb 31 eb 3c 61 00 00 cb 6e 00 00 70 04 00 00 48 06 00 00 f5 ff ff \
    ff 04 00 00 00 ed ff ff ff 0c 00 00 00 aa 05 30 00 c8 00 00 00 22 60 0d 00 91 00 00 e0 ac 4c \
    22 00 00 e0 00 e0 00 00 00 80 39 4c";

#[test]
fn a_zed_f9p_says_where_it_is() {
    let pvt = NavPvt::read(&hex(F9P)).unwrap();
    assert_eq!(
        (pvt.fix, pvt.fix_ok, pvt.carrier),
        (FixType::ThreeDimensional, true, Carrier::None)
    );
    assert_eq!(pvt.time_of_week, 336_498_000_000_000);
    let position = pvt.position.unwrap();
    assert!((position.latitude.to_degrees() - 44.068_863_9).abs() < 1e-12);
    assert!((position.longitude.to_degrees() + 121.314_098_1).abs() < 1e-12);
    assert!((position.height - 1108.976).abs() < 1e-9);
    assert!((pvt.velocity[1] + 0.095).abs() < 1e-12);
    assert_eq!((pvt.heading, pvt.declination), (None, None));
    let part = pvt.part();
    let utc = UtcTime::from_civil((2020, 6, 10), (21, 28, 0), 99_988).unwrap();
    assert_eq!(part.epoch, Some(EpochTime::Utc(utc)));
    assert_eq!((part.quality, part.invalid), (Some(FixQuality::Autonomous), false));
    let [north, east, down] = part.position_std.map(Option::unwrap);
    assert!((north.hypot(east) - 5.230).abs() < 1e-9 && (north - east).abs() < 1e-12);
    assert!((down - 7.152).abs() < 1e-9);
}

#[test]
fn a_second_that_was_rounded_up_is_taken_back() {
    let pvt = NavPvt::read(&hex(F9V)).unwrap();
    assert_eq!(pvt.time.nanosecond, -77_962);
    let utc = UtcTime::from_civil((2025, 9, 14), (2, 40, 13), 999_922_038).unwrap();
    assert_eq!(pvt.part().epoch, Some(EpochTime::Utc(utc)));
    assert_eq!(pvt.part().quality, Some(FixQuality::Differential));
    let (declination, accuracy) = pvt.declination.unwrap();
    assert!((declination.to_degrees() - 13.66).abs() < 1e-9);
    assert!((accuracy.to_degrees() - 0.7).abs() < 1e-9);
}

#[test]
fn what_an_old_receiver_leaves_in_fields_it_does_not_know_is_not_read() {
    // headVeh of this frame would be -5368 deg
    let pvt = NavPvt::read(&hex(M8N)).unwrap();
    assert_eq!((pvt.heading, pvt.declination), (None, None));
    assert_eq!(pvt.time.nanosecond, 599_900_416);
}

#[test]
fn a_frame_of_generation_7_ends_eight_bytes_earlier() {
    let whole = hex(F9P);
    let short = ubx::Frame { class: 1, id: 7, payload: &whole[6..90] }.write();
    assert_eq!(short.len(), 92);
    assert_eq!(NavPvt::read(&short), NavPvt::read(&whole));
}

#[test]
fn the_time_of_the_next_pulse_is_read_in_its_time_base() {
    let frame = hex("b5 62 0d 01 10 00 50 ab 2d 0e 00 00 00 00 0b 25 00 00 62 08 0b 0f 08 88");
    let UbxMessage::TimTp(pulse) = UbxMessage::read(&frame).unwrap() else { panic!() };
    assert!(pulse.utc_base && pulse.utc_available);
    assert_eq!((pulse.week, pulse.system, pulse.utc_standard, pulse.raim), (2146, 15, 0, 2));
    assert!((pulse.quantization.unwrap() - 9.483e-9).abs() < 1e-18);
    let utc = UtcTime::from_civil((2021, 2, 23), (18, 4, 34), 0).unwrap();
    let told = pulse.pulse().unwrap();
    assert_eq!((told.instant, told.order), (EpochTime::Utc(utc), PulseOrder::Next));
    assert_eq!(pulse.write(), frame);
}

#[test]
fn gps_time_and_leap_seconds_are_told() {
    let frame = hex("b5 62 01 20 10 00 50 8d 0e 14 94 86 01 00 3d 08 12 07 10 00 00 00 b9 4a");
    let UbxMessage::NavTimeGps(time) = UbxMessage::read(&frame).unwrap() else { panic!() };
    assert_eq!(time.gps(), Some(GpsTime::from_week(2109, 336_498_000_099_988)));
    assert_eq!(time.part().leap_seconds, Some(18));
    let frame = hex(
        "b5 62 01 26 18 00 b8 ed 2d 0e 00 00 00 00 01 12 00 00 00 00 00 00 00 00 00 00 00 00 00 \
         01 33 3c",
    );
    let UbxMessage::NavTimeLs(leaps) = UbxMessage::read(&frame).unwrap() else { panic!() };
    assert_eq!((leaps.leap_seconds, leaps.source, leaps.event), (Some(18), 1, None));
    assert_eq!(leaps.write(), frame);
}

#[test]
fn dilutions_and_words_are_read_and_written_to_the_byte() {
    let frame =
        hex("b5 62 01 04 12 00 50 8d 0e 14 b4 00 98 00 60 00 82 00 4f 00 3d 00 32 00 02 d5");
    let UbxMessage::NavDop(dop) = UbxMessage::read(&frame).unwrap() else { panic!() };
    assert!((dop.part().hdop.unwrap() - 0.79).abs() < 1e-12);
    assert_eq!(dop.write(), frame);
    let frame = hex(
        "b5 62 02 13 30 00 03 23 00 00 0a 19 02 00 22 55 90 38 1a 20 68 09 ea 0b 16 2c d1 b0 60 \
         01 7d 05 0b 16 69 58 b0 20 78 22 1e 0b d0 00 00 10 00 00 00 00 00 00 00 00 6a 1b",
    );
    let UbxMessage::RxmSfrbx(words) = UbxMessage::read(&frame).unwrap() else { panic!() };
    assert_eq!((words.words[0], words.words.len(), words.signal.satellite), (948_983_074, 10, 35));
    assert_eq!(words.write(), frame);
}

#[test]
fn rtcm_frames_have_their_number() {
    for (text, number) in [
        ("d3 00 08 4c e0 00 8a 00 00 00 00 a8 f7 2a", 1230),
        ("d3 00 13 3e d0 00 03 ba 71 ca 31 f2 b6 de 30 eb 47 0a 47 2a 66 d3 7f a0 e9", 1005),
    ] {
        let bytes = hex(text);
        let frame = rtcm::Frame::open(&bytes).unwrap();
        assert_eq!(frame.number(), Some(number));
        assert_eq!(frame.write(), bytes);
    }
    assert_eq!(rtcm::Frame { message: &[] }.write(), hex("d3 00 00 47 ea 4b"));
}

#[test]
fn a_block_of_sbf_is_framed_as_another_reader_expects() {
    // made by hand and checked with pysbf2: ReceiverTime of 2024-02-29 12:00:18 GPS, 18 s ahead
    let block = hex("24 40 5e f9 1a 17 18 00 50 e4 2c 17 ff 08 18 02 1d 0c 00 00 12 07 00 00");
    let sbf::SbfMessage::ReceiverTime(time) = sbf::SbfMessage::read(&block).unwrap() else {
        panic!()
    };
    let utc = UtcTime::from_civil((2024, 2, 29), (12, 0, 0), 0).unwrap();
    assert_eq!(time.utc.unwrap().to_utc(), Some(utc));
    assert_eq!(time.part().epoch, Some(EpochTime::Gps(utc.to_gps())));
    assert_eq!(time.leap_seconds, Some(18));
    assert_eq!(time.write(), block);
}
