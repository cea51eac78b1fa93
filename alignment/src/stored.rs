//! The aligned state of a ship at her berth, kept over a shutdown: a warm start.
//!
//! At the next start it is offered and put on trial ([`crate::trial`]); it is never just taken over,
//! as a quay crane, a tug or a change of berth may have turned the ship meanwhile.
//!
//! What is believed of it:
//! - the heading, to its stored sigma and what a ship may yaw on her moorings between two visits;
//! - roll and pitch only as a check of the mounting, because levelling finds them better in seconds;
//! - the position only as a check of the berth;
//! - the biases only if the IMU has stayed powered ([`crate::AlignmentConfig::same_power_up`]). What a
//!   data sheet calls the turn-on bias is drawn anew at each power-up, so that after one the stored
//!   bias, widened by that sigma, says no more than the data sheet does.

use insd_base::units::DEG;
use insd_base::{Attitude, Geodetic, ImuSpec, StoredDoubt, Time, Triad, earth};
use insd_nav::berth::UNSTATED;
use insd_nav::error_state::{ACCEL_BIAS, ACCEL_DRIFT, Covariance, GYRO_BIAS, GYRO_DRIFT, POSITION};
use insd_nav::{Estimator, Navigator, Nominal};
use nalgebra::{Matrix3, Vector3};

use crate::kinematics::Kinematics;
use crate::levelling::Level;

/// An aligned state of a moored ship.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StoredState {
    /// When it was valid, in the time of the voyage that stored it.
    pub time: Time,
    /// Whether the ship lay at her berth. One that did not cannot be used.
    pub moored: bool,
    /// Fingerprint of the IMU's error model, [`fingerprint`].
    pub imu: u64,
    /// Position of the IMU.
    pub position: Geodetic,
    /// 1-sigma of each component, m.
    pub position_std: f64,
    /// Roll, pitch, heading.
    pub attitude: Attitude,
    /// 1-sigma of roll, pitch, heading, rad.
    pub attitude_std: Vector3<f64>,
    /// Gyro bias, turn-on and in-run together, body axes, rad/s.
    pub gyro_bias: Vector3<f64>,
    /// 1-sigma of the same.
    pub gyro_bias_std: Vector3<f64>,
    /// Accelerometer bias, turn-on and in-run together, body axes, m/s^2.
    pub accel_bias: Vector3<f64>,
    /// 1-sigma of the same.
    pub accel_bias_std: Vector3<f64>,
    /// Slow swaying on her moorings, 1-sigma of each horizontal component, m.
    pub sway_std: f64,
}

/// Yaw of a ship on slack moorings and in the waves that a mean heading leaves out, 1-sigma, rad.
const YAW: f64 = 1.0 * DEG;
/// Distance over which swaying of the hull's ends turns her: half the length of a coaster, m.
const HALF_LENGTH: f64 = 50.0;
/// Distance from the stored place at which the ship is at another berth, m.
const ELSEWHERE: f64 = 50.0;
/// Roll and pitch by waves at either of the two visits, 1-sigma, rad: sea state 5 at the berth.
const WAVES: f64 = 3.5 * DEG;
/// Error of the first level, 1-sigma, rad.
const LEVEL: f64 = 2.0 * DEG;
/// Sigmas beyond which roll, pitch or position are others.
const SURE: f64 = 5.0;

impl StoredState {
    /// What is worth keeping of a filter; `None` unless the ship lies at her berth. That the filter
    /// is aligned is for the caller to know.
    #[must_use]
    pub fn of(navigator: &Navigator, imu: &ImuSpec) -> Option<Self> {
        if !navigator.is_moored() {
            return None;
        }
        let (filter, solution) = (navigator.filter(), navigator.solution());
        let (nominal, p) = (filter.nominal(), filter.covariance());
        let sigma = &solution.sigma;
        let stored = StoredState {
            time: solution.time,
            moored: true,
            imu: fingerprint(imu),
            position: solution.position,
            position_std: POSITION.std(p),
            attitude: solution.attitude,
            attitude_std: Vector3::new(sigma.roll, sigma.pitch, sigma.heading),
            gyro_bias: nominal.gyro_bias + nominal.gyro_drift,
            gyro_bias_std: GYRO_BIAS.std_of_sum(GYRO_DRIFT, p),
            accel_bias: nominal.accel_bias + nominal.accel_drift,
            accel_bias_std: ACCEL_BIAS.std_of_sum(ACCEL_DRIFT, p),
            sway_std: navigator.sea_std().map_or(UNSTATED, |(_, sway)| sway),
        };
        stored.is_finite().then_some(stored)
    }

