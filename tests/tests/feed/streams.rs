//! What the sensors of a ship send in each format is what the intake takes in.

use insd_base::units::{DEG, KNOT, wrap_pi};
use insd_base::{
    Arrival, ExternalReference, GnssFix, ImuSample, Input, LogVelocity, Message, Time, Voyage,
    earth,
};
use insd_intake::Intaken;
use insd_intake::choice::Why;
use insd_intake::clock::{TimeChange, TimeQuality};
use insd_intake::config::IntakeConfig;
use insd_intake::event::Happening;
use insd_intake::port::Link;
use insd_intake::sensor::TimeBase;
use insd_tests::feed::{
    DeviceClock, Encoding, FeedConfig, Reception, SensorFeed, arrivals, feed, noise,
};
use insd_wire::imu::can::Shipped;
use insd_wire::imu::xbus::Precision;
use insd_wire::log::LogFrame;

use super::{moored, taken};

/// Times of validity may be off by this, s.
const TIME: f64 = 2e-4;
/// Usual encodings of IMU, receiver, log and compass.
const USUAL: [Encoding; 4] = [Encoding::Sbg, Encoding::Ubx, Encoding::Vbw, Encoding::Ths];

/// What the intake measured of each kind.
#[derive(Default)]
struct Measured {
    imu: Vec<ImuSample>,
    gnss: Vec<GnssFix>,
    log: Vec<LogVelocity>,
    heading: Vec<ExternalReference>,
}

fn measured(all: &[Intaken]) -> Measured {
    let mut measured = Measured::default();
    for taken in all {
        let Intaken::Measured(received) = taken else { continue };
        match &received.message {
            Message::Imu(sample) => measured.imu.push(*sample),
            Message::Gnss(fix) => measured.gnss.push(*fix),
            Message::Log(log) => measured.log.push(*log),
            Message::Reference(reference) => measured.heading.push(*reference),
            Message::Ranges(_) | Message::Base(_) | Message::Rtk(_) => {}
            Message::Compass(_) | Message::Ranging(_) => {}
            Message::Camera(_) | Message::Odometry(_) => {}
        }
    }
    measured
}

/// The usual ship with one encoding in the place of the usual one of its role.
fn ship_with(voyage: &Voyage, encoding: Encoding) -> FeedConfig {
    let role = encoding.kind().role();
    let same = |own: &Encoding| if own.kind().role() == role { encoding } else { *own };
    let mut config = FeedConfig::new(voyage, &USUAL.each_ref().map(same));
    config.sensors[0].clock = DeviceClock { offset: 4290.0, drift_ppm: 20.0, count: 250 };
    config
}

fn reception(sensor: &SensorFeed) -> Reception {
    Reception::new(sensor.calendar.start, 7)
}

/// Feeds a ship with an encoding; checks the events, and that the intake says the times of the voyage.
fn fed(voyage: &Voyage, encoding: Encoding) -> Measured {
    let config = ship_with(voyage, encoding);
    let reception = reception(&config.sensors[0]);
    let all = taken(&config.intake(voyage), &arrivals(&feed(voyage, &config), &reception));
    only_the_expected_events(&all, config.sensors.len());
    let mut measured = measured(&all);
    let voyage_time = |time: &mut Time| *time = *time - reception.offset;
    measured.imu.iter_mut().for_each(|own| voyage_time(&mut own.time));
    measured.gnss.iter_mut().for_each(|own| voyage_time(&mut own.time));
    measured.log.iter_mut().for_each(|own| voyage_time(&mut own.time));
    measured.heading.iter_mut().for_each(|own| voyage_time(&mut own.time));
    measured
}

fn only_the_expected_events(all: &[Intaken], sensors: usize) {
    let events = all.iter().filter_map(|taken| match taken {
        Intaken::Event(event) => Some(&event.what),
        Intaken::Measured(_) | Intaken::Temperature(..) | Intaken::Watched(_) => None,
    });
    let (mut spoke, mut chosen, mut qualities) = (0, 0, 0);
    for event in events {
        match event {
            Happening::SensorSpeaks { .. } => spoke += 1,
            Happening::Chosen(choice) if choice.why == Why::First => chosen += 1,
            Happening::Device { .. } => {}
            Happening::Time(TimeChange::Quality(TimeQuality::Messages)) => qualities += 1,
            other => assert_eq!(None, Some(other), "not expected"),
        }
    }
    assert_eq!((spoke, chosen, qualities), (sensors, sensors, 1));
}

