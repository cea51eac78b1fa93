//! A navigator, as it is kept for the next start of the program.

use insd_base::{Span, Time};
use serde::{Deserialize, Serialize};

use super::Navigator;
use crate::berth::{Departure, Hold, HoldCheckpoint};
use crate::config::NavConfig;
use crate::filter::Filter;
use crate::filter::checkpoint::FilterCheckpoint;

/// A filter and how it is held at the berth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NavigatorCheckpoint {
    filter: FilterCheckpoint,
    hold: Option<HoldCheckpoint>,
    departure: Departure,
    is_berth_named: bool,
}

impl NavigatorCheckpoint {
    /// Instant of the estimate.
    #[must_use]
    pub fn time(&self) -> Time {
        self.filter.time()
    }

    /// The filter.
    #[must_use]
    pub fn filter(&self) -> &FilterCheckpoint {
        &self.filter
    }
}

impl Navigator {
    /// What is worth keeping.
    #[must_use]
    pub fn kept(&self) -> NavigatorCheckpoint {
        NavigatorCheckpoint {
            filter: self.filter.kept(),
            hold: self.hold.as_ref().map(Hold::kept),
            departure: self.departure,
            is_berth_named: self.is_berth_named,
        }
    }

    /// Goes on from what was kept, on a time line that is later by a span. `None` if it cannot be.
    #[must_use]
    pub fn taken_up(config: &NavConfig, kept: &NavigatorCheckpoint, by: Span) -> Option<Navigator> {
        let mut filter = Filter::taken_up(config, &kept.filter, by)?;
        let hold = kept.hold.as_ref().map(|hold| Hold::taken_up(hold, &mut filter, by));
        Some(Navigator {
            hold,
            departure: kept.departure.shifted(by),
            is_berth_named: kept.is_berth_named,
            ..Navigator::of(filter, None)
        })
    }
}
