//! The sea as an autoregression of the ship's *displacement*, fitted to a sliding window.
//!
//! d(k) = sum A_i d(k-i) + eps(k), both horizontal axes jointly; A(q) = I - sum A_i q^-i makes white noise of the
//! displacement. The displacement of a ship on her moorings has finite power at frequency zero, which such a model
//! has, too; her velocity has none there, which no autoregression of the velocity can say.

use std::collections::VecDeque;

use insd_base::Span;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::prior::{SAMPLES, SeaPrior};

/// Settings of the autoregression of the displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WhiteningConfig {
    /// From sample to sample.
    pub spacing: Span,
    /// Length of the window.
    pub window: Span,
    /// Number of lags.
    pub order: usize,
}

impl Default for WhiteningConfig {
    fn default() -> Self {
        WhiteningConfig {
            spacing: Span::from_seconds(4.0),
            window: Span::from_seconds(900.0),
            order: 8,
        }
    }
}

/// A displacement and how clearly it was seen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Displacement {
    /// Forward and to starboard, m.
    pub seen: Vector2<f64>,
    /// Weight of it in the fit, 0..1.
    pub clearness: f64,
}

/// Samples of a sliding window, and what they tell of the sea: a sample that comes is added to the sums, one that leaves
/// is taken away.
#[derive(Clone, Debug)]
pub struct SeaWindow {
    /// Newest first; nothing where one was lost.
    samples: VecDeque<Option<Displacement>>,
    sums: SeaSums,
    length: usize,
    /// Samples since the sums were last added up from nothing.
    since_renewal: usize,
}

/// Sums of products of samples with those before them: with x(k) = [d(k); d(k-1); ..; d(k-p)], sum x x^T over the samples
/// that have an unbroken past, the normal equations of every order up to p.
#[derive(Clone, Debug)]
pub struct SeaSums {
    moments: DMatrix<f64>,
    weight: f64,
    order: usize,
}

/// A(q) of an order.
#[derive(Clone, Debug)]
pub struct Whitener {
    coefficients: Vec<Matrix2<f64>>,
    covariance: Matrix2<f64>,
    regressors: Cholesky<f64, Dyn>,
}

impl SeaWindow {
    /// An empty window.
    #[must_use]
    pub fn new(config: &WhiteningConfig) -> Self {
        let length = (config.window.as_seconds() / config.spacing.as_seconds()).round() as usize;
        SeaWindow {
            samples: VecDeque::new(),
            sums: SeaSums::none(config.order),
            length: length.max(2 * config.order),
            since_renewal: 0,
        }
    }

    /// Whether there is no sample.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.samples.is_empty()
    }

    /// What the samples tell.
    #[must_use]
    pub fn sums(&self) -> &SeaSums {
        &self.sums
    }

    /// The samples, oldest first; nothing where one was lost.
    pub fn samples(&self) -> impl Iterator<Item = Option<Displacement>> {
        self.samples.iter().rev().copied()
    }

    /// The newest samples before the first that was lost, oldest first, m.
    #[must_use]
    pub fn newest_run(&self) -> Vec<Vector2<f64>> {
        let run = self.samples.iter().map_while(|sample| sample.map(|sample| sample.seen));
        let newest_first: Vec<_> = run.collect();
        newest_first.into_iter().rev().collect()
    }

    /// The next sample; nothing where it was lost.
    pub fn push(&mut self, sample: Option<Displacement>) {
        self.samples.push_front(sample);
        self.add_row(0, 1.0);
        if self.samples.len() <= self.length {
            return;
        }
        self.add_row(self.samples.len() - 1 - self.sums.order, -1.0);
        self.samples.pop_back();
        self.since_renewal += 1;
        if self.since_renewal >= self.length {
            self.renew();
        }
    }

    /// Adds the sums up from nothing: adding and taking away leaves its rounding.
    fn renew(&mut self) {
        self.sums = SeaSums::none(self.sums.order);
        self.since_renewal = 0;
        for newest in 0..self.samples.len().saturating_sub(self.sums.order) {
            self.add_row(newest, 1.0);
        }
    }

    /// Adds the row whose newest sample lies so many back, or takes it away.
    fn add_row(&mut self, newest: usize, sign: f64) {
        let Some((row, clearness)) = self.row(newest) else { return };
        self.sums.moments.ger(sign * clearness, &row, &row, 1.0);
        self.sums.weight += sign * clearness;
    }

    fn row(&self, newest: usize) -> Option<(DVector<f64>, f64)> {
        let clearness = self.samples.get(newest).copied().flatten()?.clearness;
        let mut row = DVector::zeros(2 * (self.sums.order + 1));
        for lag in 0..=self.sums.order {
            let sample = self.samples.get(newest + lag).copied().flatten()?;
            row.fixed_rows_mut::<2>(2 * lag).copy_from(&sample.seen);
        }
        Some((row, clearness))
    }
}

