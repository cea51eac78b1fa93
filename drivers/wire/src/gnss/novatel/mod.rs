//! NovAtel OEM7 (OEM4 to OEM6 have the same): binary logs with long and with short headers.
//!
//! Readers never panic, whatever the bytes. Layouts: NovAtel OEM7 Commands and Logs Reference Manual, held by the maker's own decoder
//! (`novatel_edie`, MIT) and the frames in its tests.

mod frame;
mod heading;
mod imu;
mod ins;
mod solution;

pub use frame::{Header, look};
pub use heading::AntennaHeading;
pub use imu::{ImuScale, RawImu, RawImuX};
pub use ins::{InsPva, InsPvax};
pub use solution::{BestPosition, BestVelocity, ReceiverClock};

use super::GnssPart;
use crate::binary::BinaryFault;
use crate::imu::ImuReading;

/// What a log says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OemBody {
    /// BESTPOS and BESTGNSSPOS.
    Position(BestPosition),
    /// BESTVEL and BESTGNSSVEL.
    Velocity(BestVelocity),
    /// HEADING2 and DUALANTENNAHEADING.
    Heading(AntennaHeading),
    /// INSPVA and INSPVAS.
    Ins(InsPva),
    /// INSPVAX.
    InsExtended(InsPvax),
    /// RAWIMU and RAWIMUS.
    Imu(RawImu),
    /// RAWIMUX and RAWIMUSX.
    ImuExtended(RawImuX),
    /// TIME.
    Time(ReceiverClock),
    /// A good log that is not read here.
    Other,
}

/// A log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OemLog {
    /// Which, and when.
    pub header: Header,
    /// What it says.
    pub body: OemBody,
}

/// Numbers of the logs that are read, their names, and how many bytes they have.
const LOGS: [(u16, &str, usize); 14] = [
    (42, "BESTPOS", 72),
    (1429, "BESTGNSSPOS", 72),
    (99, "BESTVEL", 44),
    (1430, "BESTGNSSVEL", 44),
    (1335, "HEADING2", 48),
    (2042, "DUALANTENNAHEADING", 44),
    (507, "INSPVA", 88),
    (508, "INSPVAS", 88),
    (1465, "INSPVAX", 126),
    (268, "RAWIMU", 40),
    (325, "RAWIMUS", 40),
    (1461, "RAWIMUX", 40),
    (1462, "RAWIMUSX", 40),
    (101, "TIME", 44),
];

impl OemLog {
    /// Reads a frame.
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn read(frame: &[u8]) -> Result<Self, BinaryFault> {
        let (header, payload) = Header::open(frame)?;
        let known = LOGS.iter().find(|(id, ..)| *id == header.id && !header.response);
        let Some((_, name, needed)) = known else {
            return Ok(OemLog { header, body: OemBody::Other });
        };
        if payload.len() < *needed {
            return Err(BinaryFault::Short { needed: *needed, found: payload.len() });
        }
        let body = match *name {
            "BESTPOS" | "BESTGNSSPOS" => OemBody::Position(BestPosition::read_body(payload)?),
            "BESTVEL" | "BESTGNSSVEL" => OemBody::Velocity(BestVelocity::read_body(payload)?),
            "HEADING2" | "DUALANTENNAHEADING" => {
                OemBody::Heading(AntennaHeading::read_body(payload)?)
            }
            "INSPVA" | "INSPVAS" => OemBody::Ins(InsPva::read_body(payload)?),
            "INSPVAX" => OemBody::InsExtended(InsPvax::read_body(payload)?),
            "RAWIMU" | "RAWIMUS" => OemBody::Imu(RawImu::read_body(payload)?),
            "RAWIMUX" | "RAWIMUSX" => OemBody::ImuExtended(RawImuX::read_body(payload)?),
            _ => OemBody::Time(ReceiverClock::read_body(payload)?),
        };
        Ok(OemLog { header, body })
    }

    /// The frame; of a log that is not read its header alone.
    #[must_use]
    pub fn write(&self) -> Vec<u8> {
        let mut payload = match &self.body {
            OemBody::Position(body) => body.write_body(),
            OemBody::Velocity(body) => body.write_body(),
            OemBody::Heading(body) => body.write_body(),
            OemBody::Ins(body) => body.write_body(),
            OemBody::InsExtended(body) => body.write_body(),
            OemBody::Imu(body) => body.write_body(),
            OemBody::ImuExtended(body) => body.write_body(),
            OemBody::Time(body) => body.write_body(),
            OemBody::Other => Vec::new(),
        };
        let known = LOGS.iter().find(|(id, ..)| *id == self.header.id);
        payload.resize(known.map_or(0, |(.., length)| *length).max(payload.len()), 0);
        self.header.write(&payload)
    }

    /// Its name: BESTPOS; `None` of one that is not read here.
    #[must_use]
    pub fn name(&self) -> Option<&'static str> {
        let known = LOGS.iter().find(|(id, ..)| *id == self.header.id);
        known.filter(|_| self.body != OemBody::Other).map(|(_, name, _)| *name)
    }

    /// What it says of an epoch. A place or velocity of the receiver's own inertial filter says nothing: it is not by satellites.
    #[must_use]
    pub fn part(&self) -> Option<GnssPart> {
        let part = match &self.body {
            OemBody::Position(body) => body.part()?,
            OemBody::Velocity(body) => body.part()?,
            OemBody::Heading(body) => body.part(),
            OemBody::Time(body) => body.part(),
            _ => return None,
        };
        Some(GnssPart { kind: self.name()?, epoch: self.header.epoch(), ..part })
    }

    /// True heading of the inertial system, rad, with its 1-sigma; the heading is `None` unless its solution is good. `None` of other logs.
    #[must_use]
    pub fn attitude(&self) -> Option<(Option<f64>, Option<f64>)> {
        match &self.body {
            OemBody::Ins(body) => Some((body.heading(), None)),
            OemBody::InsExtended(body) => Some((body.heading(), body.heading_std())),
            _ => None,
        }
    }

    /// A sample of the IMU, if it tells which one it is and that one is known.
    #[must_use]
    pub fn imu(&self) -> Option<ImuReading> {
        match &self.body {
            OemBody::ImuExtended(body) => body.reading(),
            _ => None,
        }
    }
}

/// Reader and writer of a body that is one table.
macro_rules! as_body {
    ($body:ident) => {
        impl $body {
            pub(super) fn read_body(bytes: &[u8]) -> Result<Self, $crate::binary::BinaryFault> {
                Self::read_fields(bytes)
            }

            pub(super) fn write_body(&self) -> Vec<u8> {
                self.write_fields()
            }
        }
    };
}
use as_body;
