//! Everything that a report says.

use insd_base::{Counts, Geodetic, StartCondition};
use insd_drivers::raw::RawRead;
use insd_engine::EngineConfig;
use insd_intake::status::IntakeStatus;

use super::bounded::Bounded;
use super::collect::Collected;

/// Faults of the recording that are kept at each end.
pub(super) const FAULTS: usize = 50;

/// Everything that a report says.
#[derive(Debug)]
pub struct VoyageReport {
    /// Name of the recording.
    pub(super) name: String,
    /// Name and version of the program that made it.
    pub(super) program: Option<String>,
    /// The configuration as text, and whether it is another than the recorded one.
    pub(super) config: Option<String>,
    pub(super) other_config: bool,
    /// Which run of the program, of how many; a voyage has none.
    pub(super) run: Option<(u32, u32)>,
    pub(super) start: StartCondition,
    /// Where she was said to be at the start.
    pub(super) place: Option<Geodetic>,
    pub(super) rate: f64,
    pub(super) collected: Collected,
    pub(super) counts: Counts,
    /// Ports, sensors, sources and time at the end; a voyage has none.
    pub(super) intake: Option<IntakeStatus>,
    /// Names of the ports that are written to.
    pub(super) outputs: Vec<String>,
    pub(super) skipped: u64,
    pub(super) faults: Faults,
}

/// What is wrong with the recording itself.
#[derive(Debug)]
pub(super) struct Faults {
    /// In words, each with where the recording stood.
    pub(super) told: Bounded<(Option<insd_base::Time>, String)>,
    pub(super) read: RawRead,
}

impl VoyageReport {
    /// A report that has gathered nothing yet.
    pub(super) fn new(name: String, engine: &EngineConfig, start: insd_base::Time) -> Self {
        VoyageReport {
            name,
            program: None,
            config: None,
            other_config: false,
            run: None,
            start: engine.start,
            place: engine.initial,
            rate: engine.output_rate,
            collected: Collected::new(start, engine.output_rate),
            counts: Counts::default(),
            intake: None,
            outputs: Vec::new(),
            skipped: 0,
            faults: Faults { told: Bounded::new(FAULTS), read: RawRead::default() },
        }
    }
}
