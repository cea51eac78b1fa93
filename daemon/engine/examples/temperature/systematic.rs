//! Errors that a data sheet does not have.

use std::f64::consts::TAU;

use insd_base::Voyage;
use insd_base::units::DEG_PER_HOUR;
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// Temperature at which the IMU was calibrated, degrees Celsius.
const CALIBRATED: f64 = 25.0;
/// Change of a bias with the temperature, 1-sigma, by the kelvin: gyros, rad/s, and accelerometers, m/s^2.
const GYRO: f64 = 2.0 * DEG_PER_HOUR;
const ACCEL: f64 = 1e-3;
/// And by its square.
const GYRO_SQUARE: f64 = 0.15 * DEG_PER_HOUR;
const ACCEL_SQUARE: f64 = 2e-5;
/// Scale of the yaw gyro, as it turns and by its sense, 1-sigma.
const SCALE: f64 = 4e-3;
/// Scale of the log, 1-sigma, and its change with the square of the speed, by (10 m/s)^2.
const LOG: [f64; 2] = [0.02, 0.01];
/// The temperature swings by this, K, within this, s.
const SWING: [f64; 2] = [7.0, 2000.0];
/// It rises by this over two hours, K.
const RISE: f64 = 6.0;

/// The errors of one ship.
struct Systematic {
    gyro: [Vector3<f64>; 2],
    accel: [Vector3<f64>; 2],
    scale: [f64; 2],
    log: [f64; 2],
    phase: f64,
}

impl Systematic {
    fn drawn(seed: u64) -> Self {
        let mut rng = Pcg64::seed_from_u64(seed ^ 0x7e47);
        let mut normal = || -> f64 { StandardNormal.sample(&mut rng) };
        let mut three = |std: f64| Vector3::from_fn(|_, _| std * normal());
        let gyro = [GYRO, GYRO_SQUARE].map(&mut three);
        let accel = [ACCEL, ACCEL_SQUARE].map(three);
        let [scale, log] = [[SCALE; 2], LOG].map(|stds| stds.map(|std| std * normal()));
        Systematic { gyro, accel, scale, log, phase: TAU * normal() }
    }

    /// Difference from the temperature at which the IMU was calibrated, K.
    fn warmth(&self, t: f64) -> f64 {
        let [swing, period] = SWING;
        swing * (TAU * t / period + self.phase).sin() + RISE * t / 7200.0
    }
}

/// A voyage, and how warm its IMU is.
pub(crate) struct Spoilt {
    pub(crate) voyage: Voyage,
    own: Systematic,
}

impl Spoilt {
    /// Temperature of the IMU, degrees Celsius.
    pub(crate) fn celsius(&self, t: f64) -> f64 {
        CALIBRATED + self.own.warmth(t)
    }
}

/// The voyage, with such errors.
pub(crate) fn spoilt(mut voyage: Voyage, seed: u64) -> Spoilt {
    let own = Systematic::drawn(seed);
    let interval = 1.0 / voyage.header.imu.rate;
    for sample in voyage.imu.iter_mut().map(|sample| &mut sample.message) {
        let warmth = own.warmth(sample.time.as_seconds());
        let of = |errors: &[Vector3<f64>; 2]| (errors[0] + errors[1] * warmth) * warmth * interval;
        let turn = sample.delta_theta.0.z;
        let [odd, even] = own.scale;
        sample.delta_theta.0 += of(&own.gyro) + Vector3::z() * (odd * turn + even * turn.abs());
        sample.delta_velocity.0 += of(&own.accel);
    }
    for u in voyage.log.iter_mut().filter_map(|log| log.message.u.as_mut()) {
        *u *= 1.0 + own.log[0] + own.log[1] * (*u / 10.0).powi(2);
    }
    Spoilt { voyage, own }
}
