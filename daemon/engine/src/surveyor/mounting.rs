//! Whether the IMU's bow is hers: by which way she goes.

use insd_base::units::{DEG, wrap_pi};
use insd_base::{Estimate, Finding, Solution, Time};
use nalgebra::Vector2;

/// Course and heading are compared above this speed, m/s, below this rate of turn, rad/s, and with a
/// heading so sure, rad.
const UNDER_WAY: f64 = 2.5;
const STEADY: f64 = 0.5 * DEG;
const SURE: f64 = 10.0 * DEG;
/// They must have been compared for so long, s, and the mean forgets with twice that.
const COMPARED: f64 = 120.0;
/// Drift that wind and current do not explain, rad, and share of the time that it must hold for.
const SIDEWAYS: f64 = 60.0 * DEG;
const AHEAD: f64 = 30.0 * DEG;
const ALWAYS: f64 = 0.9;

/// Means of what an IMU that is mounted otherwise gets wrong.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mounting {
    last: Option<Time>,
    /// Course less heading as a direction, and for how long it was seen, s.
    drift: Vector2<f64>,
    compared: f64,
    is_turned: bool,
}

impl Mounting {
    /// The heading is being found anew: what was seen of another one says nothing of it.
    pub(super) fn begin_anew(&mut self) {
        *self = Mounting { is_turned: self.is_turned, ..Mounting::default() };
    }

    /// Looks at a solution.
    pub(super) fn see(&mut self, solution: &Solution) {
        let elapsed = self.last.map_or(0.0, |last| (solution.time - last).as_seconds());
        self.last = Some(solution.time);
        let elapsed = elapsed.clamp(0.0, 1.0);
        self.compare(solution, elapsed);
    }

    fn compare(&mut self, solution: &Solution, elapsed: f64) {
        let v = solution.velocity.0;
        let steady = solution.rate.0.z.abs() < STEADY;
        let sure = solution.sigma.heading < SURE && solution.sigma.velocity.0.xy().norm() < 1.0;
        if v.xy().norm() < UNDER_WAY || !steady || !sure {
            return;
        }
        let drift = wrap_pi(v.y.atan2(v.x) - solution.attitude.heading);
        let weight = elapsed / self.compared.clamp(1.0, 2.0 * COMPARED);
        self.drift += (Vector2::new(drift.cos(), drift.sin()) - self.drift) * weight;
        self.compared += elapsed;
        self.judge();
    }

    /// Once it was found to be turned it is until she has gone where it points for as long.
    fn judge(&mut self) {
        if self.turn().is_some_and(|turn| turn > SIDEWAYS) {
            self.is_turned = true;
        } else if self.is_ahead() {
            self.is_turned = false;
        }
    }

    /// By how much course and heading have been apart all the time, rad.
    fn turn(&self) -> Option<f64> {
        let persists = self.compared >= COMPARED && self.drift.norm() > ALWAYS;
        persists.then(|| self.drift.y.atan2(self.drift.x).abs())
    }

    /// Whether she has long gone the way her bow points.
    pub(super) fn is_ahead(&self) -> bool {
        self.turn().is_some_and(|turn| turn < AHEAD)
    }

    /// Course less heading on the mean, rad; its sigma as if it were another one every minute.
    pub(super) fn drift(&self) -> Option<Estimate> {
        let length = self.drift.norm().clamp(f64::MIN_POSITIVE, 1.0);
        let scatter = (-2.0 * length.ln()).sqrt();
        let minutes = (self.compared.min(2.0 * COMPARED) / 60.0).max(1.0);
        let value = self.drift.y.atan2(self.drift.x);
        let known = self.compared >= COMPARED;
        known.then(|| Estimate { value, sigma: scatter / minutes.sqrt() })
    }

    /// How it seems to sit, if otherwise than configured.
    pub(super) fn finding(&self) -> Option<Finding> {
        let turn = self.drift.y.atan2(self.drift.x);
        self.is_turned.then_some(Finding::MountingTurned { turn })
    }
}
