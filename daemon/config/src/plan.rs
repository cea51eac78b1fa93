//! What the rooms of the ship are told: from the file to plain plans.

use insd_base::{Body, Geodetic, LeverArms, PortId, StartCondition};
use insd_drivers::ports::{PortConfig, Transport};
use insd_engine::EngineConfig;
use insd_intake::config::{IntakeConfig, PortSpec, SensorConfig};
use insd_intake::port::Link;
use insd_nav::config::{AntennaModel, Models};
use insd_output::Rate;
use insd_vessel::{OutputPlan, Pipeline, Plan};

use crate::file::Config;
use crate::filters;
use crate::output::OutputSection;
use crate::port::PortSection;
use crate::ship::Start;

/// Bits per second of a CAN bus of which nothing else is known: that of NMEA 2000.
const BITRATE: u32 = 250_000;
/// How often the groups of NMEA 2000 are looked at, Hz: their shortest interval.
const GROUPS_RATE: f64 = 100.0;

impl Config {
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
        Plan {
            intake: self.intake(),
            engine,
            spares,
            outputs: self.output_plan(),
            watched: self.watch_plans(),
        }
    }

    /// What the intake is told.
    #[must_use]
    pub fn intake(&self) -> IntakeConfig {
        let ports = self
            .ports
            .iter()
            .map(|port| PortSpec { name: port.name.clone(), link: link(&port.transport) });
        let (sensors, imu) = (self.sensors.clone(), self.ship.imu.clone());
        let watched = self.watches.iter().map(|own| own.sensor.clone()).collect();
        let rangings = self.ranging_specs();
        IntakeConfig { ports: ports.collect(), sensors, imu, rangings, watched }
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
            models: self.models(),
            alignment: self.alignment.config(),
            stored: None,
            vessel: ship.kind.into(),
            time_std: ship.time_std_s.or_else(|| self.time_std(None)),
            accept_mounting: ship.accept_mounting,
            relay: ship.relay,
            learning: self.learning.enabled,
            learnt: None,
            smoothing: None,
        }
    }

    fn models(&self) -> Models {
        let camera = self.camera.as_ref().and_then(|camera| camera.aid().ok());
        Models { antennas: self.antennas(), camera, ..self.assumed().models() }
    }

    /// How well it is known how antennas sit that are a compass; the worst of them for all.
    fn antennas(&self) -> AntennaModel {
        let own = self.sensors.iter().filter(|sensor| sensor.array);
        let std = own.clone().map(|sensor| sensor.lever_std_m).fold(0.0, f64::max);
        let levers: Vec<_> = own.filter_map(|sensor| Some(sensor.lever()?.0)).collect();
        AntennaModel::of(&levers, std)
    }

    /// The lever arm of the best receiver that has one of its own.
    fn own_lever(&self) -> Option<Body> {
        let own = self.sensors.iter().filter(|sensor| sensor.lever().is_some());
        own.min_by_key(|sensor| sensor.priority).and_then(SensorConfig::lever)
    }

    /// What is said at the ports, and who may command there.
    #[must_use]
    pub fn output_plan(&self) -> OutputPlan {
        let exponent = self.protection.exponent();
        let port = |output: &OutputSection| {
            let mut own = output.port(self.point(output.point.as_deref()));
            own.manner.policy.risk_exponent = exponent;
            own
        };
        let ports = self.outputs.iter().map(port);
        // behind the outputs, in the order of the ports
        let casters = self.ports.iter().filter_map(PortSection::told_position);
        let numbered = self.ports.iter().zip((0..).map(PortId));
        let obeyed = numbered.filter(|(port, _)| port.alerts).map(|(_, number)| number);
        OutputPlan {
            ports: ports.chain(casters).collect(),
            points: self.levers(),
            groups: (!self.nodes.is_empty()).then(|| Rate::from_hertz(GROUPS_RATE)),
            obeyed: obeyed.collect(),
            berths: self.docking(),
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
