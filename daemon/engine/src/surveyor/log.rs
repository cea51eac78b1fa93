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
        let (factor, explained) = self.factor().filter(|(factor, _)| is_wrong(factor))?;
        let scatter = ((1.0 - explained) / self.count.min(SPAN)).max(0.0).sqrt() * factor.norm();
        let scale = Estimate { value: factor.norm(), sigma: scatter };
        Some(Finding::LogMounting { scale, turn: factor.arg() })
    }

    /// Scale and turn in one, and the share that they explain, where that is most of what the log says.
    fn factor(&self) -> Option<(Complex<f64>, f64)> {
        let factor = self.together / self.predicted;
        let explained = self.together.norm_sqr() / (self.predicted * self.measured);
        (self.count >= FEWEST && explained >= EXPLAINED).then_some((factor, explained))
    }

    /// Whether she goes the way her bow points, or the other way, by log and solution alike.
    pub(super) fn agrees(&self) -> bool {
        self.factor().is_some_and(|(factor, _)| !is_wrong(&factor))
    }
}

/// Whether a scale or a turn is beyond what current and leeway do.
fn is_wrong(factor: &Complex<f64>) -> bool {
    (factor.norm() - 1.0).abs() > SCALE || factor.arg().abs() > TURN
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{LogReference, Time};

    #[test]
    fn a_log_that_says_otherwise_now_than_before_agrees_no_more() {
        let mut watch = LogWatch::default();
        let log = LogVelocity {
            time: Time::START,
            u: Some(6.0),
            v: Some(0.0),
            w: None,
            std: None,
            reference: LogReference::Bottom,
        };
        (0..900).for_each(|_| watch.hear(&log, &Vector3::new(6.1, 0.1, 0.0)));
        assert!(watch.agrees() && watch.finding().is_none());
        (0..60).for_each(|_| watch.hear(&log, &Vector3::new(0.1, 6.1, 0.0)));
        assert!(!watch.agrees() && watch.finding().is_none());
    }
}
