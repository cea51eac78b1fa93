//! A receiver that leaps may be back: who led it away has let go.
//!
//! What goes away slowly is suspected before it is proven, and a leap explains away whatever spoke for it: no drift fits both. So what was suspected
//! at a look before the leap is kept, and the two are weighed: that a lie which had grown to o, known to a covariance S, ended with the leap j, against
//! a leap of an honest receiver,
//!
//! R = chance(o) / lasts N(-j; o, S) / (rate 1 / (2 pi j^2 ln(most / least))),
//!
//! leaps being of any size between the least and the most, evenly by their logarithm.

use insd_base::Time;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::alternative::Alternative;
use super::charge::{Charge, Kind};
use super::lie::{LASTS, growth};
use super::rows::ALL;
use super::separation::Separation;
use crate::error_state::{Effects, POSITION, VELOCITY};

/// Leaps are between these, m.
const LEAPS: [f64; 2] = [3.0, 1e3];
/// What was made of a lie is known no better than this, 1-sigma, m and m/s, some seconds after it has ended.
pub(super) const UNTIDY: [f64; 2] = [3.0, 0.3];

/// A lie that was likely at a look.
#[derive(Clone, Debug)]
pub(super) struct Suspicion {
    pub(super) at: Time,
    pub(super) chance: f64,
    pub(super) charge: Charge,
    /// What a unit of each of its components had done to the estimate.
    pub(super) effects: Effects,
}

/// What the levels allow for of a receiver's growing lies.
#[derive(Clone, Debug, Default)]
pub(super) struct Allowed {
    pub(super) looks: Vec<(Time, Vec<Separation>)>,
    /// Before the leap for which it is left out.
    pub(super) before: Option<Vec<Separation>>,
    /// Chance that the leap ended one of them, once it is weighed.
    pub(super) ended: Option<f64>,
}

/// The chance that a leap which took a receiver to a place off the estimate ended one of its lies: of each cause the likeliest, as far as it would have led
/// so far.
pub(super) fn chance_of_end(lies: &[Separation], off: &Vector3<f64>) -> f64 {
    let chance = |own: &Separation| {
        let wide = own.covariance + Matrix3::from_diagonal_element(UNTIDY[0] * UNTIDY[0]);
        let left = off - own.apart;
        let square = wide.try_inverse().map_or(0.0, |inverse| left.dot(&(inverse * left)));
        own.chance * (-0.5 * square).exp()
    };
    let of_cause = |lies: &[Separation]| lies.iter().map(chance).fold(0.0, f64::max);
    let mut lies = lies.to_vec();
    lies.sort_by_key(|own| own.cause);
    lies.chunk_by(|a, b| a.cause == b.cause).map(of_cause).sum::<f64>().min(1.0)
}

impl Suspicion {
    /// The logarithm of R.
    pub(super) fn odds(
        &self,
        leap: &Vector2<f64>,
        of_leap: &Matrix2<f64>,
        since: Time,
    ) -> Option<f64> {
        let Kind::Shaped { since: begun, sized, group } = self.charge.kind else { return None };
        let age = (since - begun).as_seconds();
        let (off, _) = self.charge.lie_of_gnss(age);
        let (grown, _) = growth(self.charge.fault, age)?;
        let size: Matrix2<f64> = sized.covariance().fixed_view::<2, 2>(0, 0).into();
        let untidy = Matrix2::from_diagonal_element(UNTIDY[0] * UNTIDY[0]);
        let covariance = size * (grown * grown) + of_leap + untidy;
        let left = leap + off;
        let square = left.dot(&(covariance.try_inverse()? * left));
        let returned =
            self.chance.ln() - LASTS.ln() - 0.5 * (square + covariance.determinant().ln());
        let [least, most] = LEAPS;
        let leapt = ALL[group].log_rate - 2.0 * leap.norm().ln() - (most / least).ln().ln();
        Some(returned - leapt)
    }

    /// An estimate that followed it, without it.
    pub(super) fn ended(&self, mut followed: Alternative) -> Alternative {
        let Kind::Shaped { sized, .. } = self.charge.kind else { return followed };
        let width = self.effects.causes();
        let size = sized.covariance().view((0, 0), (width, width)).clone_owned();
        followed.covariance.spread_by(&self.effects, &size);
        followed.error += &self.effects.total(&sized.value.as_slice()[..width]);
        let [place, way] = UNTIDY.map(|std| std * std);
        POSITION.inflate(&mut followed.covariance, place);
        VELOCITY.inflate(&mut followed.covariance, way);
        followed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lie(cause: usize, chance: f64, north: f64) -> Separation {
        Separation {
            cause,
            chance,
            apart: Vector3::new(north, 0.0, 0.0),
            growth: Vector3::zeros(),
            covariance: Matrix3::from_diagonal_element(25.0),
            spreading: Matrix3::zeros(),
        }
    }

    #[test]
    fn a_leap_to_where_the_ship_would_be_without_a_lie_is_as_likely_its_end_as_it_was_a_lie() {
        let lies = [lie(2, 1e-3, 60.0), lie(4, 1e-4, 60.0), lie(2, 1e-3, 20.0)];
        let chance = chance_of_end(&lies, &Vector3::new(60.0, 0.0, 0.0));
        assert!((chance - 1.1e-3).abs() < 1e-9, "{chance}");
    }

    #[test]
    fn a_leap_elsewhere_ends_no_lie() {
        let chance = chance_of_end(&[lie(2, 1e-3, 60.0)], &Vector3::new(0.0, 60.0, 0.0));
        assert!(chance < 1e-30, "{chance}");
    }
}
