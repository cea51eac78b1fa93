//! How a port or a bus speaks of what it is told.

use crate::alerts::Condition;
use crate::policy::Policy;

/// How a port or a bus speaks of what it is told.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Manner {
    /// Limits beyond which a value is not available, or called something less.
    pub policy: Policy,
    /// The data come from a simulator: messages that can say so do, and those that cannot are not sent,
    /// so that nobody takes them for real.
    pub simulated: bool,
    /// Send everything even from a simulator. For a port that no ship's equipment listens to.
    pub unmarked_when_simulated: bool,
}

impl Manner {
    /// Whether an alert is told: from a simulator that the data are simulated, and no more, as alerts
    /// have no mark.
    pub(crate) fn shows(&self, condition: Condition) -> bool {
        match condition {
            Condition::Simulated => self.simulated,
            _ => !self.simulated || self.unmarked_when_simulated,
        }
    }
}