impl SeaSums {
    /// Of no samples.
    #[must_use]
    pub fn none(order: usize) -> Self {
        let size = 2 * (order + 1);
        SeaSums { moments: DMatrix::zeros(size, size), weight: 0.0, order }
    }

    /// So many samples, each as far as it was seen clearly.
    #[must_use]
    pub fn weight(&self) -> f64 {
        self.weight
    }

    /// Mean square of one component, m^2; zero before any was seen.
    #[must_use]
    pub fn mean_square(&self) -> f64 {
        let sum = self.moments[(0, 0)] + self.moments[(1, 1)];
        if self.weight > 0.0 { sum / (2.0 * self.weight) } else { 0.0 }
    }

    /// The model of so many lags that follows from what was seen and what was known before, if the kinds of sea that
    /// are known have these logarithms of their odds. `None` if the numbers are out of range.
    #[must_use]
    pub fn fit(&self, lags: usize, prior: &SeaPrior, odds: &[f64]) -> Option<Whitener> {
        let lags = lags.min(self.order);
        let moments =
            &self.moments + prior.moments(odds, prior.variance(self.weight, self.mean_square()));
        let past = 2 * lags;
        let regressors = Cholesky::new(moments.view((2, 2), (past, past)).into_owned())?;
        let across = moments.view((2, 0), (past, 2)).into_owned();
        let solved = regressors.solve(&across);
        let unexplained = moments.fixed_view::<2, 2>(0, 0) - across.tr_mul(&solved);
        // what was known before costs no freedom
        let samples = self.weight + SAMPLES;
        let freedom = (samples - past as f64 * self.weight / samples).max(1.0);
        let lag = |lag: usize| Matrix2::from_fn(|axis, from| solved[(2 * lag + from, axis)]);
        Some(Whitener {
            coefficients: (0..lags).map(lag).collect(),
            covariance: Matrix2::from_fn(|i, j| unexplained[(i, j)]) / freedom,
            regressors,
        })
    }
}

impl Whitener {
    /// A_1 .. A_p.
    #[must_use]
    pub fn coefficients(&self) -> &[Matrix2<f64>] {
        &self.coefficients
    }

    /// Covariance of eps, m^2.
    #[must_use]
    pub fn residual_covariance(&self) -> &Matrix2<f64> {
        &self.covariance
    }

