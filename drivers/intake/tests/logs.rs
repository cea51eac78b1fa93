//! Claims about lines that real logs hold, from bytes to measurements.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::{Arrival, GnssFix, Input, LogVelocity, Message, PortId, Stamp, Time, UtcTime};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::{Happening, Refusal};
use insd_intake::mounting::{Direction, Mounting};
use insd_intake::port::Link;
use insd_intake::status::SensorStatus;
use insd_intake::{Intake, Intaken};
use insd_wire::imu::stdbin::{Navigation, Telegram};
use insd_wire::log::pd0::{
    BottomTrack, Coordinates, Ensemble, FixedLeader, Geometry, Transformation, VariableLeader,
};
use insd_wire::log::pd6::Pd6;

/// A port with one sensor, and what came of it.
struct Ship {
    intake: Intake,
    measured: Vec<Message>,
    events: Vec<Happening>,
}

impl Ship {
    fn new(sensor: SensorConfig, link: Link) -> Self {
        let ports = vec![PortSpec { name: "port".to_owned(), link }];
        let config = IntakeConfig { ports, sensors: vec![sensor], ..IntakeConfig::default() };
        Ship { intake: Intake::new(&config), measured: Vec::new(), events: Vec::new() }
    }

    /// Bytes that come at so many seconds, in November 2026 by the computer's clock.
    fn hear(&mut self, seconds: f64, bytes: &[u8]) {
        let system = UtcTime::from_civil((2026, 11, 22), (12, 0, 0), 0).unwrap();
        let stamp = Stamp { monotonic: Time::from_seconds(100.0 + seconds), system };
        let input = Input::Bytes(bytes.to_vec());
        self.intake.handle(&Arrival { stamp, port: PortId(0), input });
        while let Some(intaken) = self.intake.poll_output() {
            match intaken {
                Intaken::Measured(received) => self.measured.push(received.message),
                Intaken::Event(event) => self.events.push(event.what),
                Intaken::Temperature(..) | Intaken::Watched(_) => {}
            }
        }
    }

    fn status(&self) -> SensorStatus {
        self.intake.status().sensors[0].clone()
    }

    fn refused(&self, reason: Refusal) -> u64 {
        self.status().refused.get(&reason).copied().unwrap_or(0)
    }

    fn fixes(&self) -> Vec<GnssFix> {
        let fix = |message: &Message| match message {
            Message::Gnss(fix) => Some(*fix),
            _ => None,
        };
        self.measured.iter().filter_map(fix).collect()
    }

    fn velocities(&self) -> Vec<LogVelocity> {
        let velocity = |message: &Message| match message {
            Message::Log(velocity) => Some(*velocity),
            _ => None,
        };
        self.measured.iter().filter_map(velocity).collect()
    }

    /// UTC at so many seconds.
    fn day(&self, seconds: f64) -> (i32, u8, u8) {
        self.intake.utc_at(Time::from_seconds(100.0 + seconds)).unwrap().to_civil().0
    }
}

fn sensor(kind: Kind) -> SensorConfig {
    SensorConfig::new("own", "port", kind)
}

fn framed(text: &str) -> String {
    format!("${text}*{:02X}\r\n", insd_wire::nmea::checksum(text.as_bytes()))
}

#[test]
fn a_receiver_that_tells_no_variation_keeps_velocity_and_date_and_its_bad_fields_are_counted() {
    let mut ship = Ship::new(sensor(Kind::NmeaGnss), Link::Stream);
    for second in 0..20 {
        // the sentences of a receiver in the tests of gpsd, each with the second of this test
        let rmc = framed(&format!(
            "GPRMC,1139{second:02}.00,A,3842.86006889,N,11705.43645510,W,9.711,46.405,221126,\
             999.9000,E,D"
        ));
        let gga = framed(&format!(
            "GPGGA,1139{second:02}.00,3842.86006889,N,11705.43645510,W,2,20,0.7,1500.0,M,-24.0,M,,"
        ));
        ship.hear(f64::from(second), format!("{rmc}{gga}").as_bytes());
    }
    let fixes = ship.fixes();
    assert!(fixes.len() > 15, "{}", fixes.len());
    assert!(fixes.iter().all(|fix| fix.velocity.is_some()), "{fixes:?}");
    assert_eq!((ship.refused(Refusal::Field), ship.refused(Refusal::Malformed)), (20, 0));
    assert_eq!(ship.day(19.0), (2026, 11, 22));
}

