//! Parameter groups of network management: who is there, what it is, and what it is asked to do.
//!
//! Facts of layout: canboat.json 8 (Apache-2.0); codes of group 126208 also from the NMEA 2000
//! corrigendum tc201401031 as ttlappalainen's NMEA2000 library (MIT) tells them.

mod function;
mod identity;
mod requests;
mod text;

pub use function::{
    Acknowledge, Command, GroupFunction, GroupRequest, INTERVAL_DEFAULT, INTERVAL_KEEP,
    IntervalError, OFFSET_KEEP, ParameterError, PgnError,
};
pub use identity::{Configuration, Controller, Heartbeat, ProductInfo};
pub(crate) use requests::answer_to;
pub use requests::{CommandedAddress, Control, IsoAcknowledgement, IsoRequest, PgnList};
pub use text::{LONGEST_TEXT, read_text};