fn same_times(encoding: Encoding, found: &[Time], sent: &[Time]) {
    assert_eq!(found.len(), sent.len(), "{encoding:?}");
    for (found, sent) in found.iter().zip(sent) {
        let off = (*found - *sent).as_seconds();
        assert!(off.abs() < TIME, "{encoding:?} at {} s: {off:e}", sent.as_seconds());
    }
}

fn near(encoding: Encoding, what: &str, found: f64, sent: f64, tolerance: f64) {
    let off = (found - sent).abs();
    assert!(off <= tolerance, "{encoding:?} {what}: {found:e} for {sent:e}, off by {off:e}");
}

/// Half a step of what an IMU's format tells of an angle, rad, and of a velocity, m/s, over 10 ms.
fn imu_steps(encoding: Encoding) -> (f64, f64) {
    match encoding {
        Encoding::Sbg => (0.005 / 67_108_864.0, 0.005 / 1_048_576.0),
        Encoding::Stim => (DEG / 4_194_304.0, 0.5 / 8.0 / 524_288.0),
        Encoding::Xbus(Precision::Fp1632) => (2.4e-10, 1.2e-10),
        Encoding::Xbus(_) => (1e-15, 1e-15),
        Encoding::CanImu(Some(Shipped::Sbg)) => (0.5e-5, 0.5e-4),
        Encoding::CanImu(Some(Shipped::Xsens)) => (0.005 / 512.0, 0.005 / 256.0),
        // a step of the quaternion's vector part is two of the angle; the velocity is below 0.125 m/s
        Encoding::CanImu(Some(Shipped::XsensIncrements)) => (1.0 / 32_767.0, 0.5 / 262_144.0),
        Encoding::CanImu(None) => (0.5e-9, 0.5e-9),
        // single precision of angles below 0.008 rad, of velocities below 0.13 m/s
        _ => (2.4e-10, 7.5e-9),
    }
}

fn the_imu_comes_through(encoding: Encoding) {
    let voyage = moored();
    let found = fed(&voyage, encoding).imu;
    let sent: Vec<ImuSample> = voyage.imu.iter().map(|own| own.message).collect();
    let times = |samples: &[ImuSample]| samples.iter().map(|own| own.time).collect::<Vec<_>>();
    same_times(encoding, &times(&found), &times(&sent));
    let (theta, velocity) = imu_steps(encoding);
    for (found, sent) in found.iter().zip(&sent) {
        for axis in 0..3 {
            let (own, other) = (found.delta_theta.0[axis], sent.delta_theta.0[axis]);
            near(encoding, "angle", own, other, 1.01 * theta);
            let (own, other) = (found.delta_velocity.0[axis], sent.delta_velocity.0[axis]);
            near(encoding, "velocity", own, other, 1.01 * velocity);
        }
    }
}

/// What a receiver's format leaves of a fix: steps of position, m, of velocity, m/s, and whether the
/// vertical velocity and the sigmas of velocity are told.
fn gnss_steps(encoding: Encoding) -> (f64, f64, bool) {
    match encoding {
        // 1e-7 deg and 1 mm; 1 mm/s
        Encoding::Ubx => (0.0056, 0.5e-3, true),
        Encoding::Sbf => (1e-6, 1e-6, true),
        // 0.01 m/s and 1e-4 rad at less than 2 m/s
        Encoding::N2kGnss => (1e-6, 0.005 + 0.5e-4 * 2.0, false),
        // 1e-5 minutes and 1 cm; 0.01 kn and 0.01 deg at less than 2 m/s
        _ => (0.0094, 0.005 * KNOT + 0.005 * DEG * 2.0, false),
    }
}

fn the_receiver_comes_through(encoding: Encoding) {
    let voyage = moored();
    let found = fed(&voyage, encoding).gnss;
    let sent: Vec<GnssFix> = voyage.gnss.iter().map(|own| own.message).collect();
    let times = |fixes: &[GnssFix]| fixes.iter().map(|own| own.time).collect::<Vec<_>>();
    same_times(encoding, &times(&found), &times(&sent));
    let (place, speed, all) = gnss_steps(encoding);
    for (found, sent) in found.iter().zip(&sent) {
        let position = |fix: &GnssFix| earth::ecef(&fix.position.unwrap()).0;
        let apart = (position(found) - position(sent)).norm();
        near(encoding, "position", apart, 0.0, place * 3_f64.sqrt());
        let (own, other) = (found.velocity.unwrap().0, sent.velocity.unwrap().0);
        let axes = if all { 3 } else { 2 };
        for axis in 0..axes {
            near(encoding, "velocity", own[axis], other[axis], 1.01 * speed);
        }
        sigmas_come_through(encoding, found, sent, all);
        assert_eq!((found.quality, found.satellites), (sent.quality, sent.satellites));
    }
}

