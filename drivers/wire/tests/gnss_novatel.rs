//! Logs of NovAtel: frames that the maker publishes with its own decoder, and what the logs say of an epoch, a heading and a sample.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::units::DEG;
use insd_base::{FixQuality, GpsTime};
use insd_wire::gnss::novatel::{
    AntennaHeading, BestPosition, BestVelocity, Header, ImuScale, InsPva, OemBody, OemLog,
    ReceiverClock,
};
use insd_wire::gnss::{EpochTime, GnssPart};
use insd_wire::imu::ImuMotion;
use insd_wire::stream::Look;

fn hex(text: &str) -> Vec<u8> {
    let digits: Vec<u8> = text.bytes().filter(u8::is_ascii_hexdigit).collect();
    let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).unwrap(), 16).unwrap();
    digits.chunks(2).map(byte).collect()
}

/// BESTPOS of a receiver in Calgary, from the tests of `novatel_edie` (MIT, copyright NovAtel Inc.), as are the next two.
const BESTPOS: &str = "aa44121c2a00002048000000a4b4ac07d8166d0808400002f6b100800000000010000000d703b04ce58e494052c426d1\
    72825cc029cb10c77aa29040333387c13d000000fa7eba3f3f57833fa9a40a40000000000000000000000000161616160006393323c4897a";

/// RAWIMUSX of an Epson G320N that lies on its back.
const RAWIMUSX: &str = "aa441328b60500006e170000042900008cc1c3b46ffe174000fea40bd8087dec224061ff695a29ffcd7dffff7db40100\
    33440500da2027b9";

/// INSPVAS of a system that waits for its azimuth.
const INSPVAS: &str = "aa441358fc017e08b092b4177e08000000000000384618418c4869cd4193494024d4ebb5f6815cc00060f6557ede9040\
    a123994c9f31603f94fbf13d25885d3ff5272cf6a27565bf15a3e28ad24ce73f32bdb32d8d29e13f00000000000000800a0000005ada2664";

fn header(id: u16) -> Header {
    let (week, milliseconds) = (2445, 302_400_250);
    Header { id, short: false, response: false, time_status: 180, week, milliseconds }
}

/// What a log says of its epoch once it was written and read.
fn part(id: u16, body: OemBody) -> Option<GnssPart> {
    let log = OemLog { header: header(id), body };
    let read = OemLog::read(&log.write()).unwrap();
    assert_eq!(read.header, log.header);
    read.part()
}

fn best(kind: u32) -> BestPosition {
    let OemBody::Position(published) = OemLog::read(&hex(BESTPOS)).unwrap().body else { panic!() };
    BestPosition { kind, ..published }
}

#[test]
fn a_published_bestpos_says_where_the_receiver_is() {
    let log = OemLog::read(&hex(BESTPOS)).unwrap();
    assert_eq!(log.name(), Some("BESTPOS"));
    let part = log.part().unwrap();
    assert_eq!(part.epoch, Some(EpochTime::Gps(GpsTime::from_week(1964, 141_367_000_000_000))));
    assert_eq!((part.quality, part.satellites), (Some(FixQuality::Autonomous), Some(22)));
    let place = part.position.unwrap();
    assert!((place.latitude.to_degrees() - 51.116_372_667_26).abs() < 1e-12);
    assert!((place.longitude.to_degrees() + 114.038_257_873_4).abs() < 1e-12);
    assert!((place.height - (1064.6199 - 16.9)).abs() < 1e-5, "above the ellipsoid");
    let [lat, lon, height] = part.position_std.map(Option::unwrap);
    assert!((lat - 1.457).abs() < 1e-6 && (lon - 1.0261).abs() < 1e-6);
    assert!((height - 2.1663).abs() < 1e-6);
}

#[test]
fn a_published_sample_senses_gravity_against_the_axis_that_points_down() {
    let log = OemLog::read(&hex(RAWIMUSX)).unwrap();
    assert!(log.header.short && log.name() == Some("RAWIMUSX"));
    let sample = log.imu().unwrap();
    let ImuMotion::Increments { delta_velocity, delta_theta } = sample.motion else { panic!() };
    let force = delta_velocity.map(|own| own * 125.0);
    assert!((force[2] + 9.80).abs() < 0.01, "{force:?}");
    assert!(force[0] < 0.0 && force[1] > 0.0, "y is told with the other sign: {force:?}");
    assert!(delta_theta.iter().all(|own| (own * 125.0).abs() < 0.05));
    assert!(sample.valid);
    assert_eq!(sample.device_time.unwrap().ticks.value, 5_998_473_000);
    assert_eq!(ImuScale::of_type(0), None);
}

#[test]
fn a_system_that_is_not_aligned_tells_no_heading() {
    let log = OemLog::read(&hex(INSPVAS)).unwrap();
    assert_eq!(log.attitude(), Some((None, None)));
    let OemBody::Ins(told) = log.body else { panic!() };
    assert_eq!((told.week, told.status), (2174, 10));
    assert!((told.pitch.unwrap() - 0.536_322_201_978_612 * DEG).abs() < 1e-15);
    let aligned = InsPva { status: 3, azimuth: Some(-0.5), ..told };
    let read =
        OemLog::read(&OemLog { header: header(507), body: OemBody::Ins(aligned) }.write()).unwrap();
    let (heading, std) = read.attitude().unwrap();
    assert!((heading.unwrap() - (std::f64::consts::TAU - 0.5)).abs() < 1e-12 && std.is_none());
    assert_eq!(read.part(), None, "a place by an inertial system is none by satellites");
}

