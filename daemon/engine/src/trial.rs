//! The trial of a heading that was found under way: what it was found by may not be as configured, and GNSS
//! tells.

use insd_alignment::in_motion::GOAL;
use insd_base::units::DEG_PER_HOUR;
use insd_base::{Solution, Span, Time};
use insd_nav::Filter;
use insd_nav::config::LeverFound;

/// It lasts so long, s; with gyros that do not find north on their own, of a larger turn-on bias than this,
/// rad/s, until motion has confirmed the lever arm that it was found by, or for so long.
const USUAL: f64 = 300.0;
const LONGEST: f64 = 7200.0;
const BLIND: f64 = 1.0 * DEG_PER_HOUR;
/// Mean square of the innovations, of which one is expected, that refutes what was handed over,
const REFUTED: f64 = 8.0;
/// and up to which its claims stand as they are.
const HONEST: f64 = 1.6;
/// What was found of the lever arm is taken to be so many times as unsure for the next alignment, and by
/// no less than this, m.
const UNSURE: f64 = 2.0;
const LEAST: f64 = 0.5;

/// A heading on trial.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trial {
    began: Time,
    end: Time,
}

impl Trial {
    /// Begins with the filter that is handed over, on gyros of a turn-on bias, rad/s.
    pub(crate) fn begin(now: Time, gyro_bias_std: f64) -> Self {
        let lasts = if gyro_bias_std < BLIND { USUAL } else { LONGEST };
        Trial { began: now, end: now + Span::from_seconds(lasts) }
    }

    fn is_over(&self, filter: &Filter) -> bool {
        filter.time() >= self.end || filter.is_lever_confirmed()
    }

    /// What the next alignment must know if this one was misled: by the lever arm that was found since, or
    /// most likely by one of which only that is known.
    pub(crate) fn refuted_by(&self, filter: &Filter) -> Option<LeverFound> {
        let is_early = (filter.time() - self.began).as_seconds() < USUAL;
        if is_early && filter.has_mended_lever() {
            let estimates = filter.estimates(false);
            let std = (UNSURE * estimates.gnss_lever_sigma.0.max()).max(LEAST);
            return Some(LeverFound { arm: estimates.gnss_lever.0, std });
        }
        let is_off = filter.strain().is_some_and(|strain| strain > REFUTED);
        (is_off && !self.is_over(filter)).then_some(LeverFound::UNKNOWN)
    }

    /// What is on trial claims no more than GNSS bears out, and no heading before GNSS has been heard for a
    /// while.
    pub(crate) fn claim(&self, filter: &Filter, solution: Solution) -> Solution {
        if self.is_over(filter) {
            return solution;
        }
        let off = filter.early_strain();
        let factor = if off > HONEST { off.sqrt() } else { 1.0 };
        let mut sigma = solution.sigma.scaled(factor);
        if filter.strain().is_none() {
            sigma.heading = sigma.heading.max(GOAL);
        }
        Solution { sigma, ..solution }
    }
}