fn sigmas_come_through(encoding: Encoding, found: &GnssFix, sent: &GnssFix, all: bool) {
    let (own, other) = (found.position_std.unwrap().0, sent.position_std.unwrap().0);
    for axis in 0..3 {
        let step = if encoding == Encoding::N2kGnss { 5.1e-3 } else { 0.51e-3 };
        near(encoding, "sigma", own[axis], other[axis], step);
    }
    let (own, other) = (found.velocity_std.unwrap().0, sent.velocity_std.unwrap().0);
    if all {
        near(encoding, "sigma of velocity", (own - other).norm(), 0.0, 1e-6);
    } else {
        assert!(own.z.is_infinite() && own.x.is_nan() && own.y.is_nan());
    }
}

fn the_log_comes_through(encoding: Encoding) {
    let voyage = moored();
    let found = fed(&voyage, encoding).log;
    let sent: Vec<LogVelocity> = voyage.log.iter().map(|own| own.message).collect();
    let times = |logs: &[LogVelocity]| logs.iter().map(|own| own.time).collect::<Vec<_>>();
    same_times(encoding, &times(&found), &times(&sent));
    let step = match encoding {
        Encoding::Vbw => 0.5e-3 * KNOT,
        // velocities of four beams to 1 mm/s make those along the axes
        Encoding::Pd0(LogFrame::Beam) => 1e-3,
        // turned to the ship, rounding of all three adds up
        Encoding::Pd0(LogFrame::Earth) => 0.87e-3,
        Encoding::Nortek => 0.5e-5,
        _ => 0.5e-3,
    };
    for (found, sent) in found.iter().zip(&sent) {
        near(encoding, "ahead", found.u.unwrap(), sent.u.unwrap(), 1.01 * step);
        near(encoding, "to starboard", found.v.unwrap(), sent.v.unwrap(), 1.01 * step);
        match found.w {
            Some(w) => near(encoding, "down", w, sent.w.unwrap(), 1.01 * step),
            None => assert!(matches!(encoding, Encoding::Vbw | Encoding::N2kLog)),
        }
        assert_eq!((found.std, found.reference), (sent.std, sent.reference));
    }
}

fn the_compass_comes_through(encoding: Encoding) {
    let voyage = moored();
    let found = fed(&voyage, encoding).heading;
    let sent: Vec<ExternalReference> = voyage.reference.iter().map(|own| own.message).collect();
    let times = |own: &[ExternalReference]| own.iter().map(|own| own.time).collect::<Vec<_>>();
    same_times(encoding, &times(&found), &times(&sent));
    for (found, sent) in found.iter().zip(&sent) {
        let off = wrap_pi(found.heading.unwrap() - sent.heading.unwrap());
        near(encoding, "heading", off, 0.0, 0.0051 * DEG);
        let (own, other) = (found.heading_std.unwrap(), sent.heading_std.unwrap());
        near(encoding, "sigma", own, other, 1e-9);
    }
}

#[test]
fn every_imu_comes_through_within_the_steps_of_its_format() {
    for encoding in [
        Encoding::Sbg,
        Encoding::Stdbin,
        Encoding::Mip,
        Encoding::Xbus(Precision::Float64),
        Encoding::Xbus(Precision::Fp1632),
        Encoding::Kvh { stamped: false },
        Encoding::Kvh { stamped: true },
        Encoding::Stim,
        Encoding::CanImu(Some(Shipped::Sbg)),
        Encoding::CanImu(Some(Shipped::Xsens)),
        Encoding::CanImu(Some(Shipped::XsensIncrements)),
        Encoding::CanImu(None),
    ] {
        the_imu_comes_through(encoding);
    }
}

#[test]
fn every_receiver_comes_through_within_the_steps_of_its_format() {
    for encoding in [Encoding::Ubx, Encoding::Sbf, Encoding::NmeaGnss, Encoding::N2kGnss] {
        the_receiver_comes_through(encoding);
    }
}

#[test]
fn every_log_comes_through_within_the_steps_of_its_format() {
    let frames = [LogFrame::Beam, LogFrame::Instrument, LogFrame::Ship, LogFrame::Earth];
    for frame in frames {
        the_log_comes_through(Encoding::Pd0(frame));
    }
    for encoding in [
        Encoding::Vbw,
        Encoding::Pd6(LogFrame::Instrument),
        Encoding::Pd6(LogFrame::Ship),
        Encoding::Nortek,
        Encoding::N2kLog,
    ] {
        the_log_comes_through(encoding);
    }
}

