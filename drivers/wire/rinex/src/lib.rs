//! RINEX: what receivers measured of satellites and what satellites broadcast, text to values and back.
//!
//! Versions 2, 3 and 4 are read, 3.05 is written, and compact RINEX is made plain. Pure: no I/O, no clock, no thread, no
//! log. Readers never panic, whatever the bytes; what they leave out they report as a [`Flaw`] with its line. All
//! times are GPS time; metres, seconds, cycles and radians. Facts of the format are from "RINEX: The Receiver
//! Independent Exchange Format" 2.11, 3.05 and 4.02 (IGS/RTCM), whose tables are named where they are used.
//!
//! ```
//! # let file = include_str!("../tests/data/moving.obs");
//! use insd_rinex::{ObservationReader, write_observations};
//!
//! let mut reader = ObservationReader::new(file)?;
//! let epochs: Vec<_> = reader.by_ref().filter_map(Result::ok).collect();
//! assert_eq!(epochs.len(), 3);
//! let text = write_observations(reader.header(), &epochs);
//! assert!(ObservationReader::new(&text)?.eq(epochs.into_iter().map(Ok)));
//! # Ok::<(), insd_rinex::RinexError>(())
//! ```

mod calendar;
mod compact;
mod decimal;
mod error;
mod navigation;
mod observation;
mod text;

pub use calendar::TimeSystem;
pub use compact::{PlainObservations, expand, is_compact};
pub use error::{Flaw, Flaws, RinexError};
pub use navigation::{NavigationMessages, read_navigation, write_navigation};
pub use observation::{
    Equipment, ObservationHeader, ObservationReader, write_moving, write_observations,
};
