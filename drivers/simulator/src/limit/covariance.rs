//! The Riccati recursion: prediction and update of a covariance, and shaping filters beside it.

use nalgebra::{DMatrix, DVector, Matrix2};

use insd_base::ImuSpec;

use super::model::{self, STATES, Start};
use super::way::Stretch;

/// Terms of the power series of the transition and its noise. The fastest states swing by a radian in
/// a step, and 1/16! is far below what matters.
const TERMS: usize = 16;

/// A stationary noise as the output of a linear system driven by white noise; its first state is the
/// noise itself.
#[derive(Clone, Debug)]
pub(super) struct Shaping {
    dynamics: DMatrix<f64>,
    density: DMatrix<f64>,
    steady: DMatrix<f64>,
}

impl Shaping {
    /// First-order Gauss-Markov noise of standard deviation `std` and correlation time, s.
    pub(super) fn markov(std: f64, time: f64) -> Self {
        let scalar = |value| DMatrix::from_element(1, 1, value);
        Shaping {
            dynamics: scalar(-1.0 / time),
            density: scalar(2.0 * std * std / time),
            steady: scalar(std * std),
        }
    }

    /// A damped oscillator: x'' + 2 zeta omega x' + omega^2 x = w, of standard deviation `std`, omega
    /// in rad/s and zeta the share of critical damping. White noise of density 4 zeta omega^3 std^2
    /// gives it that (Gelb, Applied Optimal Estimation, section 2.4).
    pub(super) fn oscillator(std: f64, omega: f64, zeta: f64) -> Self {
        let own = |m: Matrix2<f64>| DMatrix::from_column_slice(2, 2, m.as_slice());
        let power = std * std;
        Shaping {
            dynamics: own(Matrix2::new(0.0, 1.0, -omega * omega, -2.0 * zeta * omega)),
            density: own(Matrix2::new(0.0, 0.0, 0.0, 4.0 * zeta * omega.powi(3) * power)),
            steady: own(Matrix2::new(power, 0.0, 0.0, omega * omega * power)),
        }
    }
}

/// Some independent measurements: their rows H and their variances.
#[derive(Clone, Debug)]
pub(super) struct Measurement {
    pub(super) rows: DMatrix<f64>,
    pub(super) variances: DVector<f64>,
}

/// The covariance of the inertial errors and, after them, of the shaping filters.
#[derive(Clone, Debug)]
pub(super) struct Covariance {
    spec: ImuSpec,
    step: f64,
    density: DMatrix<f64>,
    p: DMatrix<f64>,
    transition: DMatrix<f64>,
    added: DMatrix<f64>,
    /// What `transition` and `added` hold for.
    stretch: Option<Stretch>,
}

impl Covariance {
    /// At the start; each prediction will be over `step`, s.
    pub(super) fn new(spec: &ImuSpec, start: Start, step: f64) -> Self {
        Covariance {
            spec: *spec,
            step,
            density: model::noise(spec),
            p: model::initial(spec, &start),
            transition: DMatrix::identity(STATES, STATES),
            added: DMatrix::zeros(STATES, STATES),
            stretch: None,
        }
    }

    /// How many states there are.
    pub(super) fn size(&self) -> usize {
        self.p.nrows()
    }

    /// The matrix.
    pub(super) fn p(&self) -> &DMatrix<f64> {
        &self.p
    }

    /// What is known is something else; gives what it was.
    pub(super) fn replace(&mut self, p: DMatrix<f64>) -> DMatrix<f64> {
        std::mem::replace(&mut self.p, p)
    }

    /// The transition of the last prediction.
    pub(super) fn transition(&self) -> &DMatrix<f64> {
        &self.transition
    }

    /// Appends a shaping filter in its steady state; gives the place of its output.
    pub(super) fn append(&mut self, shaping: &Shaping) -> usize {
        let (transition, added) = discrete(&shaping.dynamics, &shaping.density, self.step);
        let place = self.size();
        self.p = beside(&self.p, &shaping.steady);
        self.transition = beside(&self.transition, &transition);
        self.added = beside(&self.added, &added);
        place
    }

    /// P <- Phi P Phi^T + Q over a stretch of the way.
    pub(super) fn predict(&mut self, stretch: &Stretch) {
        if self.stretch.as_ref() != Some(stretch) {
            let dynamics = model::dynamics(&self.spec, stretch);
            let (transition, added) = discrete(&dynamics, &self.density, self.step);
            self.transition.view_mut((0, 0), (STATES, STATES)).copy_from(&transition);
            self.added.view_mut((0, 0), (STATES, STATES)).copy_from(&added);
            self.stretch = Some(stretch.clone());
        }
        self.p = symmetric(&self.transition * &self.p * self.transition.transpose() + &self.added);
    }

    /// P <- P - K S K^T, K = P H^T S^-1, S = H P H^T + R (Gelb, section 4.2).
    pub(super) fn update(&mut self, measurement: &Measurement) {
        let h = &measurement.rows;
        let ph = &self.p * h.transpose();
        let s = h * &ph + DMatrix::from_diagonal(&measurement.variances);
        // S is not positive only when a measurement without noise says what is known already
        if let Some(factor) = symmetric(s).cholesky() {
            let down = &ph * factor.solve(&ph.transpose());
            self.p = symmetric(&self.p - down);
        }
    }

    /// Standard deviation of a weighted sum of states.
    pub(super) fn std_of(&self, weights: &[(usize, f64)]) -> f64 {
        let pairs = weights.iter().flat_map(|a| weights.iter().map(move |b| (a, b)));
        let variance: f64 = pairs.map(|(a, b)| a.1 * b.1 * self.p[(a.0, b.0)]).sum();
        variance.max(0.0).sqrt()
    }
}

fn symmetric(m: DMatrix<f64>) -> DMatrix<f64> {
    let transposed = m.transpose();
    (m + transposed) * 0.5
}

/// Two square matrices as the blocks of a diagonal.
fn beside(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let (n, m) = (a.nrows(), b.nrows());
    let mut both = DMatrix::zeros(n + m, n + m);
    both.view_mut((0, 0), (n, n)).copy_from(a);
    both.view_mut((n, n), (m, m)).copy_from(b);
    both
}

/// Transition and noise of dx/dt = F x + w, E[w w^T] = Q, over `dt`, s, by their power series:
/// Phi = sum (F dt)^k / k!, and the integral of Phi Q Phi^T, whose terms follow from each other as
/// T_(k+1) = (F T_k + T_k F^T) dt / (k + 1), T_1 = Q dt.
pub(super) fn discrete(
    f: &DMatrix<f64>,
    q: &DMatrix<f64>,
    dt: f64,
) -> (DMatrix<f64>, DMatrix<f64>) {
    let n = f.nrows();
    let (mut power, mut term) = (DMatrix::identity(n, n), q * dt);
    let (mut transition, mut added) = (power.clone(), term.clone());
    for k in 1..TERMS {
        power = f * &power * (dt / k as f64);
        transition += &power;
        let product = f * &term;
        term = (&product + product.transpose()) * (dt / (k + 1) as f64);
        added += &term;
    }
    (transition, added)
}
