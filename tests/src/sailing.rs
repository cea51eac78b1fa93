//! A voyage in memory through the engine, and all that came out of it.

use insd_alignment::AlignmentConfig;
use insd_base::{
    AidInnovation, AlignmentStatus, Counts, Event, Message, Mode, Received, Rejection, Solution,
    Source, Time, Voyage,
};
use insd_engine::{Engine, EngineConfig, Output};
use insd_simulator::{Scenario, simulate};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::scores::Scores;

/// All that the engine said, and its counters at the end.
#[derive(Clone, Debug, Default)]
pub struct Logbook {
    /// In order of their appearance.
    pub solutions: Vec<Solution>,
    /// In order of their appearance.
    pub innovations: Vec<AidInnovation>,
    /// In order of their appearance.
    pub events: Vec<Event>,
    /// In order of their appearance.
    pub alignment: Vec<AlignmentStatus>,
    /// After the last message.
    pub counts: Counts,
}

/// A voyage and what the engine made of it.
#[derive(Clone, Debug)]
pub struct Passage {
    /// What was simulated.
    pub voyage: Voyage,
    /// What the engine said.
    pub log: Logbook,
}

/// Solutions per second unless a test needs another rate.
pub const OUTPUT_RATE: f64 = 1.0;

/// Simulates one voyage and sails it.
#[must_use]
pub fn sail(scenario: &Scenario, seed: u64) -> Passage {
    let voyage = simulate(scenario, seed);
    let log = sail_voyage(&voyage);
    Passage { voyage, log }
}

/// One passage for each seed, in parallel, in the order of the seeds.
#[must_use]
pub fn sail_all(scenario: &Scenario, seeds: std::ops::Range<u64>) -> Vec<Passage> {
    seeds.into_par_iter().map(|seed| sail(scenario, seed)).collect()
}

/// Sails a voyage at the usual output rate.
#[must_use]
pub fn sail_voyage(voyage: &Voyage) -> Logbook {
    sail_messages(&EngineConfig::for_voyage(&voyage.header, OUTPUT_RATE), &voyage.received(), 1)
}

/// The same with a choice of how she aligns.
#[must_use]
pub fn sail_aligned(voyage: &Voyage, alignment: &AlignmentConfig) -> Logbook {
    let usual = EngineConfig::for_voyage(&voyage.header, OUTPUT_RATE);
    let config = EngineConfig { alignment: *alignment, ..usual };
    sail_messages(&config, &voyage.received(), 1)
}

/// Hands messages to a new engine and drains it after every `batch` of them and at the end.
#[must_use]
pub fn sail_messages(config: &EngineConfig, messages: &[Received], batch: usize) -> Logbook {
    let mut engine = Engine::new(config.clone());
    let mut log = Logbook::default();
    for part in messages.chunks(batch) {
        for received in part {
            engine.handle(received);
        }
        while let Some(output) = engine.poll_output() {
            log.enter(output);
        }
    }
    log.counts = engine.counts().clone();
    log
}

impl Logbook {
    fn enter(&mut self, output: Output) {
        match output {
            Output::Solution(solution) => self.solutions.push(solution),
            Output::Innovation(innovation) => self.innovations.push(innovation),
            Output::Satellite(_) => {}
            Output::Alignment(status) => self.alignment.push(status),
            Output::Event(event) => self.events.push(event),
        }
    }

    /// Mode of the first solution at or after an instant, s.
    #[must_use]
    pub fn mode_at(&self, seconds: f64) -> Option<Mode> {
        let at = Time::from_seconds(seconds);
        self.solutions.iter().find(|solution| solution.time >= at).map(|solution| solution.mode)
    }

    /// Measurements of an aid that were not used, whatever the reason.
    #[must_use]
    pub fn rejected(&self, aid: &str) -> u64 {
        let of_aid = self.counts.rejected.iter().filter(|((name, _), _)| *name == aid);
        of_aid.map(|(_, count)| count).sum()
    }

    /// Measurements of an aid that were not used for a reason.
    #[must_use]
    pub fn rejected_for(&self, aid: &'static str, reason: Rejection) -> u64 {
        self.counts.rejected.get(&(aid, reason)).copied().unwrap_or(0)
    }

    /// Measurements of an aid that were used.
    #[must_use]
    pub fn accepted(&self, aid: &str) -> u64 {
        self.counts.accepted.get(aid).copied().unwrap_or(0)
    }

    /// Replaced standard deviations of an aid.
    #[must_use]
    pub fn floored(&self, aid: &str) -> u64 {
        self.counts.floored.get(aid).copied().unwrap_or(0)
    }
}

impl Passage {
    /// Errors from an instant on, s.
    #[must_use]
    pub fn scores_from(&self, seconds: f64) -> Scores {
        self.scores_between(seconds, f64::MAX)
    }

    /// Errors from one instant to another, s.
    #[must_use]
    pub fn scores_between(&self, from: f64, to: f64) -> Scores {
        Scores::new(&self.log.solutions, &self.voyage.truth, from, to)
    }
}

/// Messages as if each had arrived the moment it was valid.
#[must_use]
pub fn prompt(voyage: &Voyage) -> Vec<Received> {
    delayed(voyage, |_| 0.0)
}

/// Messages in order of receipt, each later than its time of validity by what `delay` says of its
/// place in the list, s. The IMU is always prompt.
#[must_use]
pub fn delayed(voyage: &Voyage, delay: impl Fn(usize) -> f64) -> Vec<Received> {
    let mut messages = voyage.received();
    for (index, received) in messages.iter_mut().enumerate() {
        let late = if matches!(received.message, Message::Imu(_)) { 0.0 } else { delay(index) };
        received.receipt = received.message.time() + insd_base::Span::from_seconds(late);
    }
    messages.sort_by_key(|received| (received.receipt, rank(received.source)));
    messages
}

/// Order of messages that are received at the same instant.
fn rank(source: Source) -> u8 {
    match source {
        Source::Imu(_) => 0,
        Source::Gnss(_) => 1,
        Source::Log(_) => 2,
        Source::Reference(_) => 3,
        Source::Base(_) => 4,
        Source::Ranging(_) => 5,
        Source::Camera(_) => 6,
    }
}
