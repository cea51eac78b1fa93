//! What ends the reading or writing of a recording.

use std::io;
use std::path::{Path, PathBuf};

use super::report::{BadRow, FileReport};

/// A recording that cannot be read or written. Every message names the file, and the line and
/// column where there is one, and says what was expected.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// A required file is not there.
    #[error("{}: no such file{}", .file.display(), if *.or_compressed { " (nor with .zst added)" } else { "" })]
    Missing {
        /// The file.
        file: PathBuf,
        /// Whether its compressed form was looked for, too.
        or_compressed: bool,
    },
    /// The directory of the voyage is not there, or is not a directory.
    #[error("{}: not a directory; expected a voyage with voyage.toml and imu.csv", .0.display())]
    NotADirectory(PathBuf),
    /// The operating system or the decompressor gave up.
    #[error("{}:{line}: cannot be read {}: {source}", .file.display(),
        if *.line == 0 { "from its beginning" } else { "beyond this line" })]
    Read {
        /// The file.
        file: PathBuf,
        /// Number of the last whole line, 0 before the first.
        line: u64,
        /// Why.
        source: io::Error,
    },
    /// The operating system gave up.
    #[error("{}: cannot be written: {source}", .file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A line longer than any row can be.
    #[error("{}:{line}: line longer than {limit} bytes; expected comma-separated rows", .file.display())]
    LineTooLong {
        /// The file.
        file: PathBuf,
        /// Number of the line.
        line: u64,
        /// The bound, bytes.
        limit: usize,
    },
    /// The first line is not text.
    #[error("{}:1:{column}: not UTF-8 text; expected the header {expected}", .file.display())]
    NotText {
        /// The file.
        file: PathBuf,
        /// First byte that is not text, counted from 1.
        column: usize,
        /// The header that was expected.
        expected: String,
    },
    /// Required columns are not in the header.
    #[error("{}:1: missing column{} {}; expected the header {expected}", .file.display(),
        if .missing.len() == 1 { "" } else { "s" }, .missing.join(", "))]
    MissingColumns {
        /// The file.
        file: PathBuf,
        /// Their names.
        missing: Vec<&'static str>,
        /// The header that was expected.
        expected: String,
    },
    /// A column is named twice.
    #[error("{}:1: column {column} is named twice", .file.display())]
    RepeatedColumn {
        /// The file.
        file: PathBuf,
        /// Its name.
        column: &'static str,
    },
    /// A field that no row may be left out for.
    #[error("{}:{bad}", .file.display())]
    BadField {
        /// The file.
        file: PathBuf,
        /// Line, column, and what was found.
        bad: Box<BadRow>,
    },
    /// There is no row that can be used.
    #[error("{}:{}: {}", .file.display(), .report.lines, no_rows(.report))]
    NoRows {
        /// The file.
        file: PathBuf,
        /// What was found instead.
        report: Box<FileReport>,
    },
    /// More than 100 rows and more than 10 % of the file are faulty.
    #[error("{}: {} of {} rows are faulty, more than 10 %{}", .file.display(), .report.faulty(),
        .report.rows, .report.examples_text())]
    TooManyBadRows {
        /// The file.
        file: PathBuf,
        /// How many and why.
        report: Box<FileReport>,
    },
    /// `voyage.toml` is not TOML.
    #[error("{}: {message}", .file.display())]
    Toml {
        /// The file.
        file: PathBuf,
        /// The parser's words with line, column and caret.
        message: String,
    },
    /// `voyage.toml` lacks keys or holds impossible values.
    #[error("{}: {} fault{}\n{}", .file.display(), .faults.len(),
        if .faults.len() == 1 { "" } else { "s" }, .faults.join("\n"))]
    Header {
        /// The file.
        file: PathBuf,
        /// Each with its place.
        faults: Vec<String>,
    },
}

impl RecordingError {
    /// The file, and the number of the line that is to blame, if it is one.
    #[must_use]
    pub fn place(&self) -> (&Path, Option<u64>) {
        match self {
            Self::NotADirectory(file)
            | Self::Missing { file, .. }
            | Self::Write { file, .. }
            | Self::TooManyBadRows { file, .. }
            | Self::Toml { file, .. }
            | Self::Header { file, .. } => (file, None),
            Self::Read { file, line, .. } | Self::LineTooLong { file, line, .. } => {
                (file, Some(*line))
            }
            Self::NotText { file, .. }
            | Self::MissingColumns { file, .. }
            | Self::RepeatedColumn { file, .. } => (file, Some(1)),
            Self::BadField { file, bad } => (file, Some(bad.line)),
            Self::NoRows { file, report } => (file, Some(report.lines)),
        }
    }
}

fn no_rows(report: &FileReport) -> String {
    if report.rows == 0 {
        "no rows; expected at least one after the header".to_owned()
    } else {
        format!("none of {} rows can be used{}", report.rows, report.examples_text())
    }
}
