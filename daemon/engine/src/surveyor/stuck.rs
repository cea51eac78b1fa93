//! Axes of the IMU that stand still: they tell the same number again and again.
//!
//! Noise makes two samples in a row differ, but for coarse steps of the digits and a ship at rest, where
//! runs of equal numbers are usual. So an axis is held against its own past: it stands still when it has told the same for many
//! times the longest run that it ever made before. One that has never moved is not judged.

use super::axes::{Each, Watch};

/// Times the longest run before, and at least so long, s.
const LONGER: f64 = 20.0;
const LEAST: f64 = 0.5;
/// An axis is judged after so many changes, and moves again after as many.
const CHANGES: u32 = 100;

/// One axis.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Axis {
    last: f64,
    /// How long it has told that, and the longest that it ever did so, s.
    run: f64,
    longest: f64,
    changes: u32,
    stuck: bool,
}

impl Watch for Axis {
    fn see(&mut self, value: f64, duration: f64) {
        if value == self.last {
            self.run += duration;
            let limit = LEAST.max(LONGER * self.longest);
            if self.changes >= CHANGES && self.run > limit {
                (self.stuck, self.changes) = (true, 0);
            }
            return;
        }
        if !self.stuck {
            self.longest = self.longest.max(self.run);
        }
        self.changes = self.changes.saturating_add(1);
        self.stuck &= self.changes < CHANGES;
        (self.last, self.run) = (value, 0.0);
    }

    fn is_wrong(&self) -> bool {
        self.stuck
    }
}

/// All six.
pub(super) type Stuck = Each<Axis>;

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{Body, ImuSample, Time};

    /// Sees what a function tells of each sample at 100 Hz, for so many seconds.
    fn seen(stuck: &mut Stuck, from: u32, seconds: u32, of: impl Fn(u32) -> f64) {
        for k in from * 100..(from + seconds) * 100 {
            let at = f64::from(k) * 0.01;
            let noise = |n: u32| f64::from((k * 7919 + n * 104_729) % 1000) * 1e-6;
            stuck.see(
                &ImuSample {
                    time: Time::from_seconds(at),
                    delta_theta: Body::new(noise(1), noise(2), of(k)),
                    delta_velocity: Body::new(noise(3), noise(4), noise(5)),
                },
                0.01,
            );
        }
    }

    #[test]
    fn an_axis_that_stands_still_is_found_within_a_second_and_forgiven_when_it_moves() {
        let mut stuck = Stuck::default();
        seen(&mut stuck, 0, 20, |k| f64::from(k % 17));
        assert_eq!(stuck.axes(), None);
        seen(&mut stuck, 20, 1, |_| 3.0);
        let axes = stuck.axes().unwrap();
        assert_eq!((axes.gyro, axes.accel), ([false, false, true], [false; 3]));
        seen(&mut stuck, 21, 3, |k| f64::from(k % 17));
        assert_eq!(stuck.axes(), None);
    }

    #[test]
    fn coarse_digits_of_a_ship_at_rest_are_not_standing_still() {
        let mut stuck = Stuck::default();
        // a step of the digits every 13 samples, now and then only after 26
        seen(&mut stuck, 0, 120, |k| f64::from(u32::from(k % 13 == 0 && k % 130 != 0)));
        assert_eq!(stuck.axes(), None);
        seen(&mut stuck, 120, 10, |_| 0.0);
        assert!(stuck.axes().is_some(), "but ten seconds of it are");
    }

    #[test]
    fn an_axis_that_has_never_moved_is_not_judged() {
        let mut stuck = Stuck::default();
        seen(&mut stuck, 0, 60, |_| 0.0);
        assert_eq!(stuck.axes(), None);
    }
}
