//! What is told by sensors that are watched and not used.

use insd_base::units::wrap_pi;
use insd_base::{Geodetic, Time, earth};

/// What a watched sensor says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watched {
    /// Index of the sensor in the configuration.
    pub sensor: usize,
    /// Time of validity.
    pub time: Time,
    /// What.
    pub value: WatchedValue,
    /// 1-sigma of each component, rad or m, as the sensor claims or its description has it; `None` if neither says.
    pub std: Option<f64>,
}

/// A quantity that is watched, with its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WatchedValue {
    /// True heading, rad.
    Heading(f64),
    /// Where the sensor is; the height is not used.
    Position(Geodetic),
    /// How the ship leans, rad.
    Tilt {
        /// Starboard side down positive.
        roll: f64,
        /// Bow up positive.
        pitch: f64,
    },
}

impl WatchedValue {
    /// This one less another of the same quantity, in two components: a heading and zero, rad; north and east, m; roll and
    /// pitch, rad. Angles are wrapped to half a turn. `None` where they are of different quantities.
    #[must_use]
    pub fn less(&self, other: &WatchedValue) -> Option<[f64; 2]> {
        match (self, other) {
            (WatchedValue::Heading(own), WatchedValue::Heading(other)) => {
                Some([wrap_pi(own - other), 0.0])
            }
            (WatchedValue::Position(own), WatchedValue::Position(other)) => {
                let [own, other] = [own, other].map(|at| Geodetic { height: 0.0, ..*at });
                let way = earth::ecef(&own).0 - earth::ecef(&other).0;
                let way = earth::c_ne(&other) * way;
                Some([way.x, way.y])
            }
            (
                WatchedValue::Tilt { roll, pitch },
                WatchedValue::Tilt { roll: other_roll, pitch: other_pitch },
            ) => Some([wrap_pi(roll - other_roll), pitch - other_pitch]),
            _ => None,
        }
    }
}
