//! The configuration file: TOML with environment overrides, typed, checked, all faults at once.
//!
//! The text is held against what it may say ([`check`]) and read twice: first strictly by `toml`, which
//! bends no type into another; then by `config`, which lays `INSD__SECTION__KEY` of the environment over it.

pub mod check;
mod environment;
mod faults;
mod filters;
mod imu;
mod lan;
mod node;
mod output;
mod policy;
pub mod reference;
mod service;
mod spare;
mod succession;

use std::path::{Path, PathBuf};

use anyhow::Context;
use insd_base::{Body, Geodetic, LeverArms, PortId, StartCondition, VesselKind};
use insd_drivers::can::CanFilter;
use insd_drivers::ports::{Hosts, PortConfig, Transport};
use insd_engine::EngineConfig;
use insd_intake::config::{IntakeConfig, PortSpec, Role, SensorConfig};
use insd_intake::port::Link;
use insd_intake::sensor::TimeBase;
use insd_output::Rate;
use insd_vessel::{OutputPlan, Pipeline, Plan};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::cli::BadInput;

pub use check::{Examined, Finding, Place, Severity};
pub use imu::ImuModel;
pub use lan::LanSection;
pub use node::{NodeMemory, NodeSection};
pub use output::{OutputSection, Overfull, PointSection};
pub use policy::PolicySection;
pub use service::{LogSection, StateSection, WebSection};
pub use spare::SpareSection;

/// How well receiver and IMU agree in time where neither a pulse nor the IMU's own UTC ties them, s.
const TIME_STD: f64 = 0.02;
/// Bits per second of a CAN bus of which nothing else is known: that of NMEA 2000.
const BITRATE: u32 = 250_000;
/// How often the groups of NMEA 2000 are looked at, Hz: their shortest interval.
const GROUPS_RATE: f64 = 100.0;

/// Everything that the daemon is told.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// Ship and start.
    pub ship: Ship,
    /// Error model of the IMU.
    pub imu: ImuModel,
    /// Ports that are listened to.
    #[serde(default, rename = "port")]
    pub ports: Vec<PortSection>,
    /// Sensors on them.
    #[serde(default, rename = "sensor")]
    pub sensors: Vec<SensorConfig>,
    /// Engines beside the first.
    #[serde(default, rename = "spare")]
    pub spares: Vec<SpareSection>,
    /// Points of the ship that outputs speak of.
    #[serde(default, rename = "point")]
    pub points: Vec<PointSection>,
    /// Ports that are written to.
    #[serde(default, rename = "output")]
    pub outputs: Vec<OutputSection>,
    /// Nodes of NMEA 2000 on CAN ports.
    #[serde(default, rename = "node")]
    pub nodes: Vec<NodeSection>,
    /// Recording of all that arrives.
    pub recording: Option<Recording>,
    /// Where chronyd listens for time.
    pub chrony: Option<Chrony>,
    /// Where it is kept what the next start goes on from.
    #[serde(default)]
    pub state: StateSection,
    /// The status page.
    #[serde(default)]
    pub web: WebSection,
    /// What is logged.
    #[serde(default)]
    pub log: LogSection,
}

/// Ship and start.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ship {
    /// What is known of her motion at the start: at the berth, or under way.
    #[serde(default)]
    pub start: Start,
    /// Latitude of the berth, or of the start, deg.
    pub lat_deg: Option<f64>,
    /// Longitude, deg.
    pub lon_deg: Option<f64>,
    /// Height of the IMU above the ellipsoid, m.
    #[serde(default)]
    pub height_m: f64,
    /// Antenna from the IMU: forward, starboard, down, m.
    #[serde(default)]
    pub gnss_lever_m: [f64; 3],
    /// Log from the IMU: forward, starboard, down, m.
    #[serde(default)]
    pub log_lever_m: [f64; 3],
    /// Name of the first engine's IMU, where there are several. Left out: the best that is valid.
    pub imu: Option<String>,
    /// Whether the mounting of the IMU is as it should be, whatever gravity and course say: then nothing of
    /// its attitude is taken back. For ships that sail backwards as well as forwards, like double-ended
    /// ferries.
    #[serde(default)]
    pub accept_mounting: bool,
    /// Whether position, course, speed and heading of receivers and compass pass through, marked, while
    /// there are no data of the IMU.
    #[serde(default = "yes")]
    pub relay: bool,
    /// Solutions per second.
    #[serde(default = "ten")]
    pub rate_hz: f64,
    /// What carries the sensors: `ship`, `boat` or `car`.
    #[serde(default)]
    pub kind: Kind,
    /// How well receiver and IMU agree in time, 1-sigma, s. Left out: by what ties them.
    #[serde(alias = "gnss_delay_std_s")]
    #[schemars(extend("x-alias" = "gnss_delay_std_s"))]
    pub time_std_s: Option<f64>,
    /// Real-time priority of the engine's thread, 1 to 99; that of the ports is one less. 0 for none.
    #[serde(default = "twenty")]
    pub priority: Option<u8>,
}

