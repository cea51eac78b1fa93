//! Trimble GSOF: reports of a receiver, made of records, on pages of packets of the type GENOUT.
//!
//! ```text
//! 02            start
//! status        of the receiver
//! 40            GENOUT
//! length        of what follows up to the checksum
//! transmission  number of the report
//! page          its page, from 0 on
//! last          its last page
//! records       each its type, the length of its contents, its contents; one may go on on the next page
//! checksum      sum of all bytes from the status on, modulo 256
//! 03            end
//! ```
//!
//! Big endian. Readers never panic, whatever the bytes. Source: the maker's receiver help (OEM GNSS, GSOF messages) and its own driver
//! `trimble-oss/trimble_driver_ros` (BSD-2-Clause, copyright Trimble Inc.), whose tests give the values that the tests here read. Not
//! verified against a device: that vertical velocity is positive upwards, as the maker does not tell it.

mod frame;
mod record;

pub use frame::{Page, Pages, look};
pub use record::{
    AntennaLine, CurrentTime, Dilutions, GsofRecord, LineVariances, Movement, Place, PositionSigma,
    PositionTime,
};

use super::{EpochTime, GnssPart};
use crate::binary::BinaryFault;

/// Nanoseconds of a millisecond.
const MILLI: i64 = 1_000_000;

/// A whole report.
#[derive(Clone, Debug, PartialEq)]
pub struct GsofReport {
    /// Its records, in their order.
    pub records: Vec<GsofRecord>,
}

impl GsofReport {
    /// Reads the records of a report.
    ///
    /// # Errors
    /// What is wrong with them.
    pub fn read(mut bytes: &[u8]) -> Result<Self, BinaryFault> {
        let mut records = Vec::new();
        while let [kind, length, rest @ ..] = bytes {
            let needed = usize::from(*length);
            let short = BinaryFault::Short { needed, found: rest.len() };
            let (own, behind) = rest.split_at_checked(needed).ok_or(short)?;
            records.push(GsofRecord::read(*kind, own)?);
            bytes = behind;
        }
        if bytes.is_empty() { Ok(GsofReport { records }) } else { Err(BinaryFault::Frame) }
    }

    /// Its records as they stand in a report.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let record = |record: &GsofRecord| {
            let (kind, mut own) = record.write();
            own.truncate(usize::from(u8::MAX));
            [&[kind, own.len() as u8][..], &own].concat()
        };
        self.records.iter().flat_map(record).collect()
    }

    /// Whether any record of it is read.
    #[must_use]
    pub fn is_read(&self) -> bool {
        self.records.iter().any(|record| !matches!(record, GsofRecord::Other(..)))
    }

    /// What it says of its epoch; nothing without record 1, as it is not known then when that was and whether there is a fix.
    #[must_use]
    pub fn part(&self) -> Option<GnssPart> {
        let time = self.records.iter().find_map(|record| match record {
            GsofRecord::Time(record) => Some(*record),
            _ => None,
        })?;
        let mut part = GnssPart { kind: "GSOF", ..GnssPart::default() };
        self.records.iter().for_each(|record| record.tell(&mut part));
        if part.invalid {
            let (velocity, position_std) = ([None; 3], [None; 3]);
            part = GnssPart { position: None, velocity, position_std, ..part };
        }
        if !time.has_height() {
            part.position_std[2] = None;
        }
        Some(part)
    }

    /// The heading of its antennas and when that was, if it has record 27.
    #[must_use]
    pub fn heading(&self) -> Option<GnssPart> {
        self.records.iter().find_map(|record| {
            let GsofRecord::Line(line, behind) = record else { return None };
            let heading = line.heading();
            Some(GnssPart {
                kind: "GSOF 27",
                epoch: Some(EpochTime::TimeOfWeek(i64::from(line.milliseconds) * MILLI)),
                heading,
                heading_std: behind.and_then(|own| own.heading_std()).filter(|_| heading.is_some()),
                ..GnssPart::default()
            })
        })
    }
}
