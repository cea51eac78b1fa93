//! Docking aids: distances to a line ashore and ranges to a point ashore, from a point of the ship.

use std::fmt;

use crate::frames::{Body, Geodetic};
use crate::time::Time;

/// One distance of a docking aid. It says itself what it was measured to, and from where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangingReading {
    /// Time of validity.
    pub time: Time,
    /// Number of what it was measured to: all readings to the same line or point share its survey's error.
    pub mark: u16,
    /// What it was measured to.
    pub target: RangingTarget,
    /// The point of the ship, from the IMU, body axes, m.
    pub lever: Body,
    /// Distance, m; across a line positive on the side of the water.
    pub distance: f64,
    /// 1-sigma of one reading, m.
    pub std: f64,
}

/// What a distance is measured to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RangingTarget {
    /// A line ashore: the edge of a quay, a wall.
    Line(RangingLine),
    /// A point ashore: an anchor of a radio, a reflector.
    Point {
        /// Where it is.
        place: Geodetic,
        /// How well that is known: 1-sigma of each level component, and of the height, m.
        std: [f64; 2],
    },
}

/// A line ashore with the way in which the distance to it is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangingLine {
    /// Its two ends; heights are of no account.
    pub ends: [Geodetic; 2],
    /// Whether the water is on the right of the way from the first end to the second.
    pub water_right: bool,
    /// How well each end is known across the line, 1-sigma, m.
    pub std: f64,
    /// How the distance is measured.
    pub beam: RangingBeam,
}

/// How the distance to a line is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RangingBeam {
    /// Across the line, to the point of the ship itself.
    Across,
    /// Across the line from a head ashore at so many metres from the first end, to her flat side, on which the point is.
    Ashore(f64),
    /// From the point of the ship in this direction, a unit vector in body axes, to the upright face above the line.
    Aboard(Body),
}

/// How far a docking aid is believed, where that changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RangingTurn {
    /// It contradicts the ship, time after time, and is not used.
    Contradicted,
    /// It agrees with the ship again, and is used.
    Agrees,
}

impl RangingTurn {
    /// A word for tables.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Contradicted => "refuted",
            Self::Agrees => "agrees",
        }
    }
}

impl RangingTarget {
    /// How well it is known where it is, level, 1-sigma, m.
    #[must_use]
    pub fn survey_std(&self) -> f64 {
        match self {
            Self::Line(line) => line.std,
            Self::Point { std: [level, _], .. } => *level,
        }
    }
}

impl fmt::Display for RangingTurn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Contradicted => {
                "it is not used: it contradicts the ship; the beam may meet something else, or the line or point is elsewhere"
            }
            Self::Agrees => "it agrees with the ship again, and is used",
        })
    }
}
