//! What several antennas of one hull tell of how it stands.

use std::fmt;

use nalgebra::{Matrix3, Vector3};

use super::line::LineBias;
use super::signal::{SatelliteId, SignalCode};
use crate::attitude::Attitude;
use crate::time::Time;

/// The phase of one antenna.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AntennaPhase {
    /// Where the antenna stands on the hull, forward, starboard, down from a point that all share, m.
    pub lever: Vector3<f64>,
    /// Phase less the range to a point that all share, less whole cycles and what the first antenna has of it, m.
    pub phase: f64,
    /// Variance of its error, m^2.
    pub variance: f64,
    /// Its line; `None` of the one that the others are counted from.
    pub line: Option<LineBias>,
    /// The clock of its receiver; `None` of the one that the first antenna's is on.
    pub clock: Option<usize>,
}

/// A signal of a satellite as several antennas have it, whole cycles taken out: `phase_i = g . C l_i + line_i + clock + what all share + error`.
#[derive(Clone, Debug, PartialEq)]
pub struct AntennaSignal {
    /// The satellite.
    pub satellite: SatelliteId,
    /// The signal as the first of the antennas tracks it.
    pub signal: SignalCode,
    /// Its wavelength, m: receivers on clocks of their own are known up to whole ones.
    pub wavelength: f64,
    /// How the range changes with an antenna's place, ECEF axes ([`super::Transmitter::gradient`]).
    pub gradient: Vector3<f64>,
    /// Two antennas at the least.
    pub phases: Vec<AntennaPhase>,
}

/// An epoch of a compass whose integers are believed.
#[derive(Clone, Debug, PartialEq)]
pub struct CompassPhases {
    /// How the hull stands, by these phases and their lines alone.
    pub attitude: Attitude,
    /// Covariance of roll, pitch and heading, rad^2. What satellites do not tell has ten radians.
    pub covariance: Matrix3<f64>,
    /// Signals that fit.
    pub signals: Vec<AntennaSignal>,
}

/// What the antennas of a ship measured together.
#[derive(Clone, Debug, PartialEq)]
pub struct CompassReading {
    /// When.
    pub time: Time,
    /// Another number after integers were found anew: lines begin anew, too.
    pub run: u32,
    /// What they tell.
    pub told: Result<CompassPhases, CompassRefusal>,
    /// What is wrong with the installation, as far as it has been found.
    pub faults: Vec<CompassFault>,
}

/// Why no attitude is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CompassRefusal {
    /// The array is none: fewer than two antennas, or all in one place.
    Array,
    /// Nobody knows where the antennas are, to ten metres.
    NoPlace,
    /// Two antennas have no two signals in common.
    TooFew {
        /// Signals that two antennas have in common.
        signals: usize,
    },
    /// They determine nothing.
    Geometry,
    /// Several attitudes fit, or too little bears out the one that does.
    Ambiguous {
        /// How many.
        hypotheses: usize,
        /// The chance that the likeliest is wrong.
        doubt: f64,
    },
    /// Nothing fits.
    Residuals {
        /// Variance of the residuals of what fits best over that assumed.
        level: f64,
        /// The most that is taken.
        limit: f64,
    },
    /// Antennas so far apart cannot be searched for without a better attitude to begin at.
    TooFarApart {
        /// m.
        span: f64,
    },
}

/// What is wrong with the installation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CompassFault {
    /// An antenna hears next to nothing of what the others do, or much less strongly: its cable or the antenna itself is broken.
    Broken {
        /// The antenna.
        antenna: usize,
    },
    /// A receiver runs on a clock of its own though it is said to share one. It is used as such.
    OwnClock {
        /// The antenna.
        antenna: usize,
        /// By how much its clock gains on the others by its codes, m/s.
        rate: f64,
    },
    /// Two antennas stand in each other's place: nothing fits as they are configured, and all does when they are exchanged. Of an array that is
    /// symmetrical there are two such pairs, both of which are told, unless a heading is known.
    Swapped {
        /// One of them.
        one: usize,
        /// The other.
        other: usize,
    },
    /// The phases of one antenna fit to nothing, those of the others to each other. It is left out.
    Incoherent {
        /// The antenna.
        antenna: usize,
    },
}

impl fmt::Display for CompassRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Array => write!(f, "no two antennas apart"),
            Self::NoPlace => write!(f, "nobody knows where the antennas are"),
            Self::TooFew { signals } => write!(f, "{signals} signals in common"),
            Self::Geometry => write!(f, "signals in common determine nothing"),
            Self::Ambiguous { hypotheses, doubt } => {
                write!(f, "{hypotheses} attitudes fit, the likeliest wrong by {doubt:.1e}")
            }
            Self::Residuals { level, limit } => {
                write!(f, "nothing fits: residuals {level:.1} times as assumed, at most {limit:.1}")
            }
            Self::TooFarApart { span } => {
                write!(f, "antennas {span:.1} m apart need an attitude to begin at")
            }
        }
    }
}

impl fmt::Display for CompassFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Broken { antenna } => {
                write!(f, "antenna {}: hears next to nothing; cable or antenna", antenna + 1)
            }
            Self::OwnClock { antenna, rate } => write!(
                f,
                "antenna {}: its receiver runs on a clock of its own, {rate:.2} m/s",
                antenna + 1
            ),
            Self::Swapped { one, other } => {
                write!(f, "antennas {} and {} are in each other's place", one + 1, other + 1)
            }
            Self::Incoherent { antenna } => {
                write!(f, "antenna {}: its phases fit to nothing", antenna + 1)
            }
        }
    }
}