/// A second of the R/V Nathaniel B. Palmer on the 1st of August 2014: lines without checksums, times
/// before them.
fn palmer(second: u32) -> String {
    format!(
        "2014-08-01T00:00:{second:02}.316000Z $GPZDA,0000{second:02},01,08,2014,7\r\n\
         2014-08-01T00:00:{second:02}.316000Z $GPGLL,2200.097,S,01756.346,W\r\n\
         2014-08-01T00:00:{second:02}.316000Z $GPVTG,220.6,T,,M,009.7,N,018.0,K\r\n"
    )
}

#[test]
fn short_forms_without_checksums_are_taken_where_the_installer_allows_it_and_only_there() {
    for no_checksum in [true, false] {
        let config = SensorConfig { no_checksum, ..sensor(Kind::NmeaGnss) };
        let mut ship = Ship::new(config, Link::File);
        (0..20).for_each(|second| ship.hear(f64::from(second), palmer(second).as_bytes()));
        let malformed = ship.refused(Refusal::Malformed);
        assert_eq!(malformed, if no_checksum { 0 } else { 60 });
        let status = ship.status();
        assert_eq!(status.heard.is_some(), no_checksum);
        if no_checksum {
            assert_eq!(ship.day(19.0), (2014, 8, 1), "a file tells its own time");
            let fixes = ship.fixes();
            assert!(
                fixes.len() > 15 && fixes.iter().all(|fix| fix.velocity.is_some()),
                "{fixes:?}"
            );
        }
    }
}

#[test]
fn an_old_receiver_that_tells_neither_mode_nor_height_has_a_fix() {
    // made in the form of the editions before modes, which many receivers still send
    let mut ship = Ship::new(sensor(Kind::NmeaGnss), Link::Stream);
    for second in 0..20 {
        let rmc =
            format!("GPRMC,1139{second:02},A,3842.8600,N,11705.4364,W,009.7,046.4,221126,013.1,E");
        ship.hear(f64::from(second), framed(&rmc).as_bytes());
    }
    let fixes = ship.fixes();
    assert!(fixes.len() > 15 && fixes.iter().all(|fix| fix.position.is_some()), "{fixes:?}");
    assert!(fixes.iter().all(|fix| fix.quality.is_measured()));
}

#[test]
fn a_recording_of_2014_that_is_played_to_a_line_keeps_its_date_and_a_receiver_at_work_does_not() {
    let day = |date: &str| {
        let mut ship = Ship::new(sensor(Kind::NmeaGnss), Link::Stream);
        for second in 0..20 {
            let zda = framed(&format!("GPZDA,1139{second:02}.00,{date},00,00"));
            ship.hear(f64::from(second), zda.as_bytes());
        }
        ship.day(19.0)
    };
    assert_eq!(day("01,08,2014"), (2014, 8, 1));
    assert_eq!(day("08,04,2007"), (2026, 11, 22), "1024 weeks ago");
}

fn ensemble(coordinates: Coordinates, alignment: f64, wire: [f64; 4]) -> Vec<u8> {
    let flags = Transformation { coordinates, tilts: false, three_beams: false, mapped: false };
    let fixed = FixedLeader {
        firmware: [51, 40],
        frequency: Some(300e3),
        geometry: Some(Geometry { angle: 30_f64.to_radians(), convex: true, up: false }),
        beams: 4,
        cells: 0,
        transformation: flags,
        heading_alignment: alignment.to_radians(),
        heading_bias: 0.0,
    };
    let variable = VariableLeader {
        number: 1,
        clock: None,
        self_test: 0,
        sound: 1500.0,
        depth: 4.0,
        heading: 0.0,
        pitch: 0.0,
        roll: 0.0,
        salinity: 35.0,
        temperature: 12.0,
    };
    let bottom = BottomTrack { velocity: wire.map(Some), ..BottomTrack::default() };
    Ensemble { fixed, variable, bottom: Some(bottom) }.write()
}

