//! How everything stands, gathered by the engine's thread for whoever looks on.

use insd_base::satellites::Sky;
use insd_base::{
    AlignmentStatus, Counts, Disturbance, Estimates, Finding, Heave, Mode, Motion, Stamp, Stands,
    Time, UtcTime,
};
use insd_drivers::raw::RecorderState;
use insd_engine::LearningStatus;
use insd_fleet::FleetStatus;
use insd_intake::status::IntakeStatus;
use insd_n2k::node::NodeStatus;
use insd_output::alerts::AlertView;
use insd_output::docking::Docking;
use insd_vessel::{Dispute, EngineStatus, WatchComparison};

use super::outputs::OutputReport;
use crate::state::SaverState;

/// How everything stands at one moment. What is costly to find is looked at once a second and is `None` in
/// between.
#[derive(Clone, Debug)]
pub(super) struct Report {
    pub(super) stamp: Stamp,
    pub(super) utc: Option<UtcTime>,
    pub(super) mode: Mode,
    pub(super) motion: Option<Motion>,
    pub(super) heave: Option<Heave>,
    /// How she stands to the berth that is chosen or near.
    pub(super) alongside: Option<Alongside>,
    pub(super) alignment: Option<AlignmentStatus>,
    pub(super) alerts: Vec<AlertView>,
    pub(super) engines: Vec<EngineStatus>,
    /// When each sensor spoke last, in the order of the configuration.
    pub(super) heard: Vec<Option<Time>>,
    pub(super) slow: Option<Box<Slow>>,
}

/// How she stands to a berth, and the corners of her hull in its plan.
#[derive(Clone, Debug)]
pub(super) struct Alongside {
    pub(super) docking: Docking,
    pub(super) outline: Vec<[f64; 2]>,
}

/// What is looked at once a second.
#[derive(Clone, Debug)]
pub(super) struct Slow {
    pub(super) intake: IntakeStatus,
    pub(super) attempts: Vec<u64>,
    pub(super) counts: Counts,
    pub(super) outputs: Vec<OutputReport>,
    /// Nodes of NMEA 2000, by the names of their ports.
    pub(super) nodes: Vec<(String, NodeStatus)>,
    pub(super) recorder: Option<RecorderState>,
    pub(super) saver: Option<SaverState>,
    /// How each fleet is told, by its name.
    pub(super) fleets: Vec<(String, FleetStatus)>,
    pub(super) disputes: Vec<Dispute>,
    /// How each reference that is watched stands.
    pub(super) watched: Vec<WatchComparison>,
    pub(super) estimates: Option<Estimates>,
    /// The satellites, if a receiver tells what it measures of each.
    pub(super) sky: Option<Sky>,
    /// How all stand with whom she is navigated by.
    pub(super) standings: Vec<Stands>,
    /// What of the installation is found to be otherwise than configured.
    pub(super) findings: Vec<Finding>,
    /// How what is learnt of the sensors stands.
    pub(super) learning: Option<LearningStatus>,
    /// What moves the ship: looked at every ten seconds.
    pub(super) disturbance: Option<Disturbance>,
    /// Epochs of the outputs, those that began late, and those that were skipped.
    pub(super) epochs: [u64; 3],
    /// What could not be told.
    pub(super) untold: u64,
}
