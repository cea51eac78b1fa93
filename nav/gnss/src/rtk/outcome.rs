//! What an epoch of rover and base comes to.

use std::fmt;

use insd_base::GpsTime;
use nalgebra::{Matrix3, Vector3};

use super::double::PairAmbiguity;
use crate::integers::IntegerRefusal;
use crate::single_point::NoPosition;

/// A rover's position against a base.
#[derive(Clone, Debug, PartialEq)]
pub struct RtkSolution {
    /// The rover's tag.
    pub tag: GpsTime,
    /// By how much the base's epoch is older, s; negative where it is younger.
    pub age: f64,
    /// The antenna with real ambiguities, ECEF, m.
    pub float: Vector3<f64>,
    /// Its covariance, m^2; errors of the base's place are not in it.
    pub float_covariance: Matrix3<f64>,
    /// Double differences of phase.
    pub phases: usize,
    /// Phases left out as they may be wrong by half a cycle.
    pub half_cycles: usize,
    /// The antenna with integer ambiguities, or why they are not believed.
    pub fixed: Result<RtkFix, RtkRefusal>,
    /// An earlier fix that this epoch contradicts, if one is: positions since then were wrong.
    pub withdrawn: Option<RtkWithdrawal>,
}

/// Integers that were believed and are no longer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RtkWithdrawal {
    /// When they were believed first.
    pub since: GpsTime,
    /// Epochs that were fixed with them.
    pub epochs: usize,
}

impl RtkSolution {
    /// The best there is: fixed, else float.
    #[must_use]
    pub fn position(&self) -> Vector3<f64> {
        self.fixed.as_ref().map_or(self.float, |fix| fix.position)
    }

    /// Its covariance, m^2; that integers may be wrong is not in it.
    #[must_use]
    pub fn covariance(&self) -> Matrix3<f64> {
        self.fixed.as_ref().map_or(self.float_covariance, |fix| fix.covariance)
    }
}

/// A position with integer ambiguities.
#[derive(Clone, Debug, PartialEq)]
pub struct RtkFix {
    /// The antenna, ECEF, m.
    pub position: Vector3<f64>,
    /// Its covariance if the integers are right, m^2.
    pub covariance: Matrix3<f64>,
    /// Where the next best integers would have it, ECEF, m: what a protection level takes for the fault.
    pub runner_up: Vector3<f64>,
    /// The chance that the integers are wrong, by what the candidates weigh against each other.
    pub doubt: f64,
    /// Distance of the next best integers over that of the best.
    pub ratio: f64,
    /// Success rate by bootstrapping of what is fixed.
    pub success: f64,
    /// What is fixed, and its integers, cycles.
    pub integers: Vec<(PairAmbiguity, i64)>,
    /// Subsets tried, this one among them; each had its share of the risk.
    pub attempts: usize,
    /// Residuals of the phases over what is assumed of them: variance, 1 as assumed.
    pub level: f64,
}

/// Why there is no position against a base, or no integers are believed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RtkRefusal {
    /// The base's epoch is too old, or as much ahead.
    Age {
        /// s.
        age: f64,
        /// The most that is taken, s.
        limit: f64,
    },
    /// The base's coordinates are not where its codes have it.
    BasePlace {
        /// Off, m.
        off: f64,
        /// The most that is taken, m.
        limit: f64,
    },
    /// The rover's codes give no place to begin at.
    Rover(NoPosition),
    /// Too few satellites are heard by both.
    TooFew {
        /// Double differences of code.
        codes: usize,
    },
    /// They do not determine a position.
    Geometry,
    /// Too few phases: four differences determine a position and check it.
    TooFewPhases {
        /// Double differences of phase.
        phases: usize,
    },
    /// The integers could not be searched.
    Search(IntegerRefusal),
    /// Other integers are too near.
    Ratio {
        /// Chance that the nearest ones are wrong.
        doubt: f64,
        /// The most that is allowed.
        allowed: f64,
    },
    /// The integers are clear, and the residuals larger than any noise makes them.
    Residuals {
        /// Variance over that assumed.
        level: f64,
        /// The most that is taken.
        limit: f64,
    },
    /// They contradict what was known of the position.
    Prior {
        /// Off, m.
        off: f64,
        /// In sigmas.
        sigmas: f64,
    },
}

impl fmt::Display for RtkRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Age { age, limit } => write!(f, "base data {age:.1} s old, at most {limit:.0}"),
            Self::BasePlace { off, limit } => {
                write!(f, "base {off:.0} m from its coordinates by its codes, at most {limit:.0}")
            }
            Self::Rover(_) => write!(f, "the codes give no place to begin at"),
            Self::TooFew { codes } => write!(f, "too few satellites in common ({codes} codes)"),
            Self::Geometry => write!(f, "satellites in common determine no position"),
            Self::TooFewPhases { phases } => write!(f, "{phases} phases in common"),
            Self::Search(why) => write!(f, "integers: {why}"),
            Self::Ratio { doubt, allowed } => {
                write!(f, "other integers are as near: wrong by {doubt:.1e}, at most {allowed:.1e}")
            }
            Self::Residuals { level, limit } => {
                write!(f, "residuals {level:.1} times what noise makes them, at most {limit:.1}")
            }
            Self::Prior { off, sigmas } => {
                write!(f, "{off:.2} m ({sigmas:.1} sigmas) from where it was expected")
            }
        }
    }
}
