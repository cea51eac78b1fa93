//! The header of a file.

use insd_base::{Stamp, Time, UtcTime};

use super::layout::{i64_at, u16_at, u32_at};

/// What every file begins with. The first byte is no text, so that nobody takes the file for one.
pub(crate) const MAGIC: [u8; 8] = *b"\x89INSDRAW";
/// Version of the format that is written, and the newest that is read.
pub(crate) const VERSION: u16 = 1;
/// Bytes before the header's body: magic, version, zero, length of the body, check. Every version has
/// these.
pub(crate) const PREFIX: usize = 20;
/// Longest body, bytes.
const LONGEST: usize = 1024 * 1024;
/// Bytes of the body before the texts.
const NUMBERS: usize = 24;

/// What the header of a file says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileHeader {
    /// Number of the file in its series, from 1.
    pub serial: u32,
    /// Number of the file with which this run of the program began.
    pub run: u32,
    /// The clocks at the first arrival of the file.
    pub first: Stamp,
    /// Name and version of the program that wrote it.
    pub program: String,
    /// The configuration with which it ran, as text.
    pub config: String,
}

/// What stands at the beginning of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Beginning {
    /// A header of so many bytes.
    Good(Box<FileHeader>, usize),
    /// A header that is cut short or does not pass its check.
    Damaged,
    /// A good header of a version that is not known.
    Newer(u16),
    /// Something else altogether.
    Foreign,
}

impl FileHeader {
    /// Bytes of a header with these texts, unless they are too long.
    pub(crate) fn fits(program: &str, config: &str) -> bool {
        program.len() <= usize::from(u16::MAX)
            && NUMBERS + 2 + program.len() + config.len() <= LONGEST
    }

    /// The bytes for the file.
    pub(crate) fn write(&self) -> Vec<u8> {
        let mut body = Vec::with_capacity(NUMBERS + self.program.len() + self.config.len() + 2);
        body.extend(self.serial.to_le_bytes());
        body.extend(self.run.to_le_bytes());
        body.extend(self.first.monotonic.as_nanos().to_le_bytes());
        body.extend(self.first.system.as_nanos().to_le_bytes());
        body.extend((self.program.len() as u16).to_le_bytes());
        body.extend(self.program.as_bytes());
        body.extend(self.config.as_bytes());
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend([0; 2]);
        bytes.extend((body.len() as u32).to_le_bytes());
        bytes.extend(check(&bytes, &body).to_le_bytes());
        bytes.extend(body);
        bytes
    }

    /// How many bytes a header takes that begins with these, as far as they tell: read again with so
    /// many.
    pub(crate) fn length(bytes: &[u8]) -> usize {
        let body = u32_at(bytes, 12).map_or(0, |length| length as usize);
        PREFIX + body.min(LONGEST)
    }

    /// Reads the header at the beginning of a file. The magic alone is not believed: where one of its
    /// bits is wrong, the check tells that the file is one of ours.
    pub(crate) fn read(bytes: &[u8]) -> Beginning {
        let length = Self::length(bytes);
        let checked = bytes.get(PREFIX..length).zip(bytes.get(..16)).zip(u32_at(bytes, 16));
        let is_good = checked.is_some_and(|((body, prefix), sum)| check(prefix, body) == sum);
        let is_ours = bytes.starts_with(&MAGIC);
        let version = u16_at(bytes, 8).unwrap_or(VERSION);
        match (is_ours, is_good) {
            (true, true) if version > VERSION => Beginning::Newer(version),
            (true, true) => Self::body(bytes, length)
                .map_or(Beginning::Damaged, |header| Beginning::Good(Box::new(header), length)),
            (true, false) | (false, true) => Beginning::Damaged,
            (false, false) if MAGIC.starts_with(bytes) => Beginning::Damaged,
            (false, false) => Beginning::Foreign,
        }
    }

    fn body(bytes: &[u8], length: usize) -> Option<FileHeader> {
        let body = bytes.get(PREFIX..length)?;
        let texts = body.get(NUMBERS + 2..)?;
        let (program, config) = texts.split_at_checked(usize::from(u16_at(body, NUMBERS)?))?;
        let first = Stamp {
            monotonic: Time::from_nanos(i64_at(body, 8)?),
            system: UtcTime::from_nanos(i64_at(body, 16)?),
        };
        Some(FileHeader {
            serial: u32_at(body, 0)?,
            run: u32_at(body, 4)?,
            first,
            program: String::from_utf8(program.to_vec()).ok()?,
            config: String::from_utf8(config.to_vec()).ok()?,
        })
    }
}

/// CRC-32 of all of the header but the magic and the check itself.
fn check(prefix: &[u8], body: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(prefix.get(MAGIC.len()..).unwrap_or_default());
    hasher.update(body);
    hasher.finalize()
}
