//! What must hold for whatever arrives at a ship's ports. The replay of seeds and the fuzz target share
//! it.
//!
//! The first byte chooses the link and what the devices were told to send. Then come arrivals, each of
//! three bytes and what the third says:
//!
//! ```text
//! 1   modulo 20: 0 to 11 and 17 to 19 contents of a good frame of a protocol, 12 raw bytes, 13 a pulse,
//!     14 the port is lost, 15 the system clock is set, 16 bytes at a port that is not there
//! 2   time since the arrival before: 0 to 63 ms, tens of ms, s, or a power of two of seconds
//! 3   bytes of the contents
//! ```

#![allow(clippy::unwrap_used, clippy::panic, dead_code)] // helpers of tests are not seen as tests

#[path = "../../../wire/tests/checks/good.rs"]
mod good;

use insd_base::{
    Arrival, GnssFix, Input, Message, PortId, PortState, Pulse, Span, Stamp, Time, UtcTime,
};
use insd_intake::config::{
    Dialect, IntakeConfig, Kind, KvhSettings, PortSpec, SensorConfig, StimSettings,
};
use insd_intake::mounting::{Direction, Mounting};
use insd_intake::port::Link;
use insd_intake::sensor::TimeBase;
use insd_intake::{Intake, Intaken};
use insd_wire::stream::Protocol;

/// All kinds of sensors.
const KINDS: [Kind; 40] = [
    Kind::Sbg,
    Kind::Stdbin,
    Kind::Mip,
    Kind::Xbus,
    Kind::Kvh,
    Kind::Stim,
    Kind::NmeaGnss,
    Kind::Ubx,
    Kind::Sbf,
    Kind::NmeaLog,
    Kind::Pd0,
    Kind::Pd6,
    Kind::Nortek,
    Kind::Compass,
    Kind::Psxn,
    Kind::Pashr,
    Kind::NmeaPosition,
    Kind::Rtcm,
    Kind::RtcmBase,
    Kind::Novatel,
    Kind::NovatelImu,
    Kind::NovatelIns,
    Kind::Psat,
    Kind::Ptnl,
    Kind::Pfec,
    Kind::Kmb,
    Kind::Em3000,
    Kind::Tss1,
    Kind::StdbinIns,
    Kind::Gsof,
    Kind::Vectornav,
    Kind::VectornavIns,
    Kind::Ad2cp,
    Kind::N2kGnss,
    Kind::N2kHeading,
    Kind::N2kLog,
    Kind::N2kPosition,
    Kind::SignalkHeading,
    Kind::SignalkLog,
    Kind::SignalkPosition,
];

const DIALECTS: [Dialect; 6] = [
    Dialect::Sbg,
    Dialect::SbgWassp,
    Dialect::Ixblue,
    Dialect::Novatel,
    Dialect::Trimble,
    Dialect::Applanix,
];

/// What an arrival may be.
const KINDS_OF_ARRIVALS: u8 = 22;

/// The ship's time ends here, s: a century is far beyond any voyage.
const END: f64 = 3.2e9;

/// What passed, by the kind of message: IMU, GNSS, log, reference, ranges, bases.
pub(crate) type Passed = [usize; 10];

/// Lets everything arrive that the bytes say, and looks at what is passed on.
pub(crate) fn everything(bytes: &[u8]) -> Passed {
    let Some((choice, mut bytes)) = bytes.split_first() else { return Passed::default() };
    let mut config = IntakeConfig::default();
    let port = "port".to_owned();
    config.ports = vec![PortSpec { name: port.clone(), link: link(*choice) }];
    config.sensors = KINDS.iter().map(|kind| sensor(*kind, &port, *choice)).collect();
    assert_eq!(config.faults(), []);
    let mut intake = Intake::new(&config);
    let mut passed = Passed::default();
    let mut stamp = Stamp { monotonic: Time::START, system: UtcTime::from_nanos(START) };
    while let [what, step, length, rest @ ..] = bytes {
        let (own, rest) = rest.split_at(rest.len().min(usize::from(*length)));
        bytes = rest;
        go_on(&mut stamp, *step);
        arrive(&mut intake, *what, &mut stamp, own);
        while let Some(out) = intake.poll_output() {
            if let Intaken::Measured(received) = out {
                passed[is_sane(&received.message)] += 1;
            }
        }
        drop(intake.status());
    }
    passed
}

/// The system clock at the start: March 2026.
const START: i64 = 1_772_668_800_000_000_000;

fn go_on(stamp: &mut Stamp, step: u8) {
    let count = f64::from(step & 63);
    let seconds = match step >> 6 {
        0 => count * 1e-3,
        1 => count * 1e-2,
        2 => count,
        _ => f64::from(step & 31).exp2(),
    };
    let left = END - stamp.monotonic.as_seconds();
    let span = Span::from_seconds(seconds.min(left));
    stamp.monotonic = stamp.monotonic + span;
    stamp.system = stamp.system.plus(span);
}

