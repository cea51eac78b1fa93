//! Compasses and motion sensors by their makers' formats: what of them becomes a heading.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::{Arrival, Input, Message, PortId, Stamp, Time, UtcTime};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::port::Link;
use insd_intake::{Intake, Intaken};
use insd_wire::motion::em::{EmAttitude, EmStatus};

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
    let mut intake = Intake::new(&IntakeConfig { ports, sensors, imu: None, rangings: Vec::new() });
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
