//! What the filter has found of the sensors and the sea, for those who look on.

use crate::frames::Body;
use crate::motion::Current;
use crate::sea_fit::SeaFit;

/// A number and its 1-sigma, in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its 1-sigma.
    pub sigma: f64,
}

/// Errors of the sensors as the filter has them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimates {
    /// Bias of the gyros, turn-on and in-run together, body axes, rad/s.
    pub gyro_bias: Body,
    /// 1-sigma of the same.
    pub gyro_bias_sigma: Body,
    /// Bias of the accelerometers, turn-on and in-run together, body axes, m/s^2.
    pub accel_bias: Body,
    /// 1-sigma of the same.
    pub accel_bias_sigma: Body,
    /// Scale factor error of the log, ratio.
    pub log_scale: Estimate,
    /// Misalignment of the log about starboard, rad.
    pub log_pitch: Estimate,
    /// Misalignment of the log about down, rad.
    pub log_heading: Estimate,
    /// Velocity of the water, while a log tells the speed through it.
    pub current: Option<Current>,
    /// Lever arm from the IMU to the GNSS antenna in use as configured, body axes, m.
    pub gnss_lever_configured: Body,
    /// Lever arm from the IMU to the GNSS antenna as now known, body axes, m.
    pub gnss_lever: Body,
    /// 1-sigma of the same.
    pub gnss_lever_sigma: Body,
    /// Delay of GNSS epochs behind their time tags, s.
    pub gnss_delay: Estimate,
    /// Lever arm from the IMU to the log, body axes, m, and its 1-sigma, if it is found to be otherwise than
    /// configured.
    pub log_lever: Option<(Body, Body)>,
    /// Course less heading on the mean while she went straight on, rad: leeway and current, and what the IMU is
    /// turned by. `None` before she has done so for two minutes.
    pub course_less_heading: Option<Estimate>,
    /// Whether a receiver saw her climb as no sea does.
    pub is_not_at_sea: bool,
    /// Whether she climbs as she points and never slides, as nothing does but what goes on wheels.
    pub goes_on_wheels: bool,
    /// Whether the ship is taken as lying at her berth.
    pub moored: bool,
}

/// What of the ship a model of the sea is a model of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SeaQuantity {
    /// Her velocity, m/s.
    Velocity,
    /// Her displacement from her mean place, m.
    Displacement,
}

impl SeaQuantity {
    /// Its name: `velocity`, `displacement`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            SeaQuantity::Velocity => "velocity",
            SeaQuantity::Displacement => "displacement",
        }
    }
}

/// The sea of the last minutes as an autoregressive model of how it moves the ship.
///
/// d(k) = sum A_i d(k-i) + eps(k), with d of two horizontal components: north and east where
/// the prefilter holds a ship at her berth, otherwise forward and starboard.
#[derive(Clone, Debug, PartialEq)]
pub struct Disturbance {
    /// `as_published`, `autoregressive`: the model that the alignment works with; `window`: one fitted to be looked at.
    pub method: &'static str,
    /// What d is.
    pub quantity: SeaQuantity,
    /// From sample to sample, s.
    pub interval: f64,
    /// From the oldest sample that is shown to the newest, s.
    pub window: f64,
    /// A_1, A_2, ..: four numbers each, by rows, without unit.
    pub coefficients: Vec<f64>,
    /// Largest magnitude of the roots; below 1 the model is stable.
    pub radius: f64,
    /// 1-sigma of eps, root mean square of both components, m/s or m.
    pub residual: f64,
    /// Frequency, Hz, and spectral density of both components together, one-sided, (m/s)^2/Hz or m^2/Hz, by the model.
    pub spectrum: Vec<(f64, f64)>,
    /// The same as measured; empty where too little was seen.
    pub measured: Vec<(f64, f64)>,
    /// How well the model fits that the alignment works with.
    pub fit: Option<SeaFit>,
}
