//! What owners have: receivers by GSOF, VectorNav devices and Signature instruments, from bytes to measurements.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::units::DEG;
use insd_base::{Arrival, FixQuality, Input, Message, PortId, Stamp, Time, UtcTime};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::Refusal;
use insd_intake::mounting::{Direction, Mounting};
use insd_intake::port::Link;
use insd_intake::{Intake, Intaken};
use insd_wire::gnss::gsof::{
    AntennaLine, GsofRecord, GsofReport, Movement, Page, Place, PositionSigma, PositionTime,
};
use insd_wire::imu::vectornav::VnMessage;
use insd_wire::log::ad2cp::{Ad2cpBottomTrack, Ad2cpHead};

/// Noon of the first of June 2026, a Monday, ns since 1970, and ms of the GPS week.
const NOON: i64 = 1_780_315_200_000_000_000;
const NOON_OF_WEEK: u32 = 129_618_000;

/// What comes of a sensor that sends frames twenty times a second for so many seconds, and its intake.
fn told(
    sensor: SensorConfig,
    seconds: u32,
    frames: impl Fn(u32) -> Vec<u8>,
) -> (Vec<Message>, Intake) {
    let link = Link::Serial { byte_time: 10.0 / 115_200.0 };
    let ports = vec![PortSpec { name: "p".to_owned(), link }];
    let sensors = vec![sensor];
    let mut intake = Intake::new(&IntakeConfig { ports, sensors, ..IntakeConfig::default() });
    let mut passed = Vec::new();
    for tick in 0..seconds * 20 {
        let late = i64::from(tick) * 50_000_000 + 30_000_000;
        let stamp = Stamp {
            monotonic: Time::from_nanos(late + 5_000_000_000),
            system: UtcTime::from_nanos(NOON + late),
        };
        intake.handle(&Arrival { port: PortId(0), stamp, input: Input::Bytes(frames(tick)) });
        while let Some(output) = intake.poll_output() {
            if let Intaken::Measured(received) = output {
                passed.push(received.message);
            }
        }
    }
    (passed, intake)
}

fn refused(intake: &Intake, reason: Refusal) -> u64 {
    intake.status().sensors[0].refused.get(&reason).copied().unwrap_or(0)
}

/// A report of a receiver once a second, its records on pages of 255 bytes.
fn report(tick: u32, calculated: u8, padding: usize) -> Vec<u8> {
    if !tick.is_multiple_of(20) {
        return Vec::new();
    }
    let milliseconds = NOON_OF_WEEK + tick * 50;
    let time = PositionTime {
        milliseconds,
        week: 2421,
        satellites: 11,
        calculated,
        corrected: 0b111,
        initialisation: 1,
    };
    let some = |value| Some(value);
    let sigma = PositionSigma {
        rms: None,
        east: some(0.02),
        north: some(0.01),
        covariance: None,
        up: some(0.03),
        ellipse: [None; 3],
        unit_variance: None,
        epochs: 1,
    };
    let line = AntennaLine {
        milliseconds,
        flags: 0b1111,
        satellites: 11,
        mode: 3,
        angles: [Some(0.0), Some(0.5), Some(0.0)],
        length: some(2.0),
        dilution: 12,
    };
    let records = vec![
        GsofRecord::Time(time),
        GsofRecord::Place(Place { latitude: 0.6, longitude: 2.4, height: some(40.0) }),
        GsofRecord::Other(70, vec![0; padding]),
        GsofRecord::Movement(Movement {
            flags: 1,
            speed: some(2.0),
            course: some(0.0),
            climb: some(0.5),
        }),
        GsofRecord::Sigma(sigma),
        GsofRecord::Line(line, None),
    ];
    let pages = Page::pages((tick / 20) as u8, &GsofReport { records }.write());
    pages.iter().flat_map(Page::write).collect()
}

#[test]
fn a_receiver_by_gsof_gives_fixes_and_a_heading_on_one_page_and_on_two() {
    for padding in [0, 200] {
        let sensor = SensorConfig { heading: true, ..SensorConfig::new("bow", "p", Kind::Gsof) };
        let (passed, _) = told(sensor, 10, |tick| report(tick, 0xAF, padding));
        let (mut fixes, mut headings) = (0, 0);
        for message in passed {
            match message {
                Message::Gnss(fix) => {
                    assert_eq!(fix.velocity.unwrap().0.as_slice(), [2.0, 0.0, -0.5]);
                    let std = fix.position_std.unwrap().0;
                    assert!((std.x - 0.01).abs() < 1e-8 && (std.y - 0.02).abs() < 1e-8);
                    assert!((fix.position.unwrap().height - 40.0).abs() < 1e-9);
                    assert_eq!(fix.quality, FixQuality::RtkFixed);
                    fixes += 1;
                }
                Message::Reference(told) => {
                    assert!((told.heading.unwrap() - 0.5).abs() < 1e-9);
                    headings += 1;
                }
                other => panic!("{other:?}"),
            }
        }
        assert!(fixes >= 8 && headings >= 8, "{fixes} {headings}");
    }
}

