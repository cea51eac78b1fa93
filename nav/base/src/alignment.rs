//! What the aligner says of itself: how sure it is, when it will be sure enough, and why not sooner.

use std::fmt;

use crate::earth;
use crate::sea_fit::SeaFit;
use crate::sensor::ImuSpec;
use crate::time::Time;
use crate::units::DEG;

/// Where alignment stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AlignmentPhase {
    /// Finding which way is down.
    Levelling,
    /// At the berth, several headings still possible.
    Searching,
    /// At the berth with one heading, which is growing better.
    Fine,
    /// Under way, without a heading to steer by.
    InMotion,
    /// At the berth: the heading has been as good as is asked for. Under way: good enough to steer by.
    Aligned,
}

impl AlignmentPhase {
    /// Its word in files: `levelling`, `searching`, `fine`, `in_motion`, `aligned`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            AlignmentPhase::Levelling => "levelling",
            AlignmentPhase::Searching => "searching",
            AlignmentPhase::Fine => "fine",
            AlignmentPhase::InMotion => "in_motion",
            AlignmentPhase::Aligned => "aligned",
        }
    }
}

/// What keeps the heading from being better, or from being good sooner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Limiting {
    /// The bias of the gyros, which looks like a wrong heading.
    GyroBias,
    /// The angular random walk of the gyros.
    RandomWalk,
    /// The motion of the ship at her berth.
    Sea,
    /// Too near to a pole: these gyros would find the heading nearer to the equator.
    Latitude,
}

impl Limiting {
    /// Its word in files: `gyro_bias`, `random_walk`, `sea`, `latitude`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Limiting::GyroBias => "gyro_bias",
            Limiting::RandomWalk => "random_walk",
            Limiting::Sea => "sea",
            Limiting::Latitude => "latitude",
        }
    }
}

/// What a forecast lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lack {
    /// Some more time: the heading is not known well enough to foresee anything.
    Time,
    /// Changes of course or speed, by which GNSS tells the heading of a ship under way.
    Manoeuvres,
    /// GNSS velocity; there is only a log or a reference, and in time the Earth's rotation may do.
    GnssVelocity,
    /// Any aid: no GNSS velocity, no log, no reference.
    Aid,
    /// A forecast: the chosen method at the berth has none.
    Method,
}

impl Lack {
    /// Its word in files: `time`, `manoeuvres`, `gnss_velocity`, `aid`, `method`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Lack::Time => "time",
            Lack::Manoeuvres => "manoeuvres",
            Lack::GnssVelocity => "gnss_velocity",
            Lack::Aid => "aid",
            Lack::Method => "method",
        }
    }
}

/// When the heading is as good as is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Forecast {
    /// It is.
    Reached {
        /// When its claimed sigma first was below the target.
        at: Time,
    },
    /// It will be.
    Expected {
        /// When.
        at: Time,
        /// Why not sooner.
        limiting: Limiting,
    },
    /// It never will be, with these sensors in this place.
    Unreachable {
        /// The 1-sigma that can be had, rad.
        best: f64,
        /// Why not less.
        limiting: Limiting,
    },
    /// Nobody knows.
    Unknown {
        /// What it would take to know.
        lacks: Lack,
    },
}

impl Forecast {
    /// Its word in files: `reached`, `expected`, `unreachable`, `unknown`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Forecast::Reached { .. } => "reached",
            Forecast::Expected { .. } => "expected",
            Forecast::Unreachable { .. } => "unreachable",
            Forecast::Unknown { .. } => "unknown",
        }
    }

    /// When the heading was or will be as good as is asked for.
    #[must_use]
    pub fn ready_at(self) -> Option<Time> {
        match self {
            Forecast::Reached { at } | Forecast::Expected { at, .. } => Some(at),
            Forecast::Unreachable { .. } | Forecast::Unknown { .. } => None,
        }
    }
}

/// 1-sigma of the attitude, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttitudeSigma {
    /// Roll.
    pub roll: f64,
    /// Pitch.
    pub pitch: f64,
    /// Heading.
    pub heading: f64,
}

/// The sea as the IMU feels it, of the last minutes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeaEstimate {
    /// Mean zero-crossing period of the heave, s; `None` in a sea too calm to tell.
    pub period: Option<f64>,
    /// Significant heave, crest to trough: four times its standard deviation, m.
    pub significant_heave: f64,
    /// The same of the horizontal motion in the waves, of both components together, m.
    pub significant_horizontal: f64,
    /// Displacement by waves that the filter at the berth assumes, 1-sigma of each component, m.
    pub waves_std: Option<f64>,
    /// Displacement by slow swaying on the moorings that it assumes, 1-sigma of each component, m.
    pub sway_std: Option<f64>,
}

/// What the aligner knows at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlignmentStatus {
    /// Instant.
    pub time: Time,
    /// Where it stands.
    pub phase: AlignmentPhase,
    /// Whether the ship is taken as lying at her berth.
    pub moored: bool,
    /// How sure the attitude is now; `None` while levelling.
    pub sigma: Option<AttitudeSigma>,
    /// Heading sigma that is asked for here, rad; `None` while nobody knows where the ship is.
    pub target: Option<f64>,
    /// Heading sigma that the bias of the gyros leaves to a gyrocompass here, rad.
    pub gyrocompass: Option<f64>,
    /// When the target is reached.
    pub ready: Forecast,
    /// The sea, once it has been seen.
    pub sea: Option<SeaEstimate>,
    /// How well the model of the sea fits, where one holds her.
    pub fit: Option<SeaFit>,
    /// How often the ship's mean place at the berth was found to have shifted.
    pub shifts: u32,
}

/// Heading sigma that counts as aligned on the equator unless another is asked for, rad.
pub const ACCURACY: f64 = 0.1 * DEG;

