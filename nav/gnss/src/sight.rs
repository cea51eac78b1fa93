//! A satellite as one antenna sees it at one epoch: when the signal left, along which line it came, how long the way should be.

use insd_base::satellites::SPEED_OF_LIGHT;
use insd_base::{BroadcastRecord, GpsTime, Span, earth, frames::Ecef};
use nalgebra::{Matrix3, Vector3};

use crate::atmosphere::Direction;
use crate::orbit::{SatelliteState, clock_alone};

/// Rotation rate of the Earth by which signals are carried along, rad/s (IS-GPS-200N, 20.3.3.4.3).
const EARTH_RATE: f64 = 7.292_115_146_7e-5;

/// A satellite at the instant at which it sent what was received.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Time of transmission.
    pub sent: GpsTime,
    /// The satellite then, in the axes of that instant.
    pub satellite: SatelliteState,
}

impl Sight {
    /// By a receiver's own tag and its own pseudorange, m: the sum of both clocks' errors and of the way is in it, so that the time of
    /// transmission is right to what the satellite's clock is worth (gnss.md, eq. 4; IS-GPS-200N, 20.3.3.3.3.1).
    #[must_use]
    pub fn new(record: &BroadcastRecord, tag: GpsTime, code: f64) -> Self {
        let by_its_clock = tag.plus(Span::from_seconds(-code / SPEED_OF_LIGHT));
        // its clock moves by less than 1e-18 s within the correction of its clock
        let clock = clock_alone(record, by_its_clock);
        let sent = by_its_clock.plus(Span::from_seconds(-clock));
        Self { sent, satellite: SatelliteState::at(record, sent) }
    }

    /// Geometric range to a point of the turning Earth at reception, m: `|r_s - r_a| + w/c (x_s y_a - y_s x_a)`
    /// (Groves, 2nd ed., eq. 8.37 to first order; the rest is below 0.1 mm).
    #[must_use]
    pub fn range(&self, antenna: &Vector3<f64>) -> f64 {
        let s = &self.satellite.position;
        (s - antenna).norm() + EARTH_RATE / SPEED_OF_LIGHT * (s.x * antenna.y - s.y * antenna.x)
    }

    /// Rate of [`Self::range`] for an antenna with this velocity over the Earth, m/s.
    #[must_use]
    pub fn range_rate(&self, antenna: &Vector3<f64>, velocity: &Vector3<f64>) -> f64 {
        let (s, v) = (&self.satellite.position, &self.satellite.velocity);
        let carried = v.x * antenna.y + s.x * velocity.y - v.y * antenna.x - s.y * velocity.x;
        self.line(antenna).dot(&(v - velocity)) + EARTH_RATE / SPEED_OF_LIGHT * carried
    }

    /// Unit vector e from the antenna to the satellite: the range changes by `-e . dr`.
    #[must_use]
    pub fn line(&self, antenna: &Vector3<f64>) -> Vector3<f64> {
        (self.satellite.position - antenna).normalize()
    }

    /// Azimuth and elevation at the antenna.
    #[must_use]
    pub fn direction(&self, antenna: &Vector3<f64>) -> Direction {
        let c_ne: Matrix3<f64> = earth::c_ne(&earth::geodetic(&Ecef(*antenna)));
        let n = c_ne * self.line(antenna);
        Direction {
            azimuth: n.y.atan2(n.x).rem_euclid(std::f64::consts::TAU),
            elevation: (-n.z).asin(),
        }
    }
}