    fn is_finite(&self) -> bool {
        let angles = [self.attitude.roll, self.attitude.pitch, self.attitude.heading];
        let vectors = [
            &self.attitude_std,
            &self.gyro_bias,
            &self.gyro_bias_std,
            &self.accel_bias,
            &self.accel_bias_std,
        ];
        let place = [self.position.latitude, self.position.longitude, self.position.height];
        let scalars = [self.position_std, self.sway_std];
        angles.iter().chain(&place).chain(&scalars).all(|value| value.is_finite())
            && vectors.iter().all(|vector| vector.iter().all(|value| value.is_finite()))
    }

    /// 1-sigma of the heading at the next start, rad: her yaw then and now are different ones.
    #[must_use]
    pub fn heading_std(&self) -> f64 {
        let yaw = YAW.hypot(self.sway_std / HALF_LENGTH);
        self.attitude_std.z.hypot(yaw)
    }

    /// What speaks against it before any motion has been seen.
    #[must_use]
    pub fn doubt(
        &self,
        imu: &ImuSpec,
        level: &Level,
        kinematics: &Kinematics,
    ) -> Option<StoredDoubt> {
        if self.imu != fingerprint(imu) {
            return Some(StoredDoubt::OtherImu);
        }
        if !self.moored || !kinematics.moored {
            return Some(StoredDoubt::NotMoored);
        }
        if self.is_elsewhere(&kinematics.position) {
            return Some(StoredDoubt::Moved);
        }
        let now =
            level.attitude(self.attitude.heading, &kinematics.position, &kinematics.acceleration);
        let limit = SURE * LEVEL.hypot(WAVES * std::f64::consts::SQRT_2);
        let roll = (now.roll - self.attitude.roll).abs();
        let pitch = (now.pitch - self.attitude.pitch).abs();
        (roll > SURE * self.attitude_std.x + limit || pitch > SURE * self.attitude_std.y + limit)
            .then_some(StoredDoubt::Tilted)
    }

    /// Whether a place at which the ship is now is another than the stored one.
    #[must_use]
    pub fn is_elsewhere(&self, place: &Geodetic) -> bool {
        let level = Geodetic { height: self.position.height, ..*place };
        let distance = (earth::ecef(&level).0 - earth::ecef(&self.position).0).norm();
        distance > ELSEWHERE.max(SURE * self.position_std)
    }

    /// Brings what is known of the biases into an estimate and its covariance.
    pub fn carry_biases(&self, nominal: &mut Nominal, p: &mut Covariance) {
        let squares = |std: &Vector3<f64>| Matrix3::from_diagonal(&std.component_mul(std));
        nominal.gyro_bias = self.gyro_bias;
        GYRO_BIAS.renew(p, &squares(&self.gyro_bias_std));
        nominal.accel_bias = self.accel_bias;
        ACCEL_BIAS.renew(p, &squares(&self.accel_bias_std));
    }
}

/// A number that tells IMUs apart by their error model: FNV-1a (Fowler, Noll and Vo) over its values
/// with nine digits, so that a change of units and back leaves it as it is.
#[must_use]
pub fn fingerprint(imu: &ImuSpec) -> u64 {
    let of =
        |t: &Triad| [t.bias_std, t.instability_std, t.instability_time, t.random_walk, t.scale_std];
    let values = std::iter::once(imu.rate).chain(of(&imu.gyro)).chain(of(&imu.accel));
    values
        .flat_map(|value| format!("{value:.8e};").into_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
}
