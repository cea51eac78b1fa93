//! NMEA 0183 / IEC 61162-1 and -450: framing, checksum, TAG blocks, and the sentences, one file each.
//!
//! What holds for all of them:
//! - an approved sentence is at most [`MAX_LEN`] bytes from `$` to line feed, a maker's own
//!   [`MAX_LEN_OWN`]; a writer that would be longer first drops optional fields, then decimals, longest
//!   first;
//! - an unknown or unprintable value (NaN, infinite, out of the field's range) is an empty field,
//!   never a zero;
//! - a reader takes any bytes without panicking, refuses a wrong checksum, and ignores fields after
//!   the ones it knows, as later editions of the standard only append;
//! - the checksum is weak (a line cut short passes one time in 256), so a reader also checks that all
//!   fields are there, their letters and their ranges.
//!
//! Sources: gpsd `www/NMEA.adoc` for the layouts; manuals of receivers where a file names them.

mod civil;
mod decimal;
mod fault;
mod fields;
mod frame;
mod line;
mod look;
mod mode;
pub mod others;
mod position;
mod tag;

mod dtm;
mod gga;
mod gll;
mod gns;
mod gsa;
mod gst;
mod gsv;
mod hdg;
mod hdm;
mod hdt;
mod pashr;
mod pinsd;
mod pnorbt;
mod psxn;
mod rmc;
mod rot;
mod sentence;
mod ths;
mod vbw;
mod vdr;
mod vhw;
mod vlw;
mod vtg;
mod zda;

pub use civil::{CivilTime, Date, TimeOfDay};
pub use dtm::{Datum, Dtm};
pub use fault::Fault;
pub use fields::Fields;
pub use frame::{ChecksumPolicy, Frame, checksum};
pub use gga::Gga;
pub use gll::Gll;
pub use gns::{Gns, MAX_SYSTEMS};
pub use gsa::{FixDimension, Gsa, MAX_USED};
pub use gst::Gst;
pub use gsv::{Gsv, SatelliteInView};
pub use hdg::Hdg;
pub use hdm::Hdm;
pub use hdt::Hdt;
pub use line::{Line, MAX_LEN, MAX_LEN_OWN, Talker};
pub use look::look;
pub use mode::{HeadingMode, NavStatus, PositionMode};
pub use pashr::{Pashr, PashrDialect, PashrStatus};
pub use pinsd::Pinsd;
pub use pnorbt::{NortekBeam, NortekBottomTrack, NortekGroundSpeed, NortekSensors};
pub use position::Position;
pub use psxn::{Psxn, PsxnQuality};
pub use rmc::Rmc;
pub use rot::Rot;
pub use sentence::Sentence;
pub use tag::{DATAGRAM_HEADER, MAX_DATAGRAM, TagBlock, TagGroup, datagram};
pub use ths::Ths;
pub use vbw::{Vbw, VbwStern, VbwVelocity};
pub use vdr::Vdr;
pub use vhw::Vhw;
pub use vlw::Vlw;
pub use vtg::Vtg;
pub use zda::{Zda, Zone};
