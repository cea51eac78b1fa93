//! One run of the daemon out of a raw recording.

use std::path::Path;

use insd_base::{Arrival, Received};
use insd_config::{BadInput, Config};
use insd_drivers::raw::{EXTENSION, FileHeader, RawFault, RawRead, RawReader};
use insd_intake::{Intake, Intaken};

/// The arrivals of one run, and the configuration that it had.
pub struct RawRun {
    /// The configuration.
    pub config: Config,
    reader: RawReader,
    run: u32,
    header: Option<FileHeader>,
}

/// Whether a path is a raw recording, or a folder that holds one.
#[must_use]
pub fn is_recording(path: &Path) -> bool {
    let is_own = |path: &Path| path.extension().is_some_and(|extension| extension == EXTENSION);
    if path.is_dir() {
        let entries = std::fs::read_dir(path).into_iter().flatten().flatten();
        return entries.into_iter().any(|entry| is_own(&entry.path()));
    }
    is_own(path)
}

impl RawRun {
    /// Opens a recording for its run of this number, from 1. `config` replaces the recorded
    /// configuration.
    ///
    /// # Errors
    /// It is no recording, or there is no configuration that could be read.
    pub fn open(path: &Path, config: Option<&Path>, run: u32) -> anyhow::Result<Self> {
        let reader = RawReader::open(path).map_err(|fault| BadInput(fault.to_string()))?;
        let config = match config {
            Some(file) => Config::load(file)?.0,
            None => {
                let header = reader.header().ok_or_else(|| {
                    let hint = "its configuration is not known: give one with --config";
                    BadInput(format!("{}: {hint}", path.display()))
                })?;
                Config::of_text(&header.config).map_err(|fault| {
                    BadInput(format!("{}: recorded configuration: {fault}", path.display()))
                })?
            }
        };
        let header = reader.header().cloned();
        Ok(RawRun { config, reader, run, header })
    }

    /// Hands over the arrivals in their order. What is wrong with the recording is told on standard
    /// error, and reading goes on behind it.
    ///
    /// # Errors
    /// The first that `each` returns; or there is no such run.
    pub fn for_each(
        &mut self,
        each: impl FnMut(&Arrival) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        let runs = self.for_each_of_run(each)?;
        self.tell_other_runs(runs);
        Ok(())
    }

    /// The same, and gives the number of runs without a word about them.
    ///
    /// # Errors
    /// As [`RawRun::for_each`].
    pub fn for_each_of_run(
        &mut self,
        mut each: impl FnMut(&Arrival) -> anyhow::Result<()>,
    ) -> anyhow::Result<u32> {
        self.walk(|item| match item {
            Ok(arrival) => each(&arrival),
            Err(fault) => {
                eprintln!("{fault}");
                Ok(())
            }
        })
    }

    /// Tells on standard error that there are other runs than the one that was read.
    pub fn tell_other_runs(&self, runs: u32) {
        if runs > 1 {
            eprintln!("run {} of {runs} was read; choose another with --run", self.run);
        }
    }

    /// Hands over the arrivals in their order, each with the intake that has just heard it, and what was measured. Gives the
    /// intake as it is at the end.
    ///
    /// # Errors
    /// As [`RawRun::for_each`].
    pub fn hear(
        &mut self,
        mut arrived: impl FnMut(&Arrival, &Intake),
        mut measured: impl FnMut(Received),
    ) -> anyhow::Result<Intake> {
        let mut intake = Intake::new(&self.config.intake());
        self.for_each(|arrival| {
            intake.handle(arrival);
            arrived(arrival, &intake);
            while let Some(taken) = intake.poll_output() {
                if let Intaken::Measured(received) = taken {
                    measured(received);
                }
            }
            Ok(())
        })?;
        Ok(intake)
    }

    /// Hands over the arrivals in their order, and between them what is wrong with the recording, that
    /// of its other runs included. Gives the number of runs.
    ///
    /// # Errors
    /// The first that `each` returns; or there is no such run.
    pub fn walk(
        &mut self,
        mut each: impl FnMut(Result<Arrival, RawFault>) -> anyhow::Result<()>,
    ) -> anyhow::Result<u32> {
        let mut run = 1;
        let mut begun = false;
        while let Some(item) = self.reader.next() {
            run += u32::from(matches!(item, Err(RawFault::NewRun { .. })));
            if item.is_ok() && run != self.run {
                continue;
            }
            if item.is_ok() && !begun {
                begun = true;
                self.header = self.reader.header().cloned();
            }
            each(item)?;
        }
        if run < self.run {
            return Err(BadInput(format!("there are {run} runs in this recording")).into());
        }
        Ok(run)
    }

    /// What the file says in which the run begins: the program and its configuration. `None` if every
    /// header up to there was damaged.
    #[must_use]
    pub fn header(&self) -> Option<&FileHeader> {
        self.header.as_ref()
    }

    /// What was read so far, of all runs.
    #[must_use]
    pub fn read(&self) -> RawRead {
        self.reader.counts()
    }
}
