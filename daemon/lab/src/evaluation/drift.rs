//! What a stretch without GNSS costs.

use insd_base::{Mode, Solution, Span, Time};
use serde::{Deserialize, Serialize};

use super::component::Component;
use super::errors::EpochError;

/// Stretches shorter than this are no outages.
const SHORTEST: Span = Span::from_nanos(10_000_000_000);
/// A few aided epochs within this do not divide an outage.
const BRIEF: Span = Span::from_nanos(1_000_000_000);

/// A stretch in which the solution went on without GNSS after having been aided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outage {
    /// First epoch without GNSS.
    pub start: Time,
    /// Last epoch without GNSS.
    pub end: Time,
}

/// Errors in and at the end of an outage.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drift {
    /// First epoch without GNSS, s.
    pub start_s: f64,
    /// From the first to the last epoch without GNSS, s.
    pub length_s: f64,
    /// Largest horizontal error within, m.
    pub max_horizontal_m: f64,
    /// Horizontal error at the last epoch, m.
    pub end_horizontal_m: f64,
    /// Claimed 1-sigma (radius) at the last epoch, m.
    pub end_sigma_m: f64,
    /// Heading error at the last epoch, deg, if truth knows it.
    pub end_heading_deg: Option<f64>,
}

/// Stretches of at least 10 s in modes `dead_reckoning` or `inertial` after an aided one.
#[must_use]
pub fn outages(nav: &[Solution]) -> Vec<Outage> {
    let mut found: Vec<Outage> = Vec::new();
    let mut was_aided = false;
    let mut is_open = false;
    for solution in nav {
        let time = solution.time;
        let is_out = matches!(solution.mode, Mode::DeadReckoning | Mode::Inertial);
        if is_out && was_aided {
            match found.last_mut() {
                Some(last) if is_open || time - last.end <= BRIEF => last.end = time,
                _ => found.push(Outage { start: time, end: time }),
            }
        }
        is_open = is_out && was_aided;
        was_aided |= solution.mode == Mode::Aided;
    }
    found.retain(|outage| outage.end - outage.start >= SHORTEST);
    found
}

/// Errors in each outage that has epochs with truth.
#[must_use]
pub fn drifts(outages: &[Outage], epochs: &[EpochError]) -> Vec<Drift> {
    outages.iter().filter_map(|outage| drift(outage, epochs)).collect()
}

fn drift(outage: &Outage, epochs: &[EpochError]) -> Option<Drift> {
    let from = epochs.partition_point(|epoch| epoch.time < outage.start);
    let to = epochs.partition_point(|epoch| epoch.time <= outage.end);
    let within = epochs.get(from..to)?;
    let last = within.last()?;
    let largest = within.iter().filter_map(EpochError::horizontal).fold(0.0, f64::max);
    Some(Drift {
        start_s: outage.start.as_seconds(),
        length_s: (outage.end - outage.start).as_seconds(),
        max_horizontal_m: largest,
        end_horizontal_m: last.horizontal()?,
        end_sigma_m: last.horizontal_sigma(),
        end_heading_deg: last.of(Component::Heading).map(f64::to_degrees),
    })
}

#[cfg(test)]
mod tests {
    use super::super::errors::errors;
    use super::super::testing::{solution, truth};
    use super::*;
    use insd_base::Geodetic;

    fn sailing(seconds: i32, mode: impl Fn(i32) -> Mode) -> Vec<Solution> {
        let point = |t| Geodetic::from_degrees(f64::from(t) * 1e-7, 0.0, 0.0);
        (0..seconds)
            .map(|t| Solution { mode: mode(t), ..solution(f64::from(t), point(t)) })
            .collect()
    }

    #[test]
    fn outages_are_found_by_mode_and_their_drift_measured_at_the_end() {
        let nav = sailing(100, |t| match t {
            20..60 => Mode::DeadReckoning,
            70..75 => Mode::Inertial,
            _ => Mode::Aided,
        });
        let found = outages(&nav);
        assert_eq!(found.len(), 1);
        let still: Vec<_> = (0..100).map(|t| truth(f64::from(t), Geodetic::default())).collect();
        let drift = drifts(&found, &errors(&nav, &still, None).epochs)[0];
        assert_eq!((drift.start_s, drift.length_s), (20.0, 39.0));
        assert!((drift.end_horizontal_m - 59.0 * 0.011_057).abs() < 1e-3, "{drift:?}");
    }

    #[test]
    fn a_ship_that_never_had_gnss_has_no_outage() {
        assert!(outages(&sailing(100, |_| Mode::Inertial)).is_empty());
    }

    #[test]
    fn an_outage_that_lasts_to_the_end_counts() {
        let nav = sailing(100, |t| if t < 50 { Mode::Aided } else { Mode::Inertial });
        assert_eq!(outages(&nav).len(), 1);
    }
}
