//! The one data model of the page, the interface and the monitor: everything that the daemon tells of
//! itself at an instant, as JSON.
//!
//! It stands on the far side of the border: angles in degrees, speeds in knots where mariners use them,
//! and each unit is the end of the field's name (`_deg`, `_m`, `_mps`, `_kn`, `_hz`, `_s`, `_utc`).
//! Unknown is `None` and becomes `null`; it is never zero. A number that is not finite becomes `null`,
//! too. UTC is text as of RFC 3339 with milliseconds (`2026-11-21T12:00:00.000Z`). `_at_s` is an instant of
//! the ship's own time line: seconds since the program started, which never step.
//!
//! Everything that is told has an age, and what is too old is not told: [`Snapshot::after`].
//!
//! Within [`VERSION`] fields and words are only ever added; readers ignore what they do not know.

mod age;
mod aids;
mod alerts;
mod alignment;
mod docking;
mod fleets;
mod freshness;
mod learning;
mod ports;
mod program;
mod sensors;
mod ship;
mod sky;
mod watched;

pub use aids::{Cause, Rejected, Samples, ShownAid};
pub use alerts::{Alert, ShownAlertState, ShownEvent, ShownPriority, ShownSeverity};
pub use alignment::{DisturbanceAxis, ShownAlignment, ShownDisturbance, ShownFit};
pub use docking::{ShownContact, ShownDocking, ShownDockingPoint, ShownQuay};
pub use fleets::ShownFleet;
pub use freshness::{Freshness, GONE, OLD};
pub use learning::ShownLearning;
pub use ports::{
    Age, Bus, BusNode, BusState, OutputMessage, Schedule, ShownInput, ShownOutput, ShownPortState,
};
pub use program::{
    Log, Program, RecordingState, Saving, ShownEngine, ShownMode, ShownRecording, ShownTransition,
    TimeInfo,
};
pub use sensors::{Sensor, SensorState, ShownBase, ShownChoice};
pub use ship::{
    Found, ShownEstimate, ShownEstimates, ShownHeave, ShownMotion, ShownSource, ShownStands,
};
pub use sky::{SatelliteFate, ShownSatellite, ShownSignal, ShownSky, SkyState};
pub use watched::ShownWatch;

use serde::{Deserialize, Serialize};

/// Version of the model. It changes only when a field goes away or changes its meaning.
pub const VERSION: u32 = 1;

/// Most transitions of the mode that are told.
pub const MAX_MODES: usize = 50;
/// Most refused measurements that are told one by one.
pub const MAX_REJECTIONS: usize = 50;
/// Most lines of the journal that are told.
pub const MAX_EVENTS: usize = 100;

/// Everything that is told of an instant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Snapshot {
    /// [`VERSION`].
    pub version: u32,
    /// Which program this is, and since when it runs.
    pub program: Program,
    /// What time it is, and how well that is known.
    pub time: TimeInfo,
    /// What the system is doing.
    pub mode: ShownMode,
    /// The last changes of the mode, oldest first, at most [`MAX_MODES`].
    pub modes: Vec<ShownTransition>,
    /// Where the ship is, how she moves and lies; `None` while nothing is known that could be shown.
    pub motion: Option<ShownMotion>,
    /// How she stands to the berth that is chosen or near; `None` where there is none.
    pub docking: Option<ShownDocking>,
    /// Names of the berths that can be chosen.
    pub berths: Vec<String>,
    /// What the alignment knows of itself; `None` before its first word.
    pub alignment: Option<ShownAlignment>,
    /// The instances of the navigator, if there are several.
    pub engines: Vec<ShownEngine>,
    /// What the filter has found out about the sensors; `None` while there is no filter.
    pub estimates: Option<ShownEstimates>,
    /// Whom the navigator believes; before it navigates, and at the berth, those alone who are left out or on trial.
    pub standings: Vec<ShownStands>,
    /// What of the installation is found to be otherwise than configured.
    pub installation: Vec<Found>,
    /// What is learnt of the sensors; `None` where nothing is to be.
    pub learning: Option<ShownLearning>,
    /// Sensors, in the order of the configuration.
    pub sensors: Vec<Sensor>,
    /// Which sensor is used for what, and why.
    pub choices: Vec<ShownChoice>,
    /// Sensors that are watched and not used, each beside the ship's own word and beside each other.
    pub watched: Vec<ShownWatch>,
    /// The satellites, and what becomes of each.
    pub sky: ShownSky,
    /// Ports that are listened to, in the order of the configuration.
    pub inputs: Vec<ShownInput>,
    /// Ports that are written to, in the order of the configuration.
    pub outputs: Vec<ShownOutput>,
    /// CAN buses.
    pub buses: Vec<Bus>,
    /// How punctual the outputs are.
    pub schedule: Schedule,
    /// What became of the measurements of each aid.
    pub aids: Vec<ShownAid>,
    /// What became of the samples of the IMU.
    pub samples: Samples,
    /// The last measurements that were not used, oldest first, at most [`MAX_REJECTIONS`].
    pub rejections: Vec<Rejected>,
    /// Alerts that are not normal, those that matter most first.
    pub alerts: Vec<Alert>,
    /// What moves the ship; `None` until it has been seen for a while.
    pub disturbance: Option<ShownDisturbance>,
    /// The recording; `None` if none is asked for.
    pub recording: Option<ShownRecording>,
    /// What is saved for the next start; `None` if nothing is.
    pub saving: Option<Saving>,
    /// Fleets that are told, in the order of the configuration.
    pub fleets: Vec<ShownFleet>,
    /// The journal.
    pub log: Log,
    /// The last lines of the journal, oldest first, at most [`MAX_EVENTS`].
    pub events: Vec<ShownEvent>,
}

impl Default for Snapshot {
    fn default() -> Self {
        Snapshot {
            version: VERSION,
            program: Program::default(),
            time: TimeInfo::default(),
            mode: ShownMode::default(),
            modes: Vec::new(),
            motion: None,
            docking: None,
            berths: Vec::new(),
            alignment: None,
            engines: Vec::new(),
            estimates: None,
            standings: Vec::new(),
            installation: Vec::new(),
            learning: None,
            sensors: Vec::new(),
            choices: Vec::new(),
            watched: Vec::new(),
            sky: ShownSky::default(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            buses: Vec::new(),
            schedule: Schedule::default(),
            aids: Vec::new(),
            samples: Samples::default(),
            rejections: Vec::new(),
            alerts: Vec::new(),
            disturbance: None,
            recording: None,
            saving: None,
            fleets: Vec::new(),
            log: Log::default(),
            events: Vec::new(),
        }
    }
}

impl Snapshot {
    /// Whether the heading is good enough to steer and navigate by: the mode is `aided`,
    /// `dead_reckoning` or `inertial`.
    #[must_use]
    pub fn is_navigating(&self) -> bool {
        matches!(self.mode.name.as_str(), "aided" | "dead_reckoning" | "inertial")
    }
}
