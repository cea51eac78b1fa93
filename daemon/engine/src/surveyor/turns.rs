//! Whether the gyros say of a turn what her course says: an axis that is mirrored, swapped or dead does not.
//!
//! Over intervals of less than a minute the turn about the axis that points down is summed up and held against the
//! change of the course over ground, both smoothed alike so that the antenna's swinging is left out. Drift and current move the one against the other by some tens of
//! degrees, so whole turns are compared: the least-squares factor k of turn = k change is 1 for gyros
//! that are as configured, whatever the heading. A log that sees the bottom tells the drift: what is left is where her bow
//! points, but for a constant of its mounting, and a slow ship's small turn says as much.

use insd_base::units::{DEG, wrap_pi};
use insd_base::{Estimate, Finding, GnssFix, LogReference, LogVelocity, Time};
use insd_nav::Increment;
use nalgebra::Vector2;

/// Silence that breaks an interval, s, and the age up to which a log tells the drift.
const BROKEN: f64 = 5.0;
const FRESH: f64 = 2.5;
/// Time constant of the smoothing, s.
const SWELL: f64 = 10.0;
/// A log that changes by more than this share of its speed, and by more than a wave does, m/s, from one message to the
/// next is mounted otherwise.
const LEAP: f64 = 0.8;
const WAVE: f64 = 0.5;
/// Share of the sums that is kept from turn to turn.
const KEPT: f64 = 0.97;
/// Factors between these are of gyros that tell turns.
const LEAST: f64 = 0.3;
const GREATEST: f64 = 3.0;

/// What a change of direction is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Worth {
    /// Below this speed, m/s, it says nothing of a turn.
    under_way: f64,
    /// Length of an interval, s.
    interval: f64,
    /// Change that is a turn, rad, and the sum of them that must have been seen.
    turn: f64,
    enough: f64,
}

/// Of a course, and of a course less the drift that a log tells.
const OF_COURSE: Worth =
    Worth { under_way: 2.5, interval: 40.0, turn: 15.0 * DEG, enough: 80.0 * DEG };
const OF_BOW: Worth = Worth { under_way: 0.8, interval: 20.0, turn: 8.0 * DEG, enough: 30.0 * DEG };

/// Velocity north and east, and forward and starboard by the log, m/s, and turn by the gyros, rad, all smoothed; at the time
/// of the newest.
#[derive(Clone, Copy, Debug)]
struct Smooth {
    time: Time,
    velocity: Vector2<f64>,
    log: Option<Vector2<f64>>,
    turned: f64,
}

impl Smooth {
    fn worth(&self) -> Worth {
        if self.log.is_some() { OF_BOW } else { OF_COURSE }
    }

    /// Where she goes, less where that is from her bow if it is known, rad.
    fn direction(&self) -> f64 {
        let of = |velocity: &Vector2<f64>| velocity.y.atan2(velocity.x);
        of(&self.velocity) - self.log.as_ref().map_or(0.0, of)
    }

    fn is_under_way(&self) -> bool {
        let least = self.worth().under_way;
        let is_fast = |velocity: &Vector2<f64>| velocity.norm() > least;
        is_fast(&self.velocity) && self.log.as_ref().is_none_or(is_fast)
    }

    /// With another one, some moments later.
    fn with(&self, next: &Smooth) -> Smooth {
        let share = ((next.time - self.time).as_seconds() / SWELL).clamp(0.0, 1.0);
        let log = self.log.zip(next.log).map(|(own, next)| own.lerp(&next, share));
        Smooth {
            time: next.time,
            velocity: self.velocity.lerp(&next.velocity, share),
            log: log.or(next.log),
            turned: self.turned + (next.turned - self.turned) * share,
        }
    }
}

/// Whether a log tells another direction from one message to the next, as no ship turns, but a log that fails does:
/// as if it were mounted otherwise from now on.
fn has_leapt(last: &LogVelocity, next: &LogVelocity) -> bool {
    let of = |log: &LogVelocity| Some(Vector2::new(log.u?, log.v?));
    let is_next = (0.0..BROKEN).contains(&(next.time - last.time).as_seconds());
    let both = of(last).zip(of(next)).filter(|_| is_next);
    both.is_some_and(|(last, next)| {
        (next - last).norm() > WAVE.max(LEAP * last.norm().min(next.norm()))
    })
}

