//! Two receivers: both pass, ranked by the choice.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{Arrival, Body, Input, Message, PortId, Source, Stamp, Time, UtcTime};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::Refusal;
use insd_intake::port::Link;
use insd_intake::{Intake, Intaken};

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
    let mut intake = Intake::new(&IntakeConfig { ports, sensors, imu: None, rangings: Vec::new() });
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
