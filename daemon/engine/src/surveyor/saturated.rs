//! Axes of the IMU that reach the end of their range: what is beyond is told as the very same greatest number, again and
//! again, and nothing ever goes beyond it.
//!
//! A wave that turns slowly within the steps of the digits dwells at its top, too, but gets there step by step. A range
//! is reached at speed, and left so: samples in a row that tell the same to the last digit are entered by a leap.

use super::axes::{Each, Watch};

/// Samples in a row that tell the same make a dwelling; it is entered by more steps of the digits than this, and is so many of them high.
const DWELLS: u32 = 4;
const LEAP: f64 = 3.0;
const HIGH: f64 = 50.0;
/// Dwellings at the same number, and the share of the time of late that they take, by which a range is known; a single
/// blow of the sea does not.
const REACHED: u32 = 3;
const SHARE: f64 = 0.01;
/// What is late, s, and after how long without any it is forgotten, s.
const LATE: f64 = 60.0;
const FORGOTTEN: f64 = 300.0;

/// One axis.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Axis {
    last: f64,
    /// What was told before that, and for how many samples that has been told.
    before: f64,
    run: u32,
    /// The finest step of the digits that was seen.
    step: Option<f64>,
    /// The end of the range, as far as is known, dwellings there, their share of the time, and since when there was none, s.
    end: f64,
    dwellings: u32,
    share: f64,
    since: f64,
    is_saturated: bool,
}

impl Watch for Axis {
    fn see(&mut self, value: f64, duration: f64) {
        if value == self.last {
            self.run = self.run.saturating_add(1);
        } else {
            let step = (value - self.last).abs();
            self.step = Some(self.step.map_or(step, |finest| finest.min(step)));
            (self.before, self.last, self.run) = (self.last, value, 1);
        }
        if value.abs() > self.end {
            (self.dwellings, self.share) = (0, 0.0);
            self.end = f64::INFINITY;
        }
        let dwells = self.dwells();
        if dwells && self.run == DWELLS {
            self.reach(value.abs());
        }
        self.share += (f64::from(u8::from(dwells)) - self.share) * (duration / LATE).min(1.0);
        self.since = if dwells { 0.0 } else { self.since + duration };
        self.is_saturated |= self.dwellings >= REACHED && self.share > SHARE;
        self.is_saturated &= self.since < FORGOTTEN;
    }

    fn is_wrong(&self) -> bool {
        self.is_saturated
    }
}

impl Axis {
    fn dwells(&self) -> bool {
        let Some(step) = self.step.filter(|_| self.run >= DWELLS) else { return false };
        (self.last - self.before).abs() > LEAP * step && self.last.abs() > HIGH * step
    }

    fn reach(&mut self, end: f64) {
        self.dwellings = if end == self.end { self.dwellings.saturating_add(1) } else { 1 };
        self.end = end;
    }
}

/// All six.
pub(super) type Saturated = Each<Axis>;

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::{Body, ImuSample, Time};

    /// Whether an axis is found to reach the end of its range within so many seconds at 100 Hz, and when, s.
    fn found(seconds: u32, of: impl Fn(f64) -> f64) -> Option<f64> {
        let mut saturated = Saturated::default();
        (0..seconds * 100).map(|k| f64::from(k) * 0.01).find(|at| {
            let sample = ImuSample {
                time: Time::from_seconds(*at),
                delta_theta: Body::new(of(*at), 0.0, 0.0),
                delta_velocity: Body::default(),
            };
            saturated.see(&sample, 0.01);
            saturated.axes().is_some()
        })
    }

    /// A wave with a little noise.
    fn wave(t: f64) -> f64 {
        3.0 * (0.7 * t).sin() + 0.01 * (t * t * 37.0).sin()
    }

    fn in_steps(value: f64, step: f64) -> f64 {
        (value / step).round() * step
    }

    #[test]
    fn a_wave_that_is_cut_off_is_found_within_two_of_them() {
        for end in [0.6, 2.0, 2.9] {
            let at = found(120, |t| wave(t).clamp(-end, end));
            assert!(at.is_some_and(|at| at < 20.0), "{end}: {at:?}");
        }
        let coarse = found(120, |t| in_steps(wave(t), 0.002).clamp(-2.0, 2.0));
        assert!(coarse.is_some_and(|at| at < 20.0), "{coarse:?}");
    }

    #[test]
    fn digits_of_a_wave_are_no_end_of_a_range() {
        for step in [1e-4, 0.01, 0.1, 1.0] {
            assert_eq!(found(600, |t| in_steps(wave(t), step)), None, "{step}");
            assert_eq!(found(600, |t| in_steps(3.0 * (0.1 * t).sin(), step)), None, "{step}");
        }
    }

    #[test]
    fn one_blow_of_the_sea_is_not_told() {
        let blow = |t: f64| if t % 50.0 < 0.06 { 4.0 } else { wave(t) };
        assert_eq!(found(600, blow), None);
    }
}
