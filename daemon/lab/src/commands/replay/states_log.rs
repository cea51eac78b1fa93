//! Every error state once a second.

use std::path::Path;

use insd_base::Time;
use insd_config::OutputFile;
use insd_engine::Engine;

use crate::evaluation::{RowWriter, StateRow};

/// From one look to the next, s.
const INTERVAL: f64 = 1.0;

/// A file of error states.
pub(super) struct StatesLog {
    file: RowWriter<StateRow, OutputFile>,
    looked: Option<Time>,
}

impl StatesLog {
    pub(super) fn create(path: &Path) -> anyhow::Result<Self> {
        Ok(StatesLog { file: RowWriter::new(OutputFile::create(path)?), looked: None })
    }

    /// Looks once a second at the states of the newest solution.
    pub(super) fn look(&mut self, engine: &Engine, solved: Option<Time>) -> std::io::Result<()> {
        let Some(now) = solved else { return Ok(()) };
        if self.looked.is_some_and(|last| (now - last).as_seconds() < INTERVAL) {
            return Ok(());
        }
        self.looked = Some(now);
        let states = engine.carried_states();
        states.iter().try_for_each(|own| self.file.write(&StateRow::of(now, own)))
    }

    /// Moves the file to its place.
    pub(super) fn finish(self) -> anyhow::Result<()> {
        self.file.finish()?.finish()
    }
}
