//! A scenario: everything that decides a voyage except the seed, as its author wrote it.
//!
//! The fields are the keys of the TOML file and carry the units of their names; they are checked
//! once, here, and turned into SI where the simulation takes them up.

mod berth;
mod camera;
mod fault;
mod gnss;
mod imu;
mod log;
mod overrides;
mod raw;
mod raw_check;
mod reference;
mod sea;
mod voyage;
mod when;

use insd_base::units::DEG;
use serde::Deserialize;

use fault::Faults;

pub use berth::ScenarioBerth;
pub(crate) use camera::{Camera, CameraFault, CameraQuay};
pub use fault::{ScenarioError, ScenarioFault};
pub(crate) use gnss::{Gnss, GnssGrade, GnssNoise, StdFault};
pub(crate) use imu::{Imu, Vibration};
pub(crate) use log::{Current, Log, LogAxes};
pub use overrides::Override;
pub(crate) use raw::{
    Raw, RawAntennaFault, RawBase, RawCrane, RawFault, RawSegment, RawSky, RawSpoof,
};
pub(crate) use reference::{PositionReference, Reference};
pub(crate) use sea::{ExposurePoint, Sea, Shift};
pub(crate) use voyage::{
    HeadingReference, Leg, Mode, Route, SHORTEST_CHANGE, Ship, Start, TURN_ENTRY, Truth,
};
pub(crate) use when::{Delay, Spread, When};

/// A ship, her route, the sea and her sensors with their errors and faults.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// What to call it in tables.
    pub(crate) name: String,
    /// What it is for.
    #[serde(default)]
    pub(crate) description: String,
    /// UTC of the start, RFC 3339.
    #[serde(default = "new_year")]
    pub(crate) start_utc: String,
    /// What the navigator is told of the ship's motion at the start.
    pub(crate) mode: Mode,
    /// Length of the voyage, s; the sum of the legs unless given.
    pub(crate) duration_s: Option<f64>,
    /// Where the voyage starts.
    pub(crate) start: Start,
    /// The hull.
    #[serde(default)]
    pub(crate) ship: Ship,
    /// Where she goes.
    pub(crate) route: Route,
    /// Waves; flat calm if absent.
    pub(crate) sea: Option<Sea>,
    /// Truth.
    #[serde(default)]
    pub(crate) truth: Truth,
    /// Inertial measurement unit.
    pub(crate) imu: Imu,
    /// GNSS receiver.
    pub(crate) gnss: Option<Gnss>,
    /// Raw GNSS.
    pub(crate) raw: Option<Raw>,
    /// Camera.
    pub(crate) camera: Option<Camera>,
    /// Velocity log.
    pub(crate) log: Option<Log>,
    /// Current of the water, seen by a log that measures against it.
    #[serde(default)]
    pub(crate) current: Current,
    /// External reference.
    pub(crate) reference: Option<Reference>,
    /// The berth that the voyage ends at.
    pub(crate) berth: Option<ScenarioBerth>,
}

fn new_year() -> String {
    "2026-01-01T00:00:00Z".to_owned()
}

fn is_utc(text: &str) -> bool {
    let parsed: Result<toml::value::Datetime, _> = text.parse();
    parsed.is_ok_and(|instant| instant.offset == Some(toml::value::Offset::Z))
}

impl Scenario {
    /// Reads and checks a scenario.
    ///
    /// # Errors
    /// The TOML parser's message with line and caret, or all values that are out of range, each
    /// with its key.
    pub fn from_toml(text: &str) -> Result<Scenario, ScenarioError> {
        let scenario: Scenario =
            toml::from_str(text).map_err(|error| ScenarioError::Syntax(error.to_string()))?;
        scenario.check()?;
        Ok(scenario)
    }

    /// Reads a scenario, sound in itself, and sets some of its keys to other values.
    ///
    /// # Errors
    /// Those of [`Scenario::from_toml`]; the key of an override that names nothing, or whose value is
    /// of the wrong type; all values out of range.
    pub fn with_overrides(text: &str, overrides: &[Override]) -> Result<Scenario, ScenarioError> {
        let mut scenario = Scenario::from_toml(text)?;
        let mut table: toml::Table =
            toml::from_str(text).map_err(|error| ScenarioError::Syntax(error.to_string()))?;
        for change in overrides {
            scenario = change.apply(&mut table)?;
        }
        scenario.check()?;
        Ok(scenario)
    }

    /// Whether the navigator is told that she lies at her berth when the voyage starts.
    #[must_use]
    pub fn is_moored(&self) -> bool {
        self.mode == Mode::Moored
    }

    /// Latitude of the start, rad.
    #[must_use]
    pub fn start_latitude(&self) -> f64 {
        self.start.lat_deg * DEG
    }

    /// What to call it in tables.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it is for, in a sentence or two; empty if its author said nothing.
    #[must_use]
    pub fn description(&self) -> &str {
        &self.description
    }

    /// The berth that the voyage ends at, if it is one.
    #[must_use]
    pub fn berth(&self) -> Option<&ScenarioBerth> {
        self.berth.as_ref()
    }

    /// Whether she has a camera.
    #[must_use]
    pub fn has_camera(&self) -> bool {
        self.camera.is_some()
    }

    /// Length and beam of the hull, m; the IMU is amidships.
    #[must_use]
    pub fn hull(&self) -> [f64; 2] {
        [self.ship.length_m, self.ship.beam_m]
    }

    /// Length of the voyage, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.duration_s.unwrap_or_else(|| self.route.duration())
    }

    /// The same scenario cut short, or with its last leg prolonged, to `seconds`; at least 1 s.
    #[must_use]
    pub fn with_duration(mut self, seconds: f64) -> Self {
        self.duration_s = Some(seconds.max(1.0));
        self
    }

    /// Whether a reference gives the position of the berth while she lies there.
    pub(crate) fn knows_berth(&self) -> bool {
        self.reference.is_some_and(|reference| reference.position == PositionReference::Berth)
    }

    fn check(&self) -> Result<(), ScenarioError> {
        let mut faults = Faults::default();
        if !is_utc(&self.start_utc) {
            let problem =
                format!("expected an RFC 3339 instant in UTC, found {:?}", self.start_utc);
            faults.add("start_utc", problem);
        }
        if let Some(duration) = self.duration_s {
            faults.range("duration_s", duration, 1.0, 1e6);
        }
        self.start.check(&mut faults);
        self.ship.check(&mut faults);
        self.route.check(&mut faults);
        self.truth.check(&mut faults);
        self.imu.check(&mut faults);
        self.current.check(&mut faults);
        if let Some(sea) = &self.sea {
            sea.check(&mut faults);
        }
        if let Some(gnss) = &self.gnss {
            gnss.check(&mut faults);
        }
        if let Some(raw) = &self.raw {
            raw_check::check(raw, &mut faults);
        }
        if let Some(camera) = &self.camera {
            camera.check(&mut faults);
            if self.berth.is_none() {
                faults.add("camera", "expected a [berth], whose quay it sees");
            }
        }
        if let Some(log) = &self.log {
            log.check(&mut faults);
        }
        if let Some(reference) = &self.reference {
            reference.check(&mut faults);
        }
        if let Some(berth) = &self.berth {
            berth.check(&mut faults);
        }
        if self.mode == Mode::Moored && !self.route.legs.first().is_some_and(|leg| leg.moored) {
            faults.add("mode", "\"moored\" needs a first leg with moored = true");
        }
        faults.into_result()
    }
}

#[cfg(test)]
mod tests;
