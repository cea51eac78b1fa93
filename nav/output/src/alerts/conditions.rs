//! Which alerts there are, and when each of them holds.

use insd_base::{FixQuality, Integrity, Judgement, Mode, Parties, Party, Solution, Span, Time};
use insd_wire::nmea::{AlertId, AlertPriority, HeadingMode, Manufacturer};

use crate::docking::{Docking, DockingLimits};
use crate::epoch::{AlertText, OutputEpoch};
use crate::policy::Policy;

/// Mnemonic under which our own alerts go, that of the PINSD sentences. It is not registered anywhere.
const MANUFACTURER: &str = "INS";

/// What an alert is raised for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Condition {
    /// There is no solution that may be used, and none is in the making: the IMU is silent, or the
    /// solution is known to be wrong. Standard alert 3062 of ISO 8728.
    SystemFault,
    /// The heading was valid and is not any more: THS says V.
    HeadingLost,
    /// The heading is less certain than it should be: THS says E.
    HeadingDegraded,
    /// The position was valid and is not any more: GGA says 0.
    PositionLost,
    /// The position is estimated: GGA says 6. While she aligns at her berth that is so by design, and only a
    /// position of little certainty raises it.
    PositionEstimated,
    /// UTC is not known.
    NoUtc,
    /// The data come from a simulator.
    Simulated,
    /// Two engines are apart by more than they claim: at least one is wrong.
    EnginesDiffer,
    /// The IMU does not seem to be mounted as configured, or does not tell what it should: heading, roll and
    /// pitch are not to be used.
    MountingDoubt,
    /// Something else of the installation is found to be otherwise than configured, such as a lever arm.
    Installation,
    /// GNSS, or its first receiver, contradicts the others and is left out.
    GnssExcluded,
    /// Sensors contradict each other, and it is not known who is wrong.
    PositionDoubt,
    /// The heading reference contradicts the others and is left out.
    HeadingExcluded,
    /// The log contradicts the others and is left out.
    LogExcluded,
    /// Another reference of position, or another receiver than the first, contradicts the others and is left out.
    ReferenceExcluded,
    /// A docking aid contradicts the others and is left out.
    DockingExcluded,
    /// The IMU contradicts the others.
    ImuDoubt,
    /// GNSS is used again that was found to lie, and nothing shows that it does not any more.
    OnTrial,
    /// The level of the position is beyond the alert limit that is set.
    AlertLimit,
    /// A sensor tells nonsense, such as the same number again and again.
    BadData,
    /// What arrives cannot be recorded: the disk is full, or the folder is gone or read-only.
    NotRecording,
    /// What the next start goes on from cannot be saved.
    NotSaving,
    /// What waits for a fleet cannot be put away.
    NotSpooling,
    /// At the berth that is chosen she would touch faster than the limit that is set.
    ApproachFast,
    /// A part of her is nearer to the quay that is chosen than the limit that is set, and still comes nearer.
    QuayNear,
    /// A compass that is watched and not used is too far from our heading, or from another one.
    HeadingMonitor,
    /// The same of a position reference.
    PositionMonitor,
    /// The same of an attitude reference.
    AttitudeMonitor,
}

/// An alert that there can be.
struct Definition {
    manufacturer: Option<Manufacturer>,
    identifier: u32,
    priority: AlertPriority,
    title: &'static str,
    description: &'static str,
    /// For how many seconds the condition must hold, and be gone, before the alert is raised and
    /// rectified.
    delays: [u8; 2],
}

