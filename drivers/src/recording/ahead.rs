//! A file of rows of which the next one is known before it is taken.

use std::path::Path;

use insd_base::Time;

use super::error::RecordingError;
use super::input;
use super::report::FileReport;
use super::table::{Row, Table};

/// A file, and its next row.
pub(super) struct Ahead<T> {
    table: Table<T>,
    next: Option<T>,
}

impl<T: Row> Ahead<T> {
    /// Opens a file of a voyage, plain or compressed; `None` where there is none.
    pub(super) fn open(dir: &Path, name: &str) -> Result<Option<Self>, RecordingError> {
        let Some(path) = input::find(dir, name) else { return Ok(None) };
        let mut ahead = Ahead { table: Table::open(&path)?, next: None };
        ahead.take()?;
        Ok(Some(ahead))
    }

    /// Time of the next row.
    pub(super) fn time(&self) -> Option<Time> {
        self.next.as_ref().map(Row::time)
    }

    /// The next row.
    pub(super) fn take(&mut self) -> Result<Option<T>, RecordingError> {
        let next = self.table.next_row()?.map(|(row, _)| row);
        Ok(std::mem::replace(&mut self.next, next))
    }

    /// What was read and skipped so far.
    pub(super) fn report(&self) -> &FileReport {
        self.table.report()
    }
}
