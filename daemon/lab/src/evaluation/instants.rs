//! Roll, pitch and heading of many runs at given instants, beside the limit.

use insd_base::Time;
use serde::{Deserialize, Serialize};

use super::component::Component;
use super::errors::{EpochError, normalised};
use super::interval::{MeanOfRuns, shown};
use super::statistics::mean;
use crate::table::{Align, Table, significant};

/// The components that are scored at instants.
const ANGLES: [Component; 3] = [Component::Roll, Component::Pitch, Component::Heading];
/// An epoch further than this from an instant says nothing of it, s.
const NEAR: f64 = 1.0;

/// Error and claim of one run at the epoch nearest to an instant: roll, pitch, heading, rad.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AlignmentMoment {
    /// Errors.
    pub error: [f64; 3],
    /// Claimed 1-sigmas.
    pub sigma: [f64; 3],
}

/// The optimal filter's 1-sigma of the heading at an instant; `None` where it is not known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Instant {
    /// Instant, s.
    pub at: f64,
    /// Limit of the heading, rad.
    pub limit: Option<f64>,
}

/// All runs at one instant.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct InstantEstimates {
    /// Instant, s.
    pub at_s: f64,
    /// Runs with a solution there.
    pub runs: usize,
    /// Root mean square error of the heading, deg.
    pub heading_rms_deg: MeanOfRuns,
    /// Mean claimed 1-sigma of the heading, deg.
    pub heading_sigma_deg: f64,
    /// The 1-sigma of the optimal filter, deg.
    pub limit_deg: Option<f64>,
    /// RMS error over limit.
    pub rms_over_limit: Option<f64>,
    /// Mean claim over limit.
    pub sigma_over_limit: Option<f64>,
    /// Normalised estimation error squared of roll, pitch, heading.
    pub nees: [f64; 3],
    /// Share of the runs within the claimed 2 sigma in roll, pitch, heading.
    pub coverage_2sigma: [f64; 3],
}

/// The epochs of one run nearest to each of the instants; `None` where there is none within a second.
#[must_use]
pub fn moments(epochs: &[EpochError], instants: &[Instant]) -> Vec<Option<AlignmentMoment>> {
    instants.iter().map(|instant| moment(epochs, instant.at)).collect()
}

fn moment(epochs: &[EpochError], at: f64) -> Option<AlignmentMoment> {
    let distance = |epoch: &EpochError| (epoch.time - Time::from_seconds(at)).as_seconds().abs();
    let nearest = epochs.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    if distance(nearest) > NEAR {
        return None;
    }
    let [roll, pitch, heading] = ANGLES.map(|angle| nearest.of(angle));
    let sigma = ANGLES.map(|angle| nearest.sigma_of(angle));
    Some(AlignmentMoment { error: [roll?, pitch?, heading?], sigma })
}

/// The runs put together at an instant; `None` if none has a solution there.
pub(super) fn together(instant: &Instant, moments: &[AlignmentMoment]) -> Option<InstantEstimates> {
    let degrees = Component::Heading.scale();
    let errors: Vec<f64> = moments.iter().map(|m| m.error[2] * degrees).collect();
    let heading_rms_deg = MeanOfRuns::of_rms(&errors)?;
    let heading_sigma_deg = mean(moments.iter().map(|m| m.sigma[2] * degrees));
    let limit_deg = instant.limit.map(|limit| limit * degrees);
    let squares = |axis: usize| -> Vec<f64> {
        let ratio = |m: &AlignmentMoment| normalised(m.error[axis], m.sigma[axis]);
        moments.iter().filter_map(ratio).map(|ratio| ratio * ratio).collect()
    };
    let within = |square: &f64| f64::from(u8::from(*square <= 4.0));
    Some(InstantEstimates {
        at_s: instant.at,
        runs: moments.len(),
        heading_rms_deg,
        heading_sigma_deg,
        limit_deg,
        rms_over_limit: limit_deg.map(|limit| heading_rms_deg.mean / limit),
        sigma_over_limit: limit_deg.map(|limit| heading_sigma_deg / limit),
        nees: [0, 1, 2].map(|axis| mean(squares(axis).into_iter())),
        coverage_2sigma: [0, 1, 2].map(|axis| mean(squares(axis).iter().map(within))),
    })
}

/// One row for each instant.
pub(super) fn table(instants: &[InstantEstimates]) -> Table {
    let right = |name| (name, Align::Right);
    let mut table = Table::new(&[
        right("at s"),
        right("runs"),
        ("heading RMS deg", Align::Left),
        right("limit deg"),
        right("RMS / limit"),
        right("claim / limit"),
        ("NEES roll pitch heading", Align::Left),
        ("≤2σ % roll pitch heading", Align::Left),
    ]);
    let maybe = |value: Option<f64>| value.map_or("-".to_owned(), |value| significant(value, 3));
    for row in instants {
        let percent = row.coverage_2sigma.map(|share| format!("{:.1}", 100.0 * share));
        table.push(vec![
            format!("{}", row.at_s),
            row.runs.to_string(),
            shown(&row.heading_rms_deg, |value| significant(value, 3)),
            maybe(row.limit_deg),
            maybe(row.rms_over_limit),
            maybe(row.sigma_over_limit),
            row.nees.map(|nees| significant(nees, 3)).join("  "),
            percent.join("  "),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    fn epoch(seconds: f64, error: f64, sigma: f64) -> EpochError {
        let time = Time::from_seconds(seconds);
        EpochError { time, error: [Some(error); 9], sigma: [sigma; 9] }
    }

    #[test]
    fn the_epoch_nearest_to_an_instant_counts_unless_it_is_far() {
        let epochs = [epoch(59.4, 1.0, 1.0), epoch(60.4, 2.0, 1.0), epoch(64.0, 3.0, 1.0)];
        let at = |at| Instant { at, limit: None };
        let found = moments(&epochs, &[at(60.0), at(62.0), at(64.5)]);
        assert_eq!(
            found.iter().map(|m| m.map(|m| m.error[2])).collect::<Vec<_>>(),
            [Some(2.0), None, Some(3.0)]
        );
        assert_eq!(moments(&[], &[at(1.0)]), [None]);
    }

    #[test]
    fn the_runs_at_an_instant_are_held_against_the_limit() {
        let moment =
            |error: f64, sigma: f64| AlignmentMoment { error: [error; 3], sigma: [sigma; 3] };
        let runs = [moment(0.3, 0.1), moment(-0.4, 0.4)];
        let found = together(&Instant { at: 60.0, limit: Some(0.125) }, &runs).unwrap();
        assert!((found.rms_over_limit.unwrap() - 0.125_f64.sqrt() / 0.125).abs() < 1e-9);
        assert!((found.sigma_over_limit.unwrap() - 2.0).abs() < 1e-9);
        assert!((found.nees[2] - 5.0).abs() < 1e-9);
        assert_eq!(found.coverage_2sigma, [0.5; 3]);
        assert!(together(&Instant { at: 60.0, limit: None }, &[]).is_none());
        let unknown = together(&Instant { at: 60.0, limit: None }, &runs).unwrap();
        assert_eq!(unknown.rms_over_limit, None);
    }
}
