//! Whether the IMU tells what its configuration says it does: gravity is known, ships do not spin, and they
//! stand upright.

use insd_base::units::DEG;
use insd_base::{Finding, GnssFix, ImuSample};
use insd_nav::Increment;
use nalgebra::Vector3;

use super::gravity::Gravity;
use super::saturated::Saturated;
use super::stuck::Stuck;
use super::swing::Swing;

/// Gravity at sea, m/s^2, and by how much of it the mean force may differ: a rough sea, a short window.
const GRAVITY: f64 = 9.81;
const OFF: f64 = 0.05;
/// Root mean square of a ship's rate of turn, all axes, that is beyond any sea, rad/s: believed of an IMU whose gravity follows it alone, in a hand on trials.
const SPIN: f64 = 25.0 * DEG;
/// No ship lists like this on the mean, rad; one that was found to is upright below half of it.
const LIST: f64 = 25.0 * DEG;
/// Time constant of the means, and how long must have been seen, s.
const SPAN: f64 = 20.0;
const SEEN: f64 = 9.0;

/// Once found wrong it is right when both are within these shares of the limits for so long, s: in a calm
/// degrees look like radians.
const CALM: f64 = 0.3;
const RIGHT: f64 = 60.0;

/// Means of what the IMU says.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ImuWatch {
    force: f64,
    rate_square: f64,
    /// Mean of the specific force, axes of the ship as configured, m/s^2.
    upwards: Vector3<f64>,
    seen: f64,
    is_tilted: bool,
    swing: Swing,
    gravity: Gravity,
    stuck: Stuck,
    saturated: Saturated,
    /// What was found, and for how long it has been right since, s.
    found: Option<Finding>,
    right: f64,
}

impl ImuWatch {
    /// Sees an increment that was measured.
    pub(super) fn see(&mut self, increment: &Increment) {
        self.gravity.see(increment);
        let duration = increment.duration();
        if increment.bridged.is_some() || duration <= 0.0 {
            return;
        }
        self.seen += duration;
        let share = duration / self.seen.min(SPAN);
        self.force += (increment.velocity.norm() / duration - self.force) * share;
        self.upwards += (increment.velocity / duration - self.upwards) * share;
        let rate = increment.rotation.norm() / duration;
        self.rate_square += (rate * rate - self.rate_square) * share;
        self.swing.see(increment, duration);
        self.judge(duration);
    }

    /// Hears a fix.
    pub(super) fn hear(&mut self, fix: &GnssFix) {
        self.gravity.hear(fix);
    }

    /// Sees a sample as it came, and its duration, s.
    pub(super) fn see_raw(&mut self, sample: &ImuSample, duration: f64) {
        self.stuck.see(sample, duration);
        self.saturated.see(sample, duration);
    }

    fn judge(&mut self, duration: f64) {
        let off = (self.force / GRAVITY - 1.0).abs() / OFF;
        let spin = self.rate_square.sqrt() / SPIN;
        let is_right = off.max(spin) < CALM && !self.swing.is_wrong();
        self.right = if is_right { self.right + duration } else { 0.0 };
        if self.seen < SEEN {
            return;
        }
        let limit = if self.is_tilted { 0.5 * LIST } else { LIST };
        self.is_tilted = -self.upwards.z < limit.cos() * self.upwards.norm();
        if off > 1.0 {
            self.found = Some(Finding::ImuForce { mean: self.force });
        } else if self.swing.is_wrong() || spin > 1.0 && !self.swing.holds_gravity() {
            self.found = Some(Finding::ImuRate { mean: self.rate_square.sqrt() });
        } else if self.right > RIGHT {
            self.found = None;
        }
    }

    /// What it gets wrong, if anything.
    pub(super) fn finding(&self) -> Option<Finding> {
        let saturated = self.saturated.axes().map(|axes| Finding::ImuSaturated { axes });
        let stuck = || self.stuck.axes().map(|axes| Finding::ImuStuck { axes });
        saturated.or_else(stuck).or(self.found).or_else(|| self.gravity.finding())
    }

    /// How the ship would list and trim for ever if it sat as configured, if that is beyond any ship.
    pub(super) fn tilted(&self) -> Option<Finding> {
        let down = -self.upwards.try_normalize(1e-9)?;
        let (roll, pitch) = (down.y.atan2(down.z), -down.x.clamp(-1.0, 1.0).asin());
        self.is_tilted.then_some(Finding::MountingTilted { roll, pitch })
    }
}
