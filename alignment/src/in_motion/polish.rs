//! How long a heading that is good enough for the filter is made finer by phases before it is handed over.

use insd_base::Time;

use crate::progress::Progress;

/// Longest, s.
const PATIENCE: f64 = 60.0;
/// Who does not better the heading by a fifth in so long, s, does not better it: the filter knows more of the sensors.
const STALL: f64 = 10.0;
const BETTER: f64 = 0.2;

/// A heading that is being made finer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polish {
    begun: Time,
    progress: Progress,
    has_stalled: bool,
}

impl Polish {
    /// Begins with a 1-sigma, rad.
    pub(super) fn begin(now: Time, sigma: f64) -> Self {
        let progress = Progress::begin((STALL, BETTER), 0.0, sigma);
        Polish { begun: now, progress, has_stalled: false }
    }

    /// Hears of the heading's 1-sigma, rad.
    pub(super) fn hear(&mut self, now: Time, sigma: f64) {
        self.has_stalled |= self.progress.stalls((now - self.begun).as_seconds(), sigma);
    }

    /// Whether it is worth while.
    pub(super) fn goes_on(&self, now: Time) -> bool {
        !self.has_stalled && (now - self.begun).as_seconds() < PATIENCE
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(seconds: f64) -> Time {
        Time::from_seconds(seconds)
    }

    fn until(sigma: impl Fn(f64) -> f64) -> f64 {
        let mut polish = Polish::begin(at(0.0), sigma(0.0));
        let mut seconds = 0.0;
        while polish.goes_on(at(seconds)) {
            seconds += 1.0;
            polish.hear(at(seconds), sigma(seconds));
        }
        seconds
    }

    #[test]
    fn a_heading_that_gets_better_is_waited_for_a_minute_and_one_that_does_not_for_ten_seconds() {
        assert_eq!(until(|seconds| 0.1 * (-seconds / 30.0).exp()), 60.0);
        assert_eq!(until(|_| 0.08), 10.0);
        assert_eq!(
            until(|seconds| if seconds < 15.0 { 0.08 - 0.003 * seconds } else { 0.035 }),
            30.0
        );
    }
}
