//! The prefilter: a window of velocities in, the slow velocity out.
//!
//! Assumed: one sample a second or so, without aliased motion; a slow velocity that is a parabola
//! over the window (of an 84-minute oscillation 300 s leave a two-thousandth); a sea that is
//! stationary over it.
//!
//! What the claim is worth (200 seas each, `tests/claims.rs`; waves of 8 s and 0.22 m/s rms per
//! component, white noise of 0.02 m/s, order chosen up to 8). The factor is the real error in units
//! of the claimed sigma, root mean square; the covariance is not multiplied by it.
//!
//! | window | surge of 90 s | error, m/s | claimed, m/s | factor | refused |
//! |---|---|---|---|---|---|
//! | 120 s | none | 0.028 | 0.027 | 1.1 | 0 |
//! | 120 s | 0.05 m/s | 0.050 | 0.030 | 1.9 | 0 |
//! | 120 s | 0.20 m/s | 0.179 | 0.232 | 2.2 | 41 |
//! | 300 s | none | 0.017 | 0.016 | 1.0 | 0 |
//! | 300 s | 0.05 m/s | 0.021 | 0.022 | 1.0 | 0 |
//! | 300 s | 0.20 m/s | 0.076 | 0.100 | 0.9 | 0 |
//!
//! So a window that holds little more than one surge takes part of the surge for drift, and its
//! claim is too small by two; one of three surges is honest. Errors of consecutive estimates are
//! correlated: 0.6 after a twelfth of the window, 0.4 after an eighth, none after a quarter.
//! Estimates at a quarter of the window may be taken as independent.
//!
//! Cost of an estimate, N samples and p lags: the triangle 2 n^2 (N + p - n / 3) floating
//! operations with n = 2 p + 5, the eigenvalues about 25 (2 p)^3 for the order found. With p up to
//! 8: 0.13 million for 120 s if four lags are found, 0.22 if eight; 0.3 and 0.4 for 300 s (20 to 65
//! us on one core of a server). At a quarter of the window this is 4 to 7 thousand a second of
//! data. A push costs nothing to speak of. Memory: 24 bytes a sample (2.9 kB for 120), reserved at
//! the start; an estimate borrows 8 (N + p) n more (21 kB) and a copy of the samples while it
//! lasts.

use insd_base::{Span, Time};
use nalgebra::{Matrix2, Matrix2x3, Vector2};

use super::model::Model;
use super::regression::{Regression, Slot, columns, drift, half_width, tau, trend};
use super::slow::Response;
use super::window::{Push, Window};

/// Orders beyond this are not tried.
const HIGHEST_ORDER: usize = 16;
/// Fewest and most samples of a window.
const SAMPLES: (usize, usize) = (32, 3600);
/// Rows that a fit needs over its unknowns per component.
const ROWS_PER_UNKNOWN: usize = 3;
/// Standard deviation of the disturbance below which there is nothing to model, m/s.
const STILL: f64 = 1e-6;
/// Distance of I - sum A_i from singular, in its own standard deviations, below which the drift and
/// the sea cannot be told apart.
const DISTINCT: f64 = 1.0;
/// Growth of an undriven disturbance over the window at which a fit is refused.
const GROWTH: f64 = std::f64::consts::E;

/// How many past samples the model of the sea looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelOrder {
    /// Always so many.
    Fixed(usize),
    /// The best of 0 to `max` by Akaike's criterion, at every estimate.
    Chosen {
        /// Highest order that is tried.
        max: usize,
    },
}

/// Settings of a [`Prefilter`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrefilterConfig {
    /// From sample to sample; at least 1 ms.
    pub interval: Span,
    /// Length of the window; 32 to 3600 samples. At least three periods of the slowest sway: that of moorings is one to three
    /// minutes, and over five a Schuler oscillation is still a parabola.
    pub window: Span,
    /// Order of the model; at most 16.
    pub order: ModelOrder,
}

