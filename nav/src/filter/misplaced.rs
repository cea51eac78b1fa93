//! That a base is not where it says: what the levels allow for where nobody on board answers for its place.
//!
//! Integers follow a base to the millimetre, wherever it is. What knows nothing of it is the filter without ranges that sails along: with z how far apart it has
//! her, of covariance Q (both together), and a base that is off by b ~ N(0, s^2 I),
//!
//! b = s^2 (Q + s^2 I)^-1 z + ...,   covariance s^2 I - s^4 (Q + s^2 I)^-1,   ln BF = (ln det Q - ln det(Q + s^2 I) + z^T (Q^-1 - (Q + s^2 I)^-1) z) / 2,
//!
//! as for any two normal models of one mean (Kass and Raftery, J. American Statistical Association 90 (1995)). The same codes and phases that ranges give could
//! tell it better, were phases not believed to drift by less than they do beside a place that is known to the millimetre.

use nalgebra::{Cholesky, Matrix3, U3, Vector3};

use super::Filter;
use crate::error_state::{POSITION, VELOCITY};
use crate::judge::Separation;
use crate::protection::RiskModel;

/// How far off a base is that is not where it says, 1-sigma along each axis, m: frames of a continent differ by less than a metre, a mean of its own fixes is
/// off by metres, a slip of the pen by more. One is as likely as the other.
const OFF: [f64; 4] = [0.5, 2.0, 8.0, 30.0];
/// Causes of it, behind those of satellites.
const BY_BASE: usize = 1_000_000;

/// A place that may be off by so much, beside another one.
struct Misplaced {
    /// What it is off by, m, and its covariance, m^2.
    off: Vector3<f64>,
    covariance: Matrix3<f64>,
    /// How much likelier the two are that far apart, as a logarithm.
    log_factor: f64,
}

impl Misplaced {
    /// Of a place that is off by `std` along each axis, m, and another that is `apart` from it, m, with a covariance of both together, m^2.
    fn new(std: f64, apart: &Vector3<f64>, both: &Matrix3<f64>) -> Option<Self> {
        let variance = Matrix3::from_diagonal_element(std * std);
        let (own, wide) = (Cholesky::new(*both)?, Cholesky::new(both + variance)?);
        let gain = variance * wide.inverse();
        let log_volume = |of: &Cholesky<f64, U3>| 2.0 * of.l().diagonal().map(f64::ln).sum();
        let square = |of: &Cholesky<f64, U3>| apart.dot(&of.solve(apart));
        let log_factor =
            0.5 * (log_volume(&own) - log_volume(&wide) + square(&own) - square(&wide));
        Some(Misplaced { off: gain * apart, covariance: variance - gain * variance, log_factor })
    }
}

impl Filter {
    /// That the base of the places in use is not where it says, by what the filter without ranges makes of her.
    pub(super) fn base_misplaced(&self, companion: &Filter, model: &RiskModel) -> Vec<Separation> {
        if self.rtk.used.is_none() || self.rtk.is_base_surveyed {
            return Vec::new();
        }
        let apart = companion.state.nominal.position - self.state.nominal.position;
        let of = |filter: &Filter| POSITION.covariance(&filter.state.covariance);
        let (own, both) = (of(self), of(self) + of(companion));
        let chance = model.base_misplaced / OFF.len() as f64;
        let separation = |(cause, std): (usize, f64)| {
            let base = Misplaced::new(std, &apart, &both)?;
            Some(Separation {
                cause,
                chance: (chance * base.log_factor.exp()).min(1.0),
                apart: base.off,
                growth: Vector3::zeros(),
                covariance: own + base.covariance,
                spreading: VELOCITY.covariance(&self.state.covariance),
            })
        };
        (BY_BASE..).zip(OFF).filter_map(separation).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_that_another_contradicts_is_off_by_that_and_one_that_agrees_by_less() {
        let both = Matrix3::from_diagonal_element(0.25);
        let of = |std, apart| Misplaced::new(std, &Vector3::new(apart, 0.0, 0.0), &both).unwrap();
        let far = of(8.0, 5.0);
        assert!((far.off.x - 5.0).abs() < 0.03 && far.log_factor > 30.0);
        assert!((far.covariance[(0, 0)].sqrt() - 0.5).abs() < 0.01);
        let agrees = of(8.0, 0.0);
        assert!(agrees.off.norm() == 0.0 && agrees.log_factor < -8.0);
        // of what is below all that the other can tell nothing is learnt
        let small = of(0.05, 0.5);
        assert!(small.log_factor.abs() < 0.05 && small.covariance[(0, 0)] > 0.99 * 0.0025);
    }

    #[test]
    fn how_much_likelier_it_is_averages_to_one_where_it_is_not_so() {
        // an integral over where the other has her, along one axis; the two others agree
        let (both, std) = (Matrix3::from_diagonal_element(1.0), 2.0);
        let density = |x: f64| (-0.5 * x * x).exp() / (2.0 * std::f64::consts::PI).sqrt();
        let factor = |x: f64| {
            let apart = Vector3::new(x, 0.0, 0.0);
            Misplaced::new(std, &apart, &both).unwrap().log_factor.exp()
        };
        let sum: f64 =
            (-3000..=3000).map(|i| f64::from(i) * 0.01).map(|x| factor(x) * density(x)).sum();
        // the volume of the two other axes is lost
        assert!((sum * 0.01 - 1.0 / 5.0).abs() < 1e-6, "{sum}");
    }
}
