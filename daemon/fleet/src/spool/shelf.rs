//! The records of one class: segments that are appended to, and how far they were acknowledged.

use std::collections::VecDeque;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::frame::{self, MAX_FRAME, MAX_TEXT};
use super::record::SpoolRecord;

/// Bytes that are read at a time; more than a frame.
const CHUNK: usize = 4 * MAX_FRAME;
/// Name of the file that tells how far was acknowledged.
const CURSOR: &str = "acknowledged";
/// End of the names of segments.
const SEGMENT: &str = ".spool";

/// A place on a shelf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct SpoolPlace {
    segment: u64,
    offset: u64,
    /// Records before it, since the shelf was opened.
    passed: u64,
}

#[derive(Debug)]
struct Segment {
    number: u64,
    bytes: u64,
    /// Records that were not acknowledged.
    waiting: u64,
}

/// The records of one class.
#[derive(Debug)]
pub(super) struct Shelf {
    folder: PathBuf,
    /// A segment holds so many bytes, and one record more.
    limit: u64,
    /// Oldest first.
    segments: VecDeque<Segment>,
    /// The last segment, while it is written.
    writer: Option<File>,
    next: u64,
    acknowledged: SpoolPlace,
    damaged: u64,
}

impl Shelf {
    pub(super) fn open(folder: &Path, limit: u64) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let mut numbers: Vec<u64> = Vec::new();
        for entry in fs::read_dir(folder)? {
            let name = entry?.file_name();
            let number =
                name.to_str().and_then(|name| name.strip_suffix(SEGMENT)?.parse::<u64>().ok());
            numbers.extend(number);
        }
        numbers.sort_unstable();
        let acknowledged = cursor(folder);
        let mut shelf = Shelf {
            folder: folder.to_owned(),
            limit,
            segments: VecDeque::new(),
            writer: None,
            // a segment of an earlier run is never written again: its end may be torn
            next: numbers.last().map_or(0, |last| last + 1).max(acknowledged.segment + 1),
            acknowledged,
            damaged: 0,
        };
        for number in numbers {
            shelf.take_over(number)?;
        }
        shelf.tidy()?;
        Ok(shelf)
    }

    /// Counts what waits in a segment of an earlier run.
    fn take_over(&mut self, number: u64) -> io::Result<()> {
        let bytes = fs::read(self.path(number))?;
        let from = match number.cmp(&self.acknowledged.segment) {
            std::cmp::Ordering::Less => bytes.len(),
            std::cmp::Ordering::Equal => usize::try_from(self.acknowledged.offset).unwrap_or(0),
            std::cmp::Ordering::Greater => 0,
        };
        let (mut rest, mut waiting) = (bytes.get(from..).unwrap_or_default(), 0);
        while let Some(found) = frame::next(rest) {
            self.damaged += found.skipped as u64;
            rest = rest.get(found.skipped + found.length..).unwrap_or_default();
            waiting += 1;
        }
        self.damaged += rest.len() as u64;
        self.segments.push_back(Segment { number, bytes: bytes.len() as u64, waiting });
        Ok(())
    }

    pub(super) fn append(&mut self, record: &SpoolRecord) -> io::Result<()> {
        if record.text.len() > MAX_TEXT {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "the record is too long"));
        }
        let bytes = frame::write(record);
        let is_full = self.segments.back().is_none_or(|last| last.bytes >= self.limit);
        if self.writer.is_none() || is_full {
            self.begin()?;
        }
        let written = self.writer.as_mut().map_or(Ok(()), |file| file.write_all(&bytes));
        if let Err(fault) = written {
            self.take_back();
            return Err(fault);
        }
        if let Some(last) = self.segments.back_mut() {
            last.bytes += bytes.len() as u64;
            last.waiting += 1;
        }
        Ok(())
    }

    fn begin(&mut self) -> io::Result<()> {
        self.sync()?;
        let number = self.next;
        let file = OpenOptions::new().append(true).create_new(true).open(self.path(number));
        let file = match file {
            Err(fault) if fault.kind() == io::ErrorKind::NotFound => {
                // somebody has removed the folder: it is made anew
                fs::create_dir_all(&self.folder)?;
                OpenOptions::new().append(true).create_new(true).open(self.path(number))?
            }
            other => other?,
        };
        self.next += 1;
        self.writer = Some(file);
        self.segments.push_back(Segment { number, bytes: 0, waiting: 0 });
        Ok(())
    }

    /// Takes back half a frame that a full disk has left behind the last segment. Where that cannot be done the next record
    /// begins another segment.
    fn take_back(&mut self) {
        let Some(last) = self.segments.back_mut() else { return };
        if self.writer.as_ref().is_some_and(|file| file.set_len(last.bytes).is_ok()) {
            return;
        }
        self.writer = None;
        let number = last.number;
        let length = fs::metadata(self.path(number)).map_or(0, |own| own.len());
        if let Some(last) = self.segments.back_mut() {
            last.bytes = length;
        }
    }

    /// The oldest records of one run that were not acknowledged, and where the next ones begin.
    pub(super) fn oldest(
        &mut self,
        (most, most_bytes): (usize, usize),
    ) -> io::Result<Option<(Vec<SpoolRecord>, SpoolPlace)>> {
        self.tidy()?;
        let from = self.acknowledged;
        for segment in &self.segments {
            let start = if segment.number == from.segment { from.offset } else { 0 };
            let chunk = read(&self.path(segment.number), start)?;
            let (mut records, mut offset, mut bytes) = (Vec::<SpoolRecord>::new(), 0, 0);
            while let Some(found) = frame::next(chunk.get(offset..).unwrap_or_default()) {
                let record = found.record;
                let is_other = records.first().is_some_and(|own| own.key.run != record.key.run);
                let is_much = !records.is_empty() && bytes + record.text.len() > most_bytes;
                if records.len() >= most || is_other || is_much {
                    break;
                }
                bytes += record.text.len();
                offset += found.skipped + found.length;
                records.push(record);
            }
            if !records.is_empty() {
                let end = SpoolPlace {
                    segment: segment.number,
                    offset: start + offset as u64,
                    passed: from.passed + records.len() as u64,
                };
                return Ok(Some((records, end)));
            }
        }
        Ok(None)
    }

    /// All records before a place are ashore.
    pub(super) fn acknowledge(&mut self, end: SpoolPlace) -> io::Result<()> {
        if end <= self.acknowledged {
            return Ok(());
        }
        let mut passed = end.passed.saturating_sub(self.acknowledged.passed);
        for segment in self.segments.iter_mut().take_while(|own| own.number <= end.segment) {
            if segment.number < end.segment {
                passed = passed.saturating_sub(segment.waiting);
                segment.waiting = 0;
            } else {
                segment.waiting = segment.waiting.saturating_sub(passed);
            }
        }
        self.acknowledged = end;
        let told = write_cursor(&self.folder, end);
        self.tidy()?;
        told
    }

    /// Removes the segments of which nothing waits, but for that which is written.
    fn tidy(&mut self) -> io::Result<()> {
        loop {
            let Some(first) = self.segments.front() else { return Ok(()) };
            let is_written = self.segments.len() == 1 && self.writer.is_some();
            if first.waiting > 0 || is_written && first.bytes < self.limit {
                return Ok(());
            }
            if is_written {
                self.writer = None;
            }
            self.remove_first()?;
        }
    }

    /// Removes the oldest segment, whatever it holds; tells how many records were lost with it.
    pub(super) fn drop_oldest(&mut self) -> io::Result<u64> {
        if self.segments.len() == 1 {
            self.writer = None;
        }
        self.remove_first()
    }

    fn remove_first(&mut self) -> io::Result<u64> {
        let Some(first) = self.segments.front() else { return Ok(0) };
        match fs::remove_file(self.path(first.number)) {
            Err(fault) if fault.kind() != io::ErrorKind::NotFound => Err(fault),
            _ => Ok(self.segments.pop_front().map_or(0, |first| first.waiting)),
        }
    }

    pub(super) fn sync(&mut self) -> io::Result<()> {
        self.writer.as_ref().map_or(Ok(()), File::sync_data)
    }

    pub(super) fn waiting(&self) -> u64 {
        self.segments.iter().map(|segment| segment.waiting).sum()
    }

    pub(super) fn bytes(&self) -> u64 {
        self.segments.iter().map(|segment| segment.bytes).sum()
    }

    pub(super) fn damaged(&self) -> u64 {
        self.damaged
    }

    fn path(&self, number: u64) -> PathBuf {
        self.folder.join(format!("{number:012}{SEGMENT}"))
    }
}

fn read(path: &Path, start: u64) -> io::Result<Vec<u8>> {
    let mut file = File::open(path)?;
    file.seek(SeekFrom::Start(start))?;
    let mut bytes = Vec::new();
    file.take(CHUNK as u64).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// How far was acknowledged; the very beginning if that is not known.
fn cursor(folder: &Path) -> SpoolPlace {
    let text = fs::read_to_string(folder.join(CURSOR)).unwrap_or_default();
    let mut words = text.split_whitespace().map(str::parse);
    match (words.next(), words.next(), words.next()) {
        (Some(Ok(segment)), Some(Ok(offset)), None) => SpoolPlace { segment, offset, passed: 0 },
        _ => SpoolPlace::default(),
    }
}

/// Written beside and renamed. It need not reach the disk: an older one sends records again, no more.
fn write_cursor(folder: &Path, place: SpoolPlace) -> io::Result<()> {
    let beside = folder.join("acknowledged.new");
    fs::write(&beside, format!("{} {}\n", place.segment, place.offset))?;
    fs::rename(beside, folder.join(CURSOR))
}
