//! The slow signal of a fitted model: the polynomial that the drift terms drive, and its
//! covariance.
//!
//! s(k) = S u(k) must satisfy s(k) = sum A_i s(k-i) + B u(k) (systems S1, below eq. (4)). With d_i
//! the lag i on the scale of tau, u(k-i) = T_i u(k),
//!
//! T_i = [1 0 0; -d_i 1 0; d_i^2 -2 d_i 1],   S = sum A_i S T_i + B,
//!
//! which is triangular in the columns of S, each with the same 2x2 matrix M = I - sum A_i.

use nalgebra::{DMatrix, Matrix2, Matrix2x3, Matrix3, Vector2};

use super::regression::{DRIFT, Regression, columns};

/// A(q) and what follows from it for polynomials.
#[derive(Clone, Debug)]
pub(super) struct Response {
    /// M = I - sum A_i.
    pub(super) gain: Matrix2<f64>,
    inverse: Matrix2<f64>,
    /// sum d_i A_i.
    first: Matrix2<f64>,
    /// sum d_i^2 A_i.
    second: Matrix2<f64>,
}

impl Response {
    /// Of coefficients A_i, with half the window in samples. `None` if M cannot be inverted.
    pub(super) fn new(coefficients: &[Matrix2<f64>], half: f64) -> Option<Self> {
        let weighted = |power: i32| -> Matrix2<f64> {
            let lags = coefficients.iter().enumerate();
            lags.map(|(i, a)| a * ((i + 1) as f64 / half).powi(power)).sum()
        };
        let gain = Matrix2::identity() - weighted(0);
        let inverse = gain.try_inverse()?;
        Some(Response { gain, inverse, first: weighted(1), second: weighted(2) })
    }

    /// S for a drive B, both by powers of tau.
    pub(super) fn polynomial(&self, drive: &Matrix2x3<f64>) -> Matrix2x3<f64> {
        let s2 = self.inverse * drive.column(2);
        let s1 = self.inverse * (drive.column(1) - self.first * s2 * 2.0);
        let s0 = self.inverse * (drive.column(0) - self.first * s1 + self.second * s2);
        Matrix2x3::from_columns(&[s0, s1, s2])
    }

    /// Covariance of s at the newest sample, (m/s)^2, to first order in the errors of Theta.
    ///
    /// A small change of Theta = [B A_1 .. A_p] changes the drive by dTheta W, with
    /// W = [I; S T_1; ..; S T_p], and s by sum G_j dTheta w_j over the powers j. The covariance of
    /// Theta w_j with Theta w_l is Sigma w_j^T (Z^T Z)^-1 w_l, hence
    ///
    /// cov(s) = sum G_j Sigma G_l^T w_j^T (Z^T Z)^-1 w_l   (over j and l; test: `claims.rs`).
    pub(super) fn covariance(
        &self,
        slow: &Matrix2x3<f64>,
        half: f64,
        order: usize,
        regression: &Regression,
    ) -> Option<Matrix2<f64>> {
        let mut directions = DMatrix::zeros(columns(order), DRIFT);
        directions.fill_diagonal(1.0);
        for lag in 1..=order {
            let block = slow * delay(lag as f64 / half);
            directions.view_mut((columns(lag - 1), 0), (2, DRIFT)).copy_from(&block);
        }
        let spread = regression.spread(order, &directions)?;
        let sigma = regression.residual_covariance(order);
        let maps = [0, 1, 2].map(|power| self.map_to_newest(power));
        let mut covariance = Matrix2::zeros();
        for (j, g_j) in maps.iter().enumerate() {
            for (l, g_l) in maps.iter().enumerate() {
                covariance += g_j * sigma * g_l.transpose() * spread[(j, l)];
            }
        }
        Some((covariance + covariance.transpose()) * 0.5)
    }

    /// Smallest singular value of M, and its standard deviation from the errors of the A_i.
    pub(super) fn weakest(&self, order: usize, regression: &Regression) -> Option<(f64, f64)> {
        let svd = self.gain.svd(true, true);
        let (index, value) = svd.singular_values.argmin();
        let left: Vector2<f64> = svd.u?.column(index).into_owned();
        let right = svd.v_t?.row(index).transpose();
        let mut direction = DMatrix::zeros(columns(order), 1);
        for lag in 1..=order {
            direction.view_mut((columns(lag - 1), 0), (2, 1)).copy_from(&right);
        }
        let spread = regression.spread(order, &direction)?[(0, 0)];
        let sigma = (regression.residual_covariance(order) * left).dot(&left);
        Some((value, (sigma * spread).sqrt()))
    }

    /// G_j: from a change of the drive in one power of tau to s at tau = 1.
    fn map_to_newest(&self, power: usize) -> Matrix2<f64> {
        let columns = [Vector2::x(), Vector2::y()].map(|unit| {
            let mut drive = Matrix2x3::zeros();
            drive.set_column(power, &unit);
            self.polynomial(&drive).column_sum()
        });
        Matrix2::from_columns(&columns)
    }
}

/// T_i of a lag d_i.
fn delay(d: f64) -> Matrix3<f64> {
    Matrix3::new(1.0, 0.0, 0.0, -d, 1.0, 0.0, d * d, -2.0 * d, 1.0)
}
