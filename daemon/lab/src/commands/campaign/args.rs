//! The command line of a campaign.

use std::ops::Range;

use insd_simulator::Override;

use super::super::alignment::AlignmentArgs;
use super::super::outage::SensorOutage;
use super::super::{rate, seconds, stored_start};
use super::sweep::Sweep;
use crate::parts::PartsArgs;

/// Options of `insd campaign`.
///
/// Each figure is a mean over seeds with its 95 % confidence interval over seeds.
#[derive(Clone, Debug, clap::Args)]
pub struct CampaignArgs {
    /// Scenario file, or name or number of a shipped scenario
    #[arg(required_unless_present = "merge", conflicts_with = "merge")]
    pub(super) scenario: Option<String>,
    /// Seeds A to B, B left out
    #[arg(long, value_name = "A..B", value_parser = seeds, required_unless_present = "merge",
        conflicts_with = "merge")]
    pub(super) seeds: Option<Range<u64>>,
    /// Leave out what is before this time, s
    #[arg(long, value_name = "T", value_parser = seconds)]
    pub(super) from: Option<f64>,
    /// Score roll, pitch and heading at this instant, s, beside the limit of the optimal filter; may be
    /// repeated; for a moored scenario 60, 120, 300, 600, 900 and 1800 if not given
    #[arg(long, value_name = "T", value_parser = seconds)]
    pub(super) at: Vec<f64>,
    /// Set a key of the scenario to another value, as start.lat_deg=60; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(super) sets: Vec<Override>,
    /// Sail all seeds with each of several values of a key, as sea.state=3,5; may be repeated
    #[arg(long = "sweep", value_name = "KEY=A,B,C")]
    pub(super) sweeps: Vec<Sweep>,
    #[command(flatten)]
    pub(super) alignment: AlignmentArgs,
    /// Start each voyage from the state that an earlier one from the same berth stored, the ship having
    /// been turned by DEG since (0 if not given)
    #[arg(long, value_name = "DEG", num_args = 0..=1, default_missing_value = "0",
        allow_hyphen_values = true, value_parser = stored_start::turn)]
    pub(super) stored: Option<f64>,
    /// Print JSON instead of a table; a list where keys are swept
    #[arg(long)]
    pub(super) json: bool,
    /// Solutions per second that are compared
    #[arg(long, value_name = "HZ", default_value_t = 1.0, value_parser = rate)]
    pub(super) rate: f64,
    /// Take a sensor (imu, gnss, log, reference, camera) away while FROM <= t_s < TO; may be repeated
    #[arg(long = "outage", value_name = "SENSOR:FROM..TO")]
    pub(super) outages: Vec<SensorOutage>,
    #[command(flatten)]
    pub(super) parts: PartsArgs,
}

impl CampaignArgs {
    /// The options that change what comes out, as they are written.
    pub(super) fn words(&self) -> String {
        let mut words = vec![self.alignment.words(), format!("--rate {}", self.rate)];
        words.extend(self.from.map(|from| format!("--from {from}")));
        words.extend(self.at.iter().map(|at| format!("--at {at}")));
        words.extend(self.stored.map(|turned| format!("--stored {turned}")));
        words.extend(self.outages.iter().map(|outage| format!("--outage {outage}")));
        words.join(" ")
    }
}

/// `A..B` as a range that is not empty.
fn seeds(text: &str) -> Result<Range<u64>, String> {
    let parsed = text.split_once("..").and_then(|(from, to)| {
        let (from, to): (u64, u64) = (from.parse().ok()?, to.parse().ok()?);
        (from < to && to - from <= 1_000_000).then_some(from..to)
    });
    parsed.ok_or_else(|| "expected A..B with A < B, for example 0..40".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_are_half_open_and_never_empty() {
        assert_eq!(seeds("3..5"), Ok(3..5));
        for text in ["3", "5..5", "5..3", "a..b", "0..99999999999", "-1..2"] {
            assert!(seeds(text).is_err(), "{text}");
        }
    }
}
