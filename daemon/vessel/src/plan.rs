//! What a vessel is told before she sails, and what of it may change while she does.

use insd_base::{Body, PortId};
use insd_engine::EngineConfig;
use insd_engine::vote::Voice;
use insd_intake::config::IntakeConfig;
use insd_output::docking::DockingConfig;
use insd_output::{OutputPortConfig, Rate};

use crate::watch::WatchPlan;

/// What a pipeline is made of.
#[derive(Clone, Debug)]
pub struct Plan {
    /// What is plugged in.
    pub intake: IntakeConfig,
    /// What the first engine is told.
    pub engine: EngineConfig,
    /// Further engines.
    pub spares: Vec<Spare>,
    /// What is said, and who may command.
    pub outputs: OutputPlan,
    /// What is watched and not used.
    pub watched: Vec<WatchPlan>,
}

/// A further engine.
#[derive(Clone, Debug, PartialEq)]
pub struct Spare {
    /// Its name.
    pub name: String,
    /// What is plugged in, with its own IMU.
    pub intake: IntakeConfig,
    /// Its engine. The first of its monitoring points is its own IMU, the second the first engine's IMU, and
    /// then come those of the ship; all from its own IMU.
    pub engine: EngineConfig,
    /// Where its IMU sits from the first engine's, body axes, m.
    pub offset: Body,
    /// Which IMU it has; the first engine's is number 0.
    pub voice: Voice,
}

/// What is said, and who may command.
#[derive(Clone, Debug, Default)]
pub struct OutputPlan {
    /// Ports that are written to.
    pub ports: Vec<OutputPortConfig>,
    /// Monitoring points as levers from the IMU, body axes, m; the first is the IMU itself.
    pub points: Vec<Body>,
    /// How often the groups of NMEA 2000 are looked at, where there is a node.
    pub groups: Option<Rate>,
    /// Ports on which the alert management of the bridge is obeyed.
    pub obeyed: Vec<PortId>,
    /// Berths to go alongside.
    pub berths: DockingConfig,
}

/// What is different after a configuration was read again.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Change {
    /// Ports that are listened to, or sensors on them.
    pub inputs: bool,
    /// Ports that are written to, what they say, or the points they speak of.
    pub outputs: bool,
    /// Sections whose changes wait for the next start, because navigation would have to begin anew, or
    /// because what they describe is made once.
    pub waiting: Vec<&'static str>,
}

impl Change {
    /// Whether nothing is different.
    #[must_use]
    pub fn is_nothing(&self) -> bool {
        *self == Change::default()
    }
}
