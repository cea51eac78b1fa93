//! A satellite as one antenna sees it at one epoch: when the signal left, along which line it came, how long the way should be.

use insd_base::satellites::{SPEED_OF_LIGHT, Transmitter};
use insd_base::{BroadcastRecord, GpsTime, Span, earth, frames::Ecef};
use nalgebra::{Matrix3, Vector3};

use crate::atmosphere::LookAngles;
use crate::orbit::{SatelliteState, clock_alone};

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

    /// The satellite as the geometry of the range has it.
    #[must_use]
    pub fn transmitter(&self) -> Transmitter {
        Transmitter { position: self.satellite.position, velocity: self.satellite.velocity }
    }

    /// Azimuth and elevation at the antenna.
    #[must_use]
    pub fn direction(&self, antenna: &Vector3<f64>) -> LookAngles {
        let c_ne: Matrix3<f64> = earth::c_ne(&earth::geodetic(&Ecef(*antenna)));
        let n = c_ne * self.transmitter().line(antenna);
        LookAngles {
            azimuth: n.y.atan2(n.x).rem_euclid(std::f64::consts::TAU),
            elevation: (-n.z).clamp(-1.0, 1.0).asin(),
        }
    }
}
