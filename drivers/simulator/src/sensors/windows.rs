//! The spans of time in which faults hold.

use rand_pcg::Pcg64;

use crate::random::uniform;
use crate::scenario::{Spread, When};

/// A span of time, its end excluded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window {
    /// Beginning, s.
    pub(crate) start: f64,
    /// End, s.
    pub(crate) end: f64,
}

impl Window {
    /// Whether `t`, s, is in it.
    pub(crate) fn contains(&self, t: f64) -> bool {
        (self.start..self.end).contains(&t)
    }
}

/// A value of a spread.
pub(crate) fn draw(spread: Spread, rng: &mut Pcg64) -> f64 {
    let [low, high] = spread.bounds();
    uniform(rng, low, high)
}

/// The spans of one fault. Random ones share the window out evenly among them, each at a random
/// place within its share, so that they never overlap.
pub(crate) fn windows(when: &When, duration: Spread, rng: &mut Pcg64) -> Vec<Window> {
    let mut spans: Vec<Window> =
        when.at_s.iter().map(|&start| Window { start, end: start + draw(duration, rng) }).collect();
    if let Some([from, to]) = when.window_s {
        let share = (to - from) / f64::from(when.count.max(1));
        spans.extend((0..when.count).map(|index| {
            let length = draw(duration, rng);
            let slack = (share - length).max(0.0);
            let start = from + share * f64::from(index) + uniform(rng, 0.0, slack);
            Window { start, end: start + length }
        }));
    }
    spans
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, stream};

    #[test]
    fn random_windows_keep_to_their_span_and_do_not_overlap() {
        let when = When { at_s: vec![], count: 8, window_s: Some([100.0, 500.0]) };
        let duration = Spread::Between([10.0, 50.0]);
        let spans = windows(&when, duration, &mut stream(1, Purpose::GnssJumps));
        assert_eq!(spans.len(), 8);
        assert!(spans.windows(2).all(|pair| pair[0].end <= pair[1].start));
        assert!(spans[0].start >= 100.0 && spans[7].end <= 500.0);
    }
}
