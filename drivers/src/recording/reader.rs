//! A voyage directory as a stream of messages in order of receipt.

use std::path::Path;

use insd_base::{
    ExternalReference, GnssFix, ImuSample, LogVelocity, Message, Received, Source, Stamped, Time,
    Truth, VoyageHeader,
};

use super::error::RecordingError;
use super::header::read_header;
use super::input;
use super::report::FileReport;
use super::stream::Stream;
use super::table::{Row, Table};

/// Reads a voyage directory in constant memory: an iterator over its messages in order of receipt;
/// at equal times IMU, GNSS, log, reference, and in order of lines. Times of receipt never go back.
///
/// Ends after the first error.
pub struct VoyageReader {
    header: VoyageHeader,
    imu: Stream<ImuSample>,
    gnss: Option<Stream<GnssFix>>,
    log: Option<Stream<LogVelocity>>,
    reference: Option<Stream<ExternalReference>>,
    last_receipt: Option<Time>,
    is_finished: bool,
}

impl VoyageReader {
    /// Opens a voyage directory and reads `voyage.toml` and the headers of all files.
    ///
    /// # Errors
    /// A required file is missing, or a header is wrong.
    pub fn open(dir: &Path) -> Result<Self, RecordingError> {
        if !dir.is_dir() {
            return Err(RecordingError::NotADirectory(dir.to_owned()));
        }
        let header = read_header(dir)?;
        let missing = || RecordingError::Missing { file: dir.join("imu.csv"), or_compressed: true };
        Ok(VoyageReader {
            header,
            imu: open_sensor(dir, "imu.csv")?.ok_or_else(missing)?,
            gnss: open_sensor(dir, "gnss.csv")?,
            log: open_sensor(dir, "log.csv")?,
            reference: open_sensor(dir, "reference.csv")?,
            last_receipt: None,
            is_finished: false,
        })
    }

    /// What `voyage.toml` says.
    #[must_use]
    pub fn header(&self) -> &VoyageHeader {
        &self.header
    }

    /// What was read and what was skipped so far, one report for each file that is there.
    #[must_use]
    pub fn skipped(&self) -> Vec<&FileReport> {
        let gnss = self.gnss.as_ref().map(Stream::report);
        let log = self.log.as_ref().map(Stream::report);
        let reference = self.reference.as_ref().map(Stream::report);
        [Some(self.imu.report()), gnss, log, reference].into_iter().flatten().collect()
    }

    /// The message received first among those that are left.
    fn next_received(&mut self) -> Result<Option<Received>, RecordingError> {
        let heads = [
            self.imu.peek()?,
            peek(&mut self.gnss)?,
            peek(&mut self.log)?,
            peek(&mut self.reference)?,
        ];
        if heads[0].is_none() && self.last_receipt.is_none() {
            self.check_imu()?;
        }
        let mut first: Option<(Time, usize)> = None;
        for (sensor, head) in heads.iter().enumerate() {
            if let Some(receipt) = head
                && first.is_none_or(|(earliest, _)| *receipt < earliest)
            {
                first = Some((*receipt, sensor));
            }
        }
        Ok(first.and_then(|(receipt, sensor)| self.take(sensor, receipt)))
    }

    fn take(&mut self, sensor: usize, receipt: Time) -> Option<Received> {
        let (source, message) = match sensor {
            0 => (Source::Imu(0), self.imu.pop().map(Message::Imu)),
            1 => (Source::Gnss(0), pop(&mut self.gnss).map(Message::Gnss)),
            2 => (Source::Log(0), pop(&mut self.log).map(Message::Log)),
            _ => (Source::Reference(0), pop(&mut self.reference).map(Message::Reference)),
        };
        let receipt = self.last_receipt.map_or(receipt, |last| last.max(receipt));
        self.last_receipt = Some(receipt);
        message.map(|message| Received { receipt, source, message })
    }

    /// Without a single IMU sample there is nothing to navigate with.
    fn check_imu(&self) -> Result<(), RecordingError> {
        let (file, report) = (self.imu.path().to_owned(), Box::new(self.imu.report().clone()));
        Err(RecordingError::NoRows { file, report })
    }
}

impl Iterator for VoyageReader {
    type Item = Result<Received, RecordingError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.is_finished {
            return None;
        }
        let next = self.next_received().transpose();
        self.is_finished = !matches!(next, Some(Ok(_)));
        next
    }
}

/// The good rows of a file, and what was skipped.
#[derive(Clone, Debug)]
pub struct Rows<T> {
    /// Good rows in the order of the file.
    pub rows: Vec<T>,
    /// What was read and skipped.
    pub report: FileReport,
    /// Columns of the format that the file has, in the order of the format.
    pub columns: Vec<&'static str>,
}

impl<T> Rows<T> {
    /// Whether the file has a column.
    #[must_use]
    pub fn has(&self, column: &str) -> bool {
        self.columns.contains(&column)
    }
}

/// Reads a `truth.csv`, plain or compressed, with the count of its faulty rows.
///
/// # Errors
/// The file is missing, its header is wrong, or it has no or too many faulty rows.
pub fn read_truth_rows(path: &Path) -> Result<Rows<Truth>, RecordingError> {
    read_all(path)
}

/// Reads a `truth.csv`, plain or compressed.
///
/// # Errors
/// As [`read_truth_rows`].
pub fn read_truth(path: &Path) -> Result<Vec<Truth>, RecordingError> {
    read_all(path).map(|all| all.rows)
}

/// All good rows of a file.
pub(super) fn read_all<T: Row>(path: &Path) -> Result<Rows<T>, RecordingError> {
    let mut table = Table::open(&input::find_path(path)?)?;
    let mut rows = Vec::new();
    while let Some((row, _)) = table.next_row()? {
        rows.push(row);
    }
    let report = table.report().clone();
    if rows.is_empty() {
        let (file, report) = (table.path().to_owned(), Box::new(report));
        return Err(RecordingError::NoRows { file, report });
    }
    Ok(Rows { rows, report, columns: table.columns() })
}

fn open_sensor<T: Copy>(dir: &Path, name: &str) -> Result<Option<Stream<T>>, RecordingError>
where
    Stamped<T>: Row,
{
    input::find(dir, name).map(|path| Ok(Stream::new(Table::open(&path)?))).transpose()
}

fn peek<T: Copy>(stream: &mut Option<Stream<T>>) -> Result<Option<Time>, RecordingError>
where
    Stamped<T>: Row,
{
    stream.as_mut().map_or(Ok(None), Stream::peek)
}

fn pop<T: Copy>(stream: &mut Option<Stream<T>>) -> Option<T>
where
    Stamped<T>: Row,
{
    stream.as_mut().and_then(Stream::pop)
}
