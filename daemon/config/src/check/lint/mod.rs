//! What is allowed, and yet wrong on nearly every ship: what installers get wrong.

mod berths;
mod fleets;
mod found;
mod imu;
mod outputs;
mod ports;
mod sensors;
mod ship;
mod sockets;

use super::finding::ConfigFinding;
use crate::Config;

use found::Found;

/// Everything that is found in a configuration.
pub(super) fn all(config: &Config) -> Vec<ConfigFinding> {
    let mut found = Found::default();
    ship::look(config, &mut found);
    imu::look(config, &mut found);
    ports::look(config, &mut found);
    sockets::look(config, &mut found);
    sensors::look(config, &mut found);
    outputs::look(config, &mut found);
    berths::look(config, &mut found);
    fleets::look(config, &mut found);
    found.0
}
