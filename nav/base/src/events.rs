//! What happened on the way: rejections with their reason, counters, changes of state.

use std::collections::BTreeMap;

use crate::messages::Source;
use crate::solution::Mode;
use crate::time::Time;

/// Why a message or a part of it was not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Rejection {
    /// Innovation outside the chi-square gate.
    ChiSquare,
    /// Innovation outside dP_INS + dP_GNSS * DOP.
    DopTest,
    /// Another quantity of the same receiver failed its gate at this epoch, or a moment ago.
    SourceSuspect,
    /// The receiver itself says that it has no fix.
    NoFix,
    /// NaN, infinite or outside any physical range.
    OutOfRange,
    /// Older than the history that is kept.
    TooLate,
    /// Same time of validity as the sample before.
    Duplicate,
    /// Time of validity before that of the sample before.
    OutOfOrder,
    /// Not usable in the present mode (for example a log before any alignment).
    NotUsable,
}

impl Rejection {
    /// A short name for tables: `chi_square`, `dop_test`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Rejection::ChiSquare => "chi_square",
            Rejection::DopTest => "dop_test",
            Rejection::SourceSuspect => "source_suspect",
            Rejection::NoFix => "no_fix",
            Rejection::OutOfRange => "out_of_range",
            Rejection::TooLate => "too_late",
            Rejection::Duplicate => "duplicate",
            Rejection::OutOfOrder => "out_of_order",
            Rejection::NotUsable => "not_usable",
        }
    }
}

/// Why a state that was stored at the last shutdown is not believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum StoredDoubt {
    /// The IMU is not the one that it was stored with, by its error model.
    OtherImu,
    /// The ship did not lie at her berth then, or does not now.
    NotMoored,
    /// The ship is at another place.
    Moved,
    /// Roll and pitch are not what they were by more than the sea can do: the mounting has changed.
    Tilted,
    /// The heading is not what it was: the ship has been turned.
    Turned,
}

impl StoredDoubt {
    /// A short name for tables: `other_imu`, `moved`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            StoredDoubt::OtherImu => "other_imu",
            StoredDoubt::NotMoored => "not_moored",
            StoredDoubt::Moved => "moved",
            StoredDoubt::Tilted => "tilted",
            StoredDoubt::Turned => "turned",
        }
    }
}

/// Something worth telling the operator or the log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// The mode changed.
    ModeChanged {
        /// When.
        time: Time,
        /// To what.
        to: Mode,
    },
    /// A measurement was not used.
    Rejected {
        /// Its time of validity.
        time: Time,
        /// From whom.
        source: Source,
        /// Of which aid: `gnss_position`, `log_bottom`, ...
        aid: &'static str,
        /// Why.
        reason: Rejection,
    },
    /// IMU samples were missing; the gap was bridged with interpolated increments.
    ImuGap {
        /// End of the gap.
        time: Time,
        /// Missing time, s.
        missing: f64,
    },
    /// A ship that was taken as moored was found to have left her berth.
    LeftBerth {
        /// When it was found.
        time: Time,
    },
    /// The sensors have confirmed the stored heading, and the alignment goes on from it.
    StoredStateUsed {
        /// When.
        time: Time,
    },
    /// The stored state is not believed, and plays no part any more.
    StoredStateDropped {
        /// When.
        time: Time,
        /// Why.
        reason: StoredDoubt,
    },
    /// The position was set anew from a source that the gate had kept out for too long.
    PositionReset {
        /// When.
        time: Time,
    },
}

/// One component of an innovation: measured minus predicted, with the sigma that was expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Innovation {
    /// Time of validity.
    pub time: Time,
    /// Of which aid: `gnss_position`, ...
    pub aid: &'static str,
    /// Component, 0..2.
    pub component: u8,
    /// Measured minus predicted, SI.
    pub innovation: f64,
    /// Expected 1-sigma, SI.
    pub sigma: f64,
    /// Whether it was used.
    pub accepted: bool,
}

/// Counters of everything that was used, floored, rejected or bridged.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Counts {
    /// Measurements used, by aid.
    pub accepted: BTreeMap<&'static str, u64>,
    /// Measurements not used, by aid and reason.
    pub rejected: BTreeMap<(&'static str, Rejection), u64>,
    /// Standard deviations that were missing, zero or absurd and were replaced by a floor, by aid.
    pub floored: BTreeMap<&'static str, u64>,
    /// IMU samples used.
    pub imu_samples: u64,
    /// Gaps in the IMU data that were bridged.
    pub imu_gaps: u64,
    /// IMU samples repeated with the same time.
    pub imu_duplicates: u64,
    /// IMU samples with a time before the last one.
    pub imu_out_of_order: u64,
    /// IMU samples with values that are not finite or not physical.
    pub imu_out_of_range: u64,
}

impl Counts {
    /// All rejections of all aids.
    #[must_use]
    pub fn rejected_total(&self) -> u64 {
        self.rejected.values().sum()
    }
}