/// What carries the sensors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A displacement ship.
    #[default]
    Ship,
    /// A fast boat that planes.
    Boat,
    /// A car, on trials ashore.
    Car,
}

impl From<Kind> for VesselKind {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Ship => VesselKind::Ship,
            Kind::Boat => VesselKind::Boat,
            Kind::Car => VesselKind::Car,
        }
    }
}

/// What is known of the ship's motion at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// At the berth.
    Moored,
    /// Under way, or unknown.
    #[default]
    Underway,
}

/// One port that is listened to.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PortSection {
    /// Its name.
    pub name: String,
    /// What is opened.
    pub transport: Transport,
    /// Silence after which it is told, s.
    #[serde(default = "three")]
    pub patience_s: f64,
    /// Whether an adapter (slcan) may be told to open its channel: the only thing that is written
    /// without a node.
    #[serde(default)]
    pub write: bool,
    /// Whether commands about our alerts (ACN) are obeyed that come from here: the bridge's alert
    /// management.
    #[serde(default)]
    pub alerts: bool,
    /// Of a network port: the hosts whose commands are obeyed, addresses and networks like `10.0.0.0/24`:
    /// those about our alerts, and of a gateway those to our node. Left out: nobody's. A serial line needs
    /// no list.
    pub commands_from: Option<Hosts>,
    /// Of a CAN port: which frames count. Left out: those that its sensors and its node need, on an
    /// interface of the kernel.
    pub filters: Option<Vec<CanFilter>>,
}

/// Recording of all that arrives.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Recording {
    /// Where the files go.
    pub folder: PathBuf,
    /// Their name.
    #[serde(default = "insd")]
    pub name: String,
    /// A file holds at most so many megabytes.
    #[serde(default = "hundred")]
    pub rotate_mb: u64,
    /// A file holds at most so many seconds.
    #[serde(default = "hour")]
    pub rotate_s: f64,
    /// All files together hold at most so many megabytes.
    pub quota_mb: Option<u64>,
}

/// Where chronyd listens for time.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Chrony {
    /// The socket of its `refclock SOCK`.
    pub socket: PathBuf,
}

fn yes() -> bool {
    true
}
fn ten() -> f64 {
    10.0
}
fn twenty() -> Option<u8> {
    Some(20)
}
fn three() -> f64 {
    3.0
}
fn hundred() -> u64 {
    100
}
fn hour() -> f64 {
    3600.0
}
fn insd() -> String {
    "insd".to_owned()
}

impl PortSection {
    /// The hosts whose commands are obeyed, if it is a network port that is listened to for commands.
    fn commanders(&self) -> Option<Hosts> {
        let is_asked = self.alerts && self.transport.is_network();
        self.commands_from.clone().or(is_asked.then(Hosts::default))
    }

    /// Whether the node on it obeys commands of the bus: over a gateway only if all who can send there are
    /// listed.
    #[must_use]
    pub fn obeys_bus(&self) -> bool {
        let listed = self.commands_from.as_ref();
        match &self.transport {
            Transport::GatewayUdp(gateway) => {
                let from = gateway.from.as_ref();
                listed.zip(from).is_some_and(|(listed, from)| listed.covers(from))
            }
            Transport::GatewayTcp(gateway) => {
                let host = gateway.address.rsplit_once(':').and_then(|(host, _)| {
                    host.trim_start_matches('[').trim_end_matches(']').parse().ok()
                });
                listed.zip(host).is_some_and(|(listed, host)| listed.contains(host))
            }
            _ => true,
        }
    }
}

