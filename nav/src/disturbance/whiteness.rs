//! Whether what a model leaves is white, and no larger than it claims.

use std::collections::VecDeque;

use insd_base::{Residual, SeenResidual};
use nalgebra::Vector2;

/// Lags that are looked at: half a minute of samples every four seconds.
const LAGS: usize = 8;
/// Samples after which one counts for 1/e.
const MEMORY: f64 = 75.0;
/// Independent samples before anything is said.
const FEWEST: f64 = 30.0;
/// Portmanteau statistic that white residuals exceed once in a thousand: chi-square of [`LAGS`] degrees of freedom.
const COLOURED: f64 = 26.1;
/// Power of the slow part over the claimed one beyond which the claim does not hold. Of honest seas it was up to 3.5 in
/// their first five minutes and up to 2.5 later.
const LOUD: f64 = 5.0;

/// Running correlations of residuals, each over its claimed sigma.
#[derive(Clone, Debug, Default)]
pub struct Whiteness {
    /// Newest first.
    past: VecDeque<Vector2<f64>>,
    /// Weighted sums of e(k) . e(k-j) / 2, j = 0, 1, ..
    products: [f64; LAGS + 1],
    weight: f64,
    squared_weight: f64,
}

impl Whiteness {
    /// The next residual over its claimed sigma.
    pub fn push(&mut self, residual: Vector2<f64>) {
        self.past.push_front(residual);
        self.past.truncate(LAGS + 1);
        let keep = (-1.0 / MEMORY).exp();
        self.weight = keep * self.weight + 1.0;
        self.squared_weight = keep * keep * self.squared_weight + 1.0;
        for (lag, product) in self.products.iter_mut().enumerate() {
            let with = self.past.get(lag).map_or(0.0, |before| 0.5 * residual.dot(before));
            *product = keep * *product + with;
        }
    }

    /// What is to be said of it, if it was looked at for long enough.
    #[must_use]
    pub fn verdict(&self) -> Option<Residual> {
        self.correlations().map(|correlations| self.judged(&correlations))
    }

    fn judged(&self, correlations: &[f64; LAGS + 1]) -> Residual {
        if slow(correlations) > LOUD {
            Residual::Loud
        } else if self.portmanteau(correlations) > COLOURED {
            Residual::Coloured
        } else {
            Residual::White
        }
    }

    /// What was seen of residuals at a spacing, s.
    #[must_use]
    pub fn seen(&self, spacing: f64) -> Option<SeenResidual> {
        let correlations = self.correlations()?;
        let lags = correlations.iter().enumerate().skip(1);
        let most = lags.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let (lag, correlation) = most?;
        Some(SeenResidual {
            verdict: self.judged(&correlations),
            level: correlations[0],
            slow: slow(&correlations),
            correlation: correlation / correlations[0].max(f64::MIN_POSITIVE),
            apart: lag as f64 * spacing,
        })
    }

    /// Mean of e(k) . e(k-j) / 2.
    fn correlations(&self) -> Option<[f64; LAGS + 1]> {
        let is_enough = self.independent() >= FEWEST;
        is_enough.then(|| self.products.map(|product| product / self.weight))
    }

    /// Samples of equal weight that would tell as much.
    fn independent(&self) -> f64 {
        self.weight * self.weight / self.squared_weight.max(f64::MIN_POSITIVE)
    }

    /// Chi-square of as many degrees of freedom as lags if the residuals are white: of two components the mean product at
    /// a lag has a variance of 1/(2 n) (Box and Pierce, J. American Statistical Association 65 (1970)).
    fn portmanteau(&self, correlations: &[f64; LAGS + 1]) -> f64 {
        let level = correlations[0].max(f64::MIN_POSITIVE);
        let squares = correlations[1..].iter().map(|r| (r / level).powi(2));
        2.0 * self.independent() * squares.sum::<f64>()
    }
}

/// Spectral density at frequency zero over that of white residuals as large as claimed, with the weights of Bartlett:
/// what the error of a slow state has in excess of its claim, as a variance (Newey and West, Econometrica 55 (1987)).
fn slow(correlations: &[f64; LAGS + 1]) -> f64 {
    let weight = |lag: usize| 1.0 - lag as f64 / (LAGS + 1) as f64;
    let lags = correlations.iter().enumerate().skip(1);
    correlations[0] + 2.0 * lags.map(|(lag, r)| weight(lag) * r).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of residuals that are so many times the claimed, and hang together by `a` from one to the next.
    fn seen(scale: f64, a: f64) -> SeenResidual {
        let mut state = 3_u64;
        // the sum of four uniform ones has a variance of 1/3
        let mut noise = || {
            (0..4)
                .map(|_| {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                    (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
                })
                .sum::<f64>()
                * 3_f64.sqrt()
        };
        let mut whiteness = Whiteness::default();
        let mut last = Vector2::zeros();
        for _ in 0..400 {
            last = last * a + Vector2::new(noise(), noise()) * (1.0 - a * a).sqrt();
            whiteness.push(last * scale);
        }
        whiteness.seen(4.0).expect("enough")
    }

    #[test]
    fn white_residuals_are_white_however_small() {
        for scale in [0.3, 1.0] {
            let seen = seen(scale, 0.0);
            assert_eq!(seen.verdict, Residual::White, "{seen:?}");
            assert!((seen.level - scale * scale).abs() < 0.3 * scale * scale, "{seen:?}");
            assert!((seen.slow - scale * scale).abs() < 0.6 * scale * scale, "{seen:?}");
        }
    }

    #[test]
    fn residuals_that_hang_together_are_coloured_and_loud_if_their_slow_part_is() {
        let small = seen(0.6, 0.7);
        assert_eq!(small.verdict, Residual::Coloured, "{small:?}");
        assert!(small.correlation > 0.5 && small.apart == 4.0, "{small:?}");
        assert_eq!(seen(1.5, 0.7).verdict, Residual::Loud);
        assert_eq!(seen(3.0, 0.0).verdict, Residual::Loud);
    }

    #[test]
    fn a_few_residuals_tell_nothing() {
        let mut whiteness = Whiteness::default();
        (0..25).for_each(|_| whiteness.push(Vector2::new(9.0, 9.0)));
        assert_eq!(whiteness.verdict(), None);
    }
}
