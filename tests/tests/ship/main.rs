//! Whole-ship scenarios: a simulated voyage in memory goes through the very engine that the daemon
//! runs, and what comes out is held against truth. The long campaigns over seeds are
//! `insd campaign`.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod antennas;
mod arrivals;
mod berth;
mod camera;
mod consistency;
mod faults;
mod identity;
mod junk;
mod levels;
mod outputs;
mod places;
mod rangings;
mod rtk;
mod satellites;
mod starts;
mod stored;
mod telling;
mod voyages;

/// Prints a figure when asked for it: `cargo test -p insd-tests -- --nocapture`.
macro_rules! figure {
    ($($argument:tt)*) => { println!($($argument)*) };
}
pub(crate) use figure;
