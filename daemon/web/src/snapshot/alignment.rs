//! What the alignment knows of itself, and of what moves the ship at her berth.

use serde::{Deserialize, Serialize};

/// What the alignment knows of itself.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownAlignment {
    /// When it said so, on the ship's time line, s.
    pub told_at_s: f64,
    /// `levelling`, `searching`, `fine`, `in_motion`, `aligned`.
    pub phase: String,
    /// Whether the ship is taken as lying at her berth.
    pub moored: bool,
    /// How far it is, 0 to 1, by time: what has passed of what it takes in all; `None` where nothing can
    /// be foreseen.
    pub progress: Option<f64>,
    /// 1-sigma of the heading, deg; `None` while levelling.
    pub sigma_heading_deg: Option<f64>,
    /// 1-sigma of the roll, deg.
    pub sigma_roll_deg: Option<f64>,
    /// 1-sigma of the pitch, deg.
    pub sigma_pitch_deg: Option<f64>,
    /// Heading sigma that is asked for here, deg; `None` while nobody knows where the ship is.
    pub target_deg: Option<f64>,
    /// Heading sigma that the bias of the gyros leaves to a gyrocompass here, deg.
    pub gyrocompass_deg: Option<f64>,
    /// When the target is reached: `reached`, `expected`, `unreachable`, `unknown`.
    pub forecast: String,
    /// How long until then, s, from the time of the snapshot; `None` unless it is expected.
    pub ready_in_s: Option<f64>,
    /// When that is, UTC, if it is known.
    pub ready_utc: Option<String>,
    /// When it was reached, on the ship's time line, s.
    pub reached_at_s: Option<f64>,
    /// The heading sigma that can be had at best, deg, where the target is out of reach.
    pub best_deg: Option<f64>,
    /// Why not sooner, or why never: `gyro_bias`, `random_walk`, `sea`, `latitude`.
    pub limited_by: Option<String>,
    /// What a forecast lacks: `time`, `manoeuvres`, `gnss_velocity`, `aid`, `method`.
    pub lacks: Option<String>,
    /// All of that as a sentence.
    pub text: String,
    /// Mean zero-crossing period of the heave, s.
    pub sea_period_s: Option<f64>,
    /// Significant heave at the berth, crest to trough, m.
    pub sea_heave_m: Option<f64>,
    /// How often her mean place at the berth was found to have shifted.
    pub shifts: u32,
    /// What became of the stored state: `none`, `on_trial`, `used`, `dropped`.
    pub stored_state: Option<String>,
}

/// What moves the ship, as an autoregressive model of her velocity or displacement.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownDisturbance {
    /// `autoregressive`, `as_published`: the model that the alignment works with; `window`: one fitted to the last
    /// minutes to be looked at.
    pub method: String,
    /// What it is a model of: `velocity`, `displacement`.
    pub quantity: String,
    /// Order of the model.
    pub order: Option<u32>,
    /// Interval of its samples, s.
    pub interval_s: Option<f64>,
    /// Time from the first to the last of the samples that are measured, s.
    pub window_s: Option<f64>,
    /// Largest magnitude of its roots; below 1 it is stable.
    pub radius: Option<f64>,
    /// How well it fits, where the alignment works with it and that is looked at.
    pub fit: Option<ShownFit>,
    /// Each axis.
    pub axes: Vec<DisturbanceAxis>,
}

/// How well the model of the sea fits.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ShownFit {
    /// What it leaves: `white`; `coloured`: not white, but its slow part is no more than claimed; `loud`: more than that.
    pub residual: Option<String>,
    /// Variance of what it leaves over the claimed one.
    pub level: Option<f64>,
    /// The same of its slow part, which the claimed heading rests on.
    pub slow: Option<f64>,
    /// Its largest correlation with what was left before.
    pub correlation: Option<f64>,
    /// So long before, s.
    pub apart_s: Option<f64>,
    /// How often it did not hold, and what is known of any sea counted again.
    pub fallbacks: u32,
    /// All of that as a sentence.
    pub text: String,
}

/// One axis of the disturbance.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct DisturbanceAxis {
    /// `north`, `east`, or `horizontal` for both together.
    pub name: String,
    /// Coefficients a(1) to a(p) of the model of this axis, no unit; of both together four numbers each, by
    /// rows.
    pub coefficients: Vec<f64>,
    /// Standard deviation of what a model of the velocity leaves, m/s.
    pub residual_mps: Option<f64>,
    /// Standard deviation of what a model of the displacement leaves, m.
    pub residual_m: Option<f64>,
    /// Power spectral density by the model: frequency in Hz, density in (m/s)^2/Hz or m^2/Hz. All numbers are finite.
    pub model: Vec<[f64; 2]>,
    /// The same as measured, if it is.
    pub measured: Vec<[f64; 2]>,
    /// Period at which the density is greatest, s.
    pub dominant_period_s: Option<f64>,
}
