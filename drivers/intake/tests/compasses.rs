//! Compasses and motion sensors by their makers' formats: what of them becomes a heading.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use std::f64::consts::TAU;

use insd_base::{Arrival, Input, Message, PortId, Stamp, Time, UtcTime};
use insd_intake::config::{Dialect, IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::port::Link;
use insd_intake::watched::WatchedValue;
use insd_intake::{Intake, Intaken};
use insd_n2k::pgn::{Group, Heading, North};
use insd_wire::imu::stdbin;
use insd_wire::motion::em::{EmAttitude, EmStatus};
use insd_wire::ngt1::NgtMessage;

/// Noon of a day in 2026, ns since 1970.
const NOON: i64 = 1_780_315_200_000_000_000;

fn sentence(inside: &str) -> Vec<u8> {
    let sum = inside.bytes().fold(0, |sum, byte| sum ^ byte);
    format!("${inside}*{sum:02X}\r\n").into_bytes()
}

/// Headings, deg, of a sensor that sends frames a second for ten seconds, 10 deg added.
fn headings(kind: Kind, link: Link, frames: impl Fn(u32) -> Vec<u8>) -> Vec<f64> {
    let sensor =
        SensorConfig { heading_offset_deg: 10.0, ..SensorConfig::new("mast", "mast", kind) };
    let ports = vec![PortSpec { name: "mast".to_owned(), link }];
    let sensors = vec![sensor];
    let mut intake = Intake::new(&IntakeConfig { ports, sensors, ..IntakeConfig::default() });
    let mut found = Vec::new();
    for second in 0..10_u32 {
        let late = i64::from(second) * 1_000_000_000 + 80_000_000;
        let stamp = Stamp {
            monotonic: Time::from_nanos(late + 5_000_000_000),
            system: UtcTime::from_nanos(NOON + late),
        };
        intake.handle(&Arrival { port: PortId(0), stamp, input: Input::Bytes(frames(second)) });
        while let Some(output) = intake.poll_output() {
            if let Intaken::Measured(received) = output {
                let Message::Reference(told) = received.message else { panic!("{received:?}") };
                found.push(told.heading.unwrap().to_degrees());
            }
        }
    }
    found
}

#[test]
fn em3000_gives_headings_while_the_sensor_is_in_order() {
    let told = |second: u32| {
        let status = if second < 6 { EmStatus::Normal } else { EmStatus::Unsettled };
        let (roll, pitch, heave) = (Some(0.01), Some(-0.02), Some(0.5));
        let heading = Some(271.5_f64.to_radians());
        EmAttitude { status: Some(status), roll, pitch, heave, heading }.write().to_vec()
    };
    for link in [Link::Serial { byte_time: 1e-3 }, Link::Datagrams] {
        let found = headings(Kind::Em3000, link, told);
        assert_eq!(found.len(), 6);
        assert!(found.iter().all(|heading| (heading - 281.5).abs() < 1e-9), "{found:?}");
    }
}

#[test]
fn km_binary_gives_headings_unless_it_says_that_they_are_invalid() {
    let seed = std::fs::read("../../fuzz/corpus/kmb/telegrams.kmb").unwrap();
    let told = |second: u32| {
        let mut telegram = seed[..132].to_vec();
        telegram[16] = if second < 6 { 0 } else { 4 };
        telegram
    };
    let found = headings(Kind::Kmb, Link::Datagrams, told);
    assert_eq!(found.len(), 6);
    assert!(found.iter().all(|heading| (heading - 281.5).abs() < 1e-6), "{found:?}");
}

#[test]
fn satellite_compasses_by_their_makers_sentences_give_headings_while_they_measure() {
    let of = |kind, good: &'static str, bad: &'static str| {
        let frames = |second| sentence(if second < 6 { good } else { bad });
        headings(kind, Link::Serial { byte_time: 1e-3 }, frames)
    };
    let hpr = ("PSAT,HPR,235410.50,89.58,3.35,,N", "PSAT,HPR,235410.50,89.58,3.35,,G");
    let avr = (
        "PTNL,AVR,212405.20,+52.1531,Yaw,-0.0806,Tilt,,,12.575,3,1.4,16",
        "PTNL,AVR,212405.20,+52.1531,Yaw,-0.0806,Tilt,,,12.575,2,1.4,16",
    );
    let pfec = ("PFEC,GPatt,294.7,-02.5,+00.4", "PFEC,GPatt,,,");
    for (kind, (good, bad), heading) in
        [(Kind::Psat, hpr, 99.58), (Kind::Ptnl, avr, 62.1531), (Kind::Pfec, pfec, 304.7)]
    {
        let found = of(kind, good, bad);
        assert_eq!(found.len(), 6, "{kind:?}");
        assert!(found.iter().all(|own| (own - heading).abs() < 1e-9), "{kind:?}: {found:?}");
    }
}

#[test]
fn a_compass_of_nmea_2000_behind_a_serial_adapter_is_read_as_on_its_bus() {
    let told = |second: u32| {
        let heading = Heading {
            sid: None,
            heading: Some(271.5_f64.to_radians()),
            deviation: None,
            variation: None,
            reference: Some(North::True),
        };
        let message = NgtMessage {
            priority: Heading::PRIORITY,
            pgn: Heading::PGN,
            destination: 255,
            source: 0x10,
            clock: second * 1000,
            data: heading.write(),
        };
        // an engine's, which nobody listens to, stands beside
        let other = NgtMessage { pgn: 127_488, data: vec![0xFF; 8], ..message.clone() };
        [other.write().unwrap(), message.write().unwrap()].concat()
    };
    for link in [Link::Serial { byte_time: 1e-4 }, Link::Datagrams, Link::Stream] {
        let found = headings(Kind::N2kHeading, link, told);
        assert_eq!(found.len(), 10, "{link:?}");
        assert!(found.iter().all(|heading| (heading - 281.5).abs() < 0.01), "{found:?}");
    }
}

/// How often a watched sensor that says the same ten times tells a heading and a tilt, which `is_right` looks at.
fn watched(kind: Kind, frame: &[u8], is_right: impl Fn(&WatchedValue) -> bool) -> [usize; 2] {
    let dialect = (kind == Kind::Pashr).then_some(Dialect::Novatel);
    let sensor = SensorConfig { dialect, ..SensorConfig::new("gyro", "gyro", kind) };
    let port = PortSpec { name: "gyro".to_owned(), link: Link::Datagrams };
    let mut intake = Intake::new(&IntakeConfig {
        ports: vec![port],
        sensors: vec![sensor],
        watched: vec!["gyro".to_owned()],
        ..IntakeConfig::default()
    });
    let mut told = [0; 2];
    for second in 0..10_i64 {
        let late = second * 1_000_000_000;
        let stamp =
            Stamp { monotonic: Time::from_nanos(late), system: UtcTime::from_nanos(NOON + late) };
        let input = Input::Bytes(frame.to_vec());
        intake.handle(&Arrival { port: PortId(0), stamp, input });
        while let Some(output) = intake.poll_output() {
            let Intaken::Watched(watched) = output else {
                assert!(matches!(output, Intaken::Event(_)), "{output:?}");
                continue;
            };
            assert!(is_right(&watched.value), "{kind:?}: {watched:?}");
            told[0] += usize::from(matches!(watched.value, WatchedValue::Heading(_)));
            told[1] += usize::from(matches!(watched.value, WatchedValue::Tilt { .. }));
        }
    }
    assert_eq!(intake.status().choices.iter().filter_map(|own| own.sensor).count(), 0);
    told
}

#[test]
fn what_a_watched_sensor_says_goes_to_the_watch_and_no_further() {
    let tss1 = b":1A4770 -0016H 0429 -0680\r\n".to_vec();
    let unsettled = b":1A4770 -0016h 0429 -0680\r\n".to_vec();
    let pashr = sentence("PASHR,120000.00,271.50,T,+4.29,-6.80,+0.10,0.020,0.030,0.040,1,1");
    let hdt = sentence("HEHDT,271.5,T");
    let degrees = [4.29_f64, -6.8].map(f64::to_radians);
    for (kind, frame, tilt, told) in [
        (Kind::Tss1, tss1, degrees, [0, 10]),
        (Kind::Tss1, unsettled, degrees, [0, 0]),
        (Kind::Pashr, pashr, degrees, [10, 10]),
        (Kind::Compass, hdt, degrees, [10, 0]),
        (Kind::StdbinIns, exail(0b101), [0.02, -0.01], [10, 10]),
        (Kind::StdbinIns, exail(0b10), [0.02, -0.01], [0, 0]),
    ] {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-7;
        let found = watched(kind, &frame, |value| match value {
            WatchedValue::Heading(heading) => near(*heading, 271.5_f64.to_radians()),
            WatchedValue::Tilt { roll, pitch } => near(*roll, tilt[0]) && near(*pitch, tilt[1]),
            WatchedValue::Position(at) => near(at.longitude + TAU, 5.0) && near(at.latitude, 0.6),
        });
        assert_eq!(found, told, "{kind:?}");
    }
}

/// What an Exail system says that has a heading of 271.5 deg.
fn exail(status: u32) -> Vec<u8> {
    let attitude =
        stdbin::StdBinAttitude { heading: 271.5_f64.to_radians(), roll: 0.02, pitch: -0.01 };
    let position =
        stdbin::Position { latitude: 0.6, longitude: 5.0, altitude: 3.0, above_ellipsoid: true };
    let navigation = stdbin::Navigation {
        attitude: Some(attitude),
        attitude_std: Some([1e-3, 2e-4, 2e-4]),
        position: Some(position),
        algorithm_status: Some([status, 0, 0, 0]),
        ..stdbin::Navigation::default()
    };
    stdbin::Telegram { version: 3, navigation, ..stdbin::Telegram::default() }.write()
}

#[test]
fn an_exail_system_gives_headings_when_it_is_aligned_and_its_position_to_a_watch_alone() {
    let told = |second: u32| exail(if second < 4 { 0b10 } else { 0b101 });
    let found = headings(Kind::StdbinIns, Link::Datagrams, told);
    assert_eq!(found.len(), 6);
    assert!(found.iter().all(|heading| (heading - 281.5).abs() < 1e-5), "{found:?}");
}
