//! A record as bytes in a segment: length, CRC-32, and what it protects. All numbers are little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 4 | length of the body |
//! | 4 | CRC-32 of the body |
//! | 8 | the run, as a number |
//! | 8 | the sequence within the run |
//! | 8 | UTC of the record, ns since 1970; the least number if it was not known |
//! | the rest | text, UTF-8 |
//!
//! The reader never panics: what is damaged is passed over to the next frame that is whole.

use insd_base::UtcTime;

use super::record::SpoolRecord;
use crate::key::{RecordKey, RunId};

/// Length and CRC.
const HEAD: usize = 8;
/// Run, sequence and UTC.
const FIXED: usize = 24;
/// Longest text of a record, bytes.
pub(super) const MAX_TEXT: usize = 16 * 1024;
/// Longest frame, bytes.
pub(super) const MAX_FRAME: usize = HEAD + FIXED + MAX_TEXT;
/// What stands where UTC was not known.
const UNKNOWN: i64 = i64::MIN;

/// A frame that was found.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FoundFrame {
    /// Bytes in front of it that belong to no whole frame.
    pub(super) skipped: usize,
    /// Its own length, bytes.
    pub(super) length: usize,
    pub(super) record: SpoolRecord,
}

/// The bytes of a record.
pub(super) fn write(record: &SpoolRecord) -> Vec<u8> {
    let mut body = Vec::with_capacity(FIXED + record.text.len());
    body.extend(record.key.run.number().to_le_bytes());
    body.extend(record.key.sequence.to_le_bytes());
    body.extend(record.utc.map_or(UNKNOWN, UtcTime::as_nanos).to_le_bytes());
    body.extend(record.text.as_bytes());
    let length = u32::try_from(body.len()).unwrap_or(u32::MAX);
    let crc = crc32fast::hash(&body);
    [length.to_le_bytes().as_slice(), &crc.to_le_bytes(), &body].concat()
}

/// The next whole frame of some bytes; `None` if there is none.
pub(super) fn next(bytes: &[u8]) -> Option<FoundFrame> {
    (0..bytes.len()).find_map(|skipped| {
        let (record, length) = whole(bytes.get(skipped..)?)?;
        Some(FoundFrame { skipped, length, record })
    })
}

/// The frame that begins here, if it is whole.
fn whole(bytes: &[u8]) -> Option<(SpoolRecord, usize)> {
    let number = |at: usize| Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    let length = usize::try_from(number(0)?).ok()?;
    if !(FIXED..=FIXED + MAX_TEXT).contains(&length) {
        return None;
    }
    let body = bytes.get(HEAD..HEAD + length)?;
    if crc32fast::hash(body) != number(4)? {
        return None;
    }
    let word = |at: usize| Some(u64::from_le_bytes(body.get(at..at + 8)?.try_into().ok()?));
    let utc = i64::from_le_bytes(body.get(16..24)?.try_into().ok()?);
    let record = SpoolRecord {
        key: RecordKey { run: RunId::of_number(word(0)?), sequence: word(8)? },
        utc: (utc != UNKNOWN).then(|| UtcTime::from_nanos(utc)),
        text: std::str::from_utf8(body.get(FIXED..)?).ok()?.to_owned(),
    };
    Some((record, HEAD + length))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn record(sequence: u64, utc: Option<i64>, text: &str) -> SpoolRecord {
        let key = RecordKey { run: RunId::of_number(7), sequence };
        SpoolRecord { key, utc: utc.map(UtcTime::from_nanos), text: text.to_owned() }
    }

    proptest! {
        #[test]
        fn what_is_written_is_read(sequence: u64, utc in proptest::option::of(0_i64..i64::MAX), text in ".{0,200}") {
            let record = record(sequence, utc, &text);
            let bytes = write(&record);
            let found = next(&bytes).unwrap();
            prop_assert_eq!((found.skipped, found.length), (0, bytes.len()));
            prop_assert_eq!(found.record, record);
        }

        #[test]
        fn no_bytes_make_it_panic(bytes: Vec<u8>) {
            let _ = next(&bytes);
        }
    }

    #[test]
    fn behind_damage_the_next_whole_frame_is_found() {
        let mut bytes = write(&record(1, None, "{\"a\":1}"));
        let damaged = bytes.len();
        bytes[20] ^= 0x40;
        bytes.extend(write(&record(2, Some(5), "{\"a\":2}")));
        let found = next(&bytes).unwrap();
        assert_eq!((found.skipped, found.record.key.sequence), (damaged, 2));
    }

    #[test]
    fn a_frame_that_is_cut_anywhere_is_none() {
        let bytes = write(&record(1, Some(3), "{\"heading_deg\":271.3}"));
        assert!((0..bytes.len()).all(|cut| next(&bytes[..cut]).is_none()));
    }
}