/// Sums of the regression.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Turns {
    /// What the gyros have turned by, rad.
    turned: f64,
    log: Option<LogVelocity>,
    /// As it is now, and as it was when the interval began.
    now: Option<Smooth>,
    begun: Option<Smooth>,
    together: f64,
    by_course: f64,
    by_gyro: f64,
    /// How many turns were seen, and what they are of all that must have been.
    turns: f64,
    seen: f64,
}

impl Turns {
    /// Sees an increment of the IMU.
    pub(super) fn see(&mut self, increment: &Increment) {
        self.turned += increment.rotation.z;
    }

    /// Hears a log.
    pub(super) fn hear_log(&mut self, log: &LogVelocity) {
        let next = Some(*log).filter(|log| log.reference == LogReference::Bottom);
        if self.log.zip(next).is_some_and(|(last, next)| has_leapt(&last, &next)) {
            (self.now, self.begun) = (None, None);
        }
        self.log = next;
    }

    /// The velocity of a log that tells the bottom now.
    fn drift(&self, now: Time) -> Option<Vector2<f64>> {
        let log = self.log.filter(|log| (now - log.time).as_seconds().abs() < FRESH)?;
        let velocity = Vector2::new(log.u?, log.v?);
        velocity.iter().all(|value| value.is_finite()).then_some(velocity)
    }

    /// Hears a fix.
    pub(super) fn hear(&mut self, fix: &GnssFix) {
        let velocity = fix.velocity.filter(|_| fix.quality.is_measured());
        let Some(velocity) = velocity.map(|velocity| velocity.0.xy()) else { return };
        let log = self.drift(fix.time);
        let next = Smooth { time: fix.time, velocity, log, turned: self.turned };
        let is_other = |now: &Smooth| {
            !(0.0..BROKEN).contains(&(fix.time - now.time).as_seconds())
                || now.log.is_some() != log.is_some()
        };
        if self.now.as_ref().is_none_or(is_other) {
            (self.now, self.begun) = (Some(next), None);
            return;
        }
        self.now = self.now.map(|now| now.with(&next));
        self.look();
    }

    /// Compares what she has turned by since the interval began, if it is over.
    fn look(&mut self) {
        let Some(now) = self.now.filter(Smooth::is_under_way) else {
            self.begun = None;
            return;
        };
        let begun = *self.begun.get_or_insert(now);
        let worth = now.worth();
        if (now.time - begun.time).as_seconds() < worth.interval {
            return;
        }
        self.begun = Some(now);
        let change = wrap_pi(now.direction() - begun.direction());
        if change.abs() > worth.turn {
            self.compare(change, now.turned - begun.turned);
            self.turns += change.abs() / worth.turn;
            self.seen += change.abs() / worth.enough;
        }
    }

    fn compare(&mut self, change: f64, turn: f64) {
        self.together = self.together * KEPT + change * turn;
        self.by_course = self.by_course * KEPT + change * change;
        self.by_gyro = self.by_gyro * KEPT + turn * turn;
    }

    /// What the gyros make of her turns, if it is not what they are.
    pub(super) fn finding(&self) -> Option<Finding> {
        let value = self.together / self.by_course;
        let is_wrong = self.seen > 1.0 && !(LEAST..=GREATEST).contains(&value);
        let left = (self.by_gyro / self.by_course - value * value).max(0.0);
        let sigma = (left / self.turns.max(1.0)).sqrt();
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
        sailed_with(1.5, factor, current, |_| None)
    }

    /// The same with turns of so much to either side, rad, and a log that tells forward and starboard, m/s, at a time, s.
    fn sailed_with(
        swing: f64,
        factor: f64,
        current: f64,
        log: impl Fn(f64) -> Option<(f64, f64)>,
    ) -> Turns {
        let mut turns = Turns::default();
        for second in 0..600 {
            let at = f64::from(second);
            let heading = |t: f64| swing * (t / 40.0).sin();
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
                celsius: None,
            });
            if let Some((u, v)) = log(at) {
                let time = fix.time;
                turns.hear_log(&LogVelocity {
                    time,
                    u: Some(u),
                    v: Some(v),
                    w: None,
                    std: None,
                    reference: LogReference::Bottom,
                });
            }
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

    #[test]
    fn a_log_that_is_turned_under_way_has_no_gyro_doubted() {
        for from in [280.0, 303.0, 317.0] {
            let turned = |at: f64| Some(if at < from { (6.0, 0.0) } else { (0.0, 6.0) });
            assert_eq!(sailed_with(0.0, 1.0, 0.0, turned).finding(), None, "from {from} s");
        }
    }
}
