//! A simulated ship's byte streams through the intake, and through intake and engine with all that
//! goes wrong on a ship's wires and with her clocks.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod antennas;
mod bus;
mod clocks;
mod converted;
mod formats;
mod images;
mod imus;
mod lines;
mod passage;
mod pulses;
mod rtk;
mod satellites;
mod streams;
mod wild;

use insd_base::{Arrival, Voyage};
use insd_intake::config::IntakeConfig;
use insd_intake::{Intake, Intaken};

/// All that an intake makes of what arrives.
fn taken(config: &IntakeConfig, arrivals: &[Arrival]) -> Vec<Intaken> {
    assert_eq!(config.faults(), []);
    let mut intake = Intake::new(config);
    let mut all = Vec::new();
    for arrival in arrivals {
        intake.handle(arrival);
        all.extend(std::iter::from_fn(|| intake.poll_output()));
    }
    all
}

/// Half a minute at the berth with all sensors.
fn moored() -> Voyage {
    let sensors = "[gnss]\nrate_hz = 5.0\n[log]\n[reference]\ninterval_s = 1.0\nposition = \"none\"\n\
                   heading_std_deg = 0.1";
    let scenario = insd_tests::variant(22, &[("[gnss]\n[reference]", sensors)]);
    insd_simulator::simulate(&scenario.with_duration(30.0), 1)
}