/// Why there is no slow velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PrefilterRefusal {
    /// The window holds too few samples with an unbroken past.
    TooFew {
        /// So many there are.
        rows: usize,
        /// So many are needed.
        needed: usize,
    },
    /// The velocity is a parabola to within 1 um/s: there is no sea to take out.
    Still,
    /// The model grows: over the window an undriven disturbance would grow more than e-fold.
    Unstable {
        /// Growth from sample to sample.
        radius: f64,
    },
    /// The sea has so much power near frequency zero that drift and sea cannot be told apart.
    Indistinct {
        /// Smallest singular value of I - sum A_i.
        gain: f64,
        /// Its standard deviation.
        gain_std: f64,
    },
    /// The numbers are out of range.
    NotFinite,
}

/// The slow part of the velocity at the newest sample.
#[derive(Clone, Debug, PartialEq)]
pub struct SlowVelocity {
    /// Time of the newest sample.
    pub time: Time,
    /// The slow velocity, north and east, m/s.
    pub value: Vector2<f64>,
    /// Its covariance by the fit, (m/s)^2: true under waves, up to a factor of two in sigma too
    /// small if the ship surges with a period near the window (module documentation of the
    /// prefilter).
    pub covariance: Matrix2<f64>,
    /// Its first derivative, m/s^2.
    pub acceleration: Vector2<f64>,
    /// Its second derivative, m/s^3.
    pub jerk: Vector2<f64>,
    /// The sea that was taken out; holds order and residual covariance.
    pub model: Model,
    /// Samples that the fit explains.
    pub rows: usize,
}

impl SlowVelocity {
    /// The slow velocity, m/s, some seconds after the newest sample (before it: negative).
    #[must_use]
    pub fn at(&self, seconds: f64) -> Vector2<f64> {
        self.value + self.acceleration * seconds + self.jerk * (0.5 * seconds * seconds)
    }
}

/// The sliding window and how it is read.
#[derive(Clone, Debug)]
pub struct Prefilter {
    window: Window,
    order: ModelOrder,
}

impl Default for PrefilterConfig {
    fn default() -> Self {
        PrefilterConfig {
            interval: Span::from_seconds(1.0),
            window: Span::from_seconds(300.0),
            order: ModelOrder::Chosen { max: 8 },
        }
    }
}

impl ModelOrder {
    fn highest(self) -> usize {
        match self {
            ModelOrder::Fixed(order) | ModelOrder::Chosen { max: order } => {
                order.min(HIGHEST_ORDER)
            }
        }
    }
}

impl Prefilter {
    /// An empty window. Settings out of their range are taken at the nearer end of it.
    #[must_use]
    pub fn new(config: &PrefilterConfig) -> Self {
        let interval = config.interval.max(Span::from_nanos(1_000_000));
        let samples = (config.window.as_seconds() / interval.as_seconds()).round();
        let length = (samples as usize).clamp(SAMPLES.0, SAMPLES.1);
        Prefilter { window: Window::new(interval, length), order: config.order }
    }

    /// Adds the velocity, m/s, north and east, at a time; the oldest sample makes room for it.
    ///
    /// Samples lost on the way leave empty slots, and the rows of the fit that span them are left
    /// out. A gap as long as the window, or a sample more than a tenth of the interval off the grid
    /// of the one before, begins the window anew.
    pub fn push(&mut self, time: Time, velocity: &Vector2<f64>) -> Push {
        self.window.push(time, *velocity)
    }

    /// Changes the past as if a correction made at the newest sample had always been there:
    /// `derivatives` are those of the correction at the newest sample by time, north and east, m/s,
    /// m/s^2, m/s^3 and so on; the sample t seconds after it (t <= 0) gets their Taylor polynomial.
    /// A correction that is not finite empties the window.
    pub fn shift(&mut self, derivatives: &[Vector2<f64>]) {
        if derivatives.iter().flatten().all(|value| value.is_finite()) {
            self.window.shift(derivatives);
        } else {
            self.window.clear();
        }
    }

    /// The samples of the window, oldest first; what was lost is left out.
    pub fn samples(&self) -> impl Iterator<Item = &Vector2<f64>> {
        self.window.slots().flatten()
    }

    /// The newest samples before the first that was lost, oldest first.
    #[must_use]
    pub fn newest_run(&self) -> Vec<Vector2<f64>> {
        let slots: Vec<_> = self.window.slots().copied().collect();
        let first = slots.iter().rposition(Option::is_none).map_or(0, |lost| lost + 1);
        slots.into_iter().skip(first).flatten().collect()
    }

