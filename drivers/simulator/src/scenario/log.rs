//! The velocity log, and the current that a log sees which measures against the water.

use serde::Deserialize;

use super::fault::Faults;
use super::when::{Delay, Spread, When};

/// Which components the log gives.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum LogAxes {
    /// Forward only.
    U,
    /// Forward and starboard.
    Uv,
    /// Forward, starboard and down.
    #[default]
    Uvw,
}

/// What the log measures against.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Track {
    /// The sea bed.
    #[default]
    Bottom,
    /// The water.
    Water,
}

/// No messages.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Dropout {
    /// When.
    pub(crate) when: When,
    /// For how long.
    pub(crate) duration_s: Spread,
}

/// The log.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Log {
    /// Rate of messages.
    pub(crate) rate_hz: f64,
    /// Log from the IMU, body axes.
    pub(crate) lever_arm_m: [f64; 3],
    /// What it measures against.
    pub(crate) track: Track,
    /// From when on it has lost the bottom and measures against the water.
    pub(crate) water_from_s: Option<f64>,
    /// Which components it gives.
    pub(crate) axes: LogAxes,
    /// White noise of each component, 1-sigma; also what it claims.
    pub(crate) white_mps: f64,
    /// Scale factor error, 1-sigma, ratio, one draw.
    pub(crate) scale_std: f64,
    /// Mounting error in pitch and in yaw, 1-sigma each, one draw.
    pub(crate) misalignment_std_deg: f64,
    /// How late messages arrive; at once if absent.
    pub(crate) arrival: Option<Delay>,
    /// No messages.
    pub(crate) dropouts: Vec<Dropout>,
}

impl Default for Log {
    fn default() -> Self {
        Log {
            rate_hz: 1.0,
            lever_arm_m: [9.0, -1.0, 9.0],
            track: Track::Bottom,
            water_from_s: None,
            axes: LogAxes::Uvw,
            white_mps: 0.03,
            scale_std: 0.005,
            misalignment_std_deg: 0.3,
            arrival: None,
            dropouts: Vec::new(),
        }
    }
}

impl Log {
    /// Whether it measures against the water at time `t`, s.
    pub(crate) fn is_in_water_track(&self, t: f64) -> bool {
        self.track == Track::Water || self.water_from_s.is_some_and(|from| t >= from)
    }

    pub(super) fn check(&self, faults: &mut Faults) {
        faults.range("log.rate_hz", self.rate_hz, 0.001, 100.0);
        faults.lever_arm("log.lever_arm_m", self.lever_arm_m);
        faults.range("log.white_mps", self.white_mps, 0.0, 10.0);
        faults.range("log.scale_std", self.scale_std, 0.0, 0.5);
        faults.range("log.misalignment_std_deg", self.misalignment_std_deg, 0.0, 45.0);
        faults.not_negative("log.water_from_s", self.water_from_s.unwrap_or(0.0));
        if let Some(arrival) = self.arrival {
            arrival.check("log.arrival", faults);
        }
        for (index, dropout) in self.dropouts.iter().enumerate() {
            let key = format!("log.dropouts[{index}]");
            dropout.duration_s.check(&format!("{key}.duration_s"), 0.0, 1e6, faults);
            dropout.when.check(&format!("{key}.when"), dropout.duration_s.bounds()[1], faults);
        }
    }
}

/// Velocity of the water over the ground.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Current {
    /// Constant part, towards north.
    pub(crate) north_mps: f64,
    /// Constant part, towards east.
    pub(crate) east_mps: f64,
    /// Slow part, 1-sigma of each of north and east, first-order Gauss-Markov.
    pub(crate) random_std_mps: f64,
    /// Correlation time of the slow part.
    pub(crate) correlation_time_s: f64,
}

impl Default for Current {
    fn default() -> Self {
        Current { north_mps: 0.0, east_mps: 0.0, random_std_mps: 0.0, correlation_time_s: 3600.0 }
    }
}

impl Current {
    pub(super) fn check(&self, faults: &mut Faults) {
        faults.range("current.north_mps", self.north_mps, -10.0, 10.0);
        faults.range("current.east_mps", self.east_mps, -10.0, 10.0);
        faults.range("current.random_std_mps", self.random_std_mps, 0.0, 10.0);
        faults.positive("current.correlation_time_s", self.correlation_time_s);
    }
}
