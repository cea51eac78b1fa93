//! The ranges of one epoch, ready for a filter: what is known beforehand is taken out.

use nalgebra::{Matrix3, Vector3};

use super::refusal::RangeRefusal;
use super::signal::{Constellation, SPEED_OF_LIGHT, SatelliteId};
use super::sky::{LookAngles, SignalStrength};
use crate::time::Time;

/// Rotation rate of the Earth by which signals are carried along, rad/s (IS-GPS-200N, 20.3.3.4.3).
const EARTH_RATE: f64 = 7.292_115_146_7e-5;

/// A satellite as it was when its signal left, ECEF axes of that instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transmitter {
    /// Position of its antenna, m.
    pub position: Vector3<f64>,
    /// Velocity relative to the turning Earth, m/s.
    pub velocity: Vector3<f64>,
}

impl Transmitter {
    /// Geometric range to a point of the turning Earth at reception, m: `|r_s - r_a| + w/c (x_s y_a - y_s x_a)`
    /// (Groves, 2nd ed., eq. 8.37 to first order; the rest is below 0.1 mm).
    #[must_use]
    pub fn range(&self, antenna: &Vector3<f64>) -> f64 {
        let s = &self.position;
        (s - antenna).norm() + EARTH_RATE / SPEED_OF_LIGHT * (s.x * antenna.y - s.y * antenna.x)
    }

    /// Rate of [`Self::range`] for an antenna with this velocity over the Earth, m/s.
    #[must_use]
    pub fn range_rate(&self, antenna: &Vector3<f64>, velocity: &Vector3<f64>) -> f64 {
        let (s, v) = (&self.position, &self.velocity);
        let carried = v.x * antenna.y + s.x * velocity.y - v.y * antenna.x - s.y * velocity.x;
        self.line(antenna).dot(&(v - velocity)) + EARTH_RATE / SPEED_OF_LIGHT * carried
    }

    /// Unit vector e from the antenna to the satellite: the range changes by `-e . dr`.
    #[must_use]
    pub fn line(&self, antenna: &Vector3<f64>) -> Vector3<f64> {
        (self.position - antenna).normalize()
    }

    /// How the range changes with the antenna's place, and its rate with the antenna's velocity: `-e` and what the turning Earth adds.
    #[must_use]
    pub fn gradient(&self, antenna: &Vector3<f64>) -> Vector3<f64> {
        let s = &self.position;
        Vector3::new(-s.y, s.x, 0.0) * (EARTH_RATE / SPEED_OF_LIGHT) - self.line(antenna)
    }
}

/// A measured quantity and the variance of its noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Its value.
    pub value: f64,
    /// Variance of the part of its error that is another one in each epoch.
    pub variance: f64,
}

/// Carrier phase as a range with a constant: the same one as long as the arc is the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcPhase {
    /// Range and a constant, m.
    pub phase: Measured,
    /// Which arc: another number after each break of tracking.
    pub arc: u32,
}

/// What one satellite tells of an antenna. The satellite's clock and the models of the atmosphere are taken out, the receiver's clock is not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SatelliteRange {
    /// The satellite.
    pub satellite: SatelliteId,
    /// Where it is measured from the antenna that the lever arm is of, body axes, m: in the middle of several antennas that have it.
    pub offset: Vector3<f64>,
    /// Where it was.
    pub transmitter: Transmitter,
    /// Above the horizon, rad.
    pub elevation: f64,
    /// Range and the receiver's clock, m.
    pub code: Option<Measured>,
    /// Rate of both, m/s.
    pub rate: Option<Measured>,
    /// Range, clock and a constant, m.
    pub phase: Option<ArcPhase>,
    /// 1-sigma of what orbit, clock and atmosphere are off by for an hour, m.
    pub slow_std: f64,
    /// How the code changes with the share by which the ionosphere as a whole is more than its model, m.
    pub by_ionosphere: f64,
    /// 1-sigma of what reflections add to the code for a minute, m.
    pub multipath_std: f64,
}

/// How far an antenna has moved, by the phases of its satellites alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AntennaDisplacement {
    /// Since this epoch.
    pub since: Time,
    /// ECEF axes, m.
    pub by: Vector3<f64>,
    /// Its covariance, m^2.
    pub covariance: Matrix3<f64>,
}

/// The ranges that one receiver took together.
#[derive(Clone, Debug, PartialEq)]
pub struct SatelliteRanges {
    /// When the sample was taken: the receiver's tag less what its clock was ahead.
    pub time: Time,
    /// The receiver's clock ahead of GPS time and its drift, m and m/s, where the epoch alone tells them.
    pub clock: Option<(f64, f64)>,
    /// Satellites in their order, each once.
    pub ranges: Vec<SatelliteRange>,
    /// How far the antenna has moved since the epoch before, where enough satellites were tracked through both.
    pub displacement: Option<AntennaDisplacement>,
    /// All satellites that the receiver heard, with a range or without.
    pub heard: Vec<HeardSatellite>,
}

/// A satellite that a receiver hears, for those who look on: nothing is reckoned with it.
#[derive(Clone, Debug, PartialEq)]
pub struct HeardSatellite {
    /// Which.
    pub satellite: SatelliteId,
    /// Where it stands, if its orbit and the place of the antenna are known.
    pub direction: Option<LookAngles>,
    /// The best signal of each band, in order of the bands.
    pub signals: Vec<SignalStrength>,
    /// Why it has no range; `None` where it has one.
    pub refused: Option<RangeRefusal>,
    /// Its codes contradict those of all others in the position that the epoch alone makes.
    pub is_outlier: bool,
}

/// Whose time a constellation keeps, with which a receiver has one offset.
#[must_use]
pub fn time_keeper(constellation: Constellation) -> Constellation {
    match constellation {
        Constellation::Qzss => Constellation::Gps,
        other => other,
    }
}
