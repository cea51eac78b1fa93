//! Line biases as states: means and covariance, and what a receiver of another clock adds to all of its own.

use nalgebra::{DMatrix, DVector};

use insd_base::satellites::LineBias;

/// 1-sigma of a line bias that is new and of a clock that is free, m: so much more than a phase is worth that it tells nothing.
const WIDE: f64 = 1.0;

/// What is known of line biases. Each is known up to whole wavelengths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineBiases {
    pub(super) keys: Vec<LineBias>,
    pub(super) mean: DVector<f64>,
    pub(super) covariance: DMatrix<f64>,
}

impl LineBiases {
    /// Each with its value and its 1-sigma, m, up to whole wavelengths.
    pub fn iter(&self) -> impl Iterator<Item = (LineBias, f64, f64)> + '_ {
        let sigma = |place: usize| self.covariance[(place, place)].sqrt();
        self.keys.iter().enumerate().map(move |(i, key)| (*key, self.mean[i], sigma(i)))
    }

    /// All of them wander for a while, s.
    pub(super) fn advance(&mut self, elapsed: f64, walk: f64) {
        for place in 0..self.keys.len() {
            self.covariance[(place, place)] += walk * walk * elapsed;
        }
    }

    /// Those that are not there yet are taken in. Gives back which are new.
    pub(super) fn join(&mut self, keys: &[LineBias]) -> Vec<bool> {
        let fresh: Vec<LineBias> =
            keys.iter().filter(|key| !self.keys.contains(key)).copied().collect();
        let (before, after) = (self.keys.len(), self.keys.len() + fresh.len());
        let mean = std::mem::replace(&mut self.mean, DVector::zeros(0));
        self.mean = mean.resize_vertically(after, 0.0);
        let covariance = std::mem::replace(&mut self.covariance, DMatrix::zeros(0, 0));
        self.covariance = covariance.resize(after, after, 0.0);
        for place in before..after {
            self.covariance[(place, place)] = WIDE * WIDE;
        }
        self.keys.extend(fresh);
        (0..after).map(|place| place >= before).collect()
    }

    pub(super) fn place(&self, key: &LineBias) -> Option<usize> {
        self.keys.iter().position(|own| own == key)
    }

    /// Some of them may all have moved by the same, whatever it is.
    pub(super) fn shake(&mut self, places: &[usize]) {
        for a in places {
            for b in places {
                self.covariance[(*a, *b)] += WIDE * WIDE;
            }
        }
    }

    /// Their inverse covariance, m^-2; nought where there is none.
    pub(super) fn information(&self) -> Option<DMatrix<f64>> {
        if self.keys.is_empty() {
            return Some(DMatrix::zeros(0, 0));
        }
        Some(self.covariance.clone().cholesky()?.inverse())
    }
}
