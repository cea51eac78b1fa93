//! How an IMU turns, look by look, as it says itself.

use insd_base::{Body, ImuSample, Message, Time};
use nalgebra::Vector3;

/// Samples that lie so many times as far apart as usual have a gap between them; what is usual is the mean of about so many.
const GAP: f64 = 1.5;
const USUAL: f64 = 100.0;

/// The samples of one IMU since the last look.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gyros {
    last: Option<Time>,
    interval: Option<f64>,
    angle: Vector3<f64>,
    count: f64,
}

impl Gyros {
    /// Hears what an engine is told.
    pub fn hear(&mut self, message: &Message) {
        if let Message::Imu(sample) = message {
            self.add(sample);
        }
    }

    fn add(&mut self, sample: &ImuSample) {
        self.angle += sample.delta_theta.0;
        self.count += 1.0;
        let Some(last) = self.last.replace(sample.time) else { return };
        let passed = (sample.time - last).as_seconds();
        if passed <= 0.0 {
            return;
        }
        let usual = self.interval.filter(|usual| passed * GAP > *usual);
        let is_gap = usual.is_some_and(|usual| passed > GAP * usual);
        if !is_gap {
            self.interval = Some(usual.map_or(passed, |usual| usual + (passed - usual) / USUAL));
        }
    }

    /// The mean rate since it was last asked, rad/s; `None` if there was no sample.
    pub fn take(&mut self) -> Option<Body> {
        let span = self.interval? * self.count;
        let rate = self.angle / span;
        (self.angle, self.count) = (Vector3::zeros(), 0.0);
        (span > 0.0 && rate.iter().all(|rate| rate.is_finite())).then_some(Body(rate))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lost_sample_is_no_slower_turn() {
        let mut gyros = Gyros::default();
        for i in (0..50).filter(|i| ![7, 30, 31].contains(i)) {
            let time = Time::from_seconds(f64::from(i) * 0.01);
            let delta_theta = Body::new(0.0, 0.002, -0.001);
            gyros.hear(&Message::Imu(ImuSample { time, delta_theta, ..ImuSample::default() }));
        }
        let rate = gyros.take().map(|rate| rate.0);
        assert!(rate.is_some_and(|rate| (rate - Vector3::new(0.0, 0.2, -0.1)).norm() < 1e-9));
        assert_eq!(gyros.take(), None);
    }
}
