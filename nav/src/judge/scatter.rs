//! How much an aid scatters from one epoch to the next, beside what it states.
//!
//! Second differences of successive innovations leave out whatever is constant or grows steadily: a jump, a drift, an
//! error of the estimate. Their median square leaves out outliers.

/// Looks that the memory spans.
const SPAN: usize = 15;
/// Medians of the mean of one, two and three squares of normal numbers.
const MEDIANS: [f64; 3] = [0.455, 0.693, 0.789];
/// Noise up to so many times the stated variance is taken as it is stated.
const HONEST: f64 = 3.0;

/// The latest second differences of one aid, as normalised squares.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scatter {
    squares: [f64; SPAN],
    count: usize,
    last: [Option<[f64; 3]>; 2],
}

impl Default for Scatter {
    fn default() -> Self {
        Scatter { squares: [0.0; SPAN], count: 0, last: [None; 2] }
    }
}

impl Scatter {
    /// Sees an innovation, each component in units of its stated noise; components that are not there are NaN.
    pub(super) fn see(&mut self, now: [f64; 3]) {
        let [first, second] = self.last;
        self.last = [second, Some(now)];
        if let (Some(first), Some(second)) = (first, second) {
            let of = |i: usize| (now[i] - 2.0 * second[i] + first[i]).powi(2) / 6.0;
            let squares = (0..3).map(of);
            let told: Vec<f64> = squares.filter(|square| square.is_finite()).collect();
            if !told.is_empty() {
                let mean = told.iter().sum::<f64>() / told.len() as f64;
                self.squares[self.count % SPAN] = mean / MEDIANS[told.len() - 1];
                self.count += 1;
            }
        }
    }

    /// By how much the variance of the noise is larger than stated; one where it is not.
    #[must_use]
    pub(super) fn factor(&self) -> f64 {
        if self.count < SPAN {
            return 1.0;
        }
        let mut sorted = self.squares;
        sorted.sort_by(f64::total_cmp);
        let typical = sorted[SPAN / 2];
        if typical > HONEST { typical } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(noise: f64, jump: f64) -> f64 {
        let mut scatter = Scatter::default();
        for i in 0..40_u32 {
            let wave = |k: u32| (f64::from(i * i + k) * 0.7).sin() * noise * 1.4;
            let off = if i > 30 { jump } else { 0.0 };
            scatter.see([wave(0) + off, wave(7) + off, f64::NAN]);
        }
        scatter.factor()
    }

    #[test]
    fn noise_beyond_what_is_stated_is_seen_and_a_jump_is_none() {
        assert_eq!(of(1.0, 0.0), 1.0);
        assert_eq!(of(1.0, 1e4), 1.0);
        assert!((30.0..300.0).contains(&of(10.0, 0.0)), "{}", of(10.0, 0.0));
    }

    #[test]
    fn what_drifts_away_faster_and_faster_is_no_noise() {
        let mut scatter = Scatter::default();
        for i in 0..40_u32 {
            scatter.see([f64::from(i * i) * 0.5, f64::NAN, f64::NAN]);
        }
        assert_eq!(scatter.factor(), 1.0);
    }
}
