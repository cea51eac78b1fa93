//! Two receivers: both pass, ranked by the choice.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::{
    Arrival, Body, FixQuality, GnssFix, Input, Message, PortId, Source, Stamp, Time, UtcTime,
};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::Refusal;
use insd_intake::port::Link;
use insd_intake::{Intake, Intaken};
use insd_wire::gnss::novatel::{
    AntennaHeading, BestPosition, BestVelocity, Header, InsPva, OemBody, OemLog,
};
use insd_wire::gnss::ubx::{
    Carrier, FixType, NavPosLlh, NavRelPosNed, NavSol, NavTimeUtc, NavVelNed,
};

/// Noon of a day in 2026, ns since 1970.
const NOON: i64 = 1_780_315_200_000_000_000;

fn sentence(inside: &str) -> String {
    let sum = inside.bytes().fold(0, |sum, byte| sum ^ byte);
    format!("${inside}*{sum:02X}\r\n")
}

/// What a receiver says of a second; `quality` as in GGA.
fn said(second: i64, quality: u8) -> Vec<u8> {
    let time = format!("1200{second:02}.00");
    let valid = if quality > 0 { 'A' } else { 'V' };
    let text = sentence(&format!("GPZDA,{time},01,06,2026,00,00"))
        + &sentence(&format!("GPGGA,{time},3526.4,N,13939.0,E,{quality},12,0.9,40.0,M,36.7,M,,"))
        + &sentence(&format!("GPRMC,{time},{valid},3526.4,N,13939.0,E,0.0,0.0,010626,,,A"));
    text.into_bytes()
}

/// The ranks of the fixes of two receivers, by second; `quality` tells what each says of its own at a second.
fn ranks(quality: impl Fn(usize, i64) -> u8) -> (Vec<(i64, u8, u8)>, Intake) {
    let link = Link::Serial { byte_time: 10.0 / 115_200.0 };
    let names = ["bow", "stern"];
    let ports = names.map(|name| PortSpec { name: name.to_owned(), link }).to_vec();
    let sensor = |(number, name): (usize, &&str)| SensorConfig {
        lever_m: Some([5.0 - 20.0 * number as f64, 1.0, -9.0]),
        delay_s: 0.1 * number as f64,
        priority: number as u8 + 1,
        ..SensorConfig::new(name, name, Kind::NmeaGnss)
    };
    let sensors = names.iter().enumerate().map(sensor).collect();
    let mut intake = Intake::new(&IntakeConfig { ports, sensors, ..IntakeConfig::default() });
    let mut ranks = Vec::new();
    for second in 0..40_i64 {
        for port in 0..2_u16 {
            let late = second * 1_000_000_000 + 80_000_000 + 1_000_000 * i64::from(port);
            let stamp = Stamp {
                monotonic: Time::from_nanos(late + 5_000_000_000),
                system: UtcTime::from_nanos(NOON + late),
            };
            let input = Input::Bytes(said(second, quality(usize::from(port), second)));
            intake.handle(&Arrival { port: PortId(port), stamp, input });
            while let Some(output) = intake.poll_output() {
                if let Intaken::Measured(received) = output
                    && let (Message::Gnss(fix), Source::Gnss(number)) =
                        (received.message, received.source)
                {
                    let bow = if number == 0 { 5.0 } else { -15.0 };
                    assert_eq!(fix.lever, Some(Body::new(bow, 1.0, -9.0)), "its own");
                    ranks.push((second, number, fix.rank));
                }
            }
        }
    }
    (ranks, intake)
}

#[test]
fn every_valid_fix_passes_and_says_whether_its_receiver_is_chosen() {
    let (ranks, intake) = ranks(|_, _| 1);
    let of = |own: u8| ranks.iter().filter(move |(_, number, _)| *number == own);
    assert!(of(0).count() > 30 && of(1).count() > 30, "{ranks:?}");
    assert!(of(0).all(|(_, _, rank)| *rank == 0), "{ranks:?}");
    assert!(of(1).all(|(_, _, rank)| *rank == 1), "{ranks:?}");
    for sensor in intake.status().sensors {
        assert_eq!(sensor.refused.get(&Refusal::NotChosen), None, "{}", sensor.name);
    }
}

#[test]
fn a_receiver_without_a_fix_is_left_and_the_other_takes_its_rank() {
    let (ranks, _) = ranks(|port, second| u8::from(port == 1 || second < 10));
    let stern = |from: i64| {
        let own = ranks.iter().filter(move |(second, number, _)| *second >= from && *number == 1);
        own.map(|(_, _, rank)| *rank).collect::<Vec<_>>()
    };
    assert!(stern(15).iter().all(|rank| *rank == 0), "{ranks:?}");
    assert!(!ranks.iter().any(|(second, number, _)| *second > 15 && *number == 0), "{ranks:?}");
}

