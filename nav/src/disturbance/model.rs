//! The sea as an autoregressive model of the disturbance velocity.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, Matrix2, Schur, Vector2};

/// Rounds of the eigenvalue iteration after which a model counts as unstable.
const ROUNDS: usize = 1000;
/// Doublings of the sum for the variance: 2^30 samples of memory.
const DOUBLINGS: usize = 30;

/// d(k) = sum A_i d(k-i) + eps(k), the disturbance d north and east, m/s (systems S1, eq. (2)); or a displacement, m, and
/// all units of the same kind.
///
/// Assumed stationary over the window: the ship does not turn in the waves.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    coefficients: Vec<Matrix2<f64>>,
    covariance: Matrix2<f64>,
    interval: f64,
    roots: Vec<Complex<f64>>,
    radius: f64,
}

impl Model {
    /// A model of coefficients A_1 .. A_p (none: white), covariance of eps, (m/s)^2, and the sample
    /// interval, s.
    #[must_use]
    pub fn new(coefficients: Vec<Matrix2<f64>>, covariance: Matrix2<f64>, interval: f64) -> Self {
        let roots = roots(&companion(&coefficients));
        let radius = roots.as_ref().map_or(f64::INFINITY, |roots| {
            roots.iter().map(|root| root.norm()).fold(0.0, f64::max)
        });
        let roots = roots.unwrap_or_default();
        Model { coefficients, covariance, interval, roots, radius }
    }

    /// A_1 .. A_p, without unit.
    #[must_use]
    pub fn coefficients(&self) -> &[Matrix2<f64>] {
        &self.coefficients
    }

    /// Number p of samples that the model looks back.
    #[must_use]
    pub fn order(&self) -> usize {
        self.coefficients.len()
    }

    /// Covariance of eps, (m/s)^2.
    #[must_use]
    pub fn residual_covariance(&self) -> &Matrix2<f64> {
        &self.covariance
    }

    /// From sample to sample, s.
    #[must_use]
    pub fn interval(&self) -> f64 {
        self.interval
    }

    /// Eigenvalues of the companion matrix.
    pub(super) fn roots(&self) -> &[Complex<f64>] {
        &self.roots
    }

    /// Largest modulus of the eigenvalues of the companion matrix: per sample, an undriven
    /// disturbance changes by this factor. Infinite if they were not found.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether an undriven disturbance dies out: all eigenvalues inside the unit circle.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.radius < 1.0
    }

    /// eps(k), the part of a disturbance, m/s, that its past does not foretell: `newest_first` is
    /// d(k), d(k-1), .., d(k-p). White if the model holds. `None` if the history is too short.
    #[must_use]
    pub fn residual(&self, newest_first: &[Vector2<f64>]) -> Option<Vector2<f64>> {
        let (newest, past) = newest_first.split_first()?;
        (past.len() >= self.order()).then(|| {
            let foretold: Vector2<f64> =
                self.coefficients.iter().zip(past).map(|(a, d)| a * d).sum();
            newest - foretold
        })
    }

    /// Spectral density of the disturbance at a frequency, Hz, one-sided: (m/s)^2/Hz, on the
    /// diagonal north and east, off it their cross spectrum. With T the sample interval
    ///
    /// S(f) = 2 T H Sigma H^H,   H = (I - sum A_i e^(-2 pi j f i T))^-1,   0 <= f <= 1/(2 T)
    ///
    /// (Priestley, Spectral Analysis and Time Series, chapter 9: multivariate autoregressions).
    /// `None` at the frequency of an undamped oscillation.
    #[must_use]
    pub fn spectrum(&self, frequency_hz: f64) -> Option<Matrix2<Complex<f64>>> {
        let turn = -TAU * frequency_hz * self.interval;
        let lags = self.coefficients.iter().enumerate();
        let past: Matrix2<Complex<f64>> = lags
            .map(|(i, a)| {
                let phase = Complex::from_polar(1.0, turn * (i + 1) as f64);
                a.map(|value| phase * value)
            })
            .sum();
        let h = (Matrix2::identity() - past).try_inverse()?;
        let sigma = self.covariance.map(|value| Complex::from(2.0 * self.interval * value));
        Some(h * sigma * h.adjoint())
    }

    /// Covariance of the disturbance velocity, (m/s)^2: the sum over the past of F^k Q F^kT, F the
    /// companion matrix, by doubling. `None` if the model is not stable.
    #[must_use]
    pub fn variance(&self) -> Option<Matrix2<f64>> {
        if !self.is_stable() || !self.covariance.iter().all(|value| value.is_finite()) {
            return None;
        }
        let mut step = companion(&self.coefficients);
        if step.is_empty() {
            return Some(self.covariance);
        }
        let mut sum = DMatrix::zeros(step.nrows(), step.nrows());
        sum.view_mut((0, 0), (2, 2)).copy_from(&self.covariance);
        for _ in 0..DOUBLINGS {
            sum += &step * &sum * step.transpose();
            step = &step * &step;
        }
        let variance = sum.fixed_view::<2, 2>(0, 0).into_owned();
        variance.iter().all(|value| value.is_finite()).then_some(variance)
    }
}

/// The matrix that takes [d(k-1); ..; d(k-p)] to [d(k); ..; d(k-p+1)] without eps.
fn companion(coefficients: &[Matrix2<f64>]) -> DMatrix<f64> {
    let size = 2 * coefficients.len();
    let mut matrix = DMatrix::zeros(size, size);
    for (lag, a) in coefficients.iter().enumerate() {
        matrix.view_mut((0, 2 * lag), (2, 2)).copy_from(a);
    }
    for row in 2..size {
        matrix[(row, row - 2)] = 1.0;
    }
    matrix
}

/// Its eigenvalues; `None` if they were not found.
fn roots(companion: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    if companion.is_empty() {
        return Some(Vec::new());
    }
    if !companion.iter().all(|value| value.is_finite()) {
        return None;
    }
    let schur = Schur::try_new(companion.clone(), f64::EPSILON, ROUNDS)?;
    Some(schur.complex_eigenvalues().iter().copied().collect())
}
