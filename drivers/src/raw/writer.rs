//! Writes a recording.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use insd_base::{Arrival, Input, PortState, Sent, Span, Stamp, Time};

use super::block::{LONGEST_PAYLOAD, Open};
use super::disk::{Disk, LocalDisk, Output};
use super::error::RawWriteError;
use super::header::FileHeader;
use super::names::{Member, is_name, members, path_of};

/// A block is written when its first record is so old: what a power cut may cost.
pub const FLUSH_EVERY: Span = Span::from_nanos(1_000_000_000);

/// How a recording is cut into files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordingConfig {
    /// Name of the series; its files are `NAME-000001.insdraw` and so on.
    pub name: String,
    /// No file grows beyond so many bytes, unless a single block does.
    pub rotate_bytes: u64,
    /// No file takes arrivals of a longer time than this, by the monotonic clock.
    pub rotate_span: Span,
    /// All files of the series together, bytes: beyond that the oldest are deleted, never the one
    /// that is being written. `None`: no limit.
    pub quota_bytes: Option<u64>,
}

/// What every file of a recording says of the program.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct RawHeader {
    /// Name and version of the program.
    pub program: String,
    /// The configuration with which it runs, as text.
    pub config: String,
}

/// Writes a recording. Nothing is lost from it silently: what could not be written, or was not
/// offered in time, stands in it as a gap with a count.
///
/// After an error it can be used like before: each later write tries the disk again, with a new file.
#[derive(Debug)]
pub struct RawWriter {
    folder: PathBuf,
    config: RecordingConfig,
    header: RawHeader,
    disk: Box<dyn Disk>,
    block: Open,
    /// Arrivals to be told as a gap before the next.
    gap: u64,
    last: Option<Stamp>,
    current: Option<Current>,
    /// Number of the last file that was made.
    serial: u32,
    /// Number of the first file of this run.
    run: Option<u32>,
    /// Older files of the series, the oldest first.
    older: Vec<Member>,
    counts: RawWritten,
    unremoved: Option<Arc<RawWriteError>>,
}

/// What a writer has done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RawWritten {
    /// Arrivals on the disk.
    pub arrivals: u64,
    /// Records on the disk: arrivals and gaps.
    pub records: u64,
    /// Arrivals that are not in the recording.
    pub dropped: u64,
    /// Bytes on the disk, headers included, deleted files too.
    pub bytes: u64,
    /// Files made.
    pub files: u32,
}

/// The file that is being written.
#[derive(Debug)]
struct Current {
    path: PathBuf,
    output: Box<dyn Output>,
    length: u64,
    /// When its first record was made.
    since: Time,
}

impl RawWriter {
    /// A writer into a folder. The folder and the first file are made when there is something to
    /// write; numbers go on after those of the files that are there.
    ///
    /// # Errors
    /// [`RawWriteError::Name`] or [`RawWriteError::Header`]; the disk is not touched yet.
    pub fn create(
        folder: &Path,
        config: RecordingConfig,
        header: RawHeader,
    ) -> Result<Self, RawWriteError> {
        Self::on_disk(Box::new(LocalDisk), folder, config, header)
    }

    pub(crate) fn on_disk(
        disk: Box<dyn Disk>,
        folder: &Path,
        config: RecordingConfig,
        header: RawHeader,
    ) -> Result<Self, RawWriteError> {
        if !is_name(&config.name) {
            return Err(RawWriteError::Name(config.name));
        }
        if !FileHeader::fits(&header.program, &header.config) {
            return Err(RawWriteError::Header {
                bytes: header.program.len() + header.config.len(),
            });
        }
        Ok(RawWriter {
            folder: folder.to_owned(),
            config,
            header,
            disk,
            block: Open::default(),
            gap: 0,
            last: None,
            current: None,
            serial: 0,
            run: None,
            older: Vec::new(),
            counts: RawWritten::default(),
            unremoved: None,
        })
    }

    /// Takes an arrival; writes when a block is full or a second old.
    ///
    /// # Errors
    /// The arrival is too long, or the disk failed: then all arrivals of the block are lost and
    /// counted.
    pub fn record(&mut self, arrival: &Arrival) -> Result<(), RawWriteError> {
        self.last = Some(arrival.stamp);
        let bytes = payload(&arrival.input);
        if bytes > LONGEST_PAYLOAD {
            self.drop_arrivals(1);
            return Err(RawWriteError::TooLong { bytes });
        }
        // an old block is closed first, so that no arrival waits for the one after it
        let written = self.tick(arrival.stamp.monotonic);
        self.push_gap(arrival.stamp);
        self.block.push(arrival);
        written?;
        if self.block.is_full() { self.flush() } else { Ok(()) }
    }

    /// Counts arrivals that are not offered. A gap stands for them before the next arrival.
    pub fn drop_arrivals(&mut self, count: u64) {
        self.gap = self.gap.saturating_add(count);
        self.counts.dropped = self.counts.dropped.saturating_add(count);
    }

    /// Whether arrivals have waited for a second.
    #[must_use]
    pub fn flush_due(&self, now: Time) -> bool {
        self.block.first().is_some_and(|first| now - first.monotonic >= FLUSH_EVERY)
    }

    /// Writes if [`RawWriter::flush_due`]. To be called when nothing has arrived for a while.
    ///
    /// # Errors
    /// The disk failed.
    pub fn tick(&mut self, now: Time) -> Result<(), RawWriteError> {
        if self.flush_due(now) { self.flush() } else { Ok(()) }
    }

