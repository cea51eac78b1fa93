//! The packet: a page of a report, and the report of several pages.

use crate::binary::BinaryFault;
use crate::stream::Look;

/// Start and end of a packet.
const STX: u8 = 0x02;
const ETX: u8 = 0x03;

/// GENOUT, the type of the packets that carry a report.
const GENOUT: u8 = 0x40;

/// Start, status, type and length.
const HEADER: usize = 4;

/// Transmission, page and last page.
const NUMBERS: usize = 3;

/// Checksum and end.
const TAIL: usize = 2;

/// Most bytes of records that a page has room for.
const LONGEST: usize = u8::MAX as usize - NUMBERS;

/// What stands at the start of some bytes. The checksum is a weak one, so the records of a report of one page must fill it as well.
#[must_use]
pub fn look(bytes: &[u8]) -> Look {
    match bytes {
        [STX] => Look::More(2),
        [STX, _] => Look::More(3),
        [STX, _, GENOUT] => Look::More(HEADER),
        [STX, _, GENOUT, length, rest @ ..] => {
            let length = usize::from(*length);
            if length < NUMBERS || matches!(rest, [_, page, last, ..] if page > last) {
                return Look::Nothing;
            }
            whole(bytes, HEADER + length + TAIL)
        }
        _ => Look::Nothing,
    }
}

fn whole(bytes: &[u8], length: usize) -> Look {
    match bytes.get(..length) {
        None => Look::More(length),
        Some([_, summed @ .., sum, ETX]) => match (checksum(summed) == *sum, summed) {
            (false, _) => Look::Damaged,
            (true, [_, _, _, _, 0, 0, records @ ..]) if !fills(records) => Look::Nothing,
            (true, _) => Look::Frame(length),
        },
        Some(_) => Look::Nothing,
    }
}

/// Whether records, each with its length, end where the bytes end.
fn fills(mut records: &[u8]) -> bool {
    while let [_, length, rest @ ..] = records {
        let Some(behind) = rest.get(usize::from(*length)..) else { return false };
        records = behind;
    }
    records.is_empty()
}

fn checksum(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum, byte| byte.wrapping_add(sum))
}

/// One page of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Status of the receiver, as it stands: bit 1 low battery, bit 3 roving.
    pub status: u8,
    /// Number of the report, the same on all its pages.
    pub transmission: u8,
    /// Number of this page, from 0 on.
    pub page: u8,
    /// Number of the last page.
    pub last: u8,
    /// The piece of the records that stands on it.
    pub records: Vec<u8>,
}

impl Page {
    /// Opens one whole packet.
    ///
    /// # Errors
    /// [`BinaryFault::Frame`] unless the bytes are one packet with a good checksum and nothing more.
    pub fn open(packet: &[u8]) -> Result<Self, BinaryFault> {
        if look(packet) != Look::Frame(packet.len()) {
            return Err(BinaryFault::Frame);
        }
        let [_, status, _, _, transmission, page, last, records @ .., _, _] = packet else {
            return Err(BinaryFault::Frame);
        };
        let (status, transmission) = (*status, *transmission);
        Ok(Page { status, transmission, page: *page, last: *last, records: records.to_vec() })
    }

    /// The packet; records for which there is no room are cut off.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let records = self.records.get(..LONGEST).unwrap_or(&self.records);
        let length = (NUMBERS + records.len()) as u8;
        let head = [self.status, GENOUT, length, self.transmission, self.page, self.last];
        let summed = [&head[..], records].concat();
        [&[STX][..], &summed, &[checksum(&summed), ETX]].concat()
    }

    /// The packets of a report's records, as many as they need.
    #[must_use]
    pub fn pages(transmission: u8, records: &[u8]) -> Vec<Self> {
        let pieces: Vec<&[u8]> = records.chunks(LONGEST).take(usize::from(u8::MAX)).collect();
        let last = pieces.len().saturating_sub(1) as u8;
        let page = |(page, records): (usize, &&[u8])| Page {
            status: 0,
            transmission,
            page: page as u8,
            last,
            records: records.to_vec(),
        };
        pieces.iter().enumerate().map(page).collect()
    }
}

/// Puts the pages of a report together.
#[derive(Clone, Debug, Default)]
pub struct Pages {
    /// The pages so far of a report that is not complete: its number, the page that comes next, the records.
    begun: Option<(u8, u8, Vec<u8>)>,
}

impl Pages {
    /// The records of a report, once its last page has come. A report of which a page is missing is dropped.
    pub fn take(&mut self, page: &Page) -> Option<Vec<u8>> {
        let before = self.begun.take();
        let mut records = match before {
            _ if page.page == 0 => Vec::new(),
            Some((number, next, records)) if (number, next) == (page.transmission, page.page) => {
                records
            }
            _ => return None,
        };
        records.extend_from_slice(&page.records);
        if page.page == page.last {
            return Some(records);
        }
        self.begun = Some((page.transmission, page.page.wrapping_add(1), records));
        None
    }
}
