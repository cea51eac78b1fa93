//! `insd`, the inertial navigation system of a ship: the commands around the engine.
//!
//! The engine and all below it are pure. Here are the files, the terminal, the threads and the one
//! clock ([`clock`]).

#![warn(clippy::print_stdout)] // it panics when the reader has gone: `commands::print` does not

mod calendar;
pub mod cli;
pub mod clock;
pub mod commands;
pub mod config;
pub mod demo;
pub mod doctor;
pub mod evaluation;
pub mod logging;
pub mod monitor;
mod output_file;
pub mod raw_run;
pub mod report;
pub mod run;
pub mod sniff;
pub mod state;
pub mod stored;