#[test]
fn published_frames_are_written_as_they_came_but_for_what_is_not_kept() {
    for text in [RAWIMUSX, INSPVAS] {
        assert_eq!(OemLog::read(&hex(text)).unwrap().write(), hex(text));
    }
    let read = OemLog::read(&hex(BESTPOS)).unwrap();
    assert_eq!(OemLog::read(&read.write()).unwrap(), read);
}

#[test]
fn qualities_are_those_of_the_position_type_and_inertial_places_are_none() {
    for (kind, quality) in [
        (16, FixQuality::Autonomous),
        (18, FixQuality::Differential),
        (69, FixQuality::Differential),
        (34, FixQuality::RtkFloat),
        (50, FixQuality::RtkFixed),
        (1, FixQuality::Manual),
        (19, FixQuality::Estimated),
        (0, FixQuality::Invalid),
    ] {
        let part = part(1429, OemBody::Position(best(kind))).unwrap();
        assert_eq!((part.kind, part.quality), ("BESTGNSSPOS", Some(quality)));
        assert_eq!(part.position.is_some(), quality != FixQuality::Invalid);
    }
    assert_eq!(part(42, OemBody::Position(best(53))), None);
    let unsolved = BestPosition { status: 1, ..best(16) };
    assert!(part(42, OemBody::Position(unsolved)).unwrap().invalid);
}

#[test]
fn velocities_are_told_north_east_and_down() {
    let told = BestVelocity {
        status: 0,
        kind: 8,
        latency: Some(0.15),
        correction_age: None,
        ground_speed: Some(5.0),
        course: Some(120.0 * DEG),
        climb: Some(0.25),
    };
    let [north, east, down] =
        part(99, OemBody::Velocity(told)).unwrap().velocity.map(Option::unwrap);
    assert!((north + 2.5).abs() < 1e-12 && (east - 4.330_127).abs() < 1e-6);
    assert_eq!(down, -0.25);
    let unsolved = BestVelocity { status: 1, ..told };
    assert_eq!(part(99, OemBody::Velocity(unsolved)).unwrap().velocity, [None; 3]);
}

#[test]
fn only_a_line_with_fixed_integers_is_a_heading() {
    let line = AntennaHeading {
        status: 0,
        kind: 50,
        length: Some(2.0),
        heading: Some(359.5 * DEG),
        pitch: Some(0.0),
        heading_std: Some(0.25 * DEG),
        pitch_std: Some(0.5 * DEG),
        rover: *b"RVR1",
    };
    for id in [1335, 2042] {
        let part = part(id, OemBody::Heading(line)).unwrap();
        assert!((part.heading.unwrap() - 359.5 * DEG).abs() < 1e-6);
        assert!((part.heading_std.unwrap() - 0.25 * DEG).abs() < 1e-9);
        assert_eq!((part.quality, part.position), (None, None));
    }
    for other in [AntennaHeading { kind: 34, ..line }, AntennaHeading { status: 6, ..line }] {
        assert_eq!(part(1335, OemBody::Heading(other)).unwrap().heading, None);
    }
}

#[test]
fn leap_seconds_are_told_once_utc_is_valid() {
    let clock = ReceiverClock {
        status: 0,
        offset: Some(1e-9),
        offset_std: Some(1e-8),
        utc_offset: Some(-18.0),
        year: 2026,
        civil: [11, 28, 1, 2],
        milliseconds: 3_000,
        utc_status: 1,
    };
    let told = part(101, OemBody::Time(clock)).unwrap();
    assert_eq!((told.leap_seconds, told.time_std), (Some(18), Some(1e-8)));
    let unsure = ReceiverClock { utc_status: 0, ..clock };
    assert_eq!(part(101, OemBody::Time(unsure)).unwrap().leap_seconds, None);
}

#[test]
fn a_time_that_is_only_approximate_is_no_time() {
    let log = OemLog {
        header: Header { time_status: 60, ..header(42) },
        body: OemBody::Position(best(16)),
    };
    assert_eq!(OemLog::read(&log.write()).unwrap().part().unwrap().epoch, None);
}

#[test]
fn cut_and_flipped_frames_are_refused_and_answers_to_commands_are_not_read() {
    for text in [BESTPOS, RAWIMUSX, INSPVAS] {
        let frame = hex(text);
        assert_eq!(insd_wire::gnss::novatel::look(&frame), Look::Frame(frame.len()));
        for length in 0..frame.len() {
            assert!(OemLog::read(&frame[..length]).is_err());
        }
        for bit in 0..frame.len() * 8 {
            let mut flipped = frame.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(OemLog::read(&flipped).is_err(), "bit {bit}");
        }
    }
    let answer = Header { response: true, ..header(42) }.write(&[0; 72]);
    assert_eq!(OemLog::read(&answer).unwrap().body, OemBody::Other);
}