/// An alert of our own.
fn own(
    identifier: u32,
    priority: AlertPriority,
    [title, description]: [&'static str; 2],
    delays: [u8; 2],
) -> Definition {
    let manufacturer = Manufacturer::new(MANUFACTURER);
    Definition { manufacturer, identifier, priority, title, description, delays }
}

impl Condition {
    /// All of them, those that matter most first.
    pub const ALL: [Condition; 28] = [
        Condition::SystemFault,
        Condition::HeadingLost,
        Condition::PositionLost,
        Condition::PositionDoubt,
        Condition::MountingDoubt,
        Condition::ImuDoubt,
        Condition::GnssExcluded,
        Condition::EnginesDiffer,
        Condition::ApproachFast,
        Condition::QuayNear,
        Condition::HeadingMonitor,
        Condition::PositionMonitor,
        Condition::AttitudeMonitor,
        Condition::HeadingDegraded,
        Condition::PositionEstimated,
        Condition::HeadingExcluded,
        Condition::LogExcluded,
        Condition::ReferenceExcluded,
        Condition::DockingExcluded,
        Condition::OnTrial,
        Condition::AlertLimit,
        Condition::BadData,
        Condition::Installation,
        Condition::NotRecording,
        Condition::NotSaving,
        Condition::NotSpooling,
        Condition::NoUtc,
        Condition::Simulated,
    ];

    /// Which alert it is. There is one instance of each, which has no number.
    #[must_use]
    pub fn alert(self) -> AlertId {
        let Definition { manufacturer, identifier, .. } = self.definition();
        AlertId { manufacturer, identifier, instance: None }
    }

    /// How urgent it is when it is raised.
    #[must_use]
    pub fn priority(self) -> AlertPriority {
        self.definition().priority
    }

    /// Its title, at most 16 characters.
    #[must_use]
    pub fn title(self) -> &'static str {
        self.definition().title
    }

    /// What it means or what to do, at most 36 characters.
    #[must_use]
    pub fn description(self) -> &'static str {
        self.definition().description
    }

    /// What it says at an epoch instead of its usual description, where there is something.
    #[must_use]
    pub fn detail(self, epoch: &OutputEpoch) -> Option<AlertText> {
        match self {
            Condition::HeadingMonitor => epoch.contradicted.heading,
            Condition::PositionMonitor => epoch.contradicted.position,
            Condition::AttitudeMonitor => epoch.contradicted.attitude,
            _ => None,
        }
    }

    fn definition(self) -> Definition {
        use AlertPriority::{Caution, Warning};
        match self {
            Condition::SystemFault => Definition {
                manufacturer: None,
                ..own(3062, Warning, ["System fault", "No solution. Check the IMU"], [5, 5])
            },
            Condition::HeadingLost => {
                own(10_001, Warning, ["Heading lost", "Use another heading"], [2, 10])
            }
            Condition::PositionLost => {
                own(10_002, Warning, ["Position lost", "Use another position"], [2, 10])
            }
            Condition::HeadingDegraded => {
                own(10_003, Caution, ["Heading degraded", "Heading is less certain"], [10, 30])
            }
            Condition::PositionEstimated => {
                own(10_004, Caution, ["Pos. estimated", "No GNSS or little certainty"], [10, 30])
            }
            Condition::NoUtc => own(10_005, Caution, ["No UTC", "Times are left empty"], [60, 10]),
            Condition::Simulated => {
                own(10_006, Caution, ["Simulated data", "Do not use for navigation"], [0, 0])
            }
            Condition::NotRecording | Condition::NotSaving | Condition::NotSpooling => {
                self.of_storage()
            }
            // the engines have already been apart, and close, for long enough
            Condition::EnginesDiffer => {
                own(10_007, Warning, ["Engines differ", "Compare with another heading"], [0, 0])
            }
            // what was found has persisted for long enough
            Condition::MountingDoubt => {
                own(10_020, Warning, ["Mounting doubt", "IMU not as configured. See page"], [0, 10])
            }
            Condition::AlertLimit => {
                own(10_016, Warning, ["Alert limit", "Error may exceed the limit set"], [10, 10])
            }
            Condition::BadData => {
                own(10_018, Caution, ["Bad data", "A sensor stands still. See page"], [0, 10])
            }
            Condition::Installation => {
                own(10_021, Caution, ["Installation", "Not as configured. See page"], [0, 10])
            }
            Condition::ApproachFast | Condition::QuayNear => self.of_approach(),
            Condition::HeadingMonitor | Condition::PositionMonitor | Condition::AttitudeMonitor => {
                self.of_watched()
            }
            Condition::GnssExcluded
            | Condition::PositionDoubt
            | Condition::HeadingExcluded
            | Condition::LogExcluded
            | Condition::ImuDoubt
            | Condition::OnTrial
            | Condition::DockingExcluded
            | Condition::ReferenceExcluded => self.of_sensors(),
        }
    }

    /// Those of what cannot be written.
    fn of_storage(self) -> Definition {
        use AlertPriority::Caution;
        match self {
            Condition::NotRecording => own(
                10_030,
                Caution,
                ["Not recording", "Disk full or folder gone. See page"],
                [0, 10],
            ),
            Condition::NotSpooling => own(
                10_032,
                Caution,
                ["Fleet not told", "Disk full or folder gone. See log"],
                [0, 10],
            ),
            // the state of the next start
            _ => own(10_031, Caution, ["State not saved", "A restart would align anew"], [0, 10]),
        }
    }

    /// Those of going alongside.
    fn of_approach(self) -> Definition {
        use AlertPriority::{Caution, Warning};
        match self {
            Condition::ApproachFast => {
                own(10_040, Warning, ["Approach speed", "Contact faster than the limit"], [1, 3])
            }
            // a part is near
            _ => own(10_041, Caution, ["Quay near", "Nearer than the limit and closing"], [1, 3]),
        }
    }

    /// Those of references that are watched: they have differed for long enough.
    fn of_watched(self) -> Definition {
        use AlertPriority::{Caution, Warning};
        match self {
            Condition::HeadingMonitor => {
                own(10_050, Warning, ["Heading monitor", "Compasses differ. See page"], [0, 10])
            }
            Condition::PositionMonitor => {
                own(10_051, Warning, ["Position monitor", "Positions differ. See page"], [0, 10])
            }
            // how she leans
            _ => own(10_052, Caution, ["Attitude monitor", "Tilts differ. See page"], [0, 10]),
        }
    }

    /// Those that the judge of the sensors raises, who has looked for long enough.
    fn of_sensors(self) -> Definition {
        use AlertPriority::{Caution, Warning};
        match self {
            Condition::GnssExcluded => {
                own(10_008, Warning, ["GNSS excluded", "Contradicted. See page"], [0, 10])
            }
            Condition::PositionDoubt => own(
                10_009,
                Warning,
                ["Position doubt", "Sources contradict. Fix by radar"],
                [2, 10],
            ),
            Condition::HeadingExcluded => own(
                10_010,
                Caution,
                ["Compass doubtful", "Contradicted. Compare headings"],
                [0, 10],
            ),
            Condition::LogExcluded => {
                own(10_011, Caution, ["Log doubtful", "Contradicted. Check speed"], [0, 10])
            }
            Condition::ImuDoubt => {
                own(10_012, Warning, ["IMU doubtful", "Use other heading and attitude"], [0, 10])
            }
            Condition::OnTrial => {
                own(10_015, Caution, ["Source on trial", "Was excluded. Not yet trusted"], [0, 10])
            }
            Condition::DockingExcluded => {
                own(10_023, Caution, ["Docking aid out", "Contradicted. See page"], [0, 10])
            }
            // another reference of position
            _ => own(10_022, Caution, ["2nd pos. doubt", "Contradicted. See page"], [0, 10]),
        }
    }

    /// Whether one of going alongside holds.
    fn holds_at(self, docking: &Docking, limits: &DockingLimits) -> bool {
        match self {
            Condition::ApproachFast => limits.is_too_fast(docking),
            _ => limits.is_too_near(docking),
        }
    }

    /// For how long it must hold, or be gone, before that counts.
    fn delay(self, holds: bool) -> Span {
        let [raised, rectified] = self.definition().delays;
        Span::from_seconds(f64::from(if holds { raised } else { rectified }))
    }
}

