//! What one voyage adds to a campaign, and what its heading is held against.

use std::collections::BTreeMap;

use insd_base::AlignmentStatus;
use insd_base::alignment::{ACCURACY, heading_target};
use insd_simulator::{LimitError, Scenario, limit};
use serde::{Deserialize, Serialize};

use super::aligned::{self, WorstHeading};
use super::alignment::{RunAlignment, alignment};
use super::drift::Drift;
use super::errors::{EpochError, VoyageErrors};
use super::instants::{self, AlignmentMoment, Instant};
use super::promises::{self, Promise};
use super::report::summaries;
use super::statistics::Summary;
use super::stored::StoredFate;

/// The scores of one seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Seed.
    pub seed: u64,
    /// Epochs compared.
    pub epochs: u64,
    /// Figures by component, as in [`super::ErrorReport`].
    pub components: BTreeMap<String, Option<Summary>>,
    /// Errors in each stretch without GNSS.
    pub outages: Vec<Drift>,
    /// The boldest claim of the heading.
    pub worst_heading: Option<WorstHeading>,
    /// At each of the instants of the yardstick.
    pub moments: Vec<Option<AlignmentMoment>>,
    /// When the heading was good.
    pub alignment: RunAlignment,
    /// When the alignment said that it would be good, at each of the instants at which that is scored.
    pub promises: Vec<Option<Promise>>,
    /// What became of the stored state, if it was to start from one.
    pub stored: Option<StoredFate>,
}

/// What the heading is held against, beside its own claims.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Yardstick {
    /// Instants in order of time, with the limits there.
    pub instants: Vec<Instant>,
    /// Why there are no limits, if there are none.
    pub no_limit: Option<String>,
    /// The heading that counts as aligned, rad.
    pub bar: f64,
}

impl Yardstick {
    /// That of a scenario at some instants, s, in order of time; without limits where they do not cover the scenario.
    ///
    /// # Errors
    /// The limit cannot be computed for another reason.
    pub fn of(scenario: &Scenario, at: &[f64]) -> Result<Self, LimitError> {
        let (limits, no_limit) = match limit(scenario, at) {
            Ok(limits) => (limits.iter().map(|limit| Some(limit.heading)).collect(), None),
            Err(fault @ LimitError::NotCovered(_)) => {
                (vec![None; at.len()], Some(fault.to_string()))
            }
            Err(fault) => return Err(fault),
        };
        let instants = at.iter().zip(limits).map(|(at, limit)| Instant { at: *at, limit });
        let bar = heading_target(ACCURACY, scenario.start_latitude());
        Ok(Yardstick { instants: instants.collect(), no_limit, bar })
    }
}

impl Run {
    /// The scores of a comparison.
    #[must_use]
    pub fn new(seed: u64, errors: &VoyageErrors, outages: Vec<Drift>) -> Self {
        let epochs = errors.epochs.len() as u64;
        Run {
            seed,
            epochs,
            components: own(summaries(errors)),
            outages,
            worst_heading: aligned::worst_heading(&errors.epochs),
            moments: Vec::new(),
            alignment: RunAlignment::default(),
            promises: Vec::new(),
            stored: None,
        }
    }

    /// The same with what the alignment said of itself.
    #[must_use]
    pub fn telling(self, statuses: &[AlignmentStatus]) -> Self {
        Run { promises: promises::promises(statuses), ..self }
    }

    /// The same with what became of its stored state.
    #[must_use]
    pub fn started_from(self, stored: Option<StoredFate>) -> Self {
        Run { stored, ..self }
    }

    /// The same with the heading held against a yardstick at all of its epochs, in order of time.
    #[must_use]
    pub fn measured(self, epochs: &[EpochError], yardstick: &Yardstick) -> Self {
        Run {
            moments: instants::moments(epochs, &yardstick.instants),
            alignment: alignment(epochs, yardstick.bar),
            ..self
        }
    }
}

fn own<T>(named: BTreeMap<&'static str, T>) -> BTreeMap<String, T> {
    named.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}
