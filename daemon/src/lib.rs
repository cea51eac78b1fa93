//! `insd`, the inertial navigation system of a ship: the daemon, and the one program.
//!
//! The engine and all below it are pure. Here are the threads, the page, the journal and the one
//! clock ([`clock`]); what is done with voyages afterwards is `insd_lab`.

#![warn(clippy::print_stdout)] // it panics when the reader has gone: `insd_lab::terminal::print` does not

pub mod cli;
pub mod clock;
pub mod commands;
pub mod doctor;
pub mod logging;
pub mod monitor;
pub mod run;
pub mod state;