    /// Writes what is waiting; it is on the disk when this returns.
    ///
    /// # Errors
    /// The disk failed; what was waiting is lost and counted.
    pub fn flush(&mut self) -> Result<(), RawWriteError> {
        if let Some(last) = self.last {
            self.push_gap(last);
        }
        let block = std::mem::take(&mut self.block);
        let Some(first) = block.first() else { return Ok(()) };
        let written = self.write(&block.seal(self.counts.records), first);
        match written {
            Ok(()) => {
                self.counts.records += u64::from(block.records());
                self.counts.arrivals += block.arrivals();
            }
            Err(_) => {
                self.gap = self.gap.saturating_add(block.stands_for());
                self.counts.dropped = self.counts.dropped.saturating_add(block.arrivals());
            }
        }
        written
    }

    /// What has been written.
    #[must_use]
    pub fn written(&self) -> RawWritten {
        self.counts
    }

    /// Why the oldest file, which is beyond the quota, is still there.
    #[must_use]
    pub fn unremoved(&self) -> Option<Arc<RawWriteError>> {
        self.unremoved.clone()
    }

    fn push_gap(&mut self, at: Stamp) {
        if self.gap > 0 {
            self.block.push_gap(std::mem::take(&mut self.gap), at);
        }
    }

    fn write(&mut self, block: &[u8], first: Stamp) -> Result<(), RawWriteError> {
        let length = block.len() as u64;
        let full = |current: &Current| {
            current.length + length > self.config.rotate_bytes
                || first.monotonic - current.since > self.config.rotate_span
        };
        let open = self.current.take().filter(|own| !full(own) && own.output.is_there());
        let current = match open {
            Some(current) => self.append(current, block)?,
            None => self.new_file(first, block)?,
        };
        let in_use = current.length;
        self.current = Some(current);
        self.remove_oldest(in_use);
        Ok(())
    }

    fn append(&mut self, mut current: Current, block: &[u8]) -> Result<Current, RawWriteError> {
        if let Err(fault) = current.output.append(block) {
            // what can not be cut off the reader tells as damage; the next write makes a new file
            let _ = current.output.cut(current.length);
            return Err(RawWriteError::disk(&current.path, fault));
        }
        current.length += block.len() as u64;
        self.counts.bytes += block.len() as u64;
        Ok(current)
    }

    /// Makes a file with a header and a block, or none.
    fn new_file(&mut self, first: Stamp, block: &[u8]) -> Result<Current, RawWriteError> {
        if self.run.is_some() && !self.folder.is_dir() {
            return Err(RawWriteError::Gone { folder: self.folder.clone() });
        }
        self.older = self.members()?;
        let newest = self.older.last().map_or(0, |member| member.serial);
        let serial = newest.max(self.serial).saturating_add(1);
        let path = path_of(&self.folder, &self.config.name, serial);
        let header = FileHeader {
            serial,
            run: self.run.unwrap_or(serial),
            first,
            program: self.header.program.clone(),
            config: self.header.config.clone(),
        };
        let bytes = [header.write().as_slice(), block].concat();
        let mut output =
            self.disk.create(&path).map_err(|fault| RawWriteError::disk(&path, fault))?;
        if let Err(fault) = output.append(&bytes) {
            // if it stays it has its number, and the next file another
            let _ = self.disk.remove(&path);
            return Err(RawWriteError::disk(&path, fault));
        }
        self.serial = serial;
        self.run = Some(header.run);
        self.counts.files += 1;
        self.counts.bytes += bytes.len() as u64;
        Ok(Current { path, output, length: bytes.len() as u64, since: first.monotonic })
    }

    fn members(&self) -> Result<Vec<Member>, RawWriteError> {
        match members(&self.folder) {
            Ok(all) => {
                Ok(all.into_iter().filter(|member| member.name == self.config.name).collect())
            }
            Err(fault) if fault.kind() == std::io::ErrorKind::NotFound => Ok(Vec::new()),
            Err(fault) => Err(RawWriteError::disk(&self.folder, fault)),
        }
    }

    /// Deletes the oldest files until the rest is within the quota.
    fn remove_oldest(&mut self, current: u64) {
        let Some(quota) = self.config.quota_bytes else { return };
        let mut total = current + self.older.iter().map(|member| member.length).sum::<u64>();
        let mut removed = 0;
        self.unremoved = None;
        for oldest in &self.older {
            if total <= quota {
                break;
            }
            match self.disk.remove(&oldest.path) {
                Err(fault) if fault.kind() != std::io::ErrorKind::NotFound => {
                    self.unremoved = Some(Arc::new(RawWriteError::disk(&oldest.path, fault)));
                    break;
                }
                _ => total -= oldest.length,
            }
            removed += 1;
        }
        self.older.drain(..removed);
    }
}

impl Drop for RawWriter {
    /// Writes what is waiting. Who wants to know whether that went well calls [`RawWriter::flush`].
    fn drop(&mut self) {
        let _ = self.flush();
    }
}

/// Bytes of an arrival that have no fixed length.
pub(crate) fn payload(input: &Input) -> usize {
    match input {
        Input::Bytes(bytes) => bytes.len(),
        Input::Sent(Sent { host, bytes, .. }) => host.len() + bytes.len(),
        Input::State(
            PortState::Open { what: text }
            | PortState::Absent { reason: text }
            | PortState::Lost { reason: text }
            | PortState::Refused { host: text, .. },
        ) => text.len(),
        Input::Order(order) => order.length(),
        Input::Can(_)
        | Input::Bus(_)
        | Input::Pulse(_)
        | Input::State(_)
        | Input::Storage(_)
        | Input::Tick => 0,
    }
}
