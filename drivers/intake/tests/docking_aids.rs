//! Docking aids and a pilot's own unit, from their sentences to what the navigator is told.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{
    Arrival, Body, ExternalReference, Geodetic, GnssFix, Input, Message, PortId, RangingReading,
    RangingTarget, Source, Stamp, Time, UtcTime,
};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::Refusal;
use insd_intake::port::Link;
use insd_intake::ranging::RangingSpec;
use insd_intake::{Intake, Intaken};

/// Noon of a day in 2026, ns since 1970.
const NOON: i64 = 1_780_315_200_000_000_000;

fn sentence(inside: &str) -> String {
    let sum = inside.bytes().fold(0, |sum, byte| sum ^ byte);
    format!("${inside}*{sum:02X}\r\n")
}

fn spec(sensor: &str, head: u32) -> RangingSpec {
    RangingSpec {
        sensor: sensor.to_owned(),
        head,
        mark: 7,
        target: RangingTarget::Point {
            place: Geodetic::from_degrees(35.0, 139.0, 40.0),
            std: [0.1, 0.2],
        },
        lever: Body::new(60.0, 11.0, 4.0),
        std: 0.05,
    }
}

/// What comes of sentences that are said ten times a second.
fn told(
    sensors: Vec<SensorConfig>,
    rangings: Vec<RangingSpec>,
    said: impl Fn(i64) -> String,
) -> (Vec<(Source, Message)>, Intake) {
    let ports = vec![PortSpec { name: "port".to_owned(), link: Link::Datagrams }];
    let mut intake =
        Intake::new(&IntakeConfig { ports, sensors, rangings, ..IntakeConfig::default() });
    let mut all = Vec::new();
    for tenth in 0..400_i64 {
        let late = tenth * 100_000_000 + 30_000_000;
        let stamp = Stamp {
            monotonic: Time::from_nanos(late + 5_000_000_000),
            system: UtcTime::from_nanos(NOON + late),
        };
        let input = Input::Bytes(said(tenth).into_bytes());
        intake.handle(&Arrival { port: PortId(0), stamp, input });
        while let Some(output) = intake.poll_output() {
            if let Intaken::Measured(received) = output {
                all.push((received.source, received.message));
            }
        }
    }
    (all, intake)
}

fn distances(all: &[(Source, Message)]) -> Vec<(Source, RangingReading)> {
    let distance = |(source, message): &(Source, Message)| match message {
        Message::Ranging(reading) => Some((*source, *reading)),
        _ => None,
    };
    all.iter().filter_map(distance).collect()
}

#[test]
fn two_heads_on_one_line_are_told_apart_and_each_is_as_old_as_it_says() {
    let sensor =
        SensorConfig { latency_s: 0.1, ..SensorConfig::new("lasers", "port", Kind::Ranging) };
    let (all, intake) = told(vec![sensor], vec![spec("lasers", 1), spec("lasers", 2)], |tenth| {
        let stern = if tenth < 200 { "8.000,A,,0.25" } else { ",V,," };
        sentence("PINSD,RNG,1,12.345,A,0.020,")
            + &sentence(&format!("PINSD,RNG,2,{stern}"))
            + &sentence("PINSD,RNG,3,1.000,A,,")
    });
    let all = distances(&all);
    let of = |own: u8| all.iter().filter(move |(source, _)| *source == Source::Ranging(own));
    assert_eq!((of(0).count(), of(1).count()), (400, 200));
    let (_, bow) = of(0).next_back().unwrap();
    assert_eq!((bow.distance, bow.std, bow.mark), (12.345, 0.02, 7));
    assert_eq!(bow.lever, Body::new(60.0, 11.0, 4.0));
    let (_, stern) = of(1).next().unwrap();
    assert_eq!((stern.distance, stern.std), (8.0, 0.05));
    let (_, first) = of(0).next().unwrap();
    assert!(((first.time - stern.time).as_seconds() - 0.25).abs() < 1e-9);
    let sensor = &intake.status().sensors[0];
    assert_eq!(sensor.refused[&Refusal::UnknownHead], 400);
    assert_eq!(sensor.refused[&Refusal::Invalid], 200);
    assert_eq!(sensor.valid, Some(true));
}

#[test]
fn a_local_position_reference_gives_a_distance_along_each_axis_and_a_heading_while_it_has_one() {
    let sensor = SensorConfig {
        heading_offset_deg: 30.0,
        heading_std_deg: 0.5,
        ..SensorConfig::new("cyscan", "port", Kind::Rls)
    };
    let specs = vec![spec("cyscan", 1), spec("cyscan", 2)];
    let (all, _) = told(vec![sensor], specs, |tenth| {
        let bearing = if tenth < 100 { "060.000,A" } else { "000.000,V" };
        sentence(&format!("RLS,-012.34,+105.60,A,{bearing},0000"))
    });
    let headings = all.iter().filter_map(|(_, message)| match message {
        Message::Reference(ExternalReference { heading, .. }) => *heading,
        _ => None,
    });
    let headings: Vec<f64> = headings.collect();
    assert_eq!(headings.len(), 100);
    assert!((headings[0].to_degrees() - 90.0).abs() < 1e-9, "{}", headings[0]);
    let told = distances(&all);
    assert_eq!(told.len(), 800);
    assert_eq!((told[0].1.distance, told[1].1.distance), (-12.34, 105.6));
}

#[test]
fn a_pilots_own_unit_is_compared_at_its_own_place_and_takes_over_with_its_heading() {
    let ship = SensorConfig {
        talkers: vec!["GP".to_owned()],
        ..SensorConfig::new("gnss", "port", Kind::NmeaGnss)
    };
    let pilot = SensorConfig {
        talkers: vec!["GN".to_owned()],
        priority: 3,
        lever_m: Some([-8.0, 14.0, -21.0]),
        heading: true,
        ..SensorConfig::new("pilot", "port", Kind::NmeaGnss)
    };
    let (all, _) = told(vec![ship, pilot], Vec::new(), |tenth| {
        if tenth % 10 > 0 {
            return String::new();
        }
        let time = format!("1200{:02}.00", tenth / 10);
        let of = |talker: &str, quality: u8| {
            let valid = if quality > 0 { 'A' } else { 'V' };
            let place = "3526.4,N,13939.0,E";
            sentence(&format!("{talker}ZDA,{time},01,06,2026,00,00"))
                + &sentence(&format!("{talker}GGA,{time},{place},{quality},12,0.9,40.0,M,36.7,M,,"))
                + &sentence(&format!("{talker}RMC,{time},{valid},{place},0.0,0.0,010626,,,A"))
        };
        of("GP", u8::from(tenth < 200)) + &of("GN", 4) + &sentence("GNHDT,123.4,T")
    });
    let fix = |(source, message): &(Source, Message)| match (source, message) {
        (Source::Gnss(1), Message::Gnss(fix)) => Some(*fix),
        _ => None,
    };
    let fixes: Vec<GnssFix> = all.iter().filter_map(fix).collect();
    assert!(fixes.len() > 30, "{}", fixes.len());
    assert!(fixes.iter().all(|fix| fix.lever == Some(Body::new(-8.0, 14.0, -21.0))));
    assert_eq!((fixes[5].rank, fixes.last().unwrap().rank), (1, 0));
    let heading = |(_, message): &(Source, Message)| {
        matches!(message, Message::Reference(told)
            if told.heading.is_some_and(|own| (own.to_degrees() - 123.4).abs() < 1e-9))
    };
    assert!(all.iter().filter(|own| heading(own)).count() > 30);
}