/// What a log makes of a frame, forward, starboard, down.
fn told(config: SensorConfig, frame: &[u8]) -> [f64; 3] {
    let mut ship = Ship::new(config, Link::Stream);
    (0..5).for_each(|second| ship.hear(f64::from(second), frame));
    let velocity = ship.velocities()[0];
    [velocity.u, velocity.v, velocity.w].map(Option::unwrap)
}

fn is_near(found: [f64; 3], expected: [f64; 3]) {
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 2e-3, "{found} instead of {expected}");
    }
}

#[test]
fn a_log_of_rdi_whose_mounting_is_not_told_has_its_beam_3_forward() {
    // going ahead at 2 m/s the bottom comes towards beam 3, at the sine of 30 deg
    let beams = [0.0, 0.0, 1.0, -1.0];
    is_near(told(sensor(Kind::Pd0), &ensemble(Coordinates::Beam, 0.0, beams)), [2.0, 0.0, 0.0]);
    let instrument = [-0.3, -2.0, 0.1, 0.0];
    let frame = ensemble(Coordinates::Instrument, 0.0, instrument);
    is_near(told(sensor(Kind::Pd0), &frame), [2.0, 0.3, 0.1]);
    let line = Pd6::read(b":BI,+00300,+02000,-00100,+00001,A\r\n").unwrap();
    is_near(told(sensor(Kind::Pd6), &line.write()), [2.0, 0.3, 0.1]);
}

#[test]
fn beam_3_points_where_the_heading_alignment_says_unless_the_installer_says_otherwise() {
    // the maker's example, EA+04500: beam 3 is turned 45 deg clockwise from the bow
    let along = 2.0 * std::f64::consts::FRAC_1_SQRT_2;
    let frame = ensemble(Coordinates::Instrument, 45.0, [along, -along, 0.0, 0.0]);
    is_near(told(sensor(Kind::Pd0), &frame), [2.0, 0.0, 0.0]);
    let axes = [Direction::Starboard, Direction::Forward, Direction::Up];
    let mounting = Mounting { axes, ..Mounting::default() };
    let config = SensorConfig { mounting, ..sensor(Kind::Pd0) };
    is_near(told(config, &frame), [along, -along, 0.0]);
    // the axes of the ship hold the alignment already
    let frame = ensemble(Coordinates::Ship, 45.0, [-0.3, -2.0, 0.1, 0.0]);
    is_near(told(sensor(Kind::Pd0), &frame), [2.0, 0.3, 0.1]);
}

#[test]
fn an_imu_that_does_not_sense_gravity_is_not_valid_and_the_reason_is_counted() {
    let telegram = |counter: u32, accel| {
        let navigation = Navigation {
            raw_rotation: Some([1e-5, 2e-5, 4e-5]),
            raw_acceleration: Some(accel),
            ..Navigation::default()
        };
        let validity = counter * 100;
        Telegram { version: 5, validity, counter, navigation, ..Telegram::default() }.write()
    };
    for (accel, valid) in [([0.02, -0.1, 9.8], true), ([0.0, 0.0, 8.0], false)] {
        let mut ship = Ship::new(sensor(Kind::Stdbin), Link::Stream);
        for sample in 0..2000 {
            ship.hear(f64::from(sample) * 0.01, &telegram(sample, accel));
        }
        assert_eq!(ship.status().valid, Some(valid));
        assert_eq!(ship.refused(Refusal::Gravity) > 1000, !valid);
        let word = |own: &Happening| matches!(own, Happening::SensorValid { valid: false, .. });
        assert_eq!(ship.events.iter().any(word), !valid);
    }
}
