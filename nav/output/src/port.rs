//! A port: its configuration and what it has already sent.

use insd_base::Solution;
use insd_wire::nmea::CivilTime;

use crate::config::{PortConfig, SentenceKind};
use crate::schedule::Schedule;
use crate::sentences::sentence;

/// Turns solutions into the bytes of one port.
#[derive(Clone, Debug)]
pub struct Port {
    config: PortConfig,
    schedules: Vec<(SentenceKind, Schedule)>,
    bytes: Vec<u8>,
}

impl Port {
    /// A port that has sent nothing yet.
    #[must_use]
    pub fn new(config: PortConfig) -> Self {
        let schedules =
            config.sentences.iter().map(|(kind, rate)| (*kind, Schedule::new(*rate))).collect();
        Port { config, schedules, bytes: Vec::new() }
    }

    /// The sentences that are due with this solution, in the order of the configuration; `utc` is
    /// the solution's time of validity, if it is known: without it times of day stay empty. Empty if
    /// none is due.
    pub fn sentences(&mut self, solution: &Solution, utc: Option<CivilTime>) -> &[u8] {
        self.bytes.clear();
        for (kind, schedule) in &mut self.schedules {
            if schedule.is_due(solution.time)
                && let Some(line) = sentence(*kind, &self.config, solution, utc)
            {
                self.bytes.extend_from_slice(line.as_bytes());
            }
        }
        &self.bytes
    }
}
