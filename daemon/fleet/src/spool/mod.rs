//! What waits on board until somebody ashore has it: a spool on disk, a shelf for each class.
//!
//! Segments are only ever appended to and removed whole, so neither `kill -9` nor a power cut can harm more
//! than the last record; what was acknowledged is kept in a small file, and if that is older than the truth
//! records are sent twice, which their keys make harmless. When the quota is reached the oldest segment of
//! the least class goes, and what was lost with it is counted.

mod frame;
mod record;
mod shelf;
#[cfg(test)]
mod tests;

use std::io;
use std::path::Path;

use insd_base::UtcTime;

pub use record::{SpoolClass, SpoolRecord};
use shelf::Shelf;
pub use shelf::SpoolPlace;

/// Records that may be sent together: of one class and one run, oldest first.
#[derive(Clone, Debug, PartialEq)]
pub struct SpoolBatch {
    /// Their class.
    pub class: SpoolClass,
    /// The records; at least one.
    pub records: Vec<SpoolRecord>,
    /// Where the next ones begin.
    pub end: SpoolPlace,
}

/// What became of records that were never sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct SpoolLosses {
    /// Left out because the quota was reached.
    pub quota: u64,
    /// Older than anybody wants to know.
    pub expired: u64,
    /// Not written: the disk is full, read-only, or fails.
    pub unwritten: u64,
    /// Bytes of segments that were damaged.
    pub damaged_bytes: u64,
}

/// The spool of one fleet.
#[derive(Debug)]
pub struct Spool {
    /// In the order of [`SpoolClass::ALL`].
    shelves: [Shelf; 2],
    quota: u64,
    losses: SpoolLosses,
    /// The newest UTC that was met in each class: what comes behind it cannot be older, whatever its own UTC is.
    newest: [Option<UtcTime>; 2],
}

impl Spool {
    /// Opens the spool of a folder, or begins one; it holds so many bytes at the most.
    ///
    /// # Errors
    /// The folder cannot be made or read.
    pub fn open(folder: &Path, quota: u64) -> io::Result<Self> {
        // a segment is what goes at once: small against the quota
        let segment = (quota / 16).clamp(4 * 1024, 256 * 1024);
        let [history, alerts] = SpoolClass::ALL;
        let open = |class: SpoolClass| Shelf::open(&folder.join(class.name()), segment);
        let shelves = [open(history)?, open(alerts)?];
        let losses = SpoolLosses::default();
        let mut spool = Spool { shelves, quota, losses, newest: [None; 2] };
        spool.keep_quota();
        Ok(spool)
    }

    /// Puts a record away.
    ///
    /// # Errors
    /// It cannot be written, which is counted.
    pub fn append(&mut self, class: SpoolClass, record: &SpoolRecord) -> io::Result<()> {
        let outcome = self.shelf(class).append(record);
        self.losses.unwritten += u64::from(outcome.is_err());
        self.keep_quota();
        outcome
    }

    /// The oldest records that were not acknowledged, so many and so many bytes of text at the most; what is
    /// older than `expired` is left out, unless a record before it is not: then a clock has been set back.
    ///
    /// # Errors
    /// They cannot be read.
    pub fn oldest(
        &mut self,
        class: SpoolClass,
        most: (usize, usize),
        expired: Option<UtcTime>,
    ) -> io::Result<Option<SpoolBatch>> {
        loop {
            let Some((records, end)) = self.shelf(class).oldest(most)? else { return Ok(None) };
            let all = records.len();
            let newest = &mut self.newest[class as usize];
            let is_wanted = |own: &SpoolRecord| {
                *newest = own.utc.max(*newest);
                let utc = own.utc.and(*newest);
                utc.zip(expired).is_none_or(|(utc, limit)| utc >= limit)
            };
            let records: Vec<SpoolRecord> = records.into_iter().filter(is_wanted).collect();
            self.losses.expired += (all - records.len()) as u64;
            if records.is_empty() {
                self.shelf(class).acknowledge(end)?;
                continue;
            }
            return Ok(Some(SpoolBatch { class, records, end }));
        }
    }

    /// Somebody ashore has all records before a place.
    ///
    /// # Errors
    /// That cannot be written down: they would be sent again after a restart.
    pub fn acknowledge(&mut self, batch: &SpoolBatch) -> io::Result<()> {
        self.shelf(batch.class).acknowledge(batch.end)
    }

    /// Makes sure that what was put away survives a power cut.
    ///
    /// # Errors
    /// What the disk says.
    pub fn sync(&mut self) -> io::Result<()> {
        self.shelves.iter_mut().try_for_each(Shelf::sync)
    }

    /// Records that wait.
    #[must_use]
    pub fn waiting(&self, class: SpoolClass) -> u64 {
        self.shelves[class as usize].waiting()
    }

    /// Bytes on the disk.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.shelves.iter().map(Shelf::bytes).sum()
    }

    /// What was lost since it was opened.
    #[must_use]
    pub fn losses(&self) -> SpoolLosses {
        let damaged_bytes = self.shelves.iter().map(Shelf::damaged).sum();
        SpoolLosses { damaged_bytes, ..self.losses }
    }

    fn shelf(&mut self, class: SpoolClass) -> &mut Shelf {
        &mut self.shelves[class as usize]
    }

    fn keep_quota(&mut self) {
        while self.bytes() > self.quota {
            let Some(shelf) = self.shelves.iter_mut().find(|shelf| shelf.bytes() > 0) else {
                return;
            };
            match shelf.drop_oldest() {
                Ok(lost) => self.losses.quota += lost,
                // a segment that cannot be removed is looked at again with the next record
                Err(_) => return,
            }
        }
    }
}
