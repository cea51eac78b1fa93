//! A bus of devices whose frames an intake takes.

#![allow(dead_code)]

use insd_base::can::{BusEvent, CanFrame};
use insd_base::{
    Arrival, ExternalReference, Geodetic, GnssFix, Input, LogVelocity, Message, PortId, Span,
    Stamp, Time, UtcTime,
};
use insd_intake::config::{IntakeConfig, Kind, PortSpec, SensorConfig};
use insd_intake::event::Happening;
use insd_intake::port::Link;
use insd_intake::{Intake, Intaken};
use insd_n2k::fast_packet::{Sequences, split};
use insd_n2k::pgn::{Dops, FixMethod, GnssPosition, Group, days_and_seconds};
use insd_n2k::{ADDRESS_CLAIM, BROADCAST, N2kId, Name};

/// A bit on the wire, s.
const BIT: f64 = 4e-6;
/// Where the receiver is.
pub(crate) const AT: Geodetic = Geodetic { latitude: 0.62, longitude: 2.44, height: 40.0 };
/// Its first epoch: 2026-03-05T12:00:00Z.
pub(crate) const UTC: UtcTime = UtcTime::from_nanos(1_772_712_000_000_000_000);

/// A sensor on the bus.
pub(crate) fn sensor(kind: Kind) -> SensorConfig {
    SensorConfig::new(&format!("{kind:?}"), "bus", kind)
}

/// A good fix so many seconds after the first.
pub(crate) fn fix(seconds: f64) -> GnssPosition {
    let (date, time) = days_and_seconds(UTC.plus(Span::from_seconds(seconds))).unwrap();
    GnssPosition {
        sid: None,
        date: Some(date),
        time: Some(time),
        latitude: Some(AT.latitude),
        longitude: Some(AT.longitude),
        altitude: Some(AT.height),
        system: None,
        method: Some(FixMethod::Differential),
        integrity: None,
        satellites: Some(11),
        hdop: Some(0.8),
        pdop: None,
        geoid: Some(36.0),
        stations: Vec::new(),
    }
}

/// Devices on a bus, and what an intake made of them.
pub(crate) struct Bus {
    pub(crate) intake: Intake,
    pub(crate) measured: Vec<Message>,
    pub(crate) events: Vec<Happening>,
    time: Time,
    sequences: Sequences,
}

impl Bus {
    /// The description of a bus with these sensors.
    pub(crate) fn config(sensors: Vec<SensorConfig>) -> IntakeConfig {
        let port = PortSpec { name: "bus".to_owned(), link: Link::Can { bit_time: BIT } };
        IntakeConfig { ports: vec![port], sensors, ..IntakeConfig::default() }
    }

    pub(crate) fn new(sensors: Vec<SensorConfig>) -> Self {
        Bus {
            intake: Intake::new(&Bus::config(sensors)),
            measured: Vec::new(),
            events: Vec::new(),
            time: Time::from_seconds(100.0),
            sequences: Sequences::default(),
        }
    }

    pub(crate) fn no_dops() -> Dops {
        Dops { sid: None, desired: None, actual: None, hdop: None, vdop: None, tdop: None }
    }

    pub(crate) fn now(&self) -> Time {
        self.time
    }

    pub(crate) fn wait(&mut self, seconds: f64) {
        self.time = self.time + Span::from_seconds(seconds);
    }

    /// The frames of a message of a device.
    pub(crate) fn frames<G: Group>(&mut self, source: u8, group: &G) -> Vec<CanFrame> {
        let (pgn, priority) = (G::PGN, G::PRIORITY);
        let id = N2kId { priority, pgn, source, destination: BROADCAST };
        split(id, &group.write(), self.sequences.next(pgn)).unwrap()
    }

    /// A device sends a message.
    pub(crate) fn send<G: Group>(&mut self, source: u8, group: &G) {
        for frame in self.frames(source, group) {
            self.give(&frame);
        }
    }

    /// A device claims an address.
    pub(crate) fn claim(&mut self, source: u8, name: u64) {
        let id = N2kId { priority: 6, pgn: ADDRESS_CLAIM, source, destination: BROADCAST };
        self.give(&CanFrame::new(id.compose(), &Name::new(name).bytes()).unwrap());
    }

    pub(crate) fn give(&mut self, frame: &CanFrame) {
        self.arrive(Input::Can(*frame));
    }

    pub(crate) fn event(&mut self, event: BusEvent) {
        self.arrive(Input::Bus(event));
    }

    fn arrive(&mut self, input: Input) {
        let since = self.time - Time::from_seconds(101.0);
        let stamp = Stamp { monotonic: self.time, system: UTC.plus(since) };
        self.intake.handle(&Arrival { stamp, port: PortId(0), input });
        while let Some(taken) = self.intake.poll_output() {
            match taken {
                Intaken::Measured(received) => self.measured.push(received.message),
                Intaken::Event(event) => self.events.push(event.what),
                Intaken::Temperature(..) | Intaken::Watched(_) => {}
            }
        }
    }

    pub(crate) fn gnss(&self) -> Vec<GnssFix> {
        let own = self.measured.iter().filter_map(|message| match message {
            Message::Gnss(fix) => Some(*fix),
            _ => None,
        });
        own.collect()
    }

    pub(crate) fn log(&self) -> Vec<LogVelocity> {
        let own = self.measured.iter().filter_map(|message| match message {
            Message::Log(log) => Some(*log),
            _ => None,
        });
        own.collect()
    }

    pub(crate) fn references(&self) -> Vec<ExternalReference> {
        let own = self.measured.iter().filter_map(|message| match message {
            Message::Reference(own) => Some(*own),
            _ => None,
        });
        own.collect()
    }

    /// Headings, rad.
    pub(crate) fn headings(&self) -> Vec<f64> {
        self.references().iter().filter_map(|own| own.heading).collect()
    }
}
