//! What the receivers of a ship measured of satellites, out of what arrived at their ports.

use std::collections::BTreeMap;

use insd_base::satellites::{BroadcastRecord, Constellation, IonosphereModel};
use insd_base::{Arrival, Body, GpsTime, Input, PortState, SatelliteEpoch, Sent};
use insd_gnss::Ephemerides;
use insd_intake::config::{IntakeConfig, Role};
use insd_intake::port::PortIntake;
use insd_intake::satellites::{EpochOrder, RawReading, RawUse, SatelliteFollower, SatelliteNews};
use insd_rinex::{Equipment, ObservationHeader};
use insd_wire::gnss::navigation::Broadcast;
use insd_wire::stream::Protocol;

/// All receivers of a ship.
pub struct RawReceivers {
    ports: Vec<PortIntake>,
    receivers: Vec<RawReceiver>,
}

/// What one receiver measured, and what the satellites told it.
#[derive(Debug, Default)]
pub struct RawReceiver {
    /// Its name.
    pub name: String,
    /// Which of several is used: lower is better.
    pub priority: u8,
    /// Its antenna from the IMU, forward, starboard, down, m, where it is not the ship's one.
    pub lever: Option<Body>,
    /// Whether the ship makes anything of its raw messages.
    pub is_used: bool,
    /// What it measured, in order.
    pub epochs: Vec<SatelliteEpoch>,
    /// What satellites told of their orbits, in the order in which it came.
    pub records: Vec<BroadcastRecord>,
    /// The newest models of the ionosphere, by who broadcasts them.
    pub ionosphere: BTreeMap<Constellation, IonosphereModel>,
    /// GPS - UTC, s.
    pub leap_seconds: Option<i8>,
    /// Raw messages, epochs and records that are refused.
    pub refused: u64,
    port: usize,
    protocol: Option<Protocol>,
    follower: SatelliteFollower,
    order: EpochOrder,
    known: Ephemerides,
}

impl RawReceivers {
    /// The receivers of a configuration.
    #[must_use]
    pub fn new(config: &IntakeConfig) -> Self {
        let ports = config.ports.iter();
        let ports = ports.map(|port| PortIntake::new(port.link, &config.protocols(&port.name)));
        let receivers = config.sensors.iter().filter(|sensor| sensor.kind.role() == Role::Gnss);
        let receivers = receivers.map(|sensor| RawReceiver {
            name: sensor.name.clone(),
            priority: sensor.priority,
            lever: sensor.lever(),
            is_used: sensor.raw != RawUse::Off,
            port: config
                .ports
                .iter()
                .position(|port| port.name == sensor.port)
                .unwrap_or(usize::MAX),
            protocol: sensor.kind.protocol(),
            ..RawReceiver::default()
        });
        RawReceivers { ports: ports.collect(), receivers: receivers.collect() }
    }

    /// Takes what arrived. `now`: GPS time, right to some hours, where it is known.
    pub fn take(&mut self, arrival: &Arrival, now: Option<GpsTime>) {
        let index = usize::from(arrival.port.0);
        let Some(port) = self.ports.get_mut(index) else { return };
        let receivers = &mut self.receivers;
        let mut hear = |protocol: Protocol, frame: &[u8]| {
            let own = receivers.iter_mut();
            own.filter(|own| own.port == index && own.protocol == Some(protocol))
                .for_each(|own| own.hear(protocol, frame, now));
        };
        match &arrival.input {
            Input::Bytes(bytes) | Input::Sent(Sent { bytes, .. }) => {
                port.take(&arrival.stamp, bytes, |frame| hear(frame.protocol, frame.bytes));
            }
            Input::State(PortState::Lost { .. } | PortState::Ended) => {
                port.interrupt(&arrival.stamp, |frame| hear(frame.protocol, frame.bytes));
            }
            _ => {}
        }
    }

    /// Those that sent raw messages.
    pub fn told(&self) -> impl Iterator<Item = &RawReceiver> {
        self.receivers.iter().filter(|own| !own.epochs.is_empty() || !own.records.is_empty())
    }
}

impl RawReceiver {
    /// The header of a RINEX file of what it measured.
    #[must_use]
    pub fn header(&self) -> ObservationHeader {
        let unknown = || Equipment { kind: "UNKNOWN".to_owned(), ..Equipment::default() };
        ObservationHeader {
            receiver: unknown(),
            antenna: unknown(),
            interval: self.interval(),
            leap_seconds: self.leap_seconds,
            ..ObservationHeader::of_marker(&self.name)
        }
    }

    fn hear(&mut self, protocol: Protocol, frame: &[u8], now: Option<GpsTime>) {
        let Some(mut reading) = RawReading::of_frame(protocol, frame) else { return };
        if let (RawReading::Measured { epoch, .. }, Some(now)) = (&mut reading, now) {
            epoch.tag = epoch.tag.nearest_rollover(now);
        }
        for told in self.follower.take(&reading, now) {
            match told {
                Ok(SatelliteNews::Epoch { epoch, .. }) if self.order.admit(epoch.tag) => {
                    self.leap_seconds = epoch.leap_seconds.or(self.leap_seconds);
                    self.epochs.push(epoch);
                }
                Ok(SatelliteNews::Broadcast(told)) => self.broadcast(told),
                Ok(SatelliteNews::Epoch { .. }) | Err(_) => self.refused += 1,
            }
        }
    }

    fn broadcast(&mut self, told: Broadcast) {
        match told {
            Broadcast::Record(record) => match self.known.insert(record) {
                Ok(true) => self.records.push(record),
                Ok(false) => {}
                Err(_) => self.refused += 1,
            },
            Broadcast::Ionosphere(model) => {
                let whose = match model {
                    IonosphereModel::Klobuchar { .. } => Constellation::Gps,
                    IonosphereModel::NeQuickG { .. } => Constellation::Galileo,
                };
                self.ionosphere.insert(whose, model);
            }
            Broadcast::LeapSeconds(leap_seconds) => self.leap_seconds = Some(leap_seconds),
        }
    }

    /// The usual interval of its epochs, s.
    #[must_use]
    pub fn interval(&self) -> Option<f64> {
        let between = self.epochs.windows(2).map(|pair| pair[1].tag.since(pair[0].tag));
        let mut nanos: Vec<i64> = between.map(insd_base::Span::as_nanos).collect();
        nanos.sort_unstable();
        // receivers hold their epochs to a millisecond of a whole fraction
        let middle = nanos.get(nanos.len() / 2)?;
        Some((*middle as f64 * 1e-6).round() * 1e-3)
    }
}
