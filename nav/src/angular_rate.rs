//! The angular rate of the body at this instant, out of samples that are noisy.
//!
//! The swing of an antenna on a mast is the rate times a long arm. Taken from the last two samples it is
//! white noise of centimetres per second with gyros of 20 deg/h, beside a receiver that is not much worse;
//! and as it stands in the measurement matrix as well, its direction passes for that of a ship that swings,
//! and each fix would tell a little of the heading though she lies still (errors in the variables: Fuller,
//! Measurement Error Models, section 1.1).
//!
//! A line with fading memory, theta^n the weight of the sample n before the last (Morrison, Introduction to
//! Sequential Smoothing and Prediction, chapter 13), theta = exp(-h / memory):
//!
//! r <- r + s h + (1 - theta^2) e,   s <- s + (1 - theta)^2 e / h,   e = sample - (r + s h).
//!
//! Its error is that of the noise, 5/4 N^2 / memory, and that of a bend of the rate, r'' memory^2; the memory
//! is such that the sum of both squares is least, for the noise that the gyros are found to have. Where that is hardly longer
//! than two samples, theta is zero and the line goes through the last two.

use insd_base::ImuSpec;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Bend of the rate of a ship that rolls 3 degrees in 10 s, rad/s^3.
const BEND: f64 = 0.013;
/// What the bend adds to the variance where the sum is least: a quarter.
const WITH_BEND: f64 = 1.25;

/// The line through the last samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AngularRate {
    /// Stated density of the gyros' noise, and that for which the memory was chosen, rad^2/s.
    stated: f64,
    density: f64,
    /// Samples in a second.
    frequency: f64,
    /// s.
    memory: f64,
    /// Of the rate at the end of a sample, when the line is as long as the memory, (rad/s)^2.
    variance: f64,
    samples: u32,
    /// In the middle of the last sample, rad/s.
    rate: Vector3<f64>,
    /// rad/s^2.
    slope: Vector3<f64>,
    /// Length of the last sample, s.
    last: f64,
}

/// Samples that the memory must span to be worth while.
const WORTH: f64 = 3.0;

/// The memory is chosen anew where the noise differs from that for which it was by such a factor.
const RETUNED: f64 = 1.5;
/// A line through samples before a gap of so many is none.
const BROKEN: f64 = 8.0;

/// Over how long samples with noise of such a density, rad^2/s, are remembered, s; zero for the last two alone.
fn memory(density: f64, frequency: f64) -> f64 {
    let best = (1.25 * density / (4.0 * BEND * BEND)).powf(0.2);
    if best * frequency < WORTH { 0.0 } else { best }
}

/// Variance of each component of the rate at the end of a sample of gyros that are as stated, (rad/s)^2.
#[must_use]
pub fn rate_variance(imu: &ImuSpec) -> f64 {
    AngularRate::new(imu).variance
}

/// That of the line, half a sample after the middle of the last.
fn variance(density: f64, frequency: f64, memory: f64) -> f64 {
    let theta = (-1.0 / (frequency * memory)).exp();
    let off = 1.0 - theta;
    let own = off * (1.0 + 4.0 * theta + 5.0 * theta * theta);
    let both = off * off * (1.0 + 3.0 * theta);
    let slope = 2.0 * off.powi(3);
    let line = (own + both + 0.25 * slope) / (1.0 + theta).powi(3);
    let bend = if theta > 0.0 { WITH_BEND } else { 1.0 };
    bend * line * density * frequency
}

impl AngularRate {
    /// Before the first sample of this IMU.
    #[must_use]
    pub fn new(imu: &ImuSpec) -> Self {
        let density = imu.gyro.random_walk.powi(2);
        let memory = memory(density, imu.rate);
        AngularRate {
            stated: density,
            density,
            frequency: imu.rate,
            memory,
            variance: variance(density, imu.rate, memory),
            samples: 0,
            rate: Vector3::zeros(),
            slope: Vector3::zeros(),
            last: 0.0,
        }
    }

    /// The gyros are found to be noisier than stated by such a density, rad^2/s.
    pub fn tune(&mut self, excess: f64) {
        let density = self.stated + excess;
        if density < RETUNED * self.density && RETUNED * density > self.density {
            return;
        }
        self.density = density;
        self.memory = memory(density, self.frequency);
        self.variance = variance(density, self.frequency, self.memory);
    }

