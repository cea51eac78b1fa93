//! What was skipped on the way through a file, and why.

use std::collections::BTreeMap;
use std::fmt;

/// How many faulty rows are kept as examples.
const EXAMPLES: usize = 5;
/// A file with at most this many faulty rows is read to its end.
const TOLERATED_ROWS: u64 = 100;
/// One in so many rows may be faulty beyond that.
const TOLERATED_SHARE: u64 = 10;
/// Longest piece of a faulty field that is quoted, characters.
const QUOTED: usize = 24;

/// Why a row was not used as it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RowFault {
    /// A field that must be a number is something else.
    NotANumber,
    /// A field is NaN or infinite.
    NotFinite,
    /// A field that must be there is empty.
    Empty,
    /// A field is outside its physical range.
    OutOfRange,
    /// A word that the format does not know.
    UnknownWord,
    /// Fewer fields than the header, as in a truncated last line.
    TooFewFields,
    /// More fields than the header.
    TooManyFields,
    /// `t_s` leaps forward for this row alone.
    TimeLeap,
    /// `t_s` is before that of an earlier row. Such rows are passed on.
    Unsorted,
}

impl RowFault {
    /// A short name for tables: `not_a_number`, `too_few_fields`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            RowFault::NotANumber => "not_a_number",
            RowFault::NotFinite => "not_finite",
            RowFault::Empty => "empty",
            RowFault::OutOfRange => "out_of_range",
            RowFault::UnknownWord => "unknown_word",
            RowFault::TooFewFields => "too_few_fields",
            RowFault::TooManyFields => "too_many_fields",
            RowFault::TimeLeap => "time_leap",
            RowFault::Unsorted => "unsorted",
        }
    }
}

/// One faulty row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadRow {
    /// Number of the line, counted from 1 at the header.
    pub line: u64,
    /// Name of the column, empty when the whole row is at fault.
    pub column: &'static str,
    /// Why.
    pub fault: RowFault,
    /// What was found, shortened.
    pub found: String,
}

impl BadRow {
    pub(super) fn new(line: u64, column: &'static str, fault: RowFault, found: &[u8]) -> Self {
        let text = String::from_utf8_lossy(&found[..found.len().min(4 * QUOTED)]);
        let found = text.chars().take(QUOTED).flat_map(char::escape_default).collect();
        BadRow { line, column, fault, found }
    }
}

impl fmt::Display for BadRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.line)?;
        if !self.column.is_empty() {
            write!(f, "{}:", self.column)?;
        }
        let found = &self.found;
        match self.fault {
            RowFault::NotANumber => write!(f, " expected a number, found \"{found}\""),
            RowFault::NotFinite => write!(f, " expected a finite number, found \"{found}\""),
            RowFault::Empty => write!(f, " expected a value, found an empty field"),
            RowFault::OutOfRange => write!(f, " {found} is out of range"),
            RowFault::UnknownWord => write!(f, " unknown word \"{found}\""),
            RowFault::TooFewFields => write!(f, " fewer fields than the header: {found}"),
            RowFault::TooManyFields => write!(f, " more fields than the header: {found}"),
            RowFault::TimeLeap => write!(f, " time leaps to {found} s for one row"),
            RowFault::Unsorted => write!(f, " time goes back to {found} s; expected time order"),
        }
    }
}

/// The rows of one file: how many there were, how many were skipped and why.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct FileReport {
    /// Name of the file in the voyage directory, or its path.
    pub file: String,
    /// Lines read so far, the header included.
    pub lines: u64,
    /// Rows read so far, faulty ones included.
    pub rows: u64,
    /// Columns of the format that it does not have, and need not: nobody tells what they would.
    pub absent: Vec<&'static str>,
    /// Rows left out, by reason.
    pub skipped: BTreeMap<RowFault, u64>,
    /// Rows whose time goes back: passed on, for the engine to judge, but faults of the file.
    pub unsorted: u64,
    /// The first few faulty rows.
    pub examples: Vec<BadRow>,
}

impl FileReport {
    /// Rows left out, for whatever reason.
    #[must_use]
    pub fn skipped_total(&self) -> u64 {
        self.skipped.values().sum()
    }

    /// Rows with any fault, left out or passed on.
    #[must_use]
    pub fn faulty(&self) -> u64 {
        self.skipped_total() + self.unsorted
    }

    pub(super) fn record(&mut self, row: BadRow) {
        if row.fault == RowFault::Unsorted {
            self.unsorted += 1;
        } else {
            *self.skipped.entry(row.fault).or_default() += 1;
        }
        if self.examples.len() < EXAMPLES {
            self.examples.push(row);
        }
    }

    pub(super) fn is_hopeless(&self) -> bool {
        self.faulty() > TOLERATED_ROWS && self.faulty() * TOLERATED_SHARE > self.rows
    }

    pub(super) fn examples_text(&self) -> String {
        let lines = self.examples.iter().map(|row| format!("\n  {}:{row}", self.file));
        lines.collect()
    }
}
