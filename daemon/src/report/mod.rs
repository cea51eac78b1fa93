//! A report of a recording: one HTML page that needs nothing else, the same for the same recording.
//!
//! The recording is replayed through the very pipeline of the daemon, and what the report needs is
//! gathered on the way in a bounded room ([`collect`]): a day at 200 Hz takes no more memory than an hour.

mod bins;
mod bounded;
mod collect;
mod draw;
mod page;
mod source;
mod statistics;
mod times;
pub(crate) mod words;

use insd_base::{Counts, Geodetic, StartCondition};
use insd_drivers::raw::RawRead;
use insd_engine::EngineConfig;
use insd_intake::status::IntakeStatus;

use bounded::Bounded;
use collect::Collected;

/// Faults of the recording that are kept at each end.
const FAULTS: usize = 50;

/// Everything that a report says.
#[derive(Debug)]
pub struct Report {
    /// Name of the recording.
    name: String,
    /// Name and version of the program that made it.
    program: Option<String>,
    /// The configuration as text, and whether it is another than the recorded one.
    config: Option<String>,
    other_config: bool,
    /// Which run of the program, of how many; a voyage has none.
    run: Option<(u32, u32)>,
    start: StartCondition,
    /// Where she was said to be at the start.
    place: Option<Geodetic>,
    rate: f64,
    collected: Collected,
    counts: Counts,
    /// Ports, sensors, sources and time at the end; a voyage has none.
    intake: Option<IntakeStatus>,
    /// Names of the ports that are written to.
    outputs: Vec<String>,
    skipped: u64,
    faults: Faults,
}

/// What is wrong with the recording itself.
#[derive(Debug)]
struct Faults {
    /// In words, each with where the recording stood.
    told: Bounded<(Option<insd_base::Time>, String)>,
    read: RawRead,
}

impl Report {
    /// A report that has gathered nothing yet.
    fn new(name: String, engine: &EngineConfig, start: insd_base::Time) -> Self {
        Report {
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

    /// The page.
    #[must_use]
    pub fn html(&self) -> String {
        page::page(self)
    }
}
