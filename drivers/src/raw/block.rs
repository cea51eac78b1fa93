//! A block: records, compressed, with the check that tells whether they are whole.

use insd_base::{Arrival, Stamp};

use super::layout::{u32_at, u64_at};
use super::record::{Encoder, Record, decode};

/// What every block begins with.
pub(crate) const MARKER: [u8; 4] = [0xB1, b'i', b'n', b's'];
/// Bytes before the records.
pub(crate) const HEAD: usize = 32;
/// A block is closed when it has so many bytes of records, before compression.
pub(crate) const FULL: usize = 64 * 1024;
/// No block has more bytes of records, before compression.
const LONGEST: usize = 4 * 1024 * 1024;
/// No arrival is recorded whose bytes or text are longer.
pub(crate) const LONGEST_PAYLOAD: usize = LONGEST - FULL - 128;

/// Bytes of the head that its own check covers.
const CHECKED: usize = HEAD - 4;

/// What stands before the records of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Head {
    /// Bytes of the body in the file.
    pub(crate) stored: usize,
    /// Bytes of the records.
    raw: usize,
    /// How many records.
    pub(crate) records: u32,
    /// Records of the run before this block.
    pub(crate) first: u64,
    check: u32,
}

impl Head {
    /// Reads a head; `None` if it is none, or damaged.
    pub(crate) fn read(bytes: &[u8]) -> Option<Self> {
        let checked = bytes.get(..CHECKED)?;
        if !checked.starts_with(&MARKER) || u32_at(bytes, CHECKED)? != crc32fast::hash(checked) {
            return None;
        }
        let head = Head {
            stored: u32_at(bytes, 4)? as usize,
            raw: u32_at(bytes, 8)? as usize,
            records: u32_at(bytes, 12)?,
            first: u64_at(bytes, 16)?,
            check: u32_at(bytes, 24)?,
        };
        (head.stored <= head.raw && head.raw <= LONGEST).then_some(head)
    }

    /// The records of the body that follows; `None` if it is damaged.
    pub(crate) fn open(&self, body: &[u8]) -> Option<Vec<Record>> {
        if body.len() != self.stored || crc32fast::hash(body) != self.check {
            return None;
        }
        if self.stored == self.raw {
            return decode(body, self.records);
        }
        let mut raw = vec![0; self.raw];
        let length = lz4_flex::block::decompress_into(body, &mut raw).ok()?;
        (length == self.raw).then_some(())?;
        decode(&raw, self.records)
    }

    fn write(&self) -> [u8; HEAD] {
        let mut bytes = Vec::with_capacity(HEAD);
        bytes.extend(MARKER);
        for number in [self.stored as u32, self.raw as u32, self.records] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(self.first.to_le_bytes());
        bytes.extend(self.check.to_le_bytes());
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        let mut head = [0; HEAD];
        head.copy_from_slice(&bytes);
        head
    }
}

/// A block in the making.
#[derive(Debug, Default)]
pub(crate) struct Open {
    encoder: Encoder,
    raw: Vec<u8>,
    records: u32,
    arrivals: u64,
    dropped: u64,
    first: Option<Stamp>,
}

impl Open {
    /// Appends a gap.
    pub(crate) fn push_gap(&mut self, dropped: u64, at: Stamp) {
        Encoder::gap(&mut self.raw, dropped);
        self.records += 1;
        self.dropped = self.dropped.saturating_add(dropped);
        self.first.get_or_insert(at);
    }

    /// Appends an arrival.
    pub(crate) fn push(&mut self, arrival: &Arrival) {
        self.encoder.arrival(&mut self.raw, arrival);
        self.records += 1;
        self.arrivals += 1;
        self.first.get_or_insert(arrival.stamp);
    }

    /// The stamp of the first record; `None` while there is none.
    pub(crate) fn first(&self) -> Option<Stamp> {
        self.first
    }

    /// Whether it is to be closed.
    pub(crate) fn is_full(&self) -> bool {
        self.raw.len() >= FULL
    }

    /// Records in it.
    pub(crate) fn records(&self) -> u32 {
        self.records
    }

    /// Arrivals in it.
    pub(crate) fn arrivals(&self) -> u64 {
        self.arrivals
    }

    /// Arrivals that it, or the gaps in it, stand for.
    pub(crate) fn stands_for(&self) -> u64 {
        self.arrivals.saturating_add(self.dropped)
    }

    /// The bytes for the file. `before` is how many records the run had before.
    pub(crate) fn seal(&self, before: u64) -> Vec<u8> {
        let packed = lz4_flex::block::compress(&self.raw);
        let body = if packed.len() < self.raw.len() { &packed } else { &self.raw };
        let head = Head {
            stored: body.len(),
            raw: self.raw.len(),
            records: self.records,
            first: before,
            check: crc32fast::hash(body),
        };
        [&head.write(), body.as_slice()].concat()
    }
}
