//! Which voyage the demo sails.

use insd_base::Voyage;
use insd_config::Config;
use insd_simulator::{Scenario, simulate};

use super::alongside;
use crate::scenario;

/// A scenario and a seed: one voyage, not yet made.
#[derive(Clone, Debug)]
pub struct DemoVoyage {
    scenario: Scenario,
    seed: u64,
}

impl DemoVoyage {
    /// Finds a scenario as all commands do: by the number or name of a shipped one, or as a file.
    ///
    /// # Errors
    /// With the list of shipped scenarios if there is no such one, or with what is wrong in it.
    pub fn find(wanted: &str, seed: u64) -> anyhow::Result<Self> {
        Ok(DemoVoyage { scenario: scenario::find(wanted, &[])?.scenario, seed })
    }

    /// What to call it on the screen.
    #[must_use]
    pub fn title(&self) -> String {
        format!("{}, seed {}", self.scenario.name(), self.seed)
    }

    /// The configuration of a ship like hers, with the berth that she goes to, and its text.
    ///
    /// # Errors
    /// What the scenario says of its berth is no berth for a configuration.
    pub fn configuration(&self) -> anyhow::Result<(Config, String)> {
        alongside::configuration(&self.scenario)
    }

    /// Makes the voyage. It takes a second or two for hours at sea.
    #[must_use]
    pub fn sail(&self) -> Voyage {
        simulate(&self.scenario, self.seed)
    }
}
