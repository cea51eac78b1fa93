//! The messages of one sensor in order of receipt.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use insd_base::{Span, Stamped, Time};

use super::error::RecordingError;
use super::report::{FileReport, RowFault};
use super::table::{Row, Table};

/// A row that is further ahead than this of the row after it, while its neighbours are in order,
/// has a wrong time.
const LEAP: Span = Span::from_nanos(1_000_000_000);

/// A message that waits for its turn.
struct Waiting<T> {
    receipt: Time,
    line: u64,
    message: T,
}

/// One sensor's file. Rows come in order of validity and leave in order of receipt; those that are
/// late wait in a heap until no later row can have arrived before them, so the memory is that of
/// the greatest delay.
pub(super) struct Stream<T>
where
    Stamped<T>: Row,
{
    table: Table<Stamped<T>>,
    /// The last row that was read; the next one shows whether its time is right.
    held: Option<(Stamped<T>, u64)>,
    latest: Option<Time>,
    /// No row to come can have been received before this.
    frontier: Time,
    waiting: BinaryHeap<Reverse<Waiting<T>>>,
    is_exhausted: bool,
}

impl<T: Copy> Stream<T>
where
    Stamped<T>: Row,
{
    pub(super) fn new(table: Table<Stamped<T>>) -> Self {
        Stream {
            table,
            held: None,
            latest: None,
            frontier: Time::from_nanos(i64::MIN),
            waiting: BinaryHeap::new(),
            is_exhausted: false,
        }
    }

    /// Time of receipt of the next message; `None` at the end of the file.
    pub(super) fn peek(&mut self) -> Result<Option<Time>, RecordingError> {
        loop {
            let head = self.waiting.peek().map(|Reverse(next)| next.receipt);
            if self.is_exhausted || head.is_some_and(|receipt| receipt <= self.frontier) {
                return Ok(head);
            }
            match self.next_in_time()? {
                Some((row, line)) => self.queue(&row, line),
                None => self.is_exhausted = true,
            }
        }
    }

    /// The message that [`Stream::peek`] announced.
    pub(super) fn pop(&mut self) -> Option<T> {
        self.waiting.pop().map(|Reverse(next)| next.message)
    }

    pub(super) fn report(&self) -> &FileReport {
        self.table.report()
    }

    pub(super) fn path(&self) -> &std::path::Path {
        self.table.path()
    }

    fn queue(&mut self, row: &Stamped<T>, line: u64) {
        let time = row.time();
        if self.latest.is_some_and(|latest| time < latest) {
            self.table.record_time_fault(line, time, RowFault::Unsorted);
        }
        self.latest = self.latest.max(Some(time));
        self.frontier = time;
        let receipt = row.arrival.unwrap_or(time);
        self.waiting.push(Reverse(Waiting { receipt, line, message: row.message }));
    }

    /// The next row but for single ones whose time leaps ahead of the rows around them.
    fn next_in_time(&mut self) -> Result<Option<(Stamped<T>, u64)>, RecordingError> {
        loop {
            let Some(next) = self.table.next_row()? else { return Ok(self.held.take()) };
            let Some(held) = self.held.replace(next) else { continue };
            let (time, next_time) = (held.0.time(), next.0.time());
            let is_leap = time - next_time > LEAP && self.latest.is_none_or(|t| next_time >= t);
            if !is_leap {
                return Ok(Some(held));
            }
            self.table.record_time_fault(held.1, time, RowFault::TimeLeap);
        }
    }
}

impl<T> Waiting<T> {
    fn key(&self) -> (Time, u64) {
        (self.receipt, self.line)
    }
}

impl<T> PartialEq for Waiting<T> {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl<T> Eq for Waiting<T> {}

impl<T> PartialOrd for Waiting<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> Ord for Waiting<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(&other.key())
    }
}
