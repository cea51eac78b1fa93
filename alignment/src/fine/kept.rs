//! A ship that has one heading, as she is kept for the next start of the program.

use insd_base::{Span, Time};
use insd_nav::filter::kept::KeptFilter;
use insd_nav::{Filter, NavConfig};
use serde::{Deserialize, Serialize};

use super::{Fine, Hold};
use crate::config::Method;
use crate::departure::Departure;
use crate::moorings::Moorings;

/// A filter and how it is held at the berth. The moorings go on; the other two methods begin with a new
/// window, as theirs has a gap in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeptFine {
    filter: KeptFilter,
    hold: Option<KeptHold>,
    departure: Departure,
    is_berth_named: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum KeptHold {
    WhiteNoise,
    Prefiltered,
    Moorings(Box<Moorings>),
}

impl KeptFine {
    /// Instant of the estimate.
    #[must_use]
    pub fn time(&self) -> Time {
        self.filter.time()
    }

    /// The filter.
    #[must_use]
    pub fn filter(&self) -> &KeptFilter {
        &self.filter
    }
}

impl Fine {
    /// What is worth keeping.
    #[must_use]
    pub fn kept(&self) -> KeptFine {
        KeptFine {
            filter: self.filter.kept(),
            hold: self.hold.as_ref().map(|hold| match hold {
                Hold::WhiteNoise(_) => KeptHold::WhiteNoise,
                Hold::Prefiltered(_) => KeptHold::Prefiltered,
                Hold::Moorings(moorings) => KeptHold::Moorings(moorings.clone()),
            }),
            departure: self.departure,
            is_berth_named: self.is_berth_named,
        }
    }

    /// Goes on from what was kept, on a time line that is later by a span. `None` if it cannot be.
    #[must_use]
    pub fn taken_up(config: &NavConfig, kept: &KeptFine, by: Span) -> Option<Fine> {
        let filter = Filter::taken_up(config, &kept.filter, by)?;
        let fine = match &kept.hold {
            None => Fine::under_way(filter),
            Some(KeptHold::WhiteNoise) => Fine::moored(filter, Method::WhiteNoise),
            Some(KeptHold::Prefiltered) => Fine::moored(filter, Method::Autoregressive),
            Some(KeptHold::Moorings(moorings)) => {
                let hold = Some(Hold::Moorings(Box::new(moorings.as_ref().clone().shifted(by))));
                Fine { hold, ..Fine::under_way(filter) }
            }
        };
        let departure = kept.departure.shifted(by);
        Some(Fine { departure, is_berth_named: kept.is_berth_named, ..fine })
    }
}
