//! What an epoch of the compass comes to.

use insd_base::satellites::{AntennaSignal, CompassFault, CompassRefusal};
use insd_base::{Attitude, GpsTime, SatelliteId, SignalCode};
use nalgebra::Matrix3;

use super::pose::CompassPose;

/// An epoch of all antennas.
#[derive(Clone, Debug, PartialEq)]
pub struct CompassEpoch {
    /// Tag of the first antenna that was heard.
    pub tag: Option<GpsTime>,
    /// What was found, or why it is not known.
    pub told: Result<CompassFix, CompassRefusal>,
    /// Attitudes or baselines that are still possible.
    pub hypotheses: usize,
    /// What is wrong with the installation, as far as it has been found.
    pub faults: Vec<CompassFault>,
    /// Signals that were not used, and why.
    pub rejected: Vec<CompassRejection>,
}

/// Attitude or baseline by phases whose integers are believed. Nothing but phases and line biases has gone into it.
#[derive(Clone, Debug, PartialEq)]
pub struct CompassFix {
    /// What was found. Of an attitude the part that satellites do not tell (about the line between two antennas, or where there are too few of them) is what was assumed;
    /// the covariance says so.
    pub pose: CompassPose,
    /// Covariance of the small rotation about north, east and down (rad^2), or of the baseline (m^2). What satellites do not tell has ten radians or metres.
    pub covariance: Matrix3<f64>,
    /// What a filter with an attitude of its own makes an aid of; of a baseline the antennas' places are nought.
    pub signals: Vec<AntennaSignal>,
    /// Integers, cycles: of each antenna against the first that has the signal, beyond what the line bias is counted from.
    pub integers: Vec<CompassInteger>,
    /// What is left of each difference.
    pub residuals: Vec<CompassResidual>,
    /// Sum of the weighed squares of the residuals, and its degrees of freedom.
    pub chi_square: (f64, usize),
    /// The chance that the integers are wrong, all hypotheses weighed against each other.
    pub doubt: f64,
    /// The chance that rounding finds the integers of an epoch from what is predicted, if its covariance is true.
    pub success: f64,
    /// Satellites in use.
    pub satellites: usize,
}

/// An integer of one antenna.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CompassInteger {
    /// The satellite.
    pub satellite: SatelliteId,
    /// The signal.
    pub signal: SignalCode,
    /// The antenna.
    pub antenna: usize,
    /// The antenna that it is counted against.
    pub against: usize,
    /// Cycles.
    pub cycles: i64,
}

/// What is left of one difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompassResidual {
    /// The satellite.
    pub satellite: SatelliteId,
    /// The signal.
    pub signal: SignalCode,
    /// The antenna, against the mean of all.
    pub antenna: usize,
    /// m.
    pub residual: f64,
    /// The 1-sigma of the antenna's own phase, m.
    pub sigma: f64,
}

/// A signal that is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompassRejection {
    /// The satellite.
    pub satellite: SatelliteId,
    /// The signal.
    pub signal: SignalCode,
    /// The antenna, where it is one alone.
    pub antenna: Option<usize>,
    /// Why.
    pub why: CompassObjection,
}

/// Why a signal is not used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CompassObjection {
    /// It may be wrong by half a cycle.
    HalfCycle,
    /// No orbit is known that holds.
    NoOrbit,
    /// The satellite stands too low.
    Low,
    /// It does not fit the others: a reflection, or a slip by parts of a cycle.
    Contradicts {
        /// The greatest residual among its antennas, m.
        residual: f64,
        /// Its sum of weighed squares over what chance allows.
        times: f64,
    },
}

impl CompassFix {
    /// Roll, pitch and heading, rad, and the covariance of them in this order, rad^2; `None` of a baseline.
    #[must_use]
    pub fn attitude(&self) -> Option<(Attitude, Matrix3<f64>)> {
        let CompassPose::Attitude(c_nb) = &self.pose else { return None };
        let attitude = Attitude::from_c_nb(c_nb);
        let by_rotation = attitude.jacobian_of_ned_rotation();
        Some((attitude, by_rotation * self.covariance * by_rotation.transpose()))
    }

    /// Yaw (clockwise from north), pitch (upwards), rad, and length, m, of a baseline, with the covariance of them; `None` of an attitude.
    #[must_use]
    pub fn baseline(&self) -> Option<([f64; 3], Matrix3<f64>)> {
        let CompassPose::Baseline(b) = &self.pose else { return None };
        let (length, level) = (b.norm(), b.xy().norm());
        if level <= 0.0 {
            return None;
        }
        let own = [b.y.atan2(b.x).rem_euclid(std::f64::consts::TAU), (-b.z).atan2(level), length];
        let square = length * length;
        #[rustfmt::skip]
        let by_vector = Matrix3::new(
            -b.y / (level * level), b.x / (level * level), 0.0,
            b.z * b.x / (level * square), b.z * b.y / (level * square), -level / square,
            b.x / length, b.y / length, b.z / length,
        );
        Some((own, by_vector * self.covariance * by_vector.transpose()))
    }
}
