//! Lies of an IMU. Increments are what it tells, so that a bias is one times the length of the interval.

use insd_base::{Body, ImuSample, Stamped, Voyage};
use nalgebra::{Rotation3, Vector3};
use rand::RngExt;
use rand_pcg::Pcg64;

use super::{Window, shifted};
use crate::random::normal3;

/// What an IMU tells wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ImuLie {
    /// A gyro stands still at what it told.
    GyroStuck(usize),
    /// A gyro tells zero.
    GyroZero(usize),
    /// An accelerometer stands still at what it told.
    AccelStuck(usize),
    /// Everything stands still.
    AllStuck,
    /// Two axes of gyros and accelerometers are swapped.
    Swapped(usize, usize),
    /// A gyro has the wrong sign.
    GyroSign(usize),
    /// The gyros are off by a rate, rad/s.
    GyroStep(Vector3<f64>),
    /// The accelerometers are off, m/s^2.
    AccelStep(Vector3<f64>),
    /// The gyros drift off at so much a second, rad/s^2.
    GyroRamp(Vector3<f64>),
    /// Its clock steps, s.
    ClockStep(f64),
    /// It is turned about the vertical, rad.
    Turned(f64),
    /// A scale factor of gyros and accelerometers.
    Scale {
        /// Of the gyros.
        gyro: f64,
        /// Of the accelerometers.
        accel: f64,
    },
    /// Now and then a sample is far off.
    Spikes,
    /// No gyro tells more than this, rad/s.
    Clipped(f64),
    /// Such a share of the samples is lost.
    Lost(f64),
    /// Nothing is told for so long, s.
    Gap(f64),
    /// Such a share of the samples is no number.
    NotANumber(f64),
    /// The noise is so many times what it was: 1-sigma of a sample, rad and m/s.
    Noise {
        /// Of the gyros, rad.
        gyro: f64,
        /// Of the accelerometers, m/s.
        accel: f64,
    },
    /// Every sample is told twice.
    Doubled,
}

/// Share of samples that are spikes, and how far off they are, rad and m/s.
const SPIKES: f64 = 0.001;
const FAR: [f64; 2] = [0.02, 0.5];

impl ImuLie {
    pub(super) fn spoil(self, voyage: &mut Voyage, window: &Window, rng: &mut Pcg64) {
        let is_told = |sample: &Stamped<ImuSample>| window.holds(sample.message.time);
        match self {
            ImuLie::Lost(share) => {
                voyage.imu.retain(|sample| !(is_told(sample) && rng.random::<f64>() < share));
            }
            ImuLie::Gap(length) => {
                let gap = Window { from: window.from, until: window.from + length };
                voyage.imu.retain(|sample| !gap.holds(sample.message.time));
            }
            ImuLie::Doubled => {
                let again: Vec<_> = voyage.imu.iter().filter(|s| is_told(s)).copied().collect();
                voyage.imu.extend(again);
                voyage.imu.sort_by_key(|sample| sample.message.time);
            }
            _ => {
                let held = voyage.imu.iter().find(|sample| is_told(sample)).copied();
                let Some(held) = held else { return };
                let interval = interval(voyage);
                for sample in voyage.imu.iter_mut().filter(|sample| is_told(sample)) {
                    let since = window.since(sample.message.time);
                    if let ImuLie::ClockStep(by) = self {
                        sample.arrival = Some(sample.arrival.unwrap_or(sample.message.time));
                        sample.message.time = shifted(sample.message.time, by);
                    }
                    self.spoil_one(&mut sample.message, &held.message, [interval, since], rng);
                }
            }
        }
    }

    fn spoil_one(
        self,
        told: &mut ImuSample,
        held: &ImuSample,
        [interval, since]: [f64; 2],
        rng: &mut Pcg64,
    ) {
        let (theta, force) = (&mut told.delta_theta.0, &mut told.delta_velocity.0);
        match self {
            ImuLie::GyroStuck(axis) => theta[axis] = held.delta_theta.0[axis],
            ImuLie::GyroZero(axis) => theta[axis] = 0.0,
            ImuLie::AccelStuck(axis) => force[axis] = held.delta_velocity.0[axis],
            ImuLie::AllStuck => (*theta, *force) = (held.delta_theta.0, held.delta_velocity.0),
            ImuLie::Swapped(one, other) => {
                theta.swap_rows(one, other);
                force.swap_rows(one, other);
            }
            ImuLie::GyroSign(axis) => theta[axis] = -theta[axis],
            ImuLie::GyroStep(rate) => *theta += rate * interval,
            ImuLie::AccelStep(by) => *force += by * interval,
            ImuLie::GyroRamp(by) => *theta += by * (since * interval),
            ImuLie::Turned(angle) => {
                let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), -angle);
                (*theta, *force) = (turn * *theta, turn * *force);
            }
            ImuLie::Scale { gyro, accel } => {
                *theta *= gyro;
                *force *= accel;
            }
            ImuLie::Clipped(rate) => {
                let most = rate * interval;
                *theta = theta.map(|x| x.clamp(-most, most));
            }
            ImuLie::Noise { gyro, accel } => {
                *theta += normal3(rng) * gyro;
                *force += normal3(rng) * accel;
            }
            ImuLie::Spikes if rng.random::<f64>() < SPIKES => {
                *theta += normal3(rng) * FAR[0];
                *force += normal3(rng) * FAR[1];
            }
            ImuLie::NotANumber(share) if rng.random::<f64>() < share => {
                told.delta_theta = Body(Vector3::repeat(f64::NAN));
            }
            _ => {}
        }
    }
}

/// Length of an interval, s.
fn interval(voyage: &Voyage) -> f64 {
    1.0 / voyage.header.imu.rate
}
