//! What an epoch of a receiver on board comes to against a base.

use std::fmt;

use nalgebra::{Matrix3, Vector3};

use crate::time::Time;

/// A receiver's epoch against a base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RtkEpoch {
    /// When the receiver on board took it.
    pub time: Time,
    /// Where its antenna is by integers that are believed, or why none are.
    pub place: Result<RtkPlace, RtkSilence>,
    /// Integers that were believed before are found to have been wrong: places that were told with them were.
    pub is_withdrawal: bool,
}

/// An antenna's place by integers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RtkPlace {
    /// ECEF, m.
    pub antenna: Vector3<f64>,
    /// Its covariance if the integers are right and the base is where it says, m^2.
    pub covariance: Matrix3<f64>,
    /// Distance to the base, m.
    pub baseline: f64,
    /// Where the base is somebody on board answers for, and not its own word alone.
    pub is_surveyed: bool,
    /// By how much the base's epoch is older, s.
    pub age: f64,
    /// The chance that the integers are wrong, by what the candidates weigh against each other.
    pub doubt: f64,
}

/// Why there is no place by integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RtkSilence {
    /// Nothing has come of the base of late.
    BaseSilent,
    /// Nobody says where the base is.
    BaseUnplaced,
    /// The base moves: its place is known no better than the ship's.
    BaseMoves,
    /// The base's own codes have it elsewhere than it says.
    BaseElsewhere,
    /// Too few satellites or phases in common.
    TooFew,
    /// Other integers are nearly as likely.
    Unclear,
    /// The integers are clear, and their residuals larger than noise makes them.
    Residuals,
    /// Integers are believed, and have to stay so for some epochs before they are told.
    Settling,
    /// They are where the ship cannot be, by her inertial navigation.
    Contradicted,
}

impl RtkSilence {
    /// A word for tables.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::BaseSilent => "base_silent",
            Self::BaseUnplaced => "base_unplaced",
            Self::BaseMoves => "base_moves",
            Self::BaseElsewhere => "base_elsewhere",
            Self::TooFew => "too_few",
            Self::Unclear => "unclear",
            Self::Residuals => "residuals",
            Self::Settling => "settling",
            Self::Contradicted => "contradicted",
        }
    }
}

impl fmt::Display for RtkSilence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::BaseSilent => "nothing comes of the base",
            Self::BaseUnplaced => "nobody says where the base is",
            Self::BaseMoves => "the base moves",
            Self::BaseElsewhere => "the base is not where it says, by its own codes",
            Self::TooFew => "too few satellites in common with the base",
            Self::Unclear => "no integers are sure",
            Self::Residuals => "the phases do not fit their integers",
            Self::Settling => "the integers are new",
            Self::Contradicted => "it contradicts inertial navigation",
        })
    }
}

/// How far RTK is believed, where that changes beside its coming and going.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RtkTurn {
    /// Integers were found to have been wrong, and what the ship made of them is forgotten.
    Withdrawn,
    /// It is where the ship cannot be, time after time: a base that has moved, or wrong integers. It is not used.
    Contradicted,
    /// It agrees with the ship again, and is used.
    Agrees,
}

impl RtkTurn {
    /// A word for tables.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Withdrawn => "withdrawn",
            Self::Contradicted => "refuted",
            Self::Agrees => "agrees",
        }
    }
}

impl fmt::Display for RtkTurn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Withdrawn => "RTK is withdrawn: its integers were wrong, and the place is found anew",
            Self::Contradicted => {
                "RTK is not used: it contradicts inertial navigation; its base may have moved, or its integers may be wrong"
            }
            Self::Agrees => "RTK agrees with inertial navigation again, and is used",
        })
    }
}
