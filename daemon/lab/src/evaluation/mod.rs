//! Scores of a navigation solution against truth: errors, consistency of its claims, drift.
//!
//! Pure functions over lists of solutions and truths; the commands `evaluate` and `campaign` and
//! the tests of the house all use these.

mod aligned;
mod alignment;
mod alignment_log;
mod by_satellites;
mod campaign;
mod component;
mod drift;
mod errors;
mod evidence;
mod innovation;
mod instants;
mod interval;
pub mod plot;
mod promises;
mod report;
mod rows;
mod run;
mod series;
mod sky;
mod stanford;
mod state;
mod statistics;
mod stored;
mod unknown;

pub use aligned::{AlignedEstimates, Times, WorstHeading, WorstRun, worst_heading};
pub use alignment::{RunAlignment, alignment};
pub use alignment_log::AlignmentRow;
pub use by_satellites::{WithSatellites, by_satellites};
pub use campaign::{CampaignReport, ComponentEstimates, OutageEstimates};
pub use component::{Component, Unit};
pub use drift::{Drift, Outage, drifts, outages};
pub use errors::{EpochError, EpochsLeftOut, VoyageErrors, errors, normalised};
pub use evidence::{Evidence, Exclusion, FaultsTold, Pieces, Share, Use, Worst, is_told};
pub use innovation::InnovationRow;
pub use instants::{AlignmentMoment, Instant, InstantEstimates, moments};
pub use interval::MeanOfRuns;
pub use promises::{Promise, PromiseEstimates};
pub use report::ErrorReport;
pub(crate) use report::summaries;
pub use rows::{RowWriter, read_rows};
pub use run::{Run, Yardstick};
pub use sky::SkyRow;
pub use stanford::{
    AlertLimit, IntegrityReport, LevelsOfAxis, StanfordClass, StanfordPoint, Tally,
    share_of_independent,
};
pub use state::StateRow;
pub use statistics::{Summary, mean, quantile, summarise, summarise_horizontal};
pub use stored::{StoredEstimates, StoredFate};

#[cfg(test)]
pub(crate) mod testing {
    //! Plain solutions and truths for tests.

    use insd_base::{Attitude, Body, Geodetic, Mode, Ned, Solution, SolutionSigma, Time, Truth};

    pub(crate) fn solution(seconds: f64, position: Geodetic) -> Solution {
        Solution {
            time: Time::from_seconds(seconds),
            position,
            velocity: Ned::default(),
            attitude: Attitude::default(),
            rate: Body::default(),
            sigma: SolutionSigma {
                position: Ned::new(1.0, 1.0, 1.0),
                velocity: Ned::new(0.1, 0.1, 0.1),
                roll: 1e-3,
                pitch: 1e-3,
                heading: 1e-2,
            },
            mode: Mode::Aided,
            judgement: insd_base::Judgement::default(),
            source: None,
            hidden: insd_base::Protection::default(),
        }
    }

    pub(crate) fn truth(seconds: f64, position: Geodetic) -> Truth {
        Truth {
            time: Time::from_seconds(seconds),
            position,
            velocity: Some(Ned::default()),
            attitude: Some(Attitude::default()),
        }
    }
}
