//! What happened on the way: rejections with their reason, counters, changes of state.

use crate::stored_doubt::StoredDoubt;
use std::collections::BTreeMap;
use std::fmt;

use crate::camera::CameraTurn;
use crate::installation::Finding;
use crate::learnt::LearntTurn;
use crate::messages::Source;
use crate::party::{ReceiverChange, Stands};
use crate::ranging::RangingTurn;
use crate::satellites::{CompassRefusal, RtkTurn, SatelliteId};
use crate::solution::{Mode, SolutionSource};
use crate::source_reason::SourceReason;
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
    /// It tells the same number again and again while the ship moves.
    Frozen,
    /// A single sample far from those before and after it.
    Spike,
    /// Not usable in the present mode (for example a log before any alignment).
    NotUsable,
    /// A fix, while the ranges that it is made of are used themselves.
    RangesInUse,
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
            Rejection::Frozen => "frozen",
            Rejection::Spike => "spike",
            Rejection::NotUsable => "not_usable",
            Rejection::RangesInUse => "ranges_in_use",
        }
    }
}

/// Why a state that was saved before a crash is not gone on from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ResumeDoubt {
    /// The bytes are not what was written.
    Damaged,
    /// It was written by a program with another state.
    OtherVersion,
    /// The IMU is another one, by its error model.
    OtherImu,
    /// The sensors sit elsewhere.
    OtherMounting,
    /// Too long ago, or not in the past.
    TooOld,
    /// Of the heading too little would be left after the gap.
    TooVague,
    /// The engine is already at work.
    TooLate,
    /// The numbers cannot be a ship's.
    NotFinite,
    /// GNSS or a reference says that the ship is elsewhere.
    Position,
    /// GNSS, a log or a reference says that she moves otherwise.
    Velocity,
    /// A reference says that she points elsewhere.
    Heading,
    /// Gravity is not where down should be.
    Level,
}

impl ResumeDoubt {
    /// A short name for tables: `damaged`, `other_imu`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            ResumeDoubt::Damaged => "damaged",
            ResumeDoubt::OtherVersion => "other_version",
            ResumeDoubt::OtherImu => "other_imu",
            ResumeDoubt::OtherMounting => "other_mounting",
            ResumeDoubt::TooOld => "too_old",
            ResumeDoubt::TooVague => "too_vague",
            ResumeDoubt::TooLate => "too_late",
            ResumeDoubt::NotFinite => "not_finite",
            ResumeDoubt::Position => "position",
            ResumeDoubt::Velocity => "velocity",
            ResumeDoubt::Heading => "heading",
            ResumeDoubt::Level => "level",
        }
    }
}

impl fmt::Display for ResumeDoubt {
    /// Its short name.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl std::error::Error for ResumeDoubt {}

/// Why the mode changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ModeReason {
    /// The IMU sends data.
    ImuHeard,
    /// The IMU sends no data any more, while others do.
    ImuSilent,
    /// It is known which way is down, and where the ship is.
    Level,
    /// One heading is left.
    HeadingFound,
    /// The heading is as good as is asked for.
    HeadingSettled,
    /// The heading of a moored ship is no longer as good as is asked for.
    HeadingUnsure,
    /// GNSS is used.
    GnssInUse,
    /// GNSS is no longer used.
    GnssLost,
    /// A log or a reference is used, without GNSS.
    LogInUse,
    /// Neither GNSS nor log nor reference is used any more.
    AidsLost,
    /// A ship that was taken as moored is under way.
    LeftBerth,
    /// A state saved before a crash is gone on from.
    Resumed,
    /// That state was refuted by the sensors.
    ResumeDropped,
    /// The solution was not finite, or not on the Earth.
    NotFinite,
    /// The IMU was silent for too long to go on.
    GapTooLong,
    /// GNSS refutes the heading that was found.
    HeadingRefuted,
    /// What the IMU says does not fit how it is said to be mounted, or what it is.
    ImuDoubted,
    /// It fits again.
    ImuBelieved,
    /// After a fault it is begun anew.
    StartedOver,
}

impl ModeReason {
    /// A short name for tables: `imu_heard`, `gnss_lost`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            ModeReason::ImuHeard => "imu_heard",
            ModeReason::ImuSilent => "imu_silent",
            ModeReason::Level => "level",
            ModeReason::HeadingFound => "heading_found",
            ModeReason::HeadingSettled => "heading_settled",
            ModeReason::HeadingUnsure => "heading_unsure",
            ModeReason::GnssInUse => "gnss_in_use",
            ModeReason::GnssLost => "gnss_lost",
            ModeReason::LogInUse => "log_in_use",
            ModeReason::AidsLost => "aids_lost",
            ModeReason::LeftBerth => "left_berth",
            ModeReason::Resumed => "resumed",
            ModeReason::ResumeDropped => "resume_dropped",
            ModeReason::NotFinite => "not_finite",
            ModeReason::GapTooLong => "gap_too_long",
            ModeReason::HeadingRefuted => "heading_refuted",
            ModeReason::ImuDoubted => "imu_doubted",
            ModeReason::ImuBelieved => "imu_believed",
            ModeReason::StartedOver => "started_over",
        }
    }
}