/// What comes of frames of a u-blox receiver, so many a second for ten seconds, 10 deg added to its heading.
fn of_ublox(frames: impl Fn(u32) -> Vec<u8>) -> Vec<Message> {
    of_kind(Kind::Ubx, frames)
}

/// The same of any kind.
fn of_kind(kind: Kind, frames: impl Fn(u32) -> Vec<u8>) -> Vec<Message> {
    let link = Link::Serial { byte_time: 10.0 / 115_200.0 };
    let sensor = SensorConfig {
        heading: true,
        heading_offset_deg: 10.0,
        ..SensorConfig::new("bow", "bow", kind)
    };
    let ports = vec![PortSpec { name: "bow".to_owned(), link }];
    let sensors = vec![sensor];
    let mut intake = Intake::new(&IntakeConfig { ports, sensors, ..IntakeConfig::default() });
    let mut passed = Vec::new();
    for second in 0..10_u32 {
        let late = i64::from(second) * 1_000_000_000 + 80_000_000;
        let stamp = Stamp {
            monotonic: Time::from_nanos(late + 5_000_000_000),
            system: UtcTime::from_nanos(NOON + late),
        };
        let input = Input::Bytes(frames(second));
        intake.handle(&Arrival { port: PortId(0), stamp, input });
        while let Some(output) = intake.poll_output() {
            if let Intaken::Measured(received) = output {
                passed.push(received.message);
            }
        }
    }
    passed
}

/// Ns of the GPS week at a second after [`NOON`], the first of June 2026, a Monday.
fn of_week(second: u32) -> i64 {
    (129_600 + 18 + i64::from(second)) * 1_000_000_000
}

fn utc(second: u32) -> NavTimeUtc {
    NavTimeUtc {
        time_of_week: of_week(second),
        accuracy: Some(1e-7),
        nanosecond: 0,
        year: 2026,
        month_day: [6, 1],
        clock: [12, 0, second as u8],
        time_of_week_valid: true,
        week_valid: true,
        valid: true,
        standard: 3,
    }
}

#[test]
fn a_receiver_without_nav_pvt_gives_fixes_with_velocity_and_sigmas() {
    let passed = of_ublox(|second| {
        let time_of_week = of_week(second);
        let llh = NavPosLlh {
            time_of_week,
            longitude: 2.4,
            latitude: 0.6,
            height: 40.0,
            height_msl: 4.0,
            horizontal_accuracy: Some(2.0),
            vertical_accuracy: Some(3.0),
        };
        let velocity = NavVelNed {
            time_of_week,
            velocity: [1.0, 2.0, 0.0],
            speed: 2.24,
            ground_speed: 2.24,
            course: 1.1,
            speed_accuracy: Some(0.2),
            course_accuracy: None,
        };
        let sol = NavSol {
            time_of_week,
            fraction: 0,
            week: 2421,
            fix: if second == 5 { FixType::None } else { FixType::ThreeDimensional },
            fix_ok: true,
            differential: false,
            week_valid: true,
            time_of_week_valid: true,
            position: [0.0; 3],
            position_accuracy: None,
            velocity: [0.0; 3],
            speed_accuracy: None,
            pdop: 1.0,
            satellites: 8,
        };
        [llh.write(), sol.write(), velocity.write(), utc(second).write()].concat()
    });
    let fixes: Vec<_> = passed
        .iter()
        .filter_map(|message| if let Message::Gnss(fix) = message { Some(fix) } else { None })
        .collect();
    let (good, bad): (Vec<&GnssFix>, Vec<&GnssFix>) =
        fixes.into_iter().partition(|fix| fix.quality == FixQuality::Autonomous);
    assert_eq!((good.len(), bad.len()), (9, 1));
    assert_eq!(bad[0].quality, FixQuality::Invalid);
    for fix in good {
        assert!((fix.position.unwrap().latitude - 0.6).abs() < 1e-9);
        assert_eq!(fix.velocity.unwrap().0.as_slice(), [1.0, 2.0, 0.0]);
        assert!((fix.position_std.unwrap().0.z - 3.0).abs() < 1e-9);
    }
}

