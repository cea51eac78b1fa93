//! What is known at one instant of one point of the ship.

use insd_base::{
    AlignmentPhase, AlignmentStatus, Finding, Heave, Ned, Solution, Span, StorageFaults, Time,
    UtcTime,
};
use insd_n2k::pgn::TimeSource;

use crate::docking::Docking;
use crate::schedule::Boundary;

/// A levelling that has said nothing for longer than this has come to a halt: it speaks every 10 s.
const LEVELLING: Span = Span::from_nanos(15_000_000_000);

/// What is known at one instant; what is not known is `None` and is sent as not available.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputEpoch {
    /// The instant: time of validity of everything here. It decides which messages are due.
    pub time: Time,
    /// Where that point is, how the ship moves and lies.
    pub solution: Option<Solution>,
    /// Acceleration of the point over the Earth, m/s^2.
    pub acceleration: Option<Ned>,
    /// Rate of turn, rad/s, starboard positive, where it is not simply that of the solution but damped.
    pub rate_of_turn: Option<f64>,
    /// North-east element of the covariance of the solution's position, m^2. With it the ellipse of the
    /// horizontal error is known, without it only its extent to the north and to the east.
    pub covariance_north_east: Option<f64>,
    /// Since when the mode of the solution is what it is.
    pub mode_since: Option<Time>,
    /// Since when its source is what it is.
    pub source_since: Option<Time>,
    /// The instant in UTC.
    pub utc: Option<UtcTime>,
    /// What UTC is known from.
    pub time_source: Option<TimeSource>,
    /// Heave of the point.
    pub heave: Option<Heave>,
    /// Magnetic variation at the ship.
    pub variation: Option<Variation>,
    /// Height of the geoid above the ellipsoid at the ship, m, where it is not to be that of EGM96.
    pub geoid: Option<f64>,
    /// Velocity of the water over ground, m/s: the current. Its down component is not used.
    pub current: Option<Ned>,
    /// What the receiver in use says of its fix.
    pub receiver: Option<SatelliteGeometry>,
    /// Distance run since the start, through the water and over ground, m.
    pub distance: Distance,
    /// How the alignment stands.
    pub alignment: Option<AlignmentStatus>,
    /// Whether two engines are apart by more than they claim.
    pub engines_differ: bool,
    /// What of the installation is found to be otherwise than configured.
    pub doubts: Doubts,
    /// Which references that are watched are contradicted.
    pub contradicted: Contradicted,
    /// What cannot be written on the disk.
    pub storage: StorageFaults,
    /// How the ship stands to the berth that is chosen or near.
    pub docking: Option<Docking>,
    /// Velocity of the stern over the Earth, where it is known which point that is, m/s.
    pub stern: Option<Ned>,
}

/// What of the installation is found to be otherwise than configured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Doubts {
    /// How the IMU is mounted, or what it tells.
    pub mounting: bool,
    /// Lever arms, delays, logs.
    pub installation: bool,
    /// Sensors that stand still.
    pub bad_data: bool,
    /// An IMU that contradicts the others, whichever engine has it.
    pub imu: bool,
}

impl Doubts {
    /// Those of a list of findings.
    #[must_use]
    pub fn of(findings: &[Finding]) -> Self {
        Doubts {
            mounting: findings.iter().any(Finding::doubts_imu),
            installation: findings
                .iter()
                .any(|it| it.is_fault() && !it.doubts_imu() && !it.is_bad_data()),
            bad_data: findings.iter().any(Finding::is_bad_data),
            imu: false,
        }
    }
}

/// Title or description of an alert.
pub type AlertText = insd_wire::nmea::Text<64>;

/// Which references that are watched are contradicted: what is to be told of each quantity; `None` where all agree.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Contradicted {
    /// Headings.
    pub heading: Option<AlertText>,
    /// Positions.
    pub position: Option<AlertText>,
    /// Roll and pitch.
    pub attitude: Option<AlertText>,
}

/// Distance run since the start, m.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Distance {
    /// Through the water.
    pub water: Option<f64>,
    /// Over ground.
    pub ground: Option<f64>,
}

/// Magnetic variation and where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variation {
    /// East positive, rad.
    pub value: f64,
    /// Year of the World Magnetic Model: 2025 for WMM 2025.
    pub model: u16,
    /// The day for which it was computed, days since 1970-01-01; `None` if not known.
    pub day: Option<u16>,
}

/// What a receiver says of its fix beside position and velocity.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SatelliteGeometry {
    /// Satellites used.
    pub satellites: Option<u16>,
    /// Horizontal dilution of precision.
    pub hdop: Option<f64>,
    /// Vertical dilution of precision.
    pub vdop: Option<f64>,
    /// Position dilution of precision.
    pub pdop: Option<f64>,
    /// Time dilution of precision.
    pub tdop: Option<f64>,
}

impl OutputEpoch {
    /// Its instant on the grid of the outputs: that of UTC as soon as it is known.
    pub(crate) fn boundary(&self) -> Boundary {
        Boundary { time: self.time, utc: self.utc }
    }

    /// An instant of which nothing else is known.
    #[must_use]
    pub fn unknown(time: Time) -> Self {
        OutputEpoch {
            time,
            solution: None,
            acceleration: None,
            rate_of_turn: None,
            covariance_north_east: None,
            mode_since: None,
            source_since: None,
            utc: None,
            time_source: None,
            heave: None,
            variation: None,
            geoid: None,
            current: None,
            receiver: None,
            distance: Distance::default(),
            alignment: None,
            engines_differ: false,
            doubts: Doubts::default(),
            contradicted: Contradicted::default(),
            storage: StorageFaults::default(),
            docking: None,
            stern: None,
        }
    }
    /// Whether it is being found which way is down: there cannot be a solution yet.
    pub(crate) fn is_levelling(&self) -> bool {
        let goes_on = |status: &AlignmentStatus| {
            status.phase == AlignmentPhase::Levelling && self.time - status.time <= LEVELLING
        };
        self.solution.is_none() && self.alignment.as_ref().is_some_and(goes_on)
    }
}
