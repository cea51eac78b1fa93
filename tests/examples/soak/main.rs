//! Days of a ship through the daemon's pipeline at the highest speed it goes: whether memory stays flat, the
//! counters are right and the outputs have no gap.
//!
//! `cargo run --release -p insd-tests --example soak [-- HOURS [IMU_HZ]]`
//!
//! The ship is simulated by this process and what her sensors send goes to another one over a pipe, so that the
//! memory that is measured is that of the pipeline alone.

#![allow(clippy::unwrap_used)] // a tool of the tests

mod pipe;
mod pipeline;
mod ship;

use std::io::BufWriter;
use std::process::{Command, ExitCode, Stdio};

/// Simulated hours, unless told otherwise.
const HOURS: f64 = 72.0;
/// Samples of the IMU a second, unless told otherwise.
const IMU_RATE: f64 = 50.0;
/// The first word of the other process.
const PIPELINE: &str = "pipeline";

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if words.first().is_some_and(|word| word == PIPELINE) {
        return pipeline::run(&words[1]);
    }
    let number = |index: usize| words.get(index).map(|word| word.parse().unwrap());
    let (hours, rate) = (number(0).unwrap_or(HOURS), number(1).unwrap_or(IMU_RATE));
    let ship = ship::Ship::new(hours, rate);
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args([PIPELINE, &ship.configuration()])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let sent = ship.send(BufWriter::with_capacity(1 << 20, child.stdin.take().unwrap()));
    println!("sent: {sent}");
    if child.wait().unwrap().success() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