/// Finds which conditions hold, from one epoch after the other.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Watch {
    /// Whether the heading and the position have been valid since the start.
    had_heading: bool,
    had_position: bool,
    latches: [Latch; Condition::ALL.len()],
}

/// What counts, and since when it is the other way.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
struct Latch {
    holds: bool,
    otherwise: Option<Time>,
}

impl Watch {
    /// Takes note of an epoch, by the limits of a policy and those of an approach; gives which conditions hold now.
    pub fn note(
        &mut self,
        epoch: &OutputEpoch,
        policy: &Policy,
        approach: &DockingLimits,
        simulated: bool,
    ) -> [(Condition, bool); Condition::ALL.len()] {
        let usable = epoch.solution.filter(|solution| solution.mode != Mode::Fault);
        let heading = usable.map(|solution| policy.heading(&solution));
        let quality = usable.map(|solution| policy.quality(&solution));
        self.had_heading |= heading.is_some_and(|mode| mode != HeadingMode::NotValid);
        self.had_position |= quality.is_some_and(|quality| quality != FixQuality::Invalid);
        let (had_heading, had_position) = (self.had_heading, self.had_position);
        let is_estimated = usable.is_some_and(|solution| is_estimated(policy, &solution));
        let Judgement { integrity, excluded } =
            epoch.solution.map(|solution| solution.judgement).unwrap_or_default();
        let is_spare_out = [Party::Gnss2, Party::Gnss3].iter().any(|own| excluded.contains(*own));
        let is_aided = usable.is_some_and(|solution| solution.mode == Mode::Aided);
        let holds = |condition| match condition {
            Condition::SystemFault => {
                usable.is_none_or(|solution| solution.mode == Mode::Standby)
                    && !epoch.is_levelling()
            }
            Condition::HeadingLost => had_heading && heading == Some(HeadingMode::NotValid),
            Condition::HeadingDegraded => heading == Some(HeadingMode::Estimated),
            Condition::PositionLost => had_position && quality == Some(FixQuality::Invalid),
            Condition::PositionEstimated => is_estimated,
            Condition::NoUtc => epoch.utc.is_none(),
            Condition::Simulated => simulated,
            Condition::EnginesDiffer => epoch.engines_differ,
            Condition::MountingDoubt => epoch.doubts.mounting,
            Condition::GnssExcluded => {
                excluded.contains(Party::Gnss) || (is_spare_out && !is_aided)
            }
            Condition::PositionDoubt => integrity == Integrity::Contradiction,
            Condition::HeadingExcluded => is_compass_out(excluded),
            Condition::DockingExcluded => excluded.contains(Party::Docking),
            Condition::LogExcluded => excluded.contains(Party::Log),
            Condition::ReferenceExcluded => excluded.contains(Party::Reference) || is_spare_out,
            Condition::ImuDoubt => {
                let is_doubted = excluded.contains(Party::Imu) || epoch.doubts.imu;
                is_doubted && !epoch.doubts.mounting
            }
            Condition::OnTrial => integrity == Integrity::Unproven,
            Condition::AlertLimit => usable.is_some_and(|own| is_beyond_limit(policy, &own)),
            Condition::BadData => epoch.doubts.bad_data,
            Condition::Installation => epoch.doubts.installation,
            Condition::NotRecording => epoch.storage.recording,
            Condition::NotSaving => epoch.storage.state,
            Condition::NotSpooling => epoch.storage.fleet,
            Condition::HeadingMonitor | Condition::PositionMonitor | Condition::AttitudeMonitor => {
                condition.detail(epoch).is_some()
            }
            Condition::ApproachFast | Condition::QuayNear => {
                epoch.docking.is_some_and(|own| condition.holds_at(&own, approach))
            }
        };
        let found = Condition::ALL.map(|condition| (condition, holds(condition)));
        self.settled(found, epoch.time)
    }

