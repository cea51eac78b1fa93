//! NMEA 0183 / IEC 61162-1 and -450: framing, checksum, TAG blocks, and the sentences, one file each.
//!
//! A sentence is a table of its fields (`table.rs`) of a few kinds (`kinds.rs`), from which struct, writer,
//! reader, documentation and tests follow; one whose fields depend on one another is written out by hand.
//!
//! What holds for all of them:
//! - an approved sentence is at most [`MAX_LEN`] bytes from `$` to line feed, a maker's own
//!   [`MAX_LEN_OWN`]; a writer that would be longer first drops optional fields, then decimals, longest
//!   first;
//! - an unknown or unprintable value (NaN, infinite, out of the field's range) is an empty field,
//!   never a zero;
//! - a reader takes any bytes without panicking, refuses a wrong checksum, and ignores fields after
//!   the ones it knows, as later editions of the standard only append;
//! - what a sentence is for, its time and its words on validity must be good. Anything else in it that is
//!   malformed is unknown, and noted ([`Frame::left_out`]): one bad field does not kill a sentence;
//! - the checksum is weak (a line cut short passes one time in 256), so a reader also checks that all
//!   fields are there, their letters and their ranges.
//!
//! The `LONGEST` of a sentence is for whoever plans what goes through a line. A ship's values are:
//! speeds below 99.9 knots, heights, sigmas and errors below 1000 m, a geoid as on Earth, heave below
//! 100 m, rates of turn below 100 deg/s, other rates below 100 deg/s, dilutions of precision below 100,
//! ages and intervals below 1000 s, distances below a million miles, numbers of satellites below 1000,
//! counts below 100.
//!
//! Sources: gpsd `www/NMEA.adoc` for the layouts; manuals of receivers where a file names them.

mod bits;
mod checksum;
mod civil;
mod decimal;
mod fault;
mod fields;
mod frame;
mod kinds;
mod lcd;
mod line;
mod look;
mod mode;
mod network;
pub mod others;
mod parts;
mod position;
mod table;
mod tag;
mod text;

mod acn;
mod alc;
mod alert;
mod alf;
mod arc;
mod dtm;
mod gbs;
mod gga;
mod glc;
mod gll;
mod gns;
mod gsa;
mod gst;
mod gsv;
mod hbt;
mod hcr;
mod hdg;
mod hdm;
mod hdt;
mod pashr;
mod pashr_meaning;
mod pfec;
mod phcmp;
mod phinf;
mod phlin;
mod phoct;
mod phtro;
mod pinsd;
mod pixse;
mod pnorbt;
mod prdid;
mod psat;
mod psxn;
mod ptnl;
mod ptnthtm;
mod rls;
mod rmc;
mod rot;
mod sentence;
mod ths;
mod txt;
mod vbw;
mod vdr;
mod vhw;
mod vlw;
mod vtg;
mod xdr;
mod zda;

pub use acn::Acn;
pub use alc::{Alc, MAX_ENTRIES};
pub use alert::{
    AlertCategory, AlertCommand, AlertEntry, AlertId, AlertPriority, AlertState, Manufacturer,
};
pub use alf::Alf;
pub use arc::Arc;
pub use checksum::checksum;
pub use civil::{CivilTime, Date, TimeOfDay};
pub use dtm::{Datum, Dtm};
pub use fault::NmeaFault;
pub use fields::{Fields, LeftOut};
pub use frame::{ChecksumPolicy, Frame};
pub use gbs::Gbs;
pub use gga::Gga;
pub use glc::{Glc, LoranSignal};
pub use gll::Gll;
pub use gns::{Gns, MAX_SYSTEMS};
pub use gsa::{FixDimension, Gsa, MAX_USED};
pub use gst::Gst;
pub use gsv::{Gsv, SatelliteInView};
pub use hbt::Hbt;
pub use hcr::{Hcr, HeadingCorrections};
pub use hdg::Hdg;
pub use hdm::Hdm;
pub use hdt::Hdt;
pub use lcd::Lcd;
pub use line::{MAX_LEN, MAX_LEN_OWN, NmeaLine, Talker};
pub use look::look;
pub use mode::{HeadingMode, NavStatus, PositionMode};
pub use network::{Sfi, TransmissionGroup};
pub use pashr::{Pashr, PashrDialect, PashrStatus};
pub use pfec::PfecAttitude;
pub use phcmp::Phcmp;
pub use phinf::{InsUserStatus, OctansStatus, Phinf};
pub use phlin::{Phlin, Phspd};
pub use phoct::{Marked, Phoct, PhoctState, SurgeSwayHeave};
pub use phtro::Phtro;
pub use pinsd::{
    Pinsd, PinsdAlignment, PinsdBerth, PinsdChoice, PinsdDocking, PinsdIntegrity, PinsdMode,
    PinsdPart, PinsdPartOfShip, PinsdPhase, PinsdProtection, PinsdRange, PinsdSide, PinsdSigma,
    PinsdSource, PinsdStatus, PinsdStep, PinsdTime, PinsdTracks, ProtectionState, TRACK_NUMBERS,
    TRACK_SENTENCES, TRACKED, TrackedPoint,
};
pub use pixse::{Pixse, PixseAlgorithmStatus, PixseHighLevelStatus, PixseSystemStatus};
pub use pnorbt::{NortekBeam, NortekBottomTrack, NortekGroundSpeed, NortekSensors};
pub use position::Position;
pub use prdid::{Prdid, PrdidForm};
pub use psat::{PsatHpr, PsatSource};
pub use psxn::{Psxn, PsxnQuality};
pub use ptnl::{PtnlAvr, PtnlQuality};
pub use ptnthtm::Ptnthtm;
pub use rls::Rls;
pub use rmc::Rmc;
pub use rot::Rot;
pub use sentence::Sentence;
pub use tag::{DATAGRAM_HEADER, MAX_DATAGRAM, TagBlock, TagGroup, Tagged, datagram, datagrams};
pub use text::Text;
pub use ths::Ths;
pub use txt::Txt;
pub use vbw::{Vbw, VbwStern, VbwVelocity};
pub use vdr::Vdr;
pub use vhw::Vhw;
pub use vlw::Vlw;
pub use vtg::Vtg;
pub use xdr::{MAX_MEASUREMENTS, Xdr, XdrMeasurement};
pub use zda::{Zda, Zone};