    /// Takes the mean rate over the next sample, rad/s, its length, and the time that is missing before it, s.
    pub fn take(&mut self, mean: &Vector3<f64>, duration: f64, missing: f64) {
        if missing * self.frequency > BROKEN {
            (self.samples, self.slope) = (0, Vector3::zeros());
        }
        self.samples = self.samples.saturating_add(1);
        if self.samples == 1 {
            (self.rate, self.last) = (*mean, duration);
            return;
        }
        let spacing = 0.5 * (self.last + duration) + missing;
        let theta = (-spacing / self.memory).exp();
        // a line through few samples weighs all of them alike
        let n = f64::from(self.samples);
        let all = n * (n + 1.0);
        let gain = (1.0 - theta * theta).max((4.0 * n - 2.0) / all);
        let slope_gain = (1.0 - theta).powi(2).max(6.0 / all);
        let ahead = self.rate + self.slope * spacing;
        let off = mean - ahead;
        self.rate = ahead + off * gain;
        self.slope += off * (slope_gain / spacing);
        self.last = duration;
    }

    /// At the end of the last sample, rad/s, and how it changes, rad/s^2.
    #[must_use]
    pub fn at_end(&self) -> (Vector3<f64>, Vector3<f64>) {
        (self.rate + self.slope * (0.5 * self.last), self.slope)
    }

    /// Variance of each component there, (rad/s)^2.
    #[must_use]
    pub fn variance(&self) -> f64 {
        let n = f64::from(self.samples.max(1));
        let few = (4.0 * n - 2.0) / (n * (n + 1.0)) * self.density * self.frequency;
        self.variance.max(few)
    }

    /// Whether all of it are numbers.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.rate.iter().chain(&self.slope).all(|x| x.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Triad;

    fn imu(random_walk: f64) -> ImuSpec {
        let triad = Triad {
            bias_std: 1e-7,
            instability_std: 1e-8,
            instability_time: 100.0,
            random_walk,
            scale_std: 1e-5,
        };
        ImuSpec { rate: 100.0, gyro: triad, accel: triad }
    }

    fn seen(imu: &ImuSpec, rate: impl Fn(f64) -> f64) -> impl Iterator<Item = (f64, f64)> {
        let mut line = AngularRate::new(imu);
        (0..2000).map(move |i| {
            let t = 0.01 * f64::from(i);
            line.take(&Vector3::x().scale(rate(t + 0.005)), 0.01, 0.0);
            (t + 0.01, line.at_end().0.x)
        })
    }

    #[test]
    fn the_noise_of_a_coarse_gyro_is_averaged_to_what_is_claimed() {
        let imu = imu(5.8e-5);
        let std = (imu.gyro.random_walk.powi(2) * imu.rate).sqrt();
        // a fixed sequence that is as good as white
        let mut state = 1_u64;
        let noise: Vec<f64> = (0..2000)
            .map(|_| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 12.0_f64.sqrt() * std
            })
            .collect();
        let found = seen(&imu, |t| noise[(t * 100.0) as usize]).skip(100);
        let (sum, count) = found.fold((0.0, 0.0), |(sum, n), (_, r)| (sum + r * r, n + 1.0));
        let ratio = sum / count * WITH_BEND / rate_variance(&imu);
        assert!((0.7..1.4).contains(&ratio), "{ratio}");
        assert!(rate_variance(&imu) < 0.1 * 2.5 * std * std, "no better than two samples");
    }

    #[test]
    fn a_rolling_ship_is_followed_without_a_lag_that_counts() {
        let imu = imu(5.8e-5);
        let rolling = |t: f64| 0.033 * (0.628 * t).sin();
        let worst = seen(&imu, rolling).skip(100).map(|(t, r)| (r - rolling(t)).abs());
        let worst = worst.fold(0.0, f64::max);
        assert!(worst < rate_variance(&imu).sqrt(), "{worst}");
    }

    #[test]
    fn the_first_samples_are_taken_as_they_are() {
        let (_, second) = seen(&imu(5.8e-5), |t| 0.1 + t).nth(1).unwrap();
        assert!((second - 0.12).abs() < 1e-9, "{second}");
    }
}