#[test]
fn every_compass_comes_through_within_the_steps_of_its_format() {
    for encoding in
        [Encoding::Hdt, Encoding::Ths, Encoding::Psxn, Encoding::Pashr, Encoding::N2kHeading]
    {
        the_compass_comes_through(encoding);
    }
}

/// The usual ship, with other formats for the second run, and noise between the messages.
fn with_noise(voyage: &Voyage, encodings: &[Encoding]) -> (IntakeConfig, Vec<Arrival>) {
    let config = FeedConfig::new(voyage, encodings);
    let mut all = arrivals(&feed(voyage, &config), &reception(&config.sensors[0]));
    for (index, arrival) in all.iter_mut().enumerate().filter(|(index, _)| index % 97 == 0) {
        if let Input::Bytes(bytes) = &mut arrival.input {
            bytes.extend(noise(index as u64, 40));
        }
    }
    (config.intake(voyage), all)
}

#[test]
fn the_same_arrivals_give_the_same_bits() {
    let voyage = moored();
    let other = [Encoding::Stim, Encoding::NmeaGnss, Encoding::Nortek, Encoding::Pashr];
    let bus = [
        Encoding::CanImu(Some(Shipped::Xsens)),
        Encoding::N2kGnss,
        Encoding::N2kLog,
        Encoding::N2kHeading,
    ];
    for encodings in [USUAL, other, bus] {
        let (config, arrivals) = with_noise(&voyage, &encodings);
        let bits = |all: &[Intaken]| all.iter().map(|own| format!("{own:?}")).collect::<Vec<_>>();
        assert_eq!(bits(&taken(&config, &arrivals)), bits(&taken(&config, &arrivals)));
    }
}

/// On a serial line the time of a byte follows from the bytes that the same read gave after it, so
/// this holds for streams without a timing of their own.
#[test]
fn other_reads_of_the_same_bytes_under_the_same_stamps_give_the_same_bits() {
    let voyage = moored();
    let other =
        [Encoding::Xbus(Precision::Float64), Encoding::Sbf, Encoding::Nortek, Encoding::Hdt];
    for encodings in [USUAL, other] {
        let (mut config, arrivals) = with_noise(&voyage, &encodings);
        config.ports.iter_mut().for_each(|port| port.link = Link::Stream);
        let whole = taken(&config, &arrivals);
        for size in [1, 13] {
            let parts: Vec<Arrival> = arrivals.iter().flat_map(|own| split(own, size)).collect();
            let split = taken(&config, &parts);
            assert!(whole.iter().map(text).eq(split.iter().map(text)), "{encodings:?} {size}");
        }
    }
}

fn text(own: &Intaken) -> String {
    format!("{own:?}")
}

fn split(arrival: &Arrival, size: usize) -> Vec<Arrival> {
    let Input::Bytes(bytes) = &arrival.input else { return vec![arrival.clone()] };
    let part = |part: &[u8]| Arrival { input: Input::Bytes(part.to_vec()), ..arrival.clone() };
    bytes.chunks(size).map(part).collect()
}

#[test]
fn the_end_of_a_device_clock_is_not_seen_in_the_times() {
    let voyage = moored();
    let run = |offset: f64| {
        let mut config = FeedConfig::new(&voyage, &USUAL);
        config.sensors[0].clock = DeviceClock { offset, drift_ppm: -35.0, count: 3 };
        let reception = reception(&config.sensors[0]);
        measured(&taken(&config.intake(&voyage), &arrivals(&feed(&voyage, &config), &reception)))
    };
    // the second clock goes on over its end after ten seconds
    let (steady, wraps) = (run(10.0), run(4_294.967_296 - 10.0));
    for (a, b) in steady.imu.iter().zip(&wraps.imu) {
        assert!((a.time - b.time).as_seconds().abs() < 2e-6, "{:?} {:?}", a.time, b.time);
    }
}

/// An SBG unit tells UTC once a second, and not before the end of its first; an Exail system always.
#[test]
fn an_imu_that_keeps_utc_may_be_believed_in_that() {
    let voyage = moored();
    for (encoding, untold) in [(Encoding::Sbg, 100), (Encoding::Stdbin, 0)] {
        let config = ship_with(&voyage, encoding);
        let reception = reception(&config.sensors[0]);
        let mut intake = config.intake(&voyage);
        intake.sensors[0].time = TimeBase::Utc;
        let found = measured(&taken(&intake, &arrivals(&feed(&voyage, &config), &reception))).imu;
        let found: Vec<Time> = found.iter().map(|own| own.time - reception.offset).collect();
        let sent: Vec<Time> = voyage.imu[untold..].iter().map(|own| own.message.time).collect();
        same_times(encoding, &found, &sent);
    }
}
