//! What there is to know of a base, and what is worth telling of it.

use std::fmt;

use insd_base::Time;
use nalgebra::Vector3;

/// What is known of a base.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct BaseStatus {
    /// Its number.
    pub station: Option<u16>,
    /// Reference point of its antenna, ECEF, m.
    pub position: Option<Vector3<f64>>,
    /// How far it is from the ship, m.
    pub distance: Option<f64>,
    /// Epochs offered to the navigator.
    pub epochs: u64,
    /// Messages that told where it is.
    pub stations: u64,
    /// Records of orbits that came with it, which are not used.
    pub records: u64,
    /// Satellites of the newest epoch.
    pub satellites: u16,
    /// Signals of the newest epoch.
    pub signals: u16,
    /// When the newest epoch was, on the ship's time line.
    pub newest: Option<Time>,
}

/// Something about a base that is news.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BaseNews {
    /// It tells where it is, for the first time.
    Placed {
        /// Number of the station.
        station: u16,
    },
    /// Another station answers.
    Station {
        /// Number of the one before.
        from: u16,
        /// Its number.
        to: u16,
        /// How far it is from the one before, m.
        by: f64,
    },
    /// Its coordinates are others than before.
    Moved {
        /// By so much, m.
        by: f64,
    },
    /// What it tells is no place on Earth, and not used.
    Implausible,
    /// It tells another place than is configured, which holds.
    Contradicts {
        /// By so much, m.
        by: f64,
    },
    /// It tells the place that is configured, again.
    Agrees,
    /// It is so far from the ship that it helps little.
    Far {
        /// So far, m.
        distance: f64,
    },
    /// It is near enough again.
    Near {
        /// So far, m.
        distance: f64,
    },
    /// It measures, and nobody tells where it is.
    Unplaced,
}

impl fmt::Display for BaseNews {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let km = |metres: f64| metres / 1000.0;
        match self {
            BaseNews::Placed { station } => write!(f, "station {station} tells where it is"),
            BaseNews::Station { from, to, by } => {
                let km = km(*by);
                write!(f, "station {to} in place of {from}, {km:.3} km away from it")
            }
            BaseNews::Moved { by } => {
                write!(f, "its coordinates have changed by {by:.3} m, and it is not to move")
            }
            BaseNews::Implausible => {
                write!(f, "its coordinates are no place on Earth, and are not used")
            }
            BaseNews::Contradicts { by } => write!(
                f,
                "it says that it is {by:.3} m from where the configuration has it, which holds"
            ),
            BaseNews::Agrees => write!(f, "it is where the configuration has it again"),
            BaseNews::Far { distance } => {
                write!(f, "it is {:.0} km away, too far to be of much use", km(*distance))
            }
            BaseNews::Near { distance } => write!(f, "it is {:.0} km away", km(*distance)),
            BaseNews::Unplaced => write!(
                f,
                "it measures, but tells no coordinates (1005 or 1006), and none are configured"
            ),
        }
    }
}
