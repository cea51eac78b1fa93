//! The configuration file: TOML with environment overrides, typed, checked, all faults at once; what it makes of
//! the ship ([`Config::plan`]); and the small files that ship and laboratory share.
//!
//! The text is held against what it may say ([`check`]) and read twice: first strictly by `toml`, which
//! bends no type into another; then by `config`, which lays `INSD__SECTION__KEY` of the environment over it.

mod bad_input;
mod berth;
mod berths;
pub mod calendar;
mod camera;
mod cameras;
pub mod check;
mod environment;
mod faults;
mod file;
mod filters;
mod fleet;
mod fleets;
mod imu;
mod lan;
pub mod learning;
mod log_filter;
mod models;
mod node;
mod output;
pub mod output_file;
mod plan;
mod policy;
mod port;
mod ranging;
mod rangings;
mod read;
pub mod reference;
mod service;
mod ship;
mod spare;
mod spares;
pub mod stored;
mod succession;
#[cfg(test)]
mod tests;
mod watch;
mod watches;

pub use bad_input::BadInput;
pub use berth::{BerthSection, DockingSection, WaterHand};
pub use calendar::VoyageCalendar;
pub use camera::{CameraFault, CameraSection, CameraTold};
pub use check::{ConfigFinding, ConfigPlace, Examined, Severity};
pub use file::Config;
pub use fleet::{FleetSection, PayloadKind};
pub use imu::ImuModel;
pub use lan::LanSection;
pub use learning::LearningSection;
pub use log_filter::filter;
pub use models::{AlignmentSection, FloorSection, GateSection, ModelSection, ProtectionSection};
pub use node::{NodeMemory, NodeSection};
pub use output::{OutputSection, Overfull, PointSection};
pub use output_file::OutputFile;
pub use policy::PolicySection;
pub use port::PortSection;
pub use ranging::{RangingBeamKind, RangingSection};
pub use service::{ChronySection, LogSection, RecordingSection, StateSection, WebSection};
pub use ship::{CarrierKind, ShipSection, Start};
pub use spare::SpareSection;
pub use watch::WatchSection;