#[test]
fn a_receiver_by_gsof_that_has_no_fix_gives_none() {
    let sensor = SensorConfig::new("bow", "p", Kind::Gsof);
    let (passed, intake) = told(sensor, 10, |tick| report(tick, 0x82, 0));
    assert_eq!(passed, []);
    assert!(refused(&intake, Refusal::Invalid) >= 8);
}

fn vectornav(tick: u32) -> VnMessage {
    VnMessage {
        startup_nanos: Some(u64::from(tick) * 50_000_000),
        attitude: Some([90.0 * DEG, 0.0, 0.0]),
        plain_rate: Some([0.0, 0.0, 0.01]),
        plain_force: Some([0.0, 0.0, -9.8]),
        ins_status: Some(2),
        ..VnMessage::default()
    }
}

#[test]
fn a_vectornav_device_is_an_imu_and_with_satellites_a_compass() {
    let imu = SensorConfig { rate_hz: 20.0, ..SensorConfig::new("imu", "p", Kind::Vectornav) };
    let (passed, intake) = told(imu, 10, |tick| vectornav(tick).write());
    assert!(passed.len() > 150 && passed.iter().all(|own| matches!(own, Message::Imu(_))));
    assert_eq!(intake.status().sensors[0].valid, Some(true));
    let compass = SensorConfig::new("ins", "p", Kind::VectornavIns);
    let (passed, _) = told(compass.clone(), 2, |tick| vectornav(tick).write());
    assert_eq!(passed.len(), 40);
    for message in passed {
        let Message::Reference(told) = message else { panic!("{message:?}") };
        assert!((told.heading.unwrap() - 90.0 * DEG).abs() < 1e-7);
    }
    let lost = |tick| VnMessage { ins_status: Some(1), ..vectornav(tick) }.write();
    assert_eq!(told(compass.clone(), 2, lost).0, []);
    let magnetic = |tick| VnMessage { ins_status: None, ..vectornav(tick) }.write();
    let (passed, intake) = told(compass, 2, magnetic);
    assert_eq!((passed, refused(&intake, Refusal::Magnetic)), (Vec::new(), 40));
}

/// A record of bottom track in some axes.
fn track(beams: u16) -> Vec<u8> {
    let head = Ad2cpHead {
        version: 1,
        offset: 78,
        config: 0x32F,
        serial: 1,
        clock: [126, 5, 1, 12, 0, 0],
        fraction: 0.0,
        sound_speed: 1500.0,
        temperature: 15.0,
        pressure: 2.0,
        heading: 0.0,
        tilt: [0.0; 2],
        beams,
        battery: 24.0,
        exponent: -5,
        error: 0,
        status: 0,
        ensemble: 1,
    };
    let velocity = [3.0, 0.25, 0.125, 0.125].map(Some);
    let (distance, merit) = ([Some(20.0); 4], [Some(5); 4]);
    Ad2cpBottomTrack { head, velocity, distance, merit }.write()
}

#[test]
fn a_signature_in_its_own_axes_is_a_log_as_it_is_mounted_and_in_other_axes_none() {
    let axes = [Direction::Forward, Direction::Starboard, Direction::Down];
    let mounting = Mounting { axes, rotation_deg: [0.0, 0.0, 90.0] };
    let log = SensorConfig { mounting, ..SensorConfig::new("log", "p", Kind::Ad2cp) };
    let (passed, _) = told(log.clone(), 2, |_| track(0x4400));
    assert_eq!(passed.len(), 40);
    for message in passed {
        let Message::Log(log) = message else { panic!("{message:?}") };
        let [ahead, starboard] = [log.u.unwrap(), log.v.unwrap()];
        assert!((ahead + 0.25).abs() < 1e-4 && (starboard - 3.0).abs() < 1e-4, "{log:?}");
    }
    for axes in [0x4000, 0x4800] {
        assert_eq!(told(log.clone(), 2, |_| track(axes)).0, []);
    }
}
