//! What would be known if less had been taken for granted of some states beforehand.
//!
//! Some states e were taken to be normal about zero with variance s^2 each. Had that been the larger w^2, the information of the posterior
//! would be less by d = 1/s^2 - 1/w^2 on each of them, and with P_e the columns of the covariance that belong to e,
//!
//! G = (I/d - P_ee)^-1,   P' = P + P_e G P_e^T,   x' = x + P_e G e,
//!
//! by the matrix inversion lemma, as the mean of what was taken for granted is zero. How much likelier all that was measured is so is the
//! mean of the ratio of both priors over the posterior:
//!
//! ln BF = k ln(s/w) - ln(det(I - d P_ee)) / 2 + e^T G e / 2.
//!
//! Exact for constants. Of a Gauss-Markov state it is what a constant fault beside it of the same effect would do, as long as it is watched for less
//! than its time constant.
//! Held by `releasing_states_gives_what_a_filter_finds_that_never_held_them` and
//! `how_much_likelier_it_is_agrees_with_the_likelihoods_of_both_filters`.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, SMatrix, SVector};

use crate::block::Block;
use crate::covariance::Covariance;
use crate::key::Key;

/// A sub-solution in which some states were not held.
#[derive(Clone, Debug)]
pub struct Release<'a> {
    p: &'a Covariance,
    states: Vec<usize>,
    factor: Cholesky<f64, Dyn>,
    /// G e.
    weighted: DVector<f64>,
    /// Logarithm of how much likelier all that was measured is with it.
    pub log_factor: f64,
}

impl<'a> Release<'a> {
    /// Of states of a block, by their numbers in it and what is estimated of each, that were held to a sigma of `held` and are let
    /// free to one of `free`, in their unit. `None` where the block is not there or the numbers are none.
    #[must_use]
    pub fn new(
        p: &'a Covariance,
        key: Key,
        of: &[(usize, f64)],
        [held, free]: [f64; 2],
    ) -> Option<Self> {
        let place = p.layout().place(key)?;
        if of.is_empty() || free <= held || of.iter().any(|(state, _)| *state >= place.width) {
            return None;
        }
        let states: Vec<usize> = of.iter().map(|(state, _)| place.start + state).collect();
        let d = 1.0 / (held * held) - 1.0 / (free * free);
        let k = states.len();
        let own = DMatrix::from_fn(k, k, |i, j| p.matrix()[(states[i], states[j])]);
        let factor = Cholesky::new(DMatrix::identity(k, k) / d - own)?;
        let estimate = DVector::from_iterator(k, of.iter().map(|(_, value)| *value));
        let weighted = factor.solve(&estimate);
        let volume: f64 = factor.l_dirty().diagonal().iter().map(|own| (own * own * d).ln()).sum();
        let narrower = k as f64 * (held / free).ln();
        let log_factor = narrower - 0.5 * volume + 0.5 * estimate.dot(&weighted);
        Some(Release { p, states, factor, weighted, log_factor })
    }

    /// Covariance of a block with the states that are released.
    fn beside<const W: usize>(&self, block: Block<W>) -> DMatrix<f64> {
        let start = self.p.layout().start(block.key());
        let of = |row: usize, column: usize| {
            start.map_or(0.0, |start| self.p.matrix()[(start + row, self.states[column])])
        };
        DMatrix::from_fn(W, self.states.len(), of)
    }

    /// What the estimate of a block lacks to that of the sub-solution.
    #[must_use]
    pub fn apart<const W: usize>(&self, block: Block<W>) -> SVector<f64, W> {
        let apart = self.beside(block) * &self.weighted;
        SVector::from_fn(|i, _| apart[i])
    }

    /// By how much the covariance of a block is larger there.
    #[must_use]
    pub fn more<const W: usize>(&self, block: Block<W>) -> SMatrix<f64, W, W> {
        let beside = self.beside(block);
        let more = &beside * self.factor.solve(&beside.transpose());
        SMatrix::from_fn(|i, j| more[(i, j)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Innovation, Jacobian};
    use nalgebra::{Matrix1, Matrix1x2, Matrix2, Vector1, Vector2};

    const PLACE: Block<1> = Block::new(0);
    const SLOW: Block<2> = Block::new(1);

    /// Estimates of both blocks, covariance and log-likelihood after measurements of the place, each with one of the slow errors or with
    /// none, by a filter that holds those to a sigma.
    fn sailed(held: [f64; 2]) -> (f64, Vector2<f64>, Covariance, f64) {
        let mut p = Covariance::none();
        p.join(PLACE, &Matrix1::new(100.0));
        p.join(SLOW, &Matrix2::from_diagonal(&Vector2::from(held.map(|std| std * std))));
        let (mut place, mut slow, mut likelihood) = (0.0, Vector2::zeros(), 0.0);
        for (told, of, std) in [(3.0, 0, 0.5), (1.0, 1, 0.7), (0.4, 2, 1.5), (3.4, 0, 0.5)] {
            let row = Matrix1x2::from_fn(|_, i| f64::from(u8::from(i == of)));
            let h = Jacobian::none(1).with(PLACE, &Matrix1::new(1.0)).with(SLOW, &row);
            let z = Vector1::new(told - place - (row * slow).x);
            let innovation = Innovation::new(&z, h, &Vector1::new(std * std));
            let weighed = innovation.weigh(&p).unwrap();
            likelihood += -0.5 * weighed.nis() - weighed.log_root_determinant();
            let error = weighed.update(&mut p);
            place += error.of(PLACE).x;
            slow += error.of(SLOW);
        }
        (place, slow, p, likelihood)
    }

    #[test]
    fn releasing_states_gives_what_a_filter_finds_that_never_held_them() {
        let (place, slow, p, _) = sailed([1.0, 1.0]);
        for (of, held) in [
            (vec![(0, slow[0])], [20.0, 1.0]),
            (vec![(1, slow[1])], [1.0, 20.0]),
            (vec![(0, slow[0]), (1, slow[1])], [20.0, 20.0]),
        ] {
            let (other, _, other_p, _) = sailed(held);
            let release = Release::new(&p, SLOW.key(), &of, [1.0, 20.0]).unwrap();
            let found = place + release.apart(PLACE).x;
            assert!((found - other).abs() < 1e-9, "{found} and {other}");
            let variance = (PLACE.covariance(&p) + release.more(PLACE)).x;
            let expected = PLACE.covariance(&other_p).x;
            assert!((variance - expected).abs() < 1e-9, "{variance} and {expected}");
        }
    }

    #[test]
    fn how_much_likelier_it_is_agrees_with_the_likelihoods_of_both_filters() {
        let (_, slow, p, held) = sailed([1.0, 1.0]);
        let of = [(0, slow[0]), (1, slow[1])];
        let release = Release::new(&p, SLOW.key(), &of, [1.0, 20.0]).unwrap();
        let (.., free) = sailed([20.0, 20.0]);
        assert!((release.log_factor - (free - held)).abs() < 1e-9, "{}", release.log_factor);
    }

    #[test]
    fn nothing_is_released_that_is_not_there_or_was_not_held() {
        let (_, slow, p, _) = sailed([1.0, 1.0]);
        let release =
            |key, state, free| Release::new(&p, key, &[(state, slow[0])], [1.0, free]).is_some();
        assert!(release(SLOW.key(), 0, 2.0));
        assert!(!release(SLOW.key(), 0, 0.5) && !release(SLOW.key(), 2, 2.0));
        assert!(!release(Block::<2>::new(7).key(), 0, 2.0));
    }
}
