//! What the system says of the ship: a solution, its standard deviations and its mode.

use nalgebra::{SVector, Vector3};

use crate::attitude::Attitude;
use crate::frames::{Body, Geodetic, Ned};
use crate::party::Judgement;
use crate::time::Time;

/// What the system is doing, as in the last column of `nav.csv`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// No data of the IMU: before the first sample, or none for a while. A solution that says so is what
    /// receivers and compass say.
    Standby,
    /// Levelling and first search for the heading.
    CoarseAlignment,
    /// At the berth: the mean velocity is known to be zero.
    FineAlignment,
    /// Under way: the heading is being found from GNSS.
    InMotionAlignment,
    /// Aligned, GNSS in use.
    Aided,
    /// Aligned, log or reference in use, no GNSS.
    DeadReckoning,
    /// Aligned, nothing but the IMU.
    Inertial,
    /// The solution must not be used.
    Fault,
}

impl Mode {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Mode::Standby,
        Mode::CoarseAlignment,
        Mode::FineAlignment,
        Mode::InMotionAlignment,
        Mode::Aided,
        Mode::DeadReckoning,
        Mode::Inertial,
        Mode::Fault,
    ];

    /// Its word, as in `nav.csv`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Mode::Standby => "standby",
            Mode::CoarseAlignment => "coarse_alignment",
            Mode::FineAlignment => "fine_alignment",
            Mode::InMotionAlignment => "in_motion_alignment",
            Mode::Aided => "aided",
            Mode::DeadReckoning => "dead_reckoning",
            Mode::Inertial => "inertial",
            Mode::Fault => "fault",
        }
    }

    /// The mode of a word of `nav.csv`.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Mode::ALL.into_iter().find(|mode| mode.as_str() == word)
    }

    /// Whether the heading is good enough to steer and navigate by.
    #[must_use]
    pub fn is_navigating(self) -> bool {
        matches!(self, Mode::Aided | Mode::DeadReckoning | Mode::Inertial)
    }
}

/// The best source that a solution lives by, as in the column `source` of `nav.csv`, the best one first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SolutionSource {
    /// Carrier phases whose integers are believed.
    Rtk,
    /// Carrier phases against a base without integers.
    Float,
    /// Carrier phases with constants that are estimated.
    Carrier,
    /// Codes: ranges of satellites, or the fixes of a receiver.
    Code,
    /// Doppler shifts, or the velocity of a receiver.
    Doppler,
    /// No satellites.
    DeadReckoning,
}

impl SolutionSource {
    /// Its word, as in `nav.csv`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Rtk => "rtk",
            Self::Float => "float",
            Self::Carrier => "carrier",
            Self::Code => "code",
            Self::Doppler => "doppler",
            Self::DeadReckoning => "dr",
        }
    }

    /// It in words, for people.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Rtk => "RTK: carrier phases against a base, with integers",
            Self::Float => "carrier phases against a base, without integers",
            Self::Carrier => "carrier phases",
            Self::Code => "codes: ranges of satellites, or a receiver's fixes",
            Self::Doppler => "Doppler shifts, or a receiver's velocity",
            Self::DeadReckoning => "dead reckoning, without satellites",
        }
    }

    /// The source of a word of `nav.csv`.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        let all =
            [Self::Rtk, Self::Float, Self::Carrier, Self::Code, Self::Doppler, Self::DeadReckoning];
        all.into_iter().find(|source| source.as_str() == word)
    }
}

/// 1-sigma of each component of a [`Solution`], SI and radians.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SolutionSigma {
    /// North, east, down, m.
    pub position: Ned,
    /// North, east, down, m/s.
    pub velocity: Ned,
    /// Roll, rad.
    pub roll: f64,
    /// Pitch, rad.
    pub pitch: f64,
    /// Heading, rad.
    pub heading: f64,
}

