//! What the filter did with a measurement.

use insd_base::{
    CameraTurn, RangingTurn, Rejection, RtkSilence, RtkTurn, SatelliteId, SatelliteInnovation,
    Source, Time,
};

/// Whether a quantity was used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Used.
    Accepted,
    /// Not used, and why.
    Rejected(Rejection),
}

/// What became of one quantity of a measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AidReport {
    /// Time of validity.
    pub time: Time,
    /// From whom.
    pub source: Source,
    /// Of which aid: `gnss_position`, ...
    pub aid: &'static str,
    /// Used or not.
    pub outcome: Outcome,
    /// Innovation and its expected 1-sigma by component, SI units of the aid; NaN where the
    /// measurement has fewer components.
    pub innovation: [(f64, f64); 3],
}

/// What became of a whole message.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Report {
    /// Each quantity in it.
    pub aids: Vec<AidReport>,
    /// Aids whose stated sigma was missing, zero or absurd.
    pub floored: Vec<&'static str>,
    /// Log-likelihood of the message under the estimate, bounded for outliers.
    pub log_likelihood: f64,
    /// The position was set anew.
    pub position_reset: bool,
    /// Satellites that are left out from an instant on (`true`), or used again.
    pub satellites: Vec<(Time, SatelliteId, bool)>,
    /// What each satellite told beside what was expected.
    pub ranges: Vec<SatelliteInnovation>,
    /// RTK is believed otherwise from now on.
    pub rtk: Vec<(Time, RtkTurn)>,
    /// Docking aids, by their number, that are believed otherwise from now on.
    pub rangings: Vec<(Time, u8, RangingTurn)>,
    /// The camera is believed otherwise from now on.
    pub camera: Vec<(Time, CameraTurn)>,
    /// What an epoch against a base came to: a place that is used, or why there is none.
    pub against_base: Option<Result<(), RtkSilence>>,
}
