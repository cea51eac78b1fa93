//! The trial of a heading that was found under way: what it was found by may not be as configured, and GNSS
//! tells.

use insd_alignment::in_motion::GOAL;
use insd_base::{Estimates, Solution, Span, Time};
use insd_nav::Filter;
use insd_nav::config::COARSE_GYRO;

/// It lasts so long, s; with coarse gyros until motion has confirmed the lever arm that it was found by, or for so long.
const USUAL: f64 = 300.0;
const LONGEST: f64 = 7200.0;
/// Mean square of the innovations, of which one is expected, that refutes what was handed over,
const REFUTED: f64 = 8.0;
/// and up to which its claims stand as they are.
const HONEST: f64 = 1.6;
/// A heading on trial.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trial {
    began: Time,
    end: Time,
}

/// What a heading was misled by.
pub(crate) enum Misled {
    /// By what was found since.
    Found(Box<Estimates>),
    /// Most likely by the lever arm of the antenna, of which nothing else is known.
    Unknown,
    /// By the IMU: an installation as it tells it is none.
    Imu,
    /// By a log that tells so many times her speed.
    Log(f64),
}

impl Trial {
    /// Begins with the filter as it is now.
    pub(crate) fn of(filter: &Filter) -> Self {
        let (now, is_blind) = (filter.time(), filter.gyro_bias_std() >= COARSE_GYRO);
        let lasts = if is_blind { LONGEST } else { USUAL };
        Trial { began: now, end: now + Span::from_seconds(lasts) }
    }

    fn is_over(&self, filter: &Filter) -> bool {
        filter.time() >= self.end || filter.is_lever_confirmed()
    }

    /// What the heading was misled by, if GNSS refutes it.
    pub(crate) fn refuted_by(&self, filter: &Filter) -> Option<Misled> {
        let is_early = (filter.time() - self.began).as_seconds() < USUAL;
        if is_early && filter.has_mended_antenna() {
            return Some(Misled::Found(Box::new(filter.estimates(false))));
        }
        let is_off = filter.strain().is_some_and(|strain| strain > REFUTED);
        (is_off && !self.is_over(filter)).then_some(Misled::Unknown)
    }

    /// Whether it is over, and GNSS bears out what was found.
    pub(crate) fn acquits(&self, filter: &Filter) -> bool {
        self.is_over(filter) && filter.strain().is_some_and(|strain| strain < HONEST)
    }

    /// Whether it has gone on for long enough to tell a mirrored IMU, and GNSS bears out what was found.
    pub(crate) fn has_gone_well(&self, filter: &Filter) -> bool {
        let is_long = (filter.time() - self.began).as_seconds() > USUAL;
        is_long && filter.strain().is_some_and(|strain| strain < HONEST)
    }

    /// What is on trial claims no more than GNSS bears out, and no heading before GNSS has been heard for a
    /// while.
    pub(crate) fn claim(&self, filter: &Filter, solution: Solution) -> Solution {
        let off = filter.early_strain();
        let is_fine = off <= HONEST && filter.strain().is_some();
        if is_fine || self.is_over(filter) {
            return solution;
        }
        let factor = if off > HONEST { off.sqrt() } else { 1.0 };
        let mut sigma = solution.sigma.scaled(factor);
        if filter.strain().is_none() {
            sigma.heading = sigma.heading.max(GOAL);
        }
        Solution { sigma, ..solution }
    }
}
