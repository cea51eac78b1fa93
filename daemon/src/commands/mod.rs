//! One command, one file.

#[cfg(feature = "vision")]
pub mod camera;
pub mod check_config;
pub mod doctor;
pub mod example_config;
pub mod fleet;
pub mod generate;
pub mod monitor;
pub mod ports;
pub mod run;
pub mod sniff;