    /// Covariance of what is not foretold from a past, newest first, m^2: that of eps, and that of the coefficients
    /// (Luetkepohl, New Introduction to Multiple Time Series Analysis, section 3.5).
    #[must_use]
    pub fn covariance(&self, past: &[Vector2<f64>]) -> Matrix2<f64> {
        let past = past.iter().flat_map(|d| [d.x, d.y]);
        let row = DVector::from_iterator(2 * self.coefficients.len(), past);
        self.covariance * (1.0 + row.dot(&self.regressors.solve(&row)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn config(order: usize, samples: f64) -> WhiteningConfig {
        let spacing = Span::from_seconds(4.0);
        WhiteningConfig { spacing, window: Span::from_seconds(4.0 * samples), order }
    }

    /// Noise without memory, of variance 1/12.
    fn noise(state: &mut u64) -> f64 {
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }

    fn clear(seen: Vector2<f64>) -> Option<Displacement> {
        Some(Displacement { seen, clearness: 1.0 })
    }

    /// Samples of d(k) = A_1 d(k-1) + A_2 d(k-2) + eps(k).
    fn sea(a: [Matrix2<f64>; 2], count: usize) -> Vec<Vector2<f64>> {
        let mut state = 7;
        let mut sea = vec![Vector2::zeros(); 2];
        for k in 2..count {
            let eps = Vector2::new(noise(&mut state), noise(&mut state));
            sea.push(a[0] * sea[k - 1] + a[1] * sea[k - 2] + eps);
        }
        sea
    }

    fn swaying() -> [Matrix2<f64>; 2] {
        // periods of 60 s to the north, of 40 s to the east, and a little of the one in the other
        [Matrix2::new(1.72, 0.05, -0.03, 1.53), Matrix2::new(-0.9, 0.0, 0.0, -0.9)]
    }

    #[test]
    fn a_long_window_finds_the_sea_that_made_it() {
        let mut window = SeaWindow::new(&config(2, 20_000.0));
        sea(swaying(), 20_000).into_iter().for_each(|d| window.push(clear(d)));
        let prior = SeaPrior::new(4.0, 2).stated(1.0);
        // 40 to 90 s and few waves, as its samples told one after the other
        let mut odds = prior.odds();
        odds[4] = 30.0;
        let whitener = window.sums().fit(2, &prior, &odds).expect("a model");
        for (found, made) in whitener.coefficients().iter().zip(swaying()) {
            assert_relative_eq!(*found, made, epsilon = 0.03);
        }
        let expected = Matrix2::from_diagonal_element(1.0 / 12.0);
        let claimed = whitener.covariance(&[Vector2::zeros(); 2]);
        assert_relative_eq!(claimed, expected, epsilon = 0.005);
    }

    #[test]
    fn what_left_the_window_is_as_if_it_had_never_been() {
        let samples = sea(swaying(), 400);
        let mut slid = SeaWindow::new(&config(3, 90.0));
        let mut fresh = SeaWindow::new(&config(3, 90.0));
        let lost = |k: usize, d: Vector2<f64>| clear(d).filter(|_| k % 37 != 5);
        for (k, d) in samples.iter().enumerate() {
            slid.push(lost(k, *d));
            if k >= 310 {
                fresh.push(lost(k, *d));
            }
        }
        assert_relative_eq!(slid.sums.moments, fresh.sums.moments, max_relative = 1e-10);
        assert_relative_eq!(slid.sums.weight, fresh.sums.weight, max_relative = 1e-12);
    }

    #[test]
    fn before_anything_was_seen_the_claim_is_the_stated_displacement_or_less() {
        let window = SeaWindow::new(&config(12, 225.0));
        let prior = SeaPrior::new(4.0, 12).stated(0.5);
        let claims: Vec<f64> = (0..=12)
            .map(|lags| {
                let whitener = window.sums().fit(lags, &prior, &prior.odds()).expect("a model");
                whitener.covariance(&vec![Vector2::zeros(); lags])[(0, 0)].sqrt()
            })
            .collect();
        assert!((0.5..0.7).contains(&claims[0]), "{claims:?}");
        assert!(claims.windows(2).all(|pair| pair[1] <= pair[0]), "{claims:?}");
        assert!(claims[12] < 0.9 * claims[0], "{claims:?}");
    }

    #[test]
    fn what_was_not_seen_clearly_teaches_little() {
        let mut window = SeaWindow::new(&config(2, 300.0));
        for seen in sea(swaying(), 300) {
            window.push(Some(Displacement { seen, clearness: 1e-4 }));
        }
        let prior = SeaPrior::new(4.0, 2).stated(1.0);
        let first =
            |sums: &SeaSums| sums.fit(2, &prior, &prior.odds()).expect("a model").coefficients()[0];
        assert_relative_eq!(first(window.sums()), first(&SeaSums::none(2)), epsilon = 0.02);
    }
}
