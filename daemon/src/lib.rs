//! `insd`, the inertial navigation system of a ship: the commands around the engine.
//!
//! The engine and all below it are pure. Here are the files, the terminal, the threads and the one
//! clock ([`clock`]).

mod calendar;
pub mod cli;
pub mod clock;
pub mod commands;
pub mod config;
pub mod demo;
mod ears;
pub mod evaluation;
pub mod logging;
pub mod monitor;
mod output_file;
pub mod pipeline;
pub mod raw_run;
pub mod redundancy;
pub mod report;
pub mod run;
pub mod sniff;
pub mod speaker;
pub mod state;
pub mod stored;
