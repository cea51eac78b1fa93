//! Whether a log sits and counts as configured: what it says against what the solution says.
//!
//! With velocities forward and starboard as complex numbers, m(k) = a p(k) + noise, p predicted, m
//! measured, the least-squares a = sum m p* / sum |p|^2 is scale and turn in one, and
//! |sum m p*|^2 / (sum |m|^2 sum |p|^2) says how much of m it explains.

use insd_base::units::DEG;
use insd_base::{Estimate, Finding, LogVelocity};
use nalgebra::{Complex, Vector3};

/// Below this speed, m/s, a log is not compared.
const MOVING: f64 = 1.5;
/// Comparisons that must have been made, and that the memory spans.
const FEWEST: f64 = 60.0;
const SPAN: f64 = 600.0;
/// Share of what the log says that must be explained.
const EXPLAINED: f64 = 0.9;
/// A scale and a turn worth a word, ratio and rad: beyond what current and leeway do.
const SCALE: f64 = 0.25;
const TURN: f64 = 20.0 * DEG;

/// Sums of the regression.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LogWatch {
    together: Complex<f64>,
    predicted: f64,
    measured: f64,
    count: f64,
}

impl LogWatch {
    /// Compares a velocity with what it should be by the solution, body axes, m/s.
    pub(super) fn hear(&mut self, log: &LogVelocity, at_log: &Vector3<f64>) {
        let (Some(u), Some(v)) = (log.u, log.v.or(Some(0.0))) else { return };
        if at_log.xy().norm() < MOVING || !(u.is_finite() && v.is_finite()) {
            return;
        }
        let (m, p) = (Complex::new(u, v), Complex::new(at_log.x, at_log.y));
        let kept = 1.0 - 1.0 / SPAN;
        self.together = self.together * kept + m * p.conj();
        self.predicted = self.predicted * kept + p.norm_sqr();
        self.measured = self.measured * kept + m.norm_sqr();
        self.count += 1.0;
    }

    /// What the log gets wrong, if it is much.
    pub(super) fn finding(&self) -> Option<Finding> {
        let factor = self.together / self.predicted;
        let explained = self.together.norm_sqr() / (self.predicted * self.measured);
        let is_wrong = (factor.norm() - 1.0).abs() > SCALE || factor.arg().abs() > TURN;
        if self.count < FEWEST || explained.is_nan() || explained < EXPLAINED || !is_wrong {
            return None;
        }
        let scatter = ((1.0 - explained) / self.count.min(SPAN)).max(0.0).sqrt() * factor.norm();
        let scale = Estimate { value: factor.norm(), sigma: scatter };
        Some(Finding::LogMounting { scale, turn: factor.arg() })
    }

    /// Whether she goes the way her bow points, or the other way, by log and solution alike.
    pub(super) fn agrees(&self) -> bool {
        self.count >= FEWEST && self.finding().is_none()
    }
}
