//! The file as types: every section, and what is looked up across them.

use insd_base::Body;
use insd_drivers::ports::Transport;
use insd_intake::config::{Role, SensorConfig};
use insd_intake::sensor::TimeBase;
use insd_languages::Language;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::berth::{BerthSection, DockingSection};
use crate::camera::CameraSection;
use crate::fleet::FleetSection;
use crate::imu::ImuModel;
use crate::learning::LearningSection;
use crate::models::{
    AlignmentSection, FloorSection, GateSection, ModelSection, ProtectionSection, Sections,
};
use crate::node::NodeSection;
use crate::output::{OutputSection, PointSection};
use crate::port::PortSection;
use crate::ranging::RangingSection;
use crate::service::{ChronySection, LogSection, RecordingSection, StateSection, WebSection};
use crate::ship::ShipSection;
use crate::spare::SpareSection;
use crate::watch::WatchSection;

/// How well receiver and IMU agree in time where neither a pulse nor the IMU's own UTC ties them, s.
pub(crate) const TIME_STD: f64 = 0.02;

/// Everything that the daemon is told.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// Ship and start.
    pub ship: ShipSection,
    /// Error model of the IMU.
    pub imu: ImuModel,
    /// How she finds her attitude and heading.
    #[serde(default)]
    pub alignment: AlignmentSection,
    /// Error models of what is measured, and of the sea.
    #[serde(default)]
    pub model: ModelSection,
    /// What is refused.
    #[serde(default)]
    pub gate: GateSection,
    /// The least sigmas that are believed.
    #[serde(default)]
    pub floor: FloorSection,
    /// The risk of protection levels, and how often faults begin.
    #[serde(default)]
    pub protection: ProtectionSection,
    /// Ports that are listened to.
    #[serde(default, rename = "port")]
    pub ports: Vec<PortSection>,
    /// Sensors on them.
    #[serde(default, rename = "sensor")]
    pub sensors: Vec<SensorConfig>,
    /// Sensors that are watched and not used.
    #[serde(default, rename = "watch")]
    pub watches: Vec<WatchSection>,
    /// Engines beside the first.
    #[serde(default, rename = "spare")]
    pub spares: Vec<SpareSection>,
    /// Points of the ship that outputs speak of.
    #[serde(default, rename = "point")]
    pub points: Vec<PointSection>,
    /// Berths to go alongside.
    #[serde(default, rename = "berth")]
    pub berths: Vec<BerthSection>,
    /// The ship that goes alongside, and when to be warned.
    #[serde(default)]
    pub docking: DockingSection,
    /// Docking aids.
    #[serde(default, rename = "ranging")]
    pub rangings: Vec<RangingSection>,
    /// A camera.
    pub camera: Option<CameraSection>,
    /// Ports that are written to.
    #[serde(default, rename = "output")]
    pub outputs: Vec<OutputSection>,
    /// Nodes of NMEA 2000 on CAN ports.
    #[serde(default, rename = "node")]
    pub nodes: Vec<NodeSection>,
    /// Fleets that are told.
    #[serde(default, rename = "fleet")]
    pub fleets: Vec<FleetSection>,
    /// Recording of all that arrives.
    pub recording: Option<RecordingSection>,
    /// Where chronyd listens for time.
    pub chrony: Option<ChronySection>,
    /// Where it is kept what the next start goes on from.
    #[serde(default)]
    pub state: StateSection,
    /// Learning the sensors.
    #[serde(default)]
    pub learning: LearningSection,
    /// The status page.
    #[serde(default)]
    pub web: WebSection,
    /// What is logged.
    #[serde(default)]
    pub log: LogSection,
}

impl Config {
    /// The language that a text of a configuration tells, sound or not; English where it tells none.
    #[must_use]
    pub fn language_of(text: &str) -> Language {
        let table = toml::from_str::<toml::Table>(text).unwrap_or_default();
        let told = table.get("ship").and_then(|ship| ship.get("language")?.as_str());
        told.and_then(|code| code.parse().ok()).unwrap_or_default()
    }

    /// What the navigator is to assume.
    pub(crate) fn assumed(&self) -> Sections<'_> {
        let Config { alignment, model, gate, floor, protection, .. } = self;
        Sections { alignment, model, gate, floor, protection }
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

    pub(crate) fn has_point(&self, name: &str) -> bool {
        self.points.iter().any(|point| point.name == name)
    }

    /// The IMU of an engine that has one of its own, else that of the first engine.
    pub(crate) fn imu(&self, own: Option<&str>) -> Option<&SensorConfig> {
        let own = own.or(self.ship.imu.as_deref());
        let imus = self.sensors.iter().filter(|sensor| sensor.kind.role() == Role::Imu);
        let used = imus.filter(|sensor| own.is_none_or(|own| sensor.name == own));
        used.min_by_key(|sensor| sensor.priority)
    }

    /// `None` where a pulse or the own UTC of an engine's IMU ties receiver and IMU.
    pub(crate) fn time_std(&self, imu: Option<&str>) -> Option<f64> {
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
