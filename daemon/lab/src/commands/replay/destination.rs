//! Where the rows of a solution go: to a file, or to whoever asked.

use std::path::Path;

use anyhow::Context;
use insd_base::{Counts, SatelliteId, SatelliteInnovation, Solution, Time};
use insd_config::OutputFile;
use insd_drivers::raw::RawRead;
use insd_drivers::recording::{FileReport, NavRow, NavTelling, NavWriter, Rows};

use super::sums::{Summed, Summing};

/// What a replay comes to in memory.
#[derive(Debug)]
pub struct Replayed {
    /// The rows of the solution, those of `nav.csv`.
    pub rows: Rows<NavRow>,
    /// What was used, rejected, bridged and skipped, in words.
    pub summary: String,
    /// The same as counts and sums, where they were asked for.
    pub(in crate::commands) summed: Option<Summed>,
}

/// Where the rows of a solution go.
pub(in crate::commands) enum Destination {
    /// To a `nav.csv`; words go to standard error.
    File(NavWriter<OutputFile>),
    /// Into memory, and the words beside them.
    Memory(Box<Kept>),
}

/// Rows that are kept.
#[derive(Default)]
pub(in crate::commands) struct Kept {
    rows: Vec<NavRow>,
    telling: NavTelling,
    summary: String,
    /// Where the replay is summed up.
    summing: Option<Summing>,
    /// Whether rows are summed up only.
    is_sparing: bool,
}

impl Kept {
    fn take(&mut self, solution: &Solution) {
        let Some(row) = self.telling.row(solution) else { return };
        if let Some(summing) = &mut self.summing {
            summing.take(&row);
        }
        if !self.is_sparing {
            self.rows.push(row);
        }
    }
}

impl Destination {
    pub(super) fn file(path: &Path) -> anyhow::Result<Self> {
        let file = NavWriter::new(OutputFile::create(path)?);
        file.context("cannot write the solution").map(Self::File)
    }

    pub(super) fn memory() -> Self {
        Self::Memory(Box::default())
    }

    /// Sums, and rows as well if they are kept.
    pub(super) fn summing(summing: Summing, keeps_rows: bool) -> Self {
        let summing = Some(summing);
        Self::Memory(Box::new(Kept { summing, is_sparing: !keeps_rows, ..Kept::default() }))
    }

    fn sums(&mut self) -> Option<&mut Summing> {
        match self {
            Self::File(_) => None,
            Self::Memory(kept) => kept.summing.as_mut(),
        }
    }

    /// A message was received.
    pub(super) fn hear(&mut self, at: Time) {
        if let Some(summing) = self.sums() {
            summing.hear(at);
        }
    }

    /// A raw recording was read, with so many runs, of a program. Gives whether that is summed up.
    pub(super) fn read(&mut self, read: RawRead, runs: u32, program: Option<&String>) -> bool {
        let summing = self.sums();
        let is_summing = summing.is_some();
        if let Some(summing) = summing {
            summing.read(read, runs, program);
        }
        is_summing
    }

    /// The replay is over: what the engine counted, and what the files lacked.
    pub(super) fn end(&mut self, counts: &Counts, files: &[&FileReport]) {
        let left_out = self.left_out();
        if let Some(summing) = self.sums() {
            summing.end(counts, left_out, files);
        }
    }

    pub(in crate::commands) fn write(&mut self, solution: &Solution) -> std::io::Result<()> {
        match self {
            Self::File(nav) => nav.write(solution)?,
            Self::Memory(kept) => kept.take(solution),
        }
        Ok(())
    }

    pub(super) fn hear_satellite(&mut self, told: &SatelliteInnovation) {
        match self {
            Self::File(nav) => nav.hear_satellite(told),
            Self::Memory(kept) => kept.telling.hear_satellite(told),
        }
    }

    pub(super) fn leave_out(&mut self, satellite: SatelliteId, is_excluded: bool) {
        match self {
            Self::File(nav) => nav.leave_out(satellite, is_excluded),
            Self::Memory(kept) => kept.telling.leave_out(satellite, is_excluded),
        }
    }

    /// Solutions that were left out because they were not finite.
    pub(super) fn left_out(&self) -> u64 {
        match self {
            Self::File(nav) => nav.left_out(),
            Self::Memory(kept) => kept.telling.left_out(),
        }
    }

    /// Says what became of the recording.
    pub(super) fn say(&mut self, summary: String) {
        match self {
            Self::File(_) => eprint!("{summary}"),
            Self::Memory(kept) => kept.summary = summary,
        }
    }

    /// Moves the file to its place, or hands over what was kept.
    pub(super) fn finish(self) -> anyhow::Result<Replayed> {
        match self {
            Self::File(nav) => {
                nav.finish().context("cannot write the solution")?.finish()?;
                Ok(Replayed { rows: Rows::told(Vec::new()), summary: String::new(), summed: None })
            }
            Self::Memory(kept) => {
                let summed = kept.summing.map(Summing::finish);
                Ok(Replayed { rows: Rows::told(kept.rows), summary: kept.summary, summed })
            }
        }
    }
}
