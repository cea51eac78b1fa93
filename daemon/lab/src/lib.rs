//! What is done with voyages: made, replayed, scored, told, shown. For who builds and judges the navigation.
//!
//! It runs the very engine and vessel of the daemon, but reads no clock: it is told the time.

#![warn(clippy::print_stdout)] // it panics when the reader has gone: `terminal::print` does not

mod background;
pub mod blame;
mod camera_table;
mod camera_voyage;
pub mod commands;
pub mod demo;
pub mod evaluation;
pub mod export;
pub mod parts;
pub mod pty;
pub mod ranges;
pub mod raw_receivers;
pub mod raw_run;
mod raw_table;
mod raw_voyage;
mod reference_table;
pub mod report;
pub mod scenario;
pub mod sniff;
pub mod style;
pub mod table;
pub mod terminal;
pub mod words;