impl fmt::Display for ModeReason {
    /// The same in words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ModeReason::ImuHeard => "the IMU sends data",
            ModeReason::ImuSilent => "the IMU is silent",
            ModeReason::Level => "it is known which way is down",
            ModeReason::HeadingFound => "one heading is left",
            ModeReason::HeadingSettled => "the heading is as good as is asked for",
            ModeReason::HeadingUnsure => "the heading is not as sure any more as is asked for",
            ModeReason::GnssInUse => "GNSS is used",
            ModeReason::GnssLost => "GNSS is not used any more",
            ModeReason::LogInUse => "a log or a reference carries her, without GNSS",
            ModeReason::AidsLost => "no GNSS, log or reference is used any more",
            ModeReason::LeftBerth => "she left her berth",
            ModeReason::Resumed => "navigation goes on from the state before the restart",
            ModeReason::ResumeDropped => "the sensors refute the state before the restart",
            ModeReason::NotFinite => "the solution was not sound and is not given",
            ModeReason::GapTooLong => "the IMU was silent for too long",
            ModeReason::HeadingRefuted => "GNSS refutes the heading that was found",
            ModeReason::ImuDoubted => "the IMU does not fit its configuration and is not used",
            ModeReason::ImuBelieved => "the IMU fits its configuration",
            ModeReason::StartedOver => "it is begun anew",
        })
    }
}

/// Something worth telling the operator or the log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// The mode changed.
    ModeChanged {
        /// When.
        time: Time,
        /// From what; `None` for the first of an engine.
        from: Option<Mode>,
        /// To what.
        to: Mode,
        /// Why.
        why: ModeReason,
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
    /// The clock that stamps the samples of the IMU stepped; they are stamped as if it had not.
    ImuClock {
        /// When, as it was before.
        time: Time,
        /// What it stepped by, ahead positive, s.
        step: f64,
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
    /// A state saved before a crash is gone on from, on trial.
    Resumed {
        /// When: the first sample of the IMU.
        time: Time,
        /// Length of the gap that was bridged, s.
        gap: f64,
    },
    /// The sensors agree with the state that is gone on from.
    ResumeConfirmed {
        /// When.
        time: Time,
    },
    /// The sensors refute the state that was gone on from; the ship is levelled anew.
    ResumeDropped {
        /// When.
        time: Time,
        /// Why.
        reason: ResumeDoubt,
    },
    /// Something of the installation is found to be otherwise than configured.
    InstallationFound {
        /// When.
        time: Time,
        /// What.
        finding: Finding,
    },
    /// Somebody is believed otherwise than before.
    Judged {
        /// When.
        time: Time,
        /// Who, and how.
        stands: Stands,
    },
    /// A satellite whose ranges contradict those of the others is left out, or used again.
    SatelliteJudged {
        /// When.
        time: Time,
        /// Which.
        satellite: SatelliteId,
        /// Whether it is left out from now on.
        is_excluded: bool,
    },
    /// RTK is believed otherwise than before.
    RtkJudged {
        /// When.
        time: Time,
        /// How.
        turn: RtkTurn,
    },
    /// Several antennas tell how the hull stands, or do not any more.
    CompassJudged {
        /// When.
        time: Time,
        /// Why they do not; `None`: they do.
        why_not: Option<CompassRefusal>,
    },
    /// A docking aid is believed otherwise than before.
    RangingJudged {
        /// When.
        time: Time,
        /// Which, in the order of the configuration.
        ranging: u8,
        /// How.
        turn: RangingTurn,
    },
    /// A camera is believed otherwise than before.
    CameraJudged {
        /// When.
        time: Time,
        /// How.
        turn: CameraTurn,
    },
    /// What is learnt of a sensor is used otherwise than before.
    Learnt {
        /// When.
        time: Time,
        /// What, and how.
        turn: LearntTurn,
    },
    /// The best source of the solution is another one.
    SourceChanged {
        /// When.
        time: Time,
        /// Before; `None` for the first.
        from: Option<SolutionSource>,
        /// From now on.
        to: SolutionSource,
        /// Why.
        why: SourceReason,
    },
    /// Another receiver is used from now on.
    ReceiverUsed {
        /// When.
        time: Time,
        /// Which.
        change: ReceiverChange,
    },
    /// The position was set anew from a source that the gate had kept out for too long.
    PositionReset {
        /// When.
        time: Time,
    },
}

/// One component of an innovation: measured minus predicted, with the sigma that was expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AidInnovation {
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

/// The innovation of a satellite's code, phase or range rate, with the sigma that was expected before any satellite of the epoch was judged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SatelliteInnovation {
    /// When the sample was taken.
    pub time: Time,
    /// What of it: `satellite_code`, `satellite_phase` or `satellite_rate`.
    pub aid: &'static str,
    /// Which satellite.
    pub satellite: SatelliteId,
    /// Measured minus predicted, m or m/s.
    pub innovation: f64,
    /// Expected 1-sigma, m or m/s.
    pub sigma: f64,
    /// Whether it was used.
    pub accepted: bool,
}

impl SatelliteInnovation {
    /// As that of an aid, whichever satellite it is of.
    #[must_use]
    pub fn of_aid(&self) -> AidInnovation {
        let SatelliteInnovation { time, aid, innovation, sigma, accepted, .. } = *self;
        AidInnovation { time, aid, component: 0, innovation, sigma, accepted }
    }
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
    /// Satellites of epochs that gave no range, by reason.
    pub unranged: BTreeMap<&'static str, u64>,
    /// Epochs against a base: `fixed`, or why none of their integers are believed; and how often RTK was `withdrawn`, contradicted (`refuted`), and
    /// agreed again (`agrees`).
    pub rtk: BTreeMap<&'static str, u64>,
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
