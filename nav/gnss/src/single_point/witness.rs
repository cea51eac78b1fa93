//! What is said of an epoch and of each of its satellites.

use std::fmt;

use insd_base::SatelliteId;

use crate::atmosphere::LookAngles;
use crate::ephemerides::OrbitRefusal;

/// Why an epoch has no position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPosition {
    /// Fewer satellites with codes and orbits than unknowns.
    TooFew {
        /// What there is.
        satellites: usize,
    },
    /// Satellites enough, but not apart enough.
    Geometry,
    /// The codes contradict one another and it does not show which is wrong.
    Contradiction,
    /// What follows is nowhere near the Earth's surface.
    NotOnEarth,
}

impl fmt::Display for NoPosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew { satellites } => write!(f, "{satellites} satellites are too few"),
            Self::Geometry => write!(f, "the satellites stand too close together"),
            Self::Contradiction => write!(f, "the codes contradict one another"),
            Self::NotOnEarth => write!(f, "the position is not on the Earth"),
        }
    }
}

/// What became of a satellite in an epoch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// Used.
    Used,
    /// It has no orbit.
    NoOrbit(OrbitRefusal),
    /// No code on the band that positions rest on.
    NoCode,
    /// Too low.
    Low,
    /// Its codes contradict those of the others.
    Faulty,
}

/// A satellite in an epoch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// Which.
    pub satellite: SatelliteId,
    /// What became of it.
    pub verdict: Verdict,
    /// Where it stands, where its orbit is known.
    pub direction: Option<LookAngles>,
    /// What its code has over what the position says, m.
    pub residual: Option<f64>,
    /// 1-sigma of that, m.
    pub residual_std: Option<f64>,
}

impl Witness {
    pub(super) fn refused(satellite: SatelliteId, verdict: Verdict) -> Self {
        Self { satellite, verdict, direction: None, residual: None, residual_std: None }
    }
}
