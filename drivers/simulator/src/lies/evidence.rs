//! When the other sensors can show that a position is false.
//!
//! A monitor predicts the position from the moment before the lie on, with sigma^2 = s^2 + (v t)^2 +
//! (a t^2 / 2)^2 after t seconds; the lie is shown when it exceeds six of them. That of a compass which drifts is when it exceeds six sigmas
//! of the heading that gyros, course and log tell without it; one that is mirrored tells nothing wrong before she turns.

use insd_base::Voyage;
use insd_base::units::{DEG, wrap_pi};

use super::{Grade, Suite};

/// Sigmas beyond which a lie is shown.
const SHOWN: f64 = 6.0;
/// Error of a position that everybody has, 1-sigma, m, and of two receivers against each other.
const RECEIVER: f64 = 1.5;
const RECEIVERS: f64 = 2.0;
/// For so long a compass is off before that is no noise, s.
const WHILE: f64 = 10.0;
/// From look to look, s.
const LOOK: f64 = 0.5;

/// How fast a prediction loses the position.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Monitor {
    floor: f64,
    velocity: f64,
    acceleration: f64,
}

impl Monitor {
    const fn new(floor: f64, velocity: f64, acceleration: f64) -> Self {
        Monitor { floor, velocity, acceleration }
    }

    fn sigma(&self, t: f64) -> f64 {
        let drift = self.velocity * t;
        self.floor.hypot(drift).hypot(0.5 * self.acceleration * t * t)
    }
}

fn monitors(grade: Grade, suite: Suite, velocity_is_honest: bool) -> Vec<Monitor> {
    let by_log = match grade {
        Grade::Navigation => 0.008,
        Grade::Mems if suite.has_compass() => 0.02,
        Grade::Mems => 0.04,
    };
    let mut all = vec![match grade {
        Grade::Navigation => Monitor::new(RECEIVER, 0.01, 2.2e-4),
        Grade::Mems => Monitor::new(RECEIVER, 0.02, 6e-3),
    }];
    if suite.has_log() {
        all.push(Monitor::new(RECEIVER, by_log, 0.0));
    }
    if velocity_is_honest {
        all.push(Monitor::new(RECEIVER, 0.015, 0.0));
    }
    if suite.has_second() {
        all.push(Monitor::new(RECEIVERS, 0.0, 0.0));
    }
    all
}

/// Seconds after a lie began at which the others can show it, if it is so far off after each of them, m;
/// `None` if they cannot before it ends.
pub fn shown_after(
    grade: Grade,
    suite: Suite,
    velocity_is_honest: bool,
    off: impl Fn(f64) -> f64,
    lasts: f64,
) -> Option<f64> {
    let all = monitors(grade, suite, velocity_is_honest);
    let looks = (lasts / LOOK).min(1e5) as u32;
    let is_shown = |t: &f64| all.iter().any(|monitor| off(*t) > SHOWN * monitor.sigma(*t));
    (0..=looks).map(|look| f64::from(look) * LOOK).find(is_shown)
}

/// How well a heading is known without the compass, 1-sigma, rad.
fn heading_sigma(grade: Grade, suite: Suite) -> f64 {
    DEG * match grade {
        Grade::Navigation => 0.1,
        Grade::Mems if suite.has_log() => 0.25,
        Grade::Mems => 0.5,
    }
}

/// Seconds after a compass began to drift at a rate, rad/s, at which the others can show it.
pub fn heading_shown_after(grade: Grade, suite: Suite, rate: f64) -> f64 {
    SHOWN * heading_sigma(grade, suite) / rate.abs()
}

/// When the others can show that a compass is off, s: it has been, by more than that, for a while.
pub(super) fn heading_shown_in(
    grade: Grade,
    suite: Suite,
    honest: &Voyage,
    spoilt: &Voyage,
) -> Option<f64> {
    let far = SHOWN * heading_sigma(grade, suite);
    let mut begun = None;
    honest.reference.iter().zip(&spoilt.reference).find_map(|(honest, spoilt)| {
        let now = spoilt.message.time.as_seconds();
        let off = wrap_pi(spoilt.message.heading? - honest.message.heading?).abs();
        begun = (off > far).then(|| begun.unwrap_or(now));
        begun.filter(|begun| now - begun >= WHILE)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_is_shown_at_once_and_a_small_one_never() {
        let shown = |size: f64| shown_after(Grade::Navigation, Suite::Gnss, false, |_| size, 600.0);
        assert_eq!(shown(30.0), Some(0.0));
        assert_eq!(shown(5.0), None);
    }

    #[test]
    fn a_slow_drag_is_shown_by_a_log_and_not_by_a_mems_imu_alone() {
        let shown = |suite| shown_after(Grade::Mems, suite, false, |t| 0.1 * t, 2400.0);
        assert_eq!(shown(Suite::Gnss), None);
        assert_eq!(shown(Suite::Log), None, "0.1 m/s is below six of 0.04");
        let by_both = shown(Suite::Both);
        assert_eq!(by_both, None, "and of 0.02");
        let faster = shown_after(Grade::Mems, Suite::Both, false, |t| 0.5 * t, 2400.0);
        assert!(faster.is_some_and(|t| (15.0..25.0).contains(&t)), "{faster:?}");
    }
}
