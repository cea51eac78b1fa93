//! A Signal K server as compass, log and position: of this ship, of one source, each value once.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use std::collections::BTreeMap;

use insd_base::{Arrival, Input, LogReference, Message, PortId, Stamp, Time, UtcTime};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::Refusal;
use insd_intake::port::Link;
use insd_intake::{Intake, Intaken};

/// Noon of a day in 2026, ns since 1970.
const NOON: i64 = 1_780_315_200_000_000_000;
const OWN: &str = "vessels.urn:mrn:signalk:uuid:c0d79334-4e25-4245-8892-54e8ccc8021d";

fn hello() -> String {
    format!("{{\"name\":\"signalk-server\",\"version\":\"2.32.0\",\"self\":\"{OWN}\"}}")
}

fn delta(context: &str, source: &str, second: u32, path: &str, value: &str) -> String {
    format!(
        "{{\"context\":\"{context}\",\"updates\":[{{\"$source\":\"{source}\",\"timestamp\":\"2026-06-01T12:00:{second:02}Z\",\
         \"values\":[{{\"path\":\"navigation.{path}\",\"value\":{value}}}]}}]}}"
    )
}

/// What is passed on of lines that come a second apart, and what is refused.
fn heard(sensor: SensorConfig, lines: &[String]) -> (Vec<Message>, BTreeMap<Refusal, u64>) {
    let ports = vec![PortSpec { name: "server".to_owned(), link: Link::Stream }];
    let config = IntakeConfig { ports, sensors: vec![sensor], ..IntakeConfig::default() };
    let mut intake = Intake::new(&config);
    let mut found = Vec::new();
    for (second, line) in (0_i64..).zip(lines) {
        let stamp = Stamp {
            monotonic: Time::from_nanos((second + 5) * 1_000_000_000),
            system: UtcTime::from_nanos(NOON + second * 1_000_000_000),
        };
        let bytes = format!("{line}\r\n").into_bytes();
        intake.handle(&Arrival { port: PortId(0), stamp, input: Input::Bytes(bytes) });
        while let Some(output) = intake.poll_output() {
            if let Intaken::Measured(received) = output {
                found.push(received.message);
            }
        }
    }
    let refused = intake.status().sensors[0].refused.clone();
    (found, refused.into_iter().collect())
}

fn sensor(kind: Kind, source: &str) -> SensorConfig {
    let source = Some(source.to_owned());
    SensorConfig { source, ..SensorConfig::new("boat", "server", kind) }
}

fn headings(messages: &[Message]) -> Vec<f64> {
    let of = |message: &Message| match message {
        Message::Reference(told) => told.heading.unwrap(),
        other => panic!("{other:?}"),
    };
    messages.iter().map(of).collect()
}

#[test]
fn a_heading_is_of_this_ship_of_one_source_and_told_once() {
    let ais = "vessels.urn:mrn:imo:mmsi:230099999";
    let lines = [
        delta(OWN, "n2k.1", 0, "headingTrue", "0.5"), // before the greeting it may be anybody's
        hello(),
        delta(OWN, "n2k.1", 2, "headingTrue", "1.0"),
        delta(ais, "n2k.1", 3, "headingTrue", "3.0"),
        delta(OWN, "n2k.9", 4, "headingTrue", "2.0"),
        delta("vessels.self", "n2k.1", 5, "headingTrue", "1.1"),
        delta(OWN, "n2k.1", 5, "headingTrue", "1.1"),
        delta(OWN, "n2k.1", 7, "headingMagnetic", "1.3"),
        delta(OWN, "n2k.1", 8, "headingTrue", "null"),
        delta(OWN, "n2k.1", 9, "headingTrue", "\"north\""),
    ];
    let (found, refused) = heard(sensor(Kind::SignalkHeading, "n2k.1"), &lines);
    assert_eq!(headings(&found), [1.0, 1.1]);
    let expected = [
        (Refusal::Field, 1),
        (Refusal::Invalid, 1),
        (Refusal::OtherDevice, 1),
        (Refusal::OtherShip, 2),
        (Refusal::Repeated, 1),
    ];
    assert_eq!(refused, BTreeMap::from(expected));
}

#[test]
fn who_told_it_must_be_said_and_of_no_other_sensor() {
    let port = PortSpec { name: "server".to_owned(), link: Link::Stream };
    let faults = |sensor: SensorConfig| {
        let ports = vec![port.clone()];
        let config = IntakeConfig { ports, sensors: vec![sensor], ..IntakeConfig::default() };
        config.faults().iter().filter(|fault| fault.key == "source").count()
    };
    assert_eq!(faults(sensor(Kind::SignalkLog, "log")), 0);
    assert_eq!(faults(SensorConfig::new("boat", "server", Kind::SignalkLog)), 1);
    assert_eq!(faults(sensor(Kind::Compass, "log")), 1);
}

#[test]
fn speed_through_the_water_and_positions_from_elsewhere_are_what_they_are() {
    let lines = [
        hello(),
        delta(OWN, "log", 1, "speedThroughWater", "5.25"),
        delta(OWN, "gps", 2, "position", "{\"latitude\":60.0,\"longitude\":-25.0}"),
    ];
    let (found, _) = heard(sensor(Kind::SignalkLog, "log"), &lines);
    let [Message::Log(log)] = &found[..] else { panic!("{found:?}") };
    assert_eq!(log.reference, LogReference::Water);
    let (found, _) = heard(sensor(Kind::SignalkPosition, "gps"), &lines);
    let [Message::Reference(told)] = &found[..] else { panic!("{found:?}") };
    let place = told.position.unwrap();
    assert!((place.longitude.to_degrees() + 25.0).abs() < 1e-9, "{place:?}");
}
