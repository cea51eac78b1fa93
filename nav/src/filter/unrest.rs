//! What phases scatter beyond what the filter expects of them.
//!
//! A phase is good to millimetres; where the antenna was when it was measured is known so well only if mast, time stamps and heading are what they are
//! taken for. What phases of many satellites contradict the filter by together is no slip. Believed to the millimetre it moves what the phases cannot
//! know, the place itself, by metres; it is measured and taken for noise instead.

use insd_base::Time;
use insd_estimation::Innovation;
use nalgebra::DVector;

use crate::error_state::{Covariance, Weighed};

/// So long it is remembered, s.
const MEMORY: f64 = 60.0;
/// Sums of squares beyond their mean by so many of their sigmas are no chance.
const CHANCE: f64 = 4.0;

/// Variance that each phase has besides its own, m^2; zero as long as they scatter no more than expected.
#[derive(Clone, Debug, Default)]
pub(super) struct Unrest {
    variance: f64,
    spread: Option<Time>,
}

impl Unrest {
    /// Gives phases the noise that those before them had.
    pub(super) fn spread(&mut self, phases: &mut Innovation, now: Time) {
        let elapsed = self.spread.replace(now).map_or(0.0, |before| (now - before).as_seconds());
        self.variance *= (-elapsed.max(0.0) / MEMORY).exp();
        widen(phases, self.variance);
    }

    /// Phases that were spread and contradict the filter together are weighed again with the noise that they show; what they show is remembered.
    pub(super) fn hear(
        &mut self,
        (phases, weighed): (&Innovation, Weighed),
        p: &Covariance,
    ) -> Weighed {
        let more = beyond_chance(&weighed);
        self.variance += more;
        if more <= 0.0 {
            return weighed;
        }
        let mut wider = phases.clone();
        widen(&mut wider, more);
        wider.weigh(p).unwrap_or(weighed)
    }
}

fn widen(rows: &mut Innovation, variance: f64) {
    for row in 0..rows.r.nrows() {
        rows.r[(row, row)] += variance;
    }
}

/// The variance x, m^2, with which the sum of squares `z^T (S + x I)^-1 z` is that of so many rows; zero where it is by chance what it is.
fn beyond_chance(weighed: &Weighed) -> f64 {
    let rows = weighed.rows() as f64;
    if weighed.nis() < rows + CHANCE * (2.0 * rows).sqrt() {
        return 0.0;
    }
    let own = weighed.covariance().symmetric_eigen();
    let along: DVector<f64> = own.eigenvectors.transpose() * weighed.z();
    let squares = |x: f64| -> f64 {
        along.iter().zip(own.eigenvalues.iter()).map(|(z, s)| z * z / (s + x)).sum()
    };
    // with this much it is less: each square is divided by more than all of them are
    let (mut least, mut most) = (0.0, along.norm_squared() / rows);
    for _ in 0..40 {
        let middle = 0.5 * (least + most);
        if squares(middle) > rows { least = middle } else { most = middle }
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Span;
    use insd_estimation::Jacobian;
    use nalgebra::DMatrix;

    fn phases(z: &[f64]) -> Innovation {
        let rows = z.len();
        let r = DMatrix::from_diagonal_element(rows, rows, 0.003 * 0.003);
        Innovation { z: DVector::from_column_slice(z), h: Jacobian::none(rows), r }
    }

    fn heard(unrest: &mut Unrest, z: &[f64], now: Time) -> Weighed {
        let mut own = phases(z);
        unrest.spread(&mut own, now);
        let p = Covariance::none();
        let weighed = own.weigh(&p).unwrap();
        unrest.hear((&own, weighed), &p)
    }

    #[test]
    fn phases_that_contradict_the_filter_together_have_the_noise_that_they_show() {
        let mut unrest = Unrest::default();
        let z = [0.05, -0.03, 0.04, -0.06, 0.02, 0.05];
        let first = heard(&mut unrest, &z, Time::START);
        assert!((first.nis() - 6.0).abs() < 0.01, "{}", first.nis());
        // an hour of phases as they ought to be, and nothing of it is left
        let still = [0.001, -0.002, 0.002, 0.003, -0.001, 0.0];
        let soon = heard(&mut unrest, &still, Time::START + Span::from_seconds(1.0));
        assert!(soon.nis() < 0.1);
        let late = heard(&mut unrest, &still, Time::START + Span::from_seconds(3600.0));
        assert!(
            (late.nis() - phases(&still).weigh(&Covariance::none()).unwrap().nis()).abs() < 1e-3
        );
    }

    #[test]
    fn phases_that_scatter_as_they_ought_to_are_left_as_they_are() {
        let mut unrest = Unrest::default();
        let z = [0.004, -0.003, 0.005, -0.002, 0.001, 0.003];
        let own = phases(&z).weigh(&Covariance::none()).unwrap();
        assert_eq!(heard(&mut unrest, &z, Time::START).nis(), own.nis());
        assert_eq!(unrest.variance, 0.0);
    }
}