#[test]
fn a_receiver_that_is_told_to_be_a_compass_alone_gives_headings() {
    let passed = of_ublox(|second| {
        let line = NavRelPosNed {
            version: 1,
            station: 0,
            time_of_week: of_week(second),
            relative: [1.0, 0.0, 0.0],
            length: 1.0,
            heading: 0.5,
            finer: [0.0; 3],
            finer_length: 0.0,
            accuracy: [Some(0.01); 3],
            length_accuracy: Some(0.01),
            heading_accuracy: Some(0.004),
            fix_ok: true,
            differential: true,
            valid: true,
            carrier: if second == 4 { Carrier::Float } else { Carrier::Fixed },
            moving: true,
            position_missing: false,
            measurements_missing: false,
            heading_valid: true,
            normalized: false,
        };
        [utc(second).write(), line.write()].concat()
    });
    let headings: Vec<_> = passed
        .iter()
        .map(|message| match message {
            Message::Reference(told) => (told.heading.unwrap(), told.heading_std.unwrap()),
            other => panic!("{other:?}"),
        })
        .collect();
    assert!((7..=9).contains(&headings.len()), "{headings:?}");
    for (heading, std) in headings {
        assert!((heading - 0.5 - 10_f64.to_radians()).abs() < 1e-6 && (std - 0.004).abs() < 1e-6);
    }
}

/// A log of NovAtel at a second; GPS week 2421.
fn oem(id: u16, second: u32, body: OemBody) -> Vec<u8> {
    let milliseconds = (of_week(second) / 1_000_000) as i32;
    let header =
        Header { id, short: false, response: false, time_status: 180, week: 2421, milliseconds };
    OemLog { header, body }.write()
}

fn best(kind: u32) -> BestPosition {
    BestPosition {
        status: 0,
        kind,
        latitude: 0.6,
        longitude: 2.4,
        height_msl: Some(4.0),
        undulation: Some(36.0),
        datum: 61,
        std: [Some(0.5), Some(0.75), Some(1.5)],
        base: [0; 4],
        correction_age: None,
        age: None,
        tracked: 12,
        satellites: 11,
    }
}

#[test]
fn a_novatel_receiver_gives_fixes_and_the_heading_of_its_antennas() {
    let told = |second| {
        let velocity = BestVelocity {
            status: 0,
            kind: 8,
            latency: None,
            correction_age: None,
            ground_speed: Some(2.0),
            course: Some(0.0),
            climb: Some(0.5),
        };
        let line = AntennaHeading {
            status: 0,
            kind: 50,
            length: Some(2.0),
            heading: Some(0.25),
            pitch: None,
            heading_std: Some(0.002),
            pitch_std: None,
            rover: [0; 4],
        };
        let place = oem(42, second, OemBody::Position(best(16)));
        let speed = oem(99, second, OemBody::Velocity(velocity));
        [place, speed, oem(1335, second, OemBody::Heading(line))].concat()
    };
    let (mut fixes, mut headings) = (0, 0);
    for message in of_kind(Kind::Novatel, told) {
        match message {
            Message::Gnss(fix) => {
                assert_eq!(fix.velocity.unwrap().0.as_slice(), [2.0, 0.0, -0.5]);
                assert_eq!(fix.position_std.unwrap().0.as_slice(), [0.5, 0.75, 1.5]);
                assert!((fix.position.unwrap().height - 40.0).abs() < 1e-9);
                fixes += 1;
            }
            Message::Reference(told) => {
                let heading = told.heading.unwrap();
                assert!((heading - 0.25 - 10_f64.to_radians()).abs() < 1e-6);
                headings += 1;
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(fixes >= 8 && headings >= 8, "{fixes} {headings}");
}

#[test]
fn an_inertial_place_of_a_novatel_receiver_is_not_used_and_its_heading_is_as_a_compass() {
    let place = |second| oem(42, second, OemBody::Position(best(53)));
    assert_eq!(of_kind(Kind::Novatel, place), []);
    let ins = |second: u32| {
        let told = InsPva {
            week: 2421,
            time_of_week: Some(of_week(second) as f64 * 1e-9),
            latitude: 0.6,
            longitude: 2.4,
            height: Some(40.0),
            velocity: [Some(0.0); 3],
            roll: Some(0.0),
            pitch: Some(0.0),
            azimuth: Some(0.5),
            status: if second < 5 { 1 } else { 3 },
        };
        oem(507, second, OemBody::Ins(told))
    };
    let headings = of_kind(Kind::NovatelIns, ins);
    assert_eq!(headings.len(), 5, "only once it is aligned");
    for message in headings {
        let Message::Reference(told) = message else { panic!("{message:?}") };
        assert!((told.heading.unwrap() - 0.5 - 10_f64.to_radians()).abs() < 1e-9);
    }
}
