//! How the heading slips from the course: on a straight course no craft turns without its course turning, too.
//!
//! The gyros of a small IMU may turn the heading for minutes before anything else of a ship with nothing but a receiver
//! contradicts them: what a false turn does to the velocity is what a small tilt does. But she would have to
//! begin to drift athwart, as she does only where she meets another current.

use insd_base::Time;
use insd_base::units::{DEG, wrap_pi};
use nalgebra::{Rotation2, Vector2};

/// Looks that the memory spans, and how far apart they are, s; a longer silence is a gap.
const SPAN: usize = 150;
const SPACING: f64 = 1.9;
const GAP: f64 = 5.0;
/// Time constant of the smoothing, s: what waves do is left out.
const SWELL: f64 = 10.0;
/// Below this speed a course says little, m/s.
const UNDER_WAY: f64 = 3.0;
/// A course that changes by less than this is straight, rad.
const STRAIGHT: f64 = 10.0 * DEG;
/// She may begin to drift athwart by so much, m/s, and her heading be off by so much for other reasons, rad.
const DRIFT: f64 = 1.0;
const OWN: f64 = 3.0 * DEG;

/// Course, and heading less course, rad.
#[derive(Clone, Copy, Debug, Default)]
struct Look {
    course: f64,
    slip: f64,
}

/// The latest looks.
#[derive(Clone, Debug)]
pub struct Slip {
    looks: [Look; SPAN],
    count: usize,
    last: Option<Time>,
    /// Smoothed: velocity north and east, m/s, and where the bow points seen from the course, times the speed.
    smooth: Option<(Vector2<f64>, Vector2<f64>)>,
}

impl Default for Slip {
    fn default() -> Self {
        Slip { looks: [Look::default(); SPAN], count: 0, last: None, smooth: None }
    }
}

impl Slip {
    /// Whether it is time to look.
    #[must_use]
    pub fn is_due(&self, now: Time) -> bool {
        self.last.is_none_or(|last| (now - last).as_seconds() >= SPACING)
    }

    /// Takes velocity, north and east, m/s, and heading, rad. Tells whether the heading has turned as it cannot have
    /// within five minutes of a straight course; `unsure` is the 1-sigma of its error, rad.
    pub fn see(&mut self, now: Time, velocity: Vector2<f64>, heading: f64, unsure: f64) -> bool {
        let since = self.last.replace(now).map_or(GAP, |last| (now - last).as_seconds());
        if since >= GAP || velocity.norm() < UNDER_WAY {
            self.restart();
        }
        let course = velocity.y.atan2(velocity.x);
        let bow = Rotation2::new(heading - course) * Vector2::new(velocity.norm(), 0.0);
        let share = (since / SWELL).min(1.0);
        let (mean, bow) = self.smooth.map_or((velocity, bow), |(mean, before)| {
            (mean.lerp(&velocity, share), before.lerp(&bow, share))
        });
        self.smooth = Some((mean, bow));
        let now = Look { course: mean.y.atan2(mean.x), slip: bow.y.atan2(bow.x) };
        let limit = (DRIFT / mean.norm()).min(1.0).asin() + OWN + 3.0 * unsure;
        let is_absurd = self.greatest_change(&now) > limit;
        self.looks[self.count % SPAN] = now;
        self.count += 1;
        is_absurd
    }

    /// By how much the slip has changed at most since her course has been straight, rad.
    fn greatest_change(&self, now: &Look) -> f64 {
        let known = self.count.min(SPAN);
        let backwards = (1..=known).map(|back| &self.looks[(self.count - back) % SPAN]);
        let (mut port, mut starboard) = (0.0_f64, 0.0_f64);
        let is_straight = |look: &&Look| {
            let turned = wrap_pi(look.course - now.course);
            (port, starboard) = (port.min(turned), starboard.max(turned));
            starboard - port < STRAIGHT
        };
        let straight = backwards.take_while(is_straight);
        straight.map(|look| wrap_pi(now.slip - look.slip).abs()).fold(0.0, f64::max)
    }

    /// Forgets what was before.
    pub fn restart(&mut self) {
        (self.count, self.smooth) = (0, None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seconds until it is absurd, looked at every other second, of a ship that makes 6 m/s while course and heading turn at such rates, deg/s.
    fn absurd_after(course: f64, heading: f64) -> Option<i32> {
        let mut slip = Slip::default();
        (0..600).step_by(2).find(|second| {
            let t = f64::from(*second);
            let wave = (t * 0.6).sin();
            let (course, heading) = (course * t + 4.0 * wave, heading * t - 3.0 * wave);
            let velocity = Rotation2::new(course * DEG) * Vector2::new(6.0, 0.0);
            slip.see(Time::from_seconds(t), velocity, heading * DEG, 0.5 * DEG)
        })
    }

    #[test]
    fn a_heading_that_turns_on_a_straight_course_is_absurd() {
        assert!(absurd_after(0.0, 0.5).is_some_and(|at| (20..45).contains(&at)));
        assert!(absurd_after(0.0, -0.15).is_some_and(|at| (80..130).contains(&at)));
        assert!(absurd_after(0.0, 0.07).is_some_and(|at| (140..290).contains(&at)));
    }

    #[test]
    fn a_turn_and_the_sea_are_not() {
        assert_eq!(absurd_after(0.0, 0.0), None);
        assert_eq!(absurd_after(1.5, 1.5), None);
        assert_eq!(absurd_after(-0.2, -0.2), None);
    }

    #[test]
    fn nothing_is_said_of_a_ship_that_makes_no_way() {
        let mut slip = Slip::default();
        let drifting = Vector2::new(0.5, 0.3);
        let is_absurd = (0..300).any(|second| {
            let t = f64::from(second);
            slip.see(Time::from_seconds(t), drifting, t * DEG, 0.01)
        });
        assert!(!is_absurd);
    }
}
