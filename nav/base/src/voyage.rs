//! A voyage as data: what is known at its start, its sensor messages and its truth.

use crate::GnssFix;
use crate::attitude::Attitude;
use crate::frames::{Geodetic, Ned};
use crate::messages::{ExternalReference, ImuSample, LogVelocity, Message, Received, Source};
use crate::sensor::{ImuSpec, LeverArms};
use crate::time::Time;
use crate::vessel::VesselKind;

/// What is known of the ship when the voyage starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum StartCondition {
    /// At the berth: the mean velocity is zero.
    Moored,
    /// Under way or unknown.
    #[default]
    Underway,
}

/// The contents of `voyage.toml`.
#[derive(Clone, Debug, PartialEq)]
pub struct VoyageHeader {
    /// UTC of [`Time::START`], RFC 3339.
    pub start_utc: String,
    /// What is known of the ship's motion at the start.
    pub start: StartCondition,
    /// Berth or starting position, if known.
    pub initial: Option<Geodetic>,
    /// The IMU's error model.
    pub imu: ImuSpec,
    /// Where the sensors sit.
    pub lever_arms: LeverArms,
    /// What carries them.
    pub vessel: VesselKind,
    /// How well GNSS epochs and IMU samples agree in time, 1-sigma, s, where it is known.
    pub time_std: Option<f64>,
}

/// A message and when it reached the computer; `arrival` is absent where it is the time of validity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stamped<T> {
    /// What was measured.
    pub message: T,
    /// Time of receipt, if it differs from the time of validity.
    pub arrival: Option<Time>,
}

/// The true state of the IMU at one instant. Recorded voyages may lack velocity or attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Instant.
    pub time: Time,
    /// Position of the IMU.
    pub position: Geodetic,
    /// Velocity of the IMU over the Earth, m/s.
    pub velocity: Option<Ned>,
    /// Roll, pitch and heading.
    pub attitude: Option<Attitude>,
}

/// A whole voyage in memory. Each list is in order of time of validity.
#[derive(Clone, Debug, PartialEq)]
pub struct Voyage {
    /// What is known at the start.
    pub header: VoyageHeader,
    /// IMU increments.
    pub imu: Vec<Stamped<ImuSample>>,
    /// GNSS fixes.
    pub gnss: Vec<Stamped<GnssFix>>,
    /// Log velocities.
    pub log: Vec<Stamped<LogVelocity>>,
    /// External references.
    pub reference: Vec<Stamped<ExternalReference>>,
    /// Truth, if known.
    pub truth: Vec<Truth>,
}

impl<T: Copy> Stamped<T> {
    /// A message received the moment it was valid.
    #[must_use]
    pub fn prompt(message: T) -> Self {
        Stamped { message, arrival: None }
    }
}

impl Voyage {
    /// All messages in order of receipt; at equal times IMU first, then GNSS, log, reference.
    #[must_use]
    pub fn received(&self) -> Vec<Received> {
        let capacity = self.imu.len() + self.gnss.len() + self.log.len() + self.reference.len();
        let mut all = Vec::with_capacity(capacity);
        push_all(&mut all, &self.imu, Source::Imu(0), Message::Imu);
        push_all(&mut all, &self.gnss, Source::Gnss(0), Message::Gnss);
        push_all(&mut all, &self.log, Source::Log(0), Message::Log);
        push_all(&mut all, &self.reference, Source::Reference(0), Message::Reference);
        all.sort_by_key(|received| received.receipt);
        all
    }
}

fn push_all<T: Copy>(
    all: &mut Vec<Received>,
    list: &[Stamped<T>],
    source: Source,
    wrap: impl Fn(T) -> Message,
) {
    all.extend(list.iter().map(|stamped| {
        let message = wrap(stamped.message);
        Received { receipt: stamped.arrival.unwrap_or(message.time()), source, message }
    }));
}
