//! Lever arm and delay of a single receiver, from its description to its fixes.

#![allow(clippy::unwrap_used)]

use insd_base::{Arrival, Body, GnssFix, Input, Message, PortId, Stamp, Time, UtcTime};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::port::Link;
use insd_intake::{Intake, Intaken};

/// Noon of a day in 2026, ns since 1970.
const NOON: i64 = 1_780_315_200_000_000_000;

fn sentence(inside: &str) -> String {
    let sum = inside.bytes().fold(0, |sum, byte| sum ^ byte);
    format!("${inside}*{sum:02X}\r\n")
}

/// The fixes of a receiver that speaks for half a minute.
fn fixes(sensor: SensorConfig) -> Vec<GnssFix> {
    let link = Link::Serial { byte_time: 10.0 / 115_200.0 };
    let ports = vec![PortSpec { name: "gnss".to_owned(), link }];
    let mut intake =
        Intake::new(&IntakeConfig { ports, sensors: vec![sensor], ..IntakeConfig::default() });
    let mut fixes = Vec::new();
    for second in 0..30_i64 {
        let time = format!("1200{second:02}.00");
        let bytes = sentence(&format!("GPZDA,{time},01,06,2026,00,00"))
            + &sentence(&format!("GPGGA,{time},3526.4,N,13939.0,E,1,12,0.9,40.0,M,36.7,M,,"))
            + &sentence(&format!("GPRMC,{time},A,3526.4,N,13939.0,E,0.0,0.0,010626,,,A"));
        let late = second * 1_000_000_000 + 80_000_000;
        let stamp = Stamp {
            monotonic: Time::from_nanos(late + 5_000_000_000),
            system: UtcTime::from_nanos(NOON + late),
        };
        let input = Input::Bytes(bytes.into_bytes());
        intake.handle(&Arrival { port: PortId(0), stamp, input });
        while let Some(output) = intake.poll_output() {
            if let Intaken::Measured(received) = output
                && let Message::Gnss(fix) = received.message
            {
                fixes.push(fix);
            }
        }
    }
    fixes
}

#[test]
fn a_receiver_has_its_own_lever_and_its_fixes_are_older_by_its_delay() {
    let plain = SensorConfig::new("gnss", "gnss", Kind::NmeaGnss);
    let own = SensorConfig { lever_m: Some([5.0, 1.0, -9.0]), delay_s: 0.25, ..plain.clone() };
    let (plain, own) = (fixes(plain), fixes(own));
    assert!(plain.len() > 20 && plain.len() == own.len(), "{} and {}", plain.len(), own.len());
    for (plain, own) in plain.iter().zip(own) {
        assert_eq!((plain.lever, own.lever), (None, Some(Body::new(5.0, 1.0, -9.0))));
        assert_eq!(((plain.time - own.time).as_seconds() * 1e6).round(), 250_000.0);
        assert_eq!(plain.position, own.position);
    }
}

#[test]
fn a_lever_of_zeros_counts_as_not_measured_and_one_of_a_log_is_a_fault() {
    let plain = SensorConfig::new("gnss", "gnss", Kind::NmeaGnss);
    let zeros = SensorConfig { lever_m: Some([0.0; 3]), ..plain };
    assert_eq!(zeros.lever(), None);
    let log = SensorConfig { lever_m: Some([1.0; 3]), ..SensorConfig::new("log", "p", Kind::Pd6) };
    let config = IntakeConfig { sensors: vec![log], ..IntakeConfig::default() };
    assert!(config.faults().iter().any(|fault| fault.key == "lever_m"));
}
