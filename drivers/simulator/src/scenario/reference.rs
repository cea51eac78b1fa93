//! The external reference: the chart's word on the berth, another navigator's velocity or heading.

use serde::Deserialize;

use super::fault::Faults;

/// Which position the reference gives.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum PositionReference {
    /// None.
    None,
    /// The surveyed position of the berth, as long as she lies there. Its 1-sigma is that of her
    /// sway about it.
    #[default]
    Berth,
}

/// The external reference.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Reference {
    /// Time from one message to the next.
    pub(crate) interval_s: f64,
    /// Which position it gives.
    pub(crate) position: PositionReference,
    /// White noise of the velocity, 1-sigma each of north and east; no velocity if absent.
    pub(crate) velocity_std_mps: Option<f64>,
    /// White noise of the heading, 1-sigma; no heading if absent.
    pub(crate) heading_std_deg: Option<f64>,
}

impl Default for Reference {
    fn default() -> Self {
        Reference {
            interval_s: 10.0,
            position: PositionReference::Berth,
            velocity_std_mps: None,
            heading_std_deg: None,
        }
    }
}

impl Reference {
    pub(super) fn check(&self, faults: &mut Faults) {
        faults.range("reference.interval_s", self.interval_s, 0.01, 1e5);
        faults.range(
            "reference.velocity_std_mps",
            self.velocity_std_mps.unwrap_or(0.0),
            0.0,
            100.0,
        );
        faults.range("reference.heading_std_deg", self.heading_std_deg.unwrap_or(0.0), 0.0, 180.0);
        if self.position == PositionReference::None
            && self.velocity_std_mps.is_none()
            && self.heading_std_deg.is_none()
        {
            faults.add("reference", "expected a position, velocity_std_mps or heading_std_deg");
        }
    }
}