/// Heading sigma beyond which nobody calls it a heading, rad.
pub const NO_HEADING: f64 = 5.0 * DEG;

/// Heading sigma asked for at a latitude, rad: what is asked for on the equator times the secant of the
/// latitude, as the horizontal Earth rate is smaller, but never more than [`NO_HEADING`].
#[must_use]
pub fn heading_target(accuracy: f64, latitude: f64) -> f64 {
    (accuracy / latitude.cos().max(1e-9)).min(NO_HEADING.max(accuracy))
}

/// Heading sigma that the gyros leave to a gyrocompass at a latitude, rad: a bias to the east of sigma
/// b looks like a heading wrong by b / (omega_ie cos(lat)) (Groves, 2nd ed., eq. (5.108)). Values
/// beyond a radian say that there is no heading at all.
#[must_use]
pub fn gyrocompass_sigma(imu: &ImuSpec, latitude: f64) -> f64 {
    let bias = imu.gyro.bias_std.hypot(imu.gyro.instability_std);
    bias / (earth::RATE * latitude.cos().abs().max(1e-9))
}

impl AlignmentStatus {
    /// Whether the rotation of the Earth can tell these gyros a heading here at all.
    #[must_use]
    pub fn can_gyrocompass(&self) -> bool {
        self.gyrocompass.is_none_or(|sigma| sigma < NO_HEADING)
    }
}

impl fmt::Display for AlignmentStatus {
    /// One line for people.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.phase.as_str().replace('_', " "))?;
        if let Some(sigma) = self.sigma {
            write!(f, ", heading to {:.2} deg", sigma.heading / DEG)?;
        }
        let target = self.target.map_or(f64::NAN, |target| target / DEG);
        match self.ready {
            Forecast::Reached { at } => {
                write!(f, ", within {target:.2} deg since {:.0} s", at.as_seconds())?;
            }
            Forecast::Expected { at, limiting } => {
                let (at, why) = (at.as_seconds(), reason(limiting));
                write!(f, ", within {target:.2} deg expected at {at:.0} s ({why})")?;
            }
            Forecast::Unreachable { best, limiting } if self.can_gyrocompass() => {
                let (best, why) = (best / DEG, reason(limiting));
                write!(f, ", {target:.2} deg out of reach: at best {best:.2} deg ({why})")?;
            }
            Forecast::Unreachable { limiting, .. } => {
                let why = reason(limiting);
                write!(
                    f,
                    ", gyrocompassing is not possible ({why}): needs GNSS and motion, or a reference"
                )?;
            }
            Forecast::Unknown { lacks } => write!(f, ", {}", lack(lacks))?,
        }
        Ok(())
    }
}

fn reason(limiting: Limiting) -> &'static str {
    match limiting {
        Limiting::GyroBias => "bias of the gyros",
        Limiting::RandomWalk => "random walk of the gyros",
        Limiting::Sea => "motion of the ship",
        Limiting::Latitude => "latitude",
    }
}

fn lack(lack: Lack) -> &'static str {
    match lack {
        Lack::Time => "too early to foresee",
        Lack::Manoeuvres => "depends on manoeuvres",
        Lack::GnssVelocity => "no GNSS velocity",
        Lack::Aid => "no GNSS velocity, no log, no reference",
        Lack::Method => "no forecast with this method",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::Triad;
    use crate::units::DEG_PER_HOUR;

    fn imu(bias_deg_per_hour: f64) -> ImuSpec {
        let triad = Triad {
            bias_std: bias_deg_per_hour * DEG_PER_HOUR,
            instability_std: 0.0,
            instability_time: 1.0,
            random_walk: 0.0,
            scale_std: 0.0,
        };
        ImuSpec { rate: 100.0, gyro: triad, accel: triad }
    }

    #[test]
    fn the_target_is_twice_as_wide_at_60_degrees_and_ends_where_no_heading_is_left() {
        let target = |degrees: f64| heading_target(ACCURACY, degrees * DEG);
        assert!((target(60.0) / target(0.0) - 2.0).abs() < 1e-9);
        assert_eq!(target(90.0), NO_HEADING);
    }

    #[test]
    fn a_hundredth_of_a_degree_per_hour_is_two_minutes_of_arc_on_the_equator() {
        let minutes = gyrocompass_sigma(&imu(0.01), 0.0) / DEG * 60.0;
        assert!((minutes - 2.285).abs() < 0.01, "{minutes}");
        assert!(gyrocompass_sigma(&imu(0.01), 88.0 * DEG) < NO_HEADING);
        assert!(gyrocompass_sigma(&imu(0.01), 89.8 * DEG) > NO_HEADING);
    }

    #[test]
    fn a_status_reads_as_a_sentence() {
        let mut status = AlignmentStatus {
            time: Time::START,
            phase: AlignmentPhase::Fine,
            moored: true,
            sigma: Some(AttitudeSigma { roll: 1e-4, pitch: 1e-4, heading: 0.5 * DEG }),
            target: Some(ACCURACY),
            gyrocompass: Some(0.04 * DEG),
            ready: Forecast::Expected { at: Time::from_seconds(260.0), limiting: Limiting::Sea },
            sea: None,
            fit: None,
            shifts: 0,
        };
        let text = status.to_string();
        assert_eq!(
            text,
            "fine, heading to 0.50 deg, within 0.10 deg expected at 260 s (motion of the ship)"
        );
        status.gyrocompass = Some(12.0 * DEG);
        status.ready = Forecast::Unreachable { best: 12.0 * DEG, limiting: Limiting::Latitude };
        assert!(status.to_string().contains("gyrocompassing is not possible (latitude)"));
    }
}
