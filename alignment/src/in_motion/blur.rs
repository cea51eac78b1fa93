//! What the noise of the IMU passes for: errors in the variables.
//!
//! (s, 1-c) is found by regression: of what the receiver says on the motion that the IMU has measured, in the
//! computed frame. That motion is noise as well, and where the ship hardly moves it is nothing else: the gyros'
//! noise leans the computed frame, and a lean is a force. Regressed on it, (s, 1-c) would shrink and be ever
//! surer of where it is, as if no motion of any direction had been seen, though there was none to see (errors in
//! the variables: Fuller, Measurement Error Models, section 1.1).
//!
//! How much of the information is of that kind is known beforehand. With P_R the covariance of (s, 1-c), C = P_xR P_R^-1
//! the response of the errors to it, a measurement is worth
//!
//! J += H_R^T S_0^-1 H_R,   H_R = H C,   S_0 = S - H_R P_R H_R^T,
//!
//! and C carries, along each axis, noise of a covariance B that grows by what the noise of the IMU does to the errors themselves, since it
//! is that noise, and is forgotten as they are by measurements:
//!
//! B <- F B F^T + Q,   B <- (I - K_0 H) B (I - K_0 H)^T,   K_0 = (P - C P_R C^T) H^T S_0^-1,
//! J_noise += tr(S_0^-1 (H B H^T + r_H)),
//!
//! r_H the noise of H itself (the swing of the antenna). Both are the same at right angles, so that J_noise is a
//! number. The estimate corrected for it is J (J - J_noise)^-1 times the one found, with the covariance (J - J_noise)^-1 J (J - J_noise)^-1
//! (Fuller, section 2.2, the error variance known), and what is known beforehand, that the point lies on the circle,
//! holds beside it: where nothing but noise was seen, nothing is known.
//!
//! Held by `gyros_that_are_noisy_tell_no_heading_of_a_ship_that_lies_still` and
//! `roll_and_pitch_are_as_sure_as_claimed_where_nothing_tells_the_heading`.

use insd_estimation::Weighed;
use nalgebra::{DMatrix, Matrix2, SymmetricEigen, Vector2};

use super::belief::{OWN, OwnCovariance, STATES, Stretched, state as x};

/// Information about each of sine and cosine when nothing is known: both have the variance 1/2 on the circle.
const PRIOR: f64 = 2.0;

/// Noise in the response to (s, 1-c), and the information that it made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blur {
    /// B.
    noise: OwnCovariance,
    /// J_noise.
    information: f64,
}

impl Default for Blur {
    fn default() -> Self {
        Blur { noise: OwnCovariance::zeros(), information: 0.0 }
    }
}

impl Blur {
    /// Over a stretch of time, after which a share of all information is left.
    pub fn propagate(&mut self, stretched: &Stretched, left: f64) {
        let f = &stretched.f;
        self.noise = f * self.noise * f.transpose() + stretched.q;
        for i in [x::SINE, x::VERSINE] {
            self.noise.row_mut(i).fill(0.0);
            self.noise.column_mut(i).fill(0.0);
        }
        self.information *= left;
    }

    /// With a measurement that is about to change a covariance, of which so much variance is noise in what its matrix takes for the
    /// motion of the hull.
    pub fn absorb(&mut self, weighed: &Weighed, own: &OwnCovariance, swing: f64) {
        let h = weighed.innovation().h.of(OWN);
        let to_state = weighed.cross().rows(0, STATES).into_owned();
        let s = weighed.covariance();
        let turn = own.fixed_view::<2, 2>(x::SINE, x::SINE).into_owned();
        let Some(inverse) = turn.try_inverse() else { return };
        let seen = to_state.fixed_rows::<2>(x::SINE).into_owned();
        let known: DMatrix<f64> = &s - seen.transpose() * inverse * &seen;
        let Some(weight) = known.try_inverse() else { return };
        let response = own.fixed_columns::<2>(x::SINE) * inverse;
        let gain = (to_state - response * seen) * &weight;
        let noise = &h * self.noise * h.transpose();
        self.information += (&weight * noise).trace() + swing * weight.trace();
        let kept = OwnCovariance::identity() - gain * &h;
        self.noise = kept * self.noise * kept.transpose();
    }

    /// Share of what was seen that is noise, of what the regression is sure of with `covariance`; one at most.
    #[must_use]
    pub fn share(&self, covariance: &Matrix2<f64>) -> f64 {
        let seen = covariance
            .symmetric_eigenvalues()
            .map(|variance| (variance.max(1e-12).recip() - PRIOR).max(1e-9));
        (self.information / seen.max()).min(1.0)
    }

    /// Mean and covariance of (cos, sin), of which the regression says `mean` and `covariance`.
    #[must_use]
    pub fn sharpened(
        &self,
        mean: &Vector2<f64>,
        covariance: &Matrix2<f64>,
    ) -> (Vector2<f64>, Matrix2<f64>) {
        if self.information <= 0.0 {
            return (*mean, *covariance);
        }
        let axes = SymmetricEigen::new(*covariance);
        let along = axes.eigenvectors.transpose() * mean;
        let by_noise = self.information;
        let pairs = Vector2::from_fn(|i, _| axes.eigenvalues[i]).map(|variance| {
            let all = (variance.max(1e-12).recip() - PRIOR).max(1e-9);
            let told = (all - by_noise).max(0.0);
            let left = (PRIOR + told * told / all).recip();
            (left, left * told / all * (all + PRIOR))
        });
        let spread = Matrix2::from_diagonal(&pairs.map(|(left, _)| left));
        let found = Vector2::new(along.x * pairs.x.1, along.y * pairs.y.1);
        (axes.eigenvectors * found, axes.eigenvectors * spread * axes.eigenvectors.transpose())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHORT: Vector2<f64> = Vector2::new(0.3, -0.4);

    fn blurred(information: f64) -> (Vector2<f64>, Matrix2<f64>) {
        let blur = Blur { information, ..Blur::default() };
        blur.sharpened(&SHORT, &Matrix2::from_diagonal_element(0.01))
    }

    #[test]
    fn what_no_noise_has_touched_is_left_as_it_is() {
        let (mean, covariance) = blurred(1e-9);
        assert!((mean - SHORT).norm() < 1e-6, "{mean}");
        assert!((covariance - Matrix2::from_diagonal_element(0.01)).amax() < 1e-6);
        assert_eq!(blurred(0.0).0, SHORT);
    }

    #[test]
    fn what_noise_has_halved_is_doubled_and_less_sure() {
        // all that was seen is worth 98, half of it noise
        let (mean, covariance) = blurred(49.0);
        assert!((mean - SHORT * (50.0 / 26.5)).norm() < 1e-3, "{mean}");
        assert!((covariance[(0, 0)] - 1.0 / (2.0 + 24.5)).abs() < 1e-6, "{covariance}");
    }

    #[test]
    fn where_noise_alone_was_seen_nothing_is_known() {
        let (mean, covariance) = blurred(120.0);
        assert!(mean.norm() < 1e-6, "{mean}");
        assert!((covariance - Matrix2::from_diagonal_element(0.5)).amax() < 1e-6);
    }
}
