//! Devices of NMEA 2000: each claims an address and sends what it measures.

use insd_base::can::CanFrame;
use insd_base::units::wrap_two_pi;
use insd_base::{FixQuality, GnssFix, LogReference, LogVelocity, Time, Voyage};
use insd_intake::device::DeviceFilter;
use insd_n2k::fast_packet::{Sequences, split};
use insd_n2k::pgn::{
    CourseSpeed, FixMethod, GnssPosition, Group, Heading, North, PseudorangeNoise, SpeedComponents,
    days_and_seconds,
};
use insd_n2k::{ADDRESS_CLAIM, BROADCAST, N2kId, Name, NameParts};

use super::heading;
use super::line::Line;
use super::sensor::{Encoding, SensorFeed};

/// Height of the geoid above the ellipsoid, m.
const GEOID: f64 = 36.0;
/// Address of the first sensor, if it is a device.
const FIRST_ADDRESS: u8 = 0x20;

/// The NAME of a sensor's device.
#[must_use]
pub fn name(sensor: usize) -> Name {
    let parts = NameParts {
        unique_number: 4711 + sensor as u32,
        manufacturer: 2046,
        instance_lower: 0,
        instance_upper: 0,
        function: 145,
        class: 60,
        system_instance: 0,
        industry: 4,
        arbitrary_address: true,
    };
    parts.name().unwrap_or(Name::new(0))
}

/// The address that a sensor's device claims.
#[must_use]
pub fn address(sensor: usize) -> u8 {
    FIRST_ADDRESS + sensor as u8
}

/// The claim of an address by a sensor's device; always one, as a NAME fills a frame.
#[must_use]
pub fn claim(sensor: usize, address: u8) -> Option<CanFrame> {
    let id = N2kId { priority: 6, pgn: ADDRESS_CLAIM, source: address, destination: BROADCAST };
    CanFrame::new(id.compose(), &name(sensor).bytes())
}

/// What tells a sensor's device from others.
pub(super) fn filter(sensor: usize) -> DeviceFilter {
    DeviceFilter { name: Some(name(sensor)), ..DeviceFilter::default() }
}

/// A device at work.
struct Device<'a> {
    line: &'a mut Line,
    source: u8,
    sequences: Sequences,
    sid: u8,
}

impl Device<'_> {
    fn send<G: Group>(&mut self, measured: Time, group: &G) {
        let (pgn, priority, source) = (G::PGN, G::PRIORITY, self.source);
        let id = N2kId { priority, pgn, source, destination: BROADCAST };
        for frame in split(id, &group.write(), self.sequences.next(pgn)).into_iter().flatten() {
            self.line.send_frame(measured, &frame);
        }
    }

    /// The SID of the next epoch.
    fn sid(&mut self) -> Option<u8> {
        self.sid = (self.sid + 1) % 253;
        Some(self.sid)
    }
}

pub(super) fn encode(voyage: &Voyage, sensor: &SensorFeed, index: usize, line: &mut Line) {
    let source = address(index);
    // before it measures anything
    if let Some(claim) = claim(index, source) {
        line.send_frame(Time::START - line.latency, &claim);
    }
    let mut device = Device { line, source, sequences: Sequences::default(), sid: 0 };
    match sensor.encoding {
        Encoding::N2kGnss => {
            for stamped in &voyage.gnss {
                fix(&stamped.message, sensor, &mut device);
            }
        }
        Encoding::N2kLog => {
            for stamped in &voyage.log {
                let log = &stamped.message;
                device.send(log.time, &components(log));
            }
        }
        _ => {
            for told in heading::headings(voyage) {
                let heading = Heading {
                    sid: device.sid(),
                    heading: Some(wrap_two_pi(told.heading)),
                    deviation: None,
                    variation: None,
                    reference: Some(North::True),
                };
                device.send(told.time, &heading);
            }
        }
    }
}

fn fix(fix: &GnssFix, sensor: &SensorFeed, device: &mut Device<'_>) {
    let sid = device.sid();
    let utc = sensor.calendar.told_gps(fix.time).to_utc(None);
    let told = days_and_seconds(utc);
    let position = GnssPosition {
        sid,
        date: told.map(|(date, _)| date),
        time: told.map(|(_, time)| time),
        latitude: fix.position.map(|at| at.latitude),
        longitude: fix.position.map(|at| at.longitude),
        altitude: fix.position.map(|at| at.height),
        system: None,
        method: Some(method(fix.quality)),
        integrity: None,
        satellites: fix.satellites.and_then(|count| u8::try_from(count).ok()),
        hdop: fix.hdop,
        pdop: None,
        geoid: Some(GEOID),
        stations: Vec::new(),
    };
    let velocity = fix.velocity.map(|velocity| velocity.0);
    let course = CourseSpeed {
        sid,
        reference: Some(North::True),
        course: velocity.map(|own| wrap_two_pi(own.y.atan2(own.x))),
        speed: velocity.map(|own| own.xy().norm()),
    };
    let std = fix.position_std.map(|std| std.0);
    let noise = PseudorangeNoise {
        sid,
        range_rms: None,
        major: None,
        minor: None,
        orientation: None,
        latitude_std: std.map(|std| std.x),
        longitude_std: std.map(|std| std.y),
        altitude_std: std.map(|std| std.z),
    };
    device.send(fix.time, &position);
    device.send(fix.time, &course);
    device.send(fix.time, &noise);
}

fn method(quality: FixQuality) -> FixMethod {
    match quality {
        FixQuality::Invalid => FixMethod::NoFix,
        FixQuality::Autonomous => FixMethod::Gnss,
        FixQuality::Differential => FixMethod::Differential,
        FixQuality::Precise => FixMethod::Precise,
        FixQuality::RtkFixed => FixMethod::RtkFixed,
        FixQuality::RtkFloat => FixMethod::RtkFloat,
        FixQuality::Estimated => FixMethod::DeadReckoning,
        FixQuality::Manual => FixMethod::Manual,
        FixQuality::Simulated => FixMethod::Simulated,
    }
}

fn components(log: &LogVelocity) -> SpeedComponents {
    match log.reference {
        LogReference::Bottom => SpeedComponents {
            forward_ground: log.u,
            starboard_ground: log.v,
            ..SpeedComponents::default()
        },
        LogReference::Water => SpeedComponents {
            forward_water: log.u,
            starboard_water: log.v,
            ..SpeedComponents::default()
        },
    }
}