fn arrive(intake: &mut Intake, what: u8, stamp: &mut Stamp, own: &[u8]) {
    let mut port = PortId(0);
    let number = own.iter().rev().take(8).fold(0_i64, |sum, byte| sum << 8 | i64::from(*byte));
    let input = match what % KINDS_OF_ARRIVALS {
        12 => Input::Bytes(own.to_vec()),
        13 => {
            // the kernel saw the edge up to a second before it was told
            let late = Span::from_nanos(number.rem_euclid(1_000_000_000));
            Input::Pulse(Pulse { time: stamp.monotonic - late, sequence: 0 })
        }
        14 => Input::State(PortState::Lost { reason: String::new() }),
        15 => {
            // years 1970 to 2106
            let seconds = number.rem_euclid(1 << 32);
            stamp.system = UtcTime::from_nanos(seconds * 1_000_000_000);
            Input::State(PortState::Speaking)
        }
        16 => {
            port = PortId(1);
            Input::Bytes(own.to_vec())
        }
        number => {
            let number = usize::from(number);
            let number = if number < 12 { number } else { number - 5 };
            let protocol = Protocol::ALL.get(number).copied().unwrap_or(Protocol::Em3000);
            Input::Bytes(good::frames(protocol, own).concat())
        }
    };
    intake.handle(&Arrival { stamp: *stamp, port, input });
}

fn link(choice: u8) -> Link {
    match choice % 3 {
        0 => Link::Stream,
        1 => Link::Datagrams,
        _ => Link::Serial { byte_time: 1e-4 },
    }
}

fn sensor(kind: Kind, port: &str, choice: u8) -> SensorConfig {
    let bit = |bit: u8| choice >> bit & 1 == 1;
    let by_utc = bit(2) && matches!(kind, Kind::Sbg | Kind::Mip | Kind::Xbus | Kind::Stdbin);
    SensorConfig {
        // of the sensors of one role the choice makes one the best
        priority: (kind as u8).wrapping_add(choice >> 3) % 5,
        latency_s: 0.01,
        time: if by_utc { TimeBase::Utc } else { TimeBase::Device },
        mounting: Mounting {
            axes: [Direction::Forward, Direction::Port, Direction::Up],
            rotation_deg: [0.5, -0.25, 2.0],
        },
        heading_offset_deg: 90.0,
        heading: true,
        magnetic: bit(3),
        no_checksum: bit(4),
        dialect: Some(DIALECTS[usize::from(choice) % DIALECTS.len()]),
        kvh: KvhSettings {
            rates: bit(3),
            degrees: bit(4),
            delta_velocity: bit(5),
            centidegrees: bit(6),
        },
        stim: StimSettings {
            gyro_increments: bit(3),
            accel_increments: bit(4),
            range_g: [2, 5, 10, 30, 80][usize::from(choice) % 5],
        },
        source: kind.is_signalk().then(|| "n2k.115".to_owned()),
        ..SensorConfig::new(&format!("{kind:?}"), port, kind)
    }
}

/// Whether all that a measurement tells is a number, and its place on Earth. Gives the kind of message.
fn is_sane(message: &Message) -> usize {
    let finite = |numbers: &[Option<f64>]| {
        assert!(numbers.iter().flatten().all(|number| number.is_finite()), "{message:?}");
    };
    match message {
        Message::Imu(sample) => {
            let components = sample.delta_theta.0.iter().chain(sample.delta_velocity.0.iter());
            assert!(components.copied().all(f64::is_finite), "{message:?}");
            0
        }
        Message::Gnss(fix) => {
            is_sane_fix(fix);
            1
        }
        Message::Log(log) => {
            finite(&[log.u, log.v, log.w, log.std]);
            2
        }
        Message::Reference(reference) => {
            let place = reference.position;
            finite(&[place.map(|own| own.latitude), place.map(|own| own.longitude)]);
            finite(&[reference.position_std, reference.heading, reference.heading_std]);
            3
        }
        Message::Base(base) => {
            let codes = base.epoch.signals.iter().map(|signal| signal.code);
            codes.for_each(|code| finite(&[code]));
            5
        }
        Message::Rtk(told) => {
            let place = told.place.map(|place| place.antenna);
            place.iter().for_each(|place| finite(&[Some(place.norm())]));
            6
        }
        Message::Compass(reading) => {
            let told = reading.told.as_ref().ok();
            let heading = told.map(|told| told.attitude.heading);
            finite(&[heading, told.map(|told| told.covariance.norm())]);
            7
        }
        Message::Ranging(reading) => {
            finite(&[Some(reading.distance), Some(reading.std)]);
            8
        }
        Message::Camera(frame) => {
            frame.points.iter().for_each(|point| finite(&[Some(point.at.norm())]));
            9
        }
        Message::Odometry(step) => {
            finite(&[Some(step.translation.norm()), Some(step.rotation.angle())]);
            10
        }
        Message::Ranges(ranges) => {
            let codes = ranges.ranges.iter().filter_map(|range| range.code);
            codes.for_each(|code| finite(&[Some(code.value), Some(code.variance)]));
            4
        }
    }
}

fn is_sane_fix(fix: &GnssFix) {
    let place = fix.position.map(|place| [place.latitude, place.longitude, place.height]);
    assert!(place.iter().flatten().all(|number| number.is_finite()), "{fix:?}");
    let velocity = fix.velocity.map(|velocity| velocity.0);
    assert!(velocity.iter().flatten().all(|number| number.is_finite()), "{fix:?}");
    // a component that the receiver does not tell has no sigma, or an infinite one
    let sigmas = [fix.position_std, fix.velocity_std].map(|std| std.map(|std| std.0));
    let negative = |sigma: &f64| *sigma < 0.0;
    assert!(!sigmas.iter().flatten().flatten().any(negative), "{fix:?}");
}
