//! Whether the gyros say of a turn what her course says: an axis that is mirrored, swapped or dead does not.
//!
//! Over intervals of half a minute the turn about the axis that points down is summed up and held against the
//! change of the course over ground, both smoothed alike so that the antenna's swinging is left out. Drift and current move the one against the other by some tens of
//! degrees, so whole turns are compared: the least-squares factor k of turn = k change is 1 for gyros
//! that are as configured, whatever the heading.

use insd_base::units::{DEG, wrap_pi};
use insd_base::{Estimate, Finding, GnssFix, Time};
use insd_nav::Increment;
use nalgebra::Vector2;

/// Below this speed, m/s, a course says nothing of a turn.
const UNDER_WAY: f64 = 2.5;
/// Length of an interval, s, and the longest silence within it.
const INTERVAL: f64 = 40.0;
const BROKEN: f64 = 5.0;
/// Time constant of the smoothing, s.
const SWELL: f64 = 10.0;
/// Change of course that is a turn, rad, and the sum of them that must have been seen.
const TURN: f64 = 15.0 * DEG;
const ENOUGH: f64 = 80.0 * DEG;
/// Share of the sums that is kept from turn to turn.
const KEPT: f64 = 0.97;
/// Factors between these are of gyros that tell turns.
const LEAST: f64 = 0.3;
const GREATEST: f64 = 3.0;

/// Velocity north and east, m/s, and turn by the gyros, rad, both smoothed; at the time of the newest.
#[derive(Clone, Copy, Debug)]
struct Smooth {
    time: Time,
    velocity: Vector2<f64>,
    turned: f64,
}

impl Smooth {
    fn course(&self) -> f64 {
        self.velocity.y.atan2(self.velocity.x)
    }

    /// With another one, some moments later.
    fn with(&self, next: &Smooth) -> Smooth {
        let share = ((next.time - self.time).as_seconds() / SWELL).clamp(0.0, 1.0);
        Smooth {
            time: next.time,
            velocity: self.velocity.lerp(&next.velocity, share),
            turned: self.turned + (next.turned - self.turned) * share,
        }
    }
}

/// Sums of the regression.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Turns {
    /// What the gyros have turned by, rad.
    turned: f64,
    /// As it is now, and as it was when the interval began.
    now: Option<Smooth>,
    begun: Option<Smooth>,
    together: f64,
    by_course: f64,
    by_gyro: f64,
    seen: f64,
}

impl Turns {
    /// Sees an increment of the IMU.
    pub(super) fn see(&mut self, increment: &Increment) {
        self.turned += increment.rotation.z;
    }

    /// Hears a fix.
    pub(super) fn hear(&mut self, fix: &GnssFix) {
        let velocity = fix.velocity.filter(|_| fix.quality.is_measured());
        let Some(velocity) = velocity.map(|velocity| velocity.0.xy()) else { return };
        let next = Smooth { time: fix.time, velocity, turned: self.turned };
        let is_old = |now: &Smooth| !(0.0..BROKEN).contains(&(fix.time - now.time).as_seconds());
        if self.now.as_ref().is_none_or(is_old) {
            (self.now, self.begun) = (Some(next), None);
            return;
        }
        self.now = self.now.map(|now| now.with(&next));
        self.look();
    }

    /// Compares what she has turned by since the interval began, if it is over.
    fn look(&mut self) {
        let Some(now) = self.now.filter(|now| now.velocity.norm() > UNDER_WAY) else {
            self.begun = None;
            return;
        };
        let begun = *self.begun.get_or_insert(now);
        if (now.time - begun.time).as_seconds() < INTERVAL {
            return;
        }
        self.begun = Some(now);
        let change = wrap_pi(now.course() - begun.course());
        if change.abs() > TURN {
            self.compare(change, now.turned - begun.turned);
        }
    }

    fn compare(&mut self, change: f64, turn: f64) {
        self.together = self.together * KEPT + change * turn;
        self.by_course = self.by_course * KEPT + change * change;
        self.by_gyro = self.by_gyro * KEPT + turn * turn;
        self.seen += change.abs();
    }

    /// What the gyros make of her turns, if it is not what they are.
    pub(super) fn finding(&self) -> Option<Finding> {
        let value = self.together / self.by_course;
        let is_wrong = self.seen > ENOUGH && !(LEAST..=GREATEST).contains(&value);
        let left = (self.by_gyro / self.by_course - value * value).max(0.0);
        let sigma = (left / (self.seen / TURN).max(1.0)).sqrt();
        is_wrong.then_some(Finding::ImuTurns { ratio: Estimate { value, sigma } })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{FixQuality, Ned};
    use nalgebra::Vector3;

    /// Ten minutes of turns to both sides at 6 m/s, the course drifting behind the bow, in a current;
    /// the gyro tells `factor` times the turn.
    fn sailed(factor: f64, current: f64) -> Turns {
        let mut turns = Turns::default();
        for second in 0..600 {
            let at = f64::from(second);
            let heading = |t: f64| 1.5 * (t / 40.0).sin();
            let way = heading(at - 3.0);
            let fix = GnssFix {
                time: Time::from_seconds(at),
                velocity: Some(Ned::new(6.0 * way.cos() + current, 6.0 * way.sin(), 0.0)),
                quality: FixQuality::Autonomous,
                ..GnssFix::default()
            };
            let rotation = Vector3::new(0.0, 0.0, factor * (heading(at + 1.0) - heading(at)));
            turns.see(&Increment {
                from: Time::from_seconds(at),
                to: Time::from_seconds(at + 1.0),
                rotation,
                velocity: Vector3::zeros(),
                end_rate: Vector3::zeros(),
                end_rate_variance: 0.0,
                angular_acceleration: Vector3::zeros(),
                rate_noise: Vector3::zeros(),
                force_noise: Vector3::zeros(),
                bridged: None,
            });
            turns.hear(&fix);
        }
        turns
    }

    #[test]
    fn gyros_that_turn_with_her_are_not_doubted() {
        for current in [-2.0, 0.0, 2.0] {
            assert_eq!(sailed(1.0, current).finding(), None, "{current}");
        }
    }

    #[test]
    fn mirrored_dead_and_miscounting_gyros_are_found() {
        for factor in [-1.0, 0.0, 57.3] {
            let Some(Finding::ImuTurns { ratio }) = sailed(factor, 1.0).finding() else {
                panic!("{factor} is not found");
            };
            assert!(
                (ratio.value / factor.max(-1.0) - 1.0).abs() < 0.3 || factor == 0.0,
                "{ratio:?}"
            );
        }
    }
}