impl SolutionSigma {
    /// Of all components in their order: position and velocity north, east, down, and roll, pitch, heading.
    #[must_use]
    pub fn of(all: &SVector<f64, 9>) -> Self {
        SolutionSigma {
            position: Ned(all.fixed_rows::<3>(0).into_owned()),
            velocity: Ned(all.fixed_rows::<3>(3).into_owned()),
            roll: all[6],
            pitch: all[7],
            heading: all[8],
        }
    }

    /// Of variances in the same order.
    #[must_use]
    pub fn of_variances(all: &SVector<f64, 9>) -> Self {
        Self::of(&all.map(|variance| variance.max(0.0).sqrt()))
    }

    /// Each component made of those of both.
    #[must_use]
    pub fn zip(&self, other: &Self, of: impl Fn(f64, f64) -> f64) -> Self {
        SolutionSigma {
            position: Ned(self.position.0.zip_map(&other.position.0, &of)),
            velocity: Ned(self.velocity.0.zip_map(&other.velocity.0, &of)),
            roll: of(self.roll, other.roll),
            pitch: of(self.pitch, other.pitch),
            heading: of(self.heading, other.heading),
        }
    }

    /// The greater one of each component.
    #[must_use]
    pub fn greatest(&self, other: &Self) -> Self {
        self.zip(other, f64::max)
    }

    /// The sum of each component.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    /// The root of the sum of the squares of each component.
    #[must_use]
    pub fn hypot(&self, other: &Self) -> Self {
        self.zip(other, f64::hypot)
    }

    /// All of them by a factor.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        SolutionSigma {
            position: Ned(self.position.0 * by),
            velocity: Ned(self.velocity.0 * by),
            roll: self.roll * by,
            pitch: self.pitch * by,
            heading: self.heading * by,
        }
    }
}

/// Errors of a position are below these, but for the risk.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Protection {
    /// The horizontal error, m.
    pub horizontal: f64,
    /// The error of the height, m.
    pub vertical: f64,
}

/// Where the ship is, how she moves and lies, at the IMU, and how sure that is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Time of validity.
    pub time: Time,
    /// Position.
    pub position: Geodetic,
    /// Velocity over the Earth, m/s.
    pub velocity: Ned,
    /// Roll, pitch, heading.
    pub attitude: Attitude,
    /// Angular rate of the hull with respect to the NED axes, body axes, rad/s.
    pub rate: Body,
    /// 1-sigma of the above.
    pub sigma: SolutionSigma,
    /// What the system is doing.
    pub mode: Mode,
    /// What is made of the sensors' words.
    pub judgement: Judgement,
    /// The best source in use; `None` before the ship navigates.
    pub source: Option<SolutionSource>,
    /// What faults that may be there, and that nobody has found, add to the protection levels, m. Negative where the claim covers two places, of which she
    /// is in one: a level reaches to the farther one and its errors, and not as many times as far as it does of a sigma.
    pub hidden: Protection,
}

impl Solution {
    /// Rate of turn: the change of heading, rad/s, starboard positive. Groves, 2nd ed., eq. (2.57):
    /// (omega_y sin(roll) + omega_z cos(roll)) / cos(pitch).
    #[must_use]
    pub fn rate_of_turn(&self) -> f64 {
        let (sin_r, cos_r) = self.attitude.roll.sin_cos();
        let rate: &Vector3<f64> = &self.rate.0;
        (rate.y * sin_r + rate.z * cos_r) / self.attitude.pitch.cos().max(1e-9)
    }

    /// Speed over ground, m/s.
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.velocity.0.xy().norm()
    }

    /// Course over ground, rad, [0, 2 pi), clockwise from true north. Meaningless at rest.
    #[must_use]
    pub fn course(&self) -> f64 {
        crate::units::wrap_two_pi(self.velocity.0.y.atan2(self.velocity.0.x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mode_is_found_by_its_word() {
        for word in [
            "standby",
            "coarse_alignment",
            "fine_alignment",
            "in_motion_alignment",
            "aided",
            "dead_reckoning",
            "inertial",
            "fault",
        ] {
            assert_eq!(Mode::from_word(word).unwrap().as_str(), word);
        }
        assert_eq!(Mode::from_word("AIDED"), None);
    }
}