impl Config {
    /// Reads and checks a file, with the environment's overrides; gives its text, too.
    ///
    /// # Errors
    /// [`BadInput`] with all faults and their places.
    pub fn load(path: &Path) -> anyhow::Result<(Self, String)> {
        let text =
            Self::text_of(path).with_context(|| format!("{}: cannot be read", path.display()))?;
        let config = Self::of_text(&text)
            .map_err(|fault| BadInput(format!("{}: {fault}", path.display())))?;
        Ok((config, text))
    }

    /// The text of a file, with the environment's overrides written below it.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn text_of(path: &Path) -> std::io::Result<String> {
        std::fs::read_to_string(path).map(|text| environment::written_below(&text))
    }

    /// The configuration of a text alone, as [`Config::load`] gives it and a recording holds it: with the
    /// overrides of the environment written below it.
    ///
    /// # Errors
    /// All faults as one text.
    pub fn of_text(text: &str) -> Result<Self, String> {
        let Examined { config, findings } = check::examine(text);
        let refused: Vec<String> =
            findings.iter().filter(|finding| finding.refused).map(ToString::to_string).collect();
        match config {
            Some(config) if refused.is_empty() => Ok(config),
            _ => Err(listed(&refused)),
        }
    }

    /// A pipeline that knows nothing yet.
    #[must_use]
    pub fn pipeline(&self) -> Pipeline<Config> {
        Pipeline::new(self.plan(), self.clone())
    }

    /// What the vessel is told.
    #[must_use]
    pub fn plan(&self) -> Plan {
        self.plan_with(self.engine())
    }

    /// The same, its engines told otherwise than the configuration has it.
    #[must_use]
    pub fn plan_with(&self, engine: EngineConfig) -> Plan {
        let spares = self.spares(&engine);
        Plan { intake: self.intake(), engine, spares, outputs: self.output_plan() }
    }

    /// What the intake is told.
    #[must_use]
    pub fn intake(&self) -> IntakeConfig {
        let ports = self
            .ports
            .iter()
            .map(|port| PortSpec { name: port.name.clone(), link: link(&port.transport) });
        let (sensors, imu) = (self.sensors.clone(), self.ship.imu.clone());
        IntakeConfig { ports: ports.collect(), sensors, imu }
    }

    /// What the engine is told.
    #[must_use]
    pub fn engine(&self) -> EngineConfig {
        let ship = &self.ship;
        let [gnss, log] = [ship.gnss_lever_m, ship.log_lever_m]
            .map(|[forward, starboard, down]| Body::new(forward, starboard, down));
        let gnss = if gnss == Body::default() { self.own_lever().unwrap_or(gnss) } else { gnss };
        let rate = self.imu(None).map_or(100.0, |sensor| sensor.rate_hz);
        let start = match ship.start {
            Start::Moored => StartCondition::Moored,
            Start::Underway => StartCondition::Underway,
        };
        let place = ship.lat_deg.zip(ship.lon_deg);
        EngineConfig {
            imu: self.imu.spec(rate),
            lever_arms: LeverArms { gnss, log },
            points: self.levers(),
            start,
            initial: place.map(|(lat, lon)| Geodetic::from_degrees(lat, lon, ship.height_m)),
            output_rate: ship.rate_hz,
            alignment: insd_alignment::AlignmentConfig::default(),
            stored: None,
            vessel: ship.kind.into(),
            time_std: ship.time_std_s.or_else(|| self.time_std(None)),
            accept_mounting: ship.accept_mounting,
            relay: ship.relay,
        }
    }

    /// The lever arm of the best receiver that has one of its own.
    fn own_lever(&self) -> Option<Body> {
        let own = self.sensors.iter().filter(|sensor| sensor.lever().is_some());
        own.min_by_key(|sensor| sensor.priority).and_then(SensorConfig::lever)
    }

    /// The monitoring points: the IMU, then those that have a name.
    #[must_use]
    pub fn levers(&self) -> Vec<Body> {
        let named = self.points.iter().map(PointSection::lever);
        std::iter::once(Body::default()).chain(named).collect()
    }

    /// Index of a monitoring point; that of the IMU without a name.
    #[must_use]
    pub fn point(&self, name: Option<&str>) -> usize {
        let is_it = |point: &PointSection| Some(point.name.as_str()) == name;
        self.points.iter().position(is_it).map_or(0, |index| index + 1)
    }

    fn has_point(&self, name: &str) -> bool {
        self.points.iter().any(|point| point.name == name)
    }

    /// What is said at the ports, and who may command there.
    #[must_use]
    pub fn output_plan(&self) -> OutputPlan {
        let ports =
            self.outputs.iter().map(|output| output.port(self.point(output.point.as_deref())));
        let numbered = self.ports.iter().zip((0..).map(PortId));
        let obeyed = numbered.filter(|(port, _)| port.alerts).map(|(_, number)| number);
        OutputPlan {
            ports: ports.collect(),
            points: self.levers(),
            groups: (!self.nodes.is_empty()).then(|| Rate::from_hertz(GROUPS_RATE)),
            obeyed: obeyed.collect(),
        }
    }

    /// What each port is opened as.
    #[must_use]
    pub fn port_configs(&self) -> Vec<PortConfig> {
        let config = |port: &PortSection| {
            let opened = PortConfig {
                patience_s: port.patience_s,
                write: port.write,
                commands_from: port.commanders(),
                ..PortConfig::new(port.transport.clone())
            };
            let filters = port.filters.clone();
            let filters = filters.unwrap_or_else(|| filters::of(self, &port.name, &opened));
            PortConfig { filters, ..opened }
        };
        self.ports.iter().map(config).collect()
    }

    /// The IMU of an engine that has one of its own, else that of the first engine.
    fn imu(&self, own: Option<&str>) -> Option<&SensorConfig> {
        let own = own.or(self.ship.imu.as_deref());
        let imus = self.sensors.iter().filter(|sensor| sensor.kind.role() == Role::Imu);
        let used = imus.filter(|sensor| own.is_none_or(|own| sensor.name == own));
        used.min_by_key(|sensor| sensor.priority)
    }

    /// `None` where a pulse or the own UTC of an engine's IMU ties receiver and IMU.
    fn time_std(&self, imu: Option<&str>) -> Option<f64> {
        let imu = imu.or(self.ship.imu.as_deref());
        let is_own = |sensor: &SensorConfig| {
            sensor.kind.role() == Role::Imu && imu.is_none_or(|imu| sensor.name == imu)
        };
        let pulse = self.ports.iter().any(|port| matches!(port.transport, Transport::Pps(_)));
        let synchronised =
            self.sensors.iter().any(|sensor| is_own(sensor) && sensor.time == TimeBase::Utc);
        (!pulse && !synchronised).then_some(TIME_STD)
    }
}

/// Faults below each other, with their number in front.
fn listed(faults: &[String]) -> String {
    let s = if faults.len() == 1 { "" } else { "s" };
    format!("{} fault{s}\n  {}", faults.len(), faults.join("\n  "))
}

fn link(transport: &Transport) -> Link {
    let bus = |bitrate: u32| Link::Can { bit_time: 1.0 / f64::from(bitrate.max(1)) };
    match transport {
        Transport::Serial(serial) => {
            let byte_time = f64::from(serial.symbols()) / f64::from(serial.baud.max(1));
            Link::Serial { byte_time }
        }
        Transport::Udp(_) => Link::Datagrams,
        Transport::File(_) => Link::File,
        Transport::Slcan(adapter) => bus(adapter.bitrate),
        Transport::Socketcan(_)
        | Transport::GatewayTcp(_)
        | Transport::GatewayUdp(_)
        | Transport::Candump(_) => bus(BITRATE),
        _ => Link::Stream,
    }
}

#[cfg(test)]
mod tests;
