//! Least squares of the autoregressive model with drift, eqs. (2)-(4), by orthogonal triangles.
//!
//! One Householder QR of the columns [u | y(k-1) | .. | y(k-p) | y(k)] serves every order up to p:
//! the rows of its triangle below the regressors of an order hold what that order leaves
//! unexplained (Golub and Van Loan, Matrix Computations, 4th ed., 5.3.2). The normal equations (4)
//! are never formed.

use nalgebra::{DMatrix, Matrix2, Vector2, Vector3};

/// Columns of the drift u = [1, tau, tau^2].
pub(super) const DRIFT: usize = 3;
/// Components of the velocity.
const AXES: usize = 2;
/// Weight that holds the A_i at zero where the data say nothing (a pure sinusoid leaves directions
/// of the regressors empty), over the standard deviation of the data.
const RIDGE: f64 = 1e-7;
/// Least standard deviation of the residual over that of the data: keeps noise-free data finite.
const FLOOR: f64 = 1e-8;

/// A slot of the window: velocity, m/s, north and east.
pub(super) type Slot = Option<Vector2<f64>>;

/// The drift at tau, the time scaled so that the window is -1..1.
pub(super) fn drift(tau: f64) -> Vector3<f64> {
    Vector3::new(1.0, tau, tau * tau)
}

/// tau of a slot of a window of `length` slots.
pub(super) fn tau(slot: usize, length: usize) -> f64 {
    let half = half_width(length);
    (slot as f64 - half) / half
}

/// Half the window in samples: what tau is scaled by.
pub(super) fn half_width(length: usize) -> f64 {
    (0.5 * (length as f64 - 1.0)).max(0.5)
}

/// Regressors of an order: its lags and the drift.
pub(super) fn columns(order: usize) -> usize {
    DRIFT + AXES * order
}

/// The parabola nearest to the samples (3x2: powers of tau by axes) and the rms distance from it
/// per component, m/s. `None` with too few samples.
pub(super) fn trend(slots: &[Slot]) -> Option<(DMatrix<f64>, f64)> {
    let present: Vec<(usize, Vector2<f64>)> =
        slots.iter().enumerate().filter_map(|(k, slot)| Some((k, (*slot)?))).collect();
    if present.len() <= columns(1) {
        return None;
    }
    let table = DMatrix::from_fn(present.len(), DRIFT + AXES, |row, column| {
        let (k, y) = present[row];
        if column < DRIFT { drift(tau(k, slots.len()))[column] } else { y[column - DRIFT] }
    });
    let triangle = table.qr().unpack_r();
    let left: f64 = sum_of_squares(&triangle, DRIFT).trace();
    let rms = (left / (AXES * (present.len() - DRIFT)) as f64).sqrt();
    Some((solve(&triangle, DRIFT)?, rms))
}

/// The triangle of a window.
#[derive(Clone, Debug)]
pub(super) struct Regression {
    triangle: DMatrix<f64>,
    rows: usize,
    floor: f64,
}

impl Regression {
    /// All rows whose sample and `order` samples before it are there; `scale` is the standard
    /// deviation of the samples, m/s. Fewer rows than unknowns make no regression.
    pub(super) fn new(slots: &[Slot], order: usize, scale: f64) -> Self {
        let complete: Vec<usize> = (order..slots.len())
            .filter(|k| slots[k - order..=*k].iter().all(Option::is_some))
            .collect();
        let rows = complete.len();
        let ridge = RIDGE * scale * (rows as f64).sqrt();
        let lags = AXES * order;
        let mut table = DMatrix::zeros(rows + lags, columns(order) + AXES);
        for (row, k) in complete.iter().enumerate() {
            let u = drift(tau(*k, slots.len()));
            table.view_mut((row, 0), (1, DRIFT)).copy_from(&u.transpose());
            let newest_last = (1..=order).chain([0]);
            for (place, lag) in newest_last.enumerate() {
                let y = slots[k - lag].unwrap_or_default();
                let column = DRIFT + AXES * place;
                table.view_mut((row, column), (1, AXES)).copy_from(&y.transpose());
            }
        }
        for lag in 0..lags {
            table[(rows + lag, DRIFT + lag)] = ridge;
        }
        let floor = (FLOOR * scale).powi(2);
        Regression { triangle: table.qr().unpack_r(), rows, floor }
    }

    /// Samples that are explained.
    pub(super) fn rows(&self) -> usize {
        self.rows
    }

    /// The order with the least AIC = N ln det Sigma + 2 n, Sigma the mean square residual of N
    /// rows and n the number of coefficients (Luetkepohl, New Introduction to Multiple Time Series
    /// Analysis, section 4.3.2, times N). All orders explain the same rows.
    pub(super) fn best_order(&self, max: usize) -> usize {
        let rows = self.rows as f64;
        let criterion = |order: usize| {
            let sigma = sum_of_squares(&self.triangle, columns(order)) / rows;
            // by eigenvalues: the determinant of a sea in one direction is all rounding
            let eigenvalues = sigma.symmetric_eigenvalues().map(|value| value.max(self.floor));
            rows * eigenvalues.map(f64::ln).sum() + 2.0 * (AXES * columns(order)) as f64
        };
        let orders = (0..=max).map(|order| (order, criterion(order)));
        orders.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(order, _)| order)
    }

    /// Covariance of eps for an order, free of the bias of the fitted coefficients, (m/s)^2.
    pub(super) fn residual_covariance(&self, order: usize) -> Matrix2<f64> {
        let freedom = self.rows.saturating_sub(columns(order)).max(1) as f64;
        sum_of_squares(&self.triangle, columns(order)) / freedom + Matrix2::identity() * self.floor
    }

    /// Transposed Theta of an order: 3 rows of B^T, then 2 rows of each A_i^T.
    pub(super) fn coefficients(&self, order: usize) -> Option<DMatrix<f64>> {
        solve(&self.triangle, columns(order))
    }

    /// W^T (Z^T Z)^-1 W for directions W (columns of length `columns(order)`): times the residual
    /// covariance this is the covariance of Theta W.
    pub(super) fn spread(&self, order: usize, directions: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let size = columns(order);
        let root =
            self.triangle.view((0, 0), (size, size)).tr_solve_upper_triangular(directions)?;
        Some(root.tr_mul(&root))
    }
}

/// Sum of squares of the last two columns of a triangle from a row on.
fn sum_of_squares(triangle: &DMatrix<f64>, from: usize) -> Matrix2<f64> {
    let last = triangle.ncols() - AXES;
    let left = triangle.view((from, last), (triangle.nrows() - from, AXES));
    let product = left.tr_mul(&left);
    Matrix2::new(product[(0, 0)], product[(0, 1)], product[(1, 0)], product[(1, 1)])
}

/// Coefficients of the first `size` columns that explain the last two.
fn solve(triangle: &DMatrix<f64>, size: usize) -> Option<DMatrix<f64>> {
    let right = triangle.view((0, triangle.ncols() - AXES), (size, AXES)).into_owned();
    triangle.view((0, 0), (size, size)).solve_upper_triangular(&right)
}
