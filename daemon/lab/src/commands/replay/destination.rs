//! Where the rows of a solution go: to a file, or to whoever asked.

use std::path::Path;

use anyhow::Context;
use insd_base::{SatelliteId, SatelliteInnovation, Solution};
use insd_config::OutputFile;
use insd_drivers::recording::{NavRow, NavTelling, NavWriter, Rows};

/// What a replay comes to in memory.
#[derive(Debug)]
pub struct Replayed {
    /// The rows of the solution, those of `nav.csv`.
    pub rows: Rows<NavRow>,
    /// What was used, rejected, bridged and skipped, in words.
    pub summary: String,
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
}

impl Destination {
    pub(super) fn file(path: &Path) -> anyhow::Result<Self> {
        let file = NavWriter::new(OutputFile::create(path)?);
        file.context("cannot write the solution").map(Self::File)
    }

    pub(super) fn memory() -> Self {
        Self::Memory(Box::default())
    }

    pub(in crate::commands) fn write(&mut self, solution: &Solution) -> std::io::Result<()> {
        match self {
            Self::File(nav) => nav.write(solution)?,
            Self::Memory(kept) => kept.rows.extend(kept.telling.row(solution)),
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
                Ok(Replayed { rows: Rows::told(Vec::new()), summary: String::new() })
            }
            Self::Memory(kept) => {
                Ok(Replayed { rows: Rows::told(kept.rows), summary: kept.summary })
            }
        }
    }
}
