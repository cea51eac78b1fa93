//! How many independent samples a series of correlated errors is worth.

use insd_base::{Span, Time};
use serde::Serialize;

/// Lags grow by this factor once they are longer than twenty steps: a correlation is smooth.
const LAG_GROWTH: f64 = 1.05;
/// Cells of the grid of time for each sample: a series with long gaps has a coarser grid.
const CELLS_PER_SAMPLE: usize = 10;
/// Pairs of samples that a lag needs.
const LEAST_PAIRS: usize = 10;

/// What a series is worth as a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Independence {
    /// Time between samples that would tell as much if they were independent, s.
    pub correlation_time_s: f64,
    /// Number of independent samples that tell as much as the series, at least 1.
    pub samples: f64,
}

/// The number of independent samples that n correlated ones are worth: n / (1 + 2 (rho_1 + rho_2 + ...)), with the
/// correlation of errors about zero, not about their mean, up to the lag at which it is first zero (at most half the
/// series). An error that stays the same for all of the time makes one sample. Sokal, Monte Carlo methods in
/// statistical mechanics, section 3. `None` without samples.
pub(super) fn independence(samples: &[(Time, [f64; 2])]) -> Option<Independence> {
    let grid = Grid::new(samples)?;
    let (mut sum, mut last, mut lag) = (0.0, (0_usize, 1.0), 1_usize);
    while lag <= grid.cells.len() / 2 {
        let Some(rho) = grid.correlation(lag).filter(|rho| *rho > 0.0) else { break };
        // the lags after the last one up to this one, on a straight line
        let steps = (lag - last.0) as f64;
        sum += 0.5 * (steps * (last.1 + rho) + rho - last.1);
        last = (lag, rho);
        lag = if lag < 20 { lag + 1 } else { (lag as f64 * LAG_GROWTH) as usize };
    }
    let count = samples.len() as f64;
    let worth = (count / (1.0 + 2.0 * sum)).clamp(1.0, count);
    Some(Independence { correlation_time_s: count * grid.step_s / worth, samples: worth })
}

/// Samples at even steps of time.
struct Grid {
    step_s: f64,
    cells: Vec<Option<[f64; 2]>>,
    /// Mean square of a sample.
    power: f64,
}

impl Grid {
    fn new(samples: &[(Time, [f64; 2])]) -> Option<Self> {
        let (first, last) = (samples.first()?.0, samples.last()?.0);
        let mut steps: Vec<Span> = samples.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
        steps.sort_unstable();
        let median = steps.get(steps.len() / 2).map_or(0.0, |step| step.as_seconds());
        let length = (last - first).as_seconds();
        let step_s = median.max(length / (CELLS_PER_SAMPLE * samples.len()) as f64);
        let cell = |time: Time| {
            if step_s > 0.0 { ((time - first).as_seconds() / step_s).round() as usize } else { 0 }
        };
        let mut cells = vec![None; cell(last) + 1];
        samples.iter().for_each(|(time, error)| cells[cell(*time)] = Some(*error));
        let squares: f64 = samples.iter().map(|(_, error)| dot(error, error)).sum();
        Some(Grid { step_s, cells, power: squares / samples.len() as f64 })
    }

    /// Correlation of samples that are so many cells apart; `None` where there are too few.
    fn correlation(&self, lag: usize) -> Option<f64> {
        let pairs = self.cells.iter().zip(self.cells.iter().skip(lag));
        let (mut sum, mut count) = (0.0, 0_usize);
        for (a, b) in pairs.filter_map(|(a, b)| a.as_ref().zip(b.as_ref())) {
            sum += dot(a, b);
            count += 1;
        }
        (count >= LEAST_PAIRS && self.power > 0.0).then(|| sum / count as f64 / self.power)
    }
}

fn dot(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    /// A Gauss-Markov process in two axes, with its correlation from sample to sample.
    fn markov(count: usize, keep: f64) -> Vec<(Time, [f64; 2])> {
        let mut random = rand_pcg::Pcg64::seed_from_u64(7);
        let mut state = [0.0; 2];
        let drive = (1.0 - keep * keep).sqrt();
        let mut next = |at: usize| {
            for axis in &mut state {
                let noise: f64 = StandardNormal.sample(&mut random);
                *axis = keep * *axis + drive * noise;
            }
            (Time::from_seconds(0.1 * at as f64), state)
        };
        (0..count).map(&mut next).collect()
    }

    #[test]
    fn white_errors_are_worth_their_number() {
        let found = independence(&markov(5000, 0.0)).unwrap();
        assert!(found.samples > 4000.0, "{found:?}");
        assert!(found.correlation_time_s < 0.13, "{found:?}");
    }

    #[test]
    fn correlated_errors_are_worth_the_length_over_twice_their_time_constant() {
        // of 200 samples, 20 s
        let found = independence(&markov(100_000, (-1.0_f64 / 200.0).exp())).unwrap();
        assert!((150.0..350.0).contains(&found.samples), "{found:?}");
        assert!((28.0..70.0).contains(&found.correlation_time_s), "{found:?}");
    }

    #[test]
    fn an_error_that_stays_is_one_sample_or_two() {
        let constant: Vec<_> =
            (0..3000).map(|at| (Time::from_seconds(f64::from(at)), [3.0, 0.0])).collect();
        let found = independence(&constant).unwrap();
        assert!((1.0..=2.0).contains(&found.samples), "{found:?}");
    }

    #[test]
    fn a_single_sample_nothing_and_a_long_gap_are_no_trouble() {
        assert!(independence(&[]).is_none());
        let one = [(Time::from_seconds(5.0), [1.0, 1.0])];
        assert!((independence(&one).unwrap().samples - 1.0).abs() < 1e-12);
        let mut gap = markov(50, 0.0);
        gap.push((Time::from_seconds(1e9), [1.0, 0.0]));
        assert!(independence(&gap).unwrap().samples >= 1.0);
        let exact = [(Time::from_seconds(0.0), [0.0; 2]), (Time::from_seconds(1.0), [0.0; 2])];
        assert!(independence(&exact).unwrap().samples >= 1.0);
    }
}
