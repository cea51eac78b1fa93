//! The sea taken out of the velocity: what is left is the slow error that alignment is after.
//!
//! At the berth the computed velocity is its own error plus the sway of the ship in the waves,
//! y = dV + V_d + e (systems S1, eq. (1)). A filter that is fed with y takes the sway for white
//! noise, which it is not. Here a sliding window of y is modelled as autoregressive with a
//! polynomial as its exogenous part (eq. (2)); the polynomial that this part drives is the estimate
//! of dV at the newest sample, with the covariance of the fit. After JP3375720B2, "prefilter" of a
//! ship's strapdown inertial system, as set down in the project's systems S1, eqs. (1)-(4).
//!
//! Velocities are north and east, m/s; the window is a regular grid in time.
//!
//! [`Prefilter`] holds the window; [`SlowVelocity`] is its answer, [`PrefilterRefusal`] why there is none;
//! [`Model`] is the sea that was found on the way: spectrum, period, significant motion, whitening.

mod displacement;
mod measured;
mod model;
mod prefilter;
mod prior;
mod regression;
mod slow;
mod spectrum;
mod whiteness;
mod window;

#[cfg(test)]
mod tests;

pub use displacement::{Displacement, SeaSums, SeaWindow, Whitener, WhiteningConfig};
pub use measured::measured_spectrum;
pub use model::Model;
pub use prefilter::{ModelOrder, Prefilter, PrefilterConfig, PrefilterRefusal, SlowVelocity};
pub use prior::{Foretold, SeaPrior};
pub use spectrum::SpectralMotion;
pub use whiteness::Whiteness;
pub use window::Push;
