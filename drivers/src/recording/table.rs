//! A CSV file as a sequence of typed rows, with its faulty rows counted.

use std::io::Read;
use std::marker::PhantomData;
use std::ops::Range;
use std::path::{Path, PathBuf};

use insd_base::Time;

use super::error::RecordingError;
use super::fields::{Columns, Fields, cut};
use super::input;
use super::lines::{LineFault, Lines, MAX_LINE};
use super::report::{BadRow, FileReport, RowFault};

/// When a row reached the computer, s: every sensor's last column.
pub(super) const ARRIVAL: &str = "arrival_s";

/// A row of one of the files of the format.
pub(super) trait Row: Sized {
    /// Its columns in the order in which [`Row::parse`] counts them.
    const COLUMNS: &'static [&'static str];
    /// Those that a header need not name: of a group all or none, as one that names some of it is misspelt.
    const OPTIONAL: &'static [&'static [&'static str]];

    /// Takes the row from its fields.
    fn parse(fields: &Fields<'_>) -> Result<Self, BadRow>;

    /// Time of validity.
    fn time(&self) -> Time;

    /// Whether a fault of a row ends the reading, where others cost the row alone.
    fn is_fatal(_: &BadRow) -> bool {
        false
    }
}

/// A file of rows of one kind.
pub(super) struct Table<T> {
    path: PathBuf,
    lines: Lines<Box<dyn Read + Send>>,
    columns: Columns,
    cuts: Vec<Range<usize>>,
    report: FileReport,
    rows: PhantomData<fn() -> T>,
}

impl<T: Row> Table<T> {
    /// Opens a file and reads its header.
    pub(super) fn open(path: &Path) -> Result<Self, RecordingError> {
        let mut lines = Lines::new(input::open(path)?);
        let header = match lines.next_line() {
            Ok(line) => line.unwrap_or_default(),
            Err(fault) => return Err(line_fault(path, 0, fault)),
        };
        let columns = find_columns::<T>(path, header)?;
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        let absent = columns.absent().filter(|column| *column != ARRIVAL).collect();
        let report = FileReport { file: name, lines: 1, absent, ..FileReport::default() };
        let (path, cuts) = (path.to_owned(), Vec::with_capacity(columns.width));
        Ok(Table { path, lines, columns, cuts, report, rows: PhantomData })
    }

    /// The next good row with the number of its line; `None` at the end of the file.
    pub(super) fn next_row(&mut self) -> Result<Option<(T, u64)>, RecordingError> {
        loop {
            let number = self.lines.number() + 1;
            let line = match self.lines.next_line() {
                Ok(Some(line)) => line,
                Ok(None) => return self.judge().map(|()| None),
                Err(fault) => return Err(line_fault(&self.path, number - 1, fault)),
            };
            self.report.lines = number;
            if line.trim_ascii().is_empty() {
                continue;
            }
            self.report.rows += 1;
            cut(line, &mut self.cuts);
            let fields = Fields { columns: &self.columns, line, number, cuts: &self.cuts };
            match parse::<T>(&fields) {
                Ok(row) => return Ok(Some((row, number))),
                Err(bad) if T::is_fatal(&bad) => {
                    let file = self.path.clone();
                    return Err(RecordingError::BadField { file, bad: Box::new(bad) });
                }
                Err(bad) => self.report.record(bad),
            }
        }
    }

    /// Counts a fault that only its neighbours show: the time of a row.
    pub(super) fn record_time_fault(&mut self, line: u64, time: Time, fault: RowFault) {
        let found = time.as_seconds().to_string();
        self.report.record(BadRow::new(line, T::COLUMNS[0], fault, found.as_bytes()));
    }

    pub(super) fn report(&self) -> &FileReport {
        &self.report
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The columns of the format that the file has.
    pub(super) fn columns(&self) -> Vec<&'static str> {
        self.columns.present().collect()
    }

    /// An error if the whole file turned out to be bad.
    fn judge(&self) -> Result<(), RecordingError> {
        let hopeless = self.report.is_hopeless();
        let fault = || RecordingError::TooManyBadRows {
            file: self.path.clone(),
            report: Box::new(self.report.clone()),
        };
        if hopeless { Err(fault()) } else { Ok(()) }
    }
}

fn parse<T: Row>(fields: &Fields<'_>) -> Result<T, BadRow> {
    let fault = match fields.cuts.len() {
        count if count < fields.columns.width => RowFault::TooFewFields,
        count if count > fields.columns.width => RowFault::TooManyFields,
        _ => return T::parse(fields),
    };
    let counts = format!("{} instead of {}", fields.cuts.len(), fields.columns.width);
    Err(BadRow::new(fields.number, "", fault, counts.as_bytes()))
}

fn line_fault(path: &Path, last: u64, fault: LineFault) -> RecordingError {
    let file = path.to_owned();
    match fault {
        LineFault::TooLong => RecordingError::LineTooLong { file, line: last + 1, limit: MAX_LINE },
        LineFault::Io(source) => RecordingError::Read { file, line: last, source },
    }
}

/// Finds the columns of a row in a header, in any order.
fn find_columns<T: Row>(path: &Path, header: &[u8]) -> Result<Columns, RecordingError> {
    let format: Vec<_> = T::COLUMNS.iter().copied().filter(|column| *column != ARRIVAL).collect();
    let expected = || format.join(",");
    let header = header.strip_prefix(b"\xef\xbb\xbf").unwrap_or(header);
    let bad_byte = match std::str::from_utf8(header) {
        Ok(text) => text.find('\0'),
        Err(fault) => Some(fault.valid_up_to()),
    };
    let file = path.to_owned();
    if let Some(byte) = bad_byte {
        return Err(RecordingError::NotText { file, column: byte + 1, expected: expected() });
    }
    let words: Vec<&[u8]> = header.split(|byte| *byte == b',').map(unquote).collect();
    let place = |name: &&str| words.iter().position(|word| *word == name.as_bytes());
    let places: Vec<Option<usize>> = T::COLUMNS.iter().map(place).collect();
    let columns = Columns { names: T::COLUMNS, places, width: words.len() };
    let may_be_absent = |column: &&str| {
        let group = T::OPTIONAL.iter().find(|group| group.contains(column));
        group.is_some_and(|group| group.iter().all(|other| columns.absent().any(|it| it == *other)))
    };
    let missing: Vec<_> = columns.absent().filter(|column| !may_be_absent(column)).collect();
    if !missing.is_empty() {
        return Err(RecordingError::MissingColumns { file, missing, expected: expected() });
    }
    let repeated = |name: &&str| words.iter().filter(|w| **w == name.as_bytes()).count() > 1;
    if let Some(column) = T::COLUMNS.iter().copied().find(repeated) {
        return Err(RecordingError::RepeatedColumn { file, column });
    }
    Ok(columns)
}

/// A column's name without blanks or the quotes that spreadsheets put around it.
fn unquote(word: &[u8]) -> &[u8] {
    let word = word.trim_ascii();
    word.strip_prefix(b"\"").and_then(|word| word.strip_suffix(b"\"")).unwrap_or(word)
}