    /// What has held, or been gone, for long enough.
    fn settled(
        &mut self,
        mut found: [(Condition, bool); Condition::ALL.len()],
        now: Time,
    ) -> [(Condition, bool); Condition::ALL.len()] {
        for ((condition, holds), latch) in found.iter_mut().zip(&mut self.latches) {
            latch.note(*holds, now, condition.delay(*holds));
            *holds = latch.holds;
        }
        found
    }
}

/// Whether a compass is left out.
fn is_compass_out(excluded: Parties) -> bool {
    [Party::Heading, Party::Antennas].iter().any(|own| excluded.contains(*own))
}

/// Whether a position is estimated. At the berth that is so by design, and only little certainty counts.
fn is_estimated(policy: &Policy, solution: &Solution) -> bool {
    let by_sigma = Policy { estimated_without_gnss: false, ..*policy };
    let at_berth = matches!(solution.mode, Mode::CoarseAlignment | Mode::FineAlignment);
    let own = if at_berth { &by_sigma } else { policy };
    own.quality(solution) == FixQuality::Estimated
}

/// Whether the level of a position is beyond the alert limit, if there is one.
fn is_beyond_limit(policy: &Policy, solution: &Solution) -> bool {
    policy.alert_limit.is_some_and(|limit| solution.protection().horizontal > limit)
}

impl Latch {
    fn note(&mut self, holds: bool, now: Time, delay: Span) {
        if holds == self.holds {
            self.otherwise = None;
        } else if now - *self.otherwise.get_or_insert(now) >= delay {
            *self = Latch { holds, otherwise: None };
        }
    }
}
