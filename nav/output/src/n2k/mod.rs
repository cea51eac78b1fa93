//! From what is known at one instant to the messages of an NMEA 2000 bus: which are due, and what each
//! says.
//!
//! Pure. [`PgnSchedule`] makes the contents; the node of `insd_n2k` sends them. `docs/n2k.md` has the table of
//! groups, their signs, and when a field is not available.

mod config;
mod groups;
mod load;
mod pgn_schedule;
mod table;

pub use config::{GroupSection, N2kGroups};
pub use load::{BITS_PER_SECOND, BusLoad};
pub use pgn_schedule::PgnSchedule;
pub use table::{default_transmit, least_interval};