    /// Forgets all samples.
    pub fn clear(&mut self) {
        self.window.clear();
    }

    /// The slow velocity at the newest sample, by eqs. (2)-(4) of the project's systems S1.
    ///
    /// A parabola is taken off first and put back after: eq. (2) keeps its form under that, and the
    /// numbers left are those of the sea alone. Fitted anew at every call: ask at a spacing.
    ///
    /// # Errors
    /// Why there is none.
    pub fn estimate(&self) -> Result<SlowVelocity, PrefilterRefusal> {
        let max = self.order.highest();
        let needed = ROWS_PER_UNKNOWN * columns(max);
        let mut slots: Vec<Slot> = self.window.slots().copied().collect();
        let time = self.window.newest().ok_or(PrefilterRefusal::TooFew { rows: 0, needed })?;
        let few = PrefilterRefusal::TooFew { rows: 0, needed };
        let (parabola, scale) = trend(&slots).ok_or(few)?;
        if !scale.is_finite() {
            return Err(PrefilterRefusal::NotFinite);
        }
        let parabola = Matrix2x3::from_fn(|axis, power| parabola[(power, axis)]);
        let length = slots.len();
        for (k, slot) in slots.iter_mut().enumerate() {
            *slot = slot.map(|velocity| velocity - parabola * drift(tau(k, length)));
        }
        let regression = Regression::new(&slots, max, scale);
        let rows = regression.rows();
        if rows < needed {
            return Err(PrefilterRefusal::TooFew { rows, needed });
        }
        if scale < STILL {
            return Err(PrefilterRefusal::Still);
        }
        let order = match self.order {
            ModelOrder::Fixed(_) => max,
            ModelOrder::Chosen { .. } => regression.best_order(max),
        };
        let half = half_width(length);
        let (slow, covariance, model) = self.fit(&regression, order, half)?;
        let slow = slow + parabola;
        let unit = half * self.window.interval();
        Ok(SlowVelocity {
            time,
            value: slow.column_sum(),
            covariance,
            acceleration: (slow.column(1) + slow.column(2) * 2.0) / unit,
            jerk: slow.column(2) * (2.0 / (unit * unit)),
            model,
            rows,
        })
    }

    /// Slow polynomial, its covariance at the newest sample, and the model.
    fn fit(
        &self,
        regression: &Regression,
        order: usize,
        half: f64,
    ) -> Result<(Matrix2x3<f64>, Matrix2<f64>, Model), PrefilterRefusal> {
        let theta = regression.coefficients(order).ok_or(PrefilterRefusal::NotFinite)?;
        let drive = Matrix2x3::from_fn(|axis, power| theta[(power, axis)]);
        let lag = |i| Matrix2::from_fn(|axis, from| theta[(columns(i) + from, axis)]);
        let coefficients: Vec<Matrix2<f64>> = (0..order).map(lag).collect();
        let sigma = regression.residual_covariance(order);
        let model = Model::new(coefficients, sigma, self.window.interval());
        let radius = model.radius();
        if radius.ln() * 2.0 * half > GROWTH.ln() {
            return Err(PrefilterRefusal::Unstable { radius });
        }
        let singular = PrefilterRefusal::Indistinct { gain: 0.0, gain_std: 0.0 };
        let response = Response::new(model.coefficients(), half).ok_or(singular)?;
        let (gain, gain_std) =
            response.weakest(order, regression).ok_or(PrefilterRefusal::NotFinite)?;
        if gain <= DISTINCT * gain_std {
            return Err(PrefilterRefusal::Indistinct { gain, gain_std });
        }
        let slow = response.polynomial(&drive);
        let covariance = response
            .covariance(&slow, half, order, regression)
            .ok_or(PrefilterRefusal::NotFinite)?;
        let is_finite = slow.iter().chain(covariance.iter()).all(|value| value.is_finite());
        if is_finite { Ok((slow, covariance, model)) } else { Err(PrefilterRefusal::NotFinite) }
    }
}
