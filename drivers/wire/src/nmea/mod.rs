//! NMEA 0183 / IEC 61162-1: framing, checksum, and the approved sentences, one file each.
//!
//! What holds for all of them:
//! - a sentence is at most [`MAX_LEN`] bytes from `$` to line feed; a writer that would be longer
//!   first drops optional fields, then decimals, longest first;
//! - an unknown or unprintable value (NaN, infinite, out of the field's range) is an empty field,
//!   never a zero;
//! - a reader takes any bytes without panicking, refuses a wrong checksum, and ignores fields after
//!   the ones it knows, as later editions of the standard only append.
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
mod position;

mod gga;
mod hdt;
mod rot;
mod sentence;
mod ths;
mod vtg;
mod zda;

pub use civil::{CivilTime, Date, TimeOfDay};
pub use fault::Fault;
pub use fields::Fields;
pub use frame::{Frame, checksum};
pub use gga::Gga;
pub use hdt::Hdt;
pub use line::{Line, MAX_LEN, Talker};
pub use look::look;
pub use mode::{HeadingMode, PositionMode};
pub use position::Position;
pub use rot::Rot;
pub use sentence::Sentence;
pub use ths::Ths;
pub use vtg::Vtg;
pub use zda::{Zda, Zone};
