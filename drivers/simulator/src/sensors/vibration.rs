//! What an engine does to the IMU: lines in the spectrum of its rates and forces.

use std::f64::consts::TAU;

use insd_base::units::DEG;
use nalgebra::Vector3;

use crate::random::{Purpose, stream, uniform};
use crate::scenario::Vibration;

/// Least share of the stated amplitude that an axis has.
const LEAST_SHARE: f64 = 1.0 / 3.0;

/// One line: amplitude sin(2 pi f t + phase) on each axis.
#[derive(Clone, Copy, Debug)]
struct Line {
    /// rad/s.
    frequency: f64,
    amplitude: Vector3<f64>,
    /// rad.
    phase: Vector3<f64>,
}

impl Line {
    /// Its integral over (from, to], s.
    fn increment(&self, from: f64, to: f64) -> Vector3<f64> {
        let cosine = |t: f64| self.phase.map(|phase| (self.frequency * t + phase).cos());
        self.amplitude.component_mul(&(cosine(from) - cosine(to))) / self.frequency
    }
}

/// The lines of an engine, of angular rate, rad/s, and of specific force, m/s^2.
#[derive(Debug)]
pub(super) struct Engine {
    lines: Vec<(Line, Line)>,
}

impl Engine {
    pub(super) fn new(vibration: &[Vibration], seed: u64) -> Self {
        let mut rng = stream(seed, Purpose::Vibration);
        let mut draw = |greatest: f64, frequency_hz: f64| Line {
            frequency: TAU * frequency_hz,
            amplitude: Vector3::from_fn(|_, _| greatest * uniform(&mut rng, LEAST_SHARE, 1.0)),
            phase: Vector3::from_fn(|_, _| uniform(&mut rng, 0.0, TAU)),
        };
        let lines = vibration.iter().map(|line| {
            let rate = draw(line.rate_deg_s * DEG, line.frequency_hz);
            (rate, draw(line.force_mps2, line.frequency_hz))
        });
        Engine { lines: lines.collect() }
    }

    /// Increments of angle, rad, and velocity, m/s, over (from, to], s.
    pub(super) fn increments(&self, from: f64, to: f64) -> (Vector3<f64>, Vector3<f64>) {
        let none = (Vector3::zeros(), Vector3::zeros());
        self.lines.iter().fold(none, |(theta, velocity), (rate, force)| {
            (theta + rate.increment(from, to), velocity + force.increment(from, to))
        })
    }
}
