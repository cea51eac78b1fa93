//! The mean height over a window of waves.
//!
//! Heave is narrow-band: single heights would alias the waves into a slow drift. Over a window of
//! several waves the heave nearly cancels, and what is left of it is learnt from the data.

use serde::{Deserialize, Serialize};

use crate::config::SeaModel;
use crate::spread::Spread;

/// Length of the window, s.
const WINDOW: f64 = 20.0;
/// No tide, swell or trim takes her so far from the level that was learnt, m;
const FAR: f64 = 10.0;
/// who is there in so many windows on end is not at sea.
const ON_END: u8 = 3;
/// What hills, locks and slopes of rivers leave of a mean level, 1-sigma, m: enough to keep a height that nothing else holds from running away.
pub const ASHORE: f64 = 100.0;
/// How far a road may go from a level that was seen in one window, 1-sigma, m: over n^2 of one that was seen in n on end.
const HILLY: f64 = 30.0;

/// Heights summed since the last mean was taken, and the spread of the means.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LevelWindow {
    sum: f64,
    length: f64,
    /// Spread of the mean heave.
    pub heave: Spread,
    /// Windows on end in which she was far from the level, and in which she was there; before anybody told her height none.
    far: u8,
    agreed: Option<u8>,
    /// She is not at sea.
    is_refuted: bool,
}

impl LevelWindow {
    /// An empty window.
    #[must_use]
    pub fn new(sea: &SeaModel) -> Self {
        LevelWindow {
            sum: 0.0,
            length: 0.0,
            heave: Spread::new(sea.initial_mean_heave, sea.least_mean_heave),
            far: 0,
            agreed: None,
            is_refuted: false,
        }
    }

    /// Sees how far the level is from a mean height that somebody else tells, m, beyond all that it may be off by or not.
    pub fn see(&mut self, off: f64, is_beyond: bool) {
        self.agreed = Some(if is_beyond { 0 } else { self.agreed.unwrap_or(0).saturating_add(1) });
        self.far = if is_beyond && off.abs() > FAR { self.far.saturating_add(1) } else { 0 };
        self.is_refuted |= self.far >= ON_END;
    }

    /// Whether she was seen where no sea is: it stays so.
    #[must_use]
    pub fn is_refuted(&self) -> bool {
        self.is_refuted
    }

    /// What is left of a mean height over the level of a ship, 1-sigma, m; where somebody told her height and nobody does now, she may be none as
    /// far as the level was not borne out.
    #[must_use]
    pub fn std(&self, is_told: bool) -> f64 {
        let hill = self.agreed.filter(|_| !is_told).map_or(0.0, |agreed| {
            let seen = f64::from(agreed.max(1));
            HILLY / (seen * seen)
        });
        self.heave.std().max(hill)
    }

    /// Adds a height, m, that held for `duration` s.
    pub fn add(&mut self, height: f64, duration: f64) {
        self.sum += height * duration;
        self.length += duration;
    }

    /// Whether the window is complete.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.length >= WINDOW
    }

    /// The mean height, m, and the length of the window, s; starts a new one.
    pub fn take_mean(&mut self) -> (f64, f64) {
        let taken = (self.sum / self.length, self.length);
        self.restart();
        taken
    }

    /// Starts a new window.
    pub fn restart(&mut self) {
        self.sum = 0.0;
        self.length = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window() -> LevelWindow {
        let sea = SeaModel { level_walk: 0.002, least_mean_heave: 0.02, initial_mean_heave: 0.3 };
        LevelWindow::new(&sea)
    }

    #[test]
    fn who_stays_tens_of_metres_from_the_sea_is_not_on_it() {
        let mut level = window();
        for off in [-12.0, -15.0] {
            level.see(off, true);
        }
        assert!(!level.is_refuted());
        level.see(-18.0, true);
        assert!(level.is_refuted());
        level.see(0.0, false);
        assert!(level.is_refuted(), "for good");
    }

    #[test]
    fn a_lock_a_leap_and_a_height_that_is_not_known_refute_no_sea() {
        let mut level = window();
        for window in 0..30 {
            level.see(7.0, true);
            level.see(30.0, window % 3 > 0);
        }
        for _ in 0..30 {
            level.see(30.0, false);
        }
        assert!(!level.is_refuted());
    }

    #[test]
    fn a_level_that_was_seen_once_holds_nobody_firmly_and_one_that_was_seen_for_minutes_does() {
        let mut level = window();
        assert!(level.std(false) < 1.0, "a ship that never hears a receiver is at sea");
        level.see(0.0, false);
        assert!(level.std(false) > 20.0 && level.std(true) < 1.0, "a road may climb");
        for _ in 0..14 {
            level.see(0.1, false);
        }
        assert!(level.std(false) < 1.0);
        level.see(2.0, true);
        assert!(level.std(false) > 20.0, "she was seen to climb");
    }
}
