//! Mean, deviation and extremes of what is not kept.

/// Running statistics of one quantity.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Statistics {
    count: u64,
    mean: f64,
    squares: f64,
    extremes: Option<(f64, f64)>,
}

impl Statistics {
    /// Takes a value in; one that is no number says nothing. Welford, Note on a method for calculating
    /// corrected sums of squares and products, Technometrics 4 (1962).
    pub(crate) fn add(&mut self, value: f64) {
        if !value.is_finite() {
            return;
        }
        self.count += 1;
        let before = value - self.mean;
        self.mean += before / self.count as f64;
        self.squares += before * (value - self.mean);
        let (least, greatest) = self.extremes.unwrap_or((value, value));
        self.extremes = Some((least.min(value), greatest.max(value)));
    }

    /// How many values.
    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// Their mean.
    pub(crate) fn mean(&self) -> Option<f64> {
        (self.count > 0).then_some(self.mean)
    }

    /// Their standard deviation about the mean.
    pub(crate) fn deviation(&self) -> Option<f64> {
        (self.count > 0).then(|| (self.squares / self.count as f64).sqrt())
    }

    /// Root of the mean square.
    pub(crate) fn root_mean_square(&self) -> Option<f64> {
        Some(self.deviation()?.hypot(self.mean()?))
    }

    /// The least and the greatest.
    pub(crate) fn extremes(&self) -> Option<(f64, f64)> {
        self.extremes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_figures_are_those_of_the_values() {
        let mut own = Statistics::default();
        assert_eq!((own.mean(), own.deviation(), own.extremes()), (None, None, None));
        [1.0, f64::NAN, 3.0, 5.0].into_iter().for_each(|value| own.add(value));
        assert_eq!((own.count(), own.mean(), own.extremes()), (3, Some(3.0), Some((1.0, 5.0))));
        assert!((own.deviation().unwrap() - (8.0_f64 / 3.0).sqrt()).abs() < 1e-12);
        assert!((own.root_mean_square().unwrap() - (35.0_f64 / 3.0).sqrt()).abs() < 1e-12);
    }
}
