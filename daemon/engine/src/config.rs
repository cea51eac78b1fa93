//! What the engine must know before the first message.

use insd_alignment::{AlignmentConfig, StoredState};
use insd_base::{
    Body, Geodetic, ImuSpec, LeverArms, Span, StartCondition, VesselKind, VoyageHeader,
};
use insd_learning::KeptModel;
use insd_nav::config::Models;
use insd_nav::smoothing::SmoothingPlan;

/// What the engine must know before the first message.
#[derive(Clone, Debug, PartialEq)]
pub struct EngineConfig {
    /// The IMU's error model.
    pub imu: ImuSpec,
    /// Where the sensors sit.
    pub lever_arms: LeverArms,
    /// What is known of the ship's motion at the start.
    pub start: StartCondition,
    /// Berth or starting position, if known.
    pub initial: Option<Geodetic>,
    /// Solutions per second.
    pub output_rate: f64,
    /// What is assumed of sensors and sea, and what is believed of them.
    pub models: Models,
    /// How the ship finds her attitude and heading.
    pub alignment: AlignmentConfig,
    /// The state at the last shutdown, offered for a ship that starts at her berth. It is put on
    /// trial ([`insd_alignment::trial`]) and told as used or dropped.
    pub stored: Option<StoredState>,
    /// How well GNSS epochs and IMU samples agree in time, 1-sigma, s; `None`: by the grade of the IMU.
    pub time_std: Option<f64>,
    /// What carries the sensors.
    pub vessel: VesselKind,
    /// Whether the mounting of the IMU is as the operator wants it, whatever gravity and course say: a ferry
    /// with two bows.
    pub accept_mounting: bool,
    /// Whether receivers and compass pass through while there are no data of the IMU.
    pub relay: bool,
    /// Monitoring points of which the heave is wanted, from the IMU, body axes, m. The first is the IMU
    /// itself. Without any there is no heave.
    pub points: Vec<Body>,
    /// Whether the errors of log and IMU that repeat are learnt while she is well aided (docs/learning.md).
    pub learning: bool,
    /// What was learnt on earlier voyages.
    pub learnt: Option<KeptModel>,
    /// Whether enough is kept of the voyage to smooth it afterwards: the interval between epochs that are smoothed by themselves, s.
    pub smoothing: Option<f64>,
}

impl EngineConfig {
    /// The configuration that a voyage's header asks for.
    #[must_use]
    pub fn for_voyage(header: &VoyageHeader, output_rate: f64) -> Self {
        EngineConfig {
            imu: header.imu,
            lever_arms: header.lever_arms,
            start: header.start,
            initial: header.initial,
            output_rate,
            models: Models::default(),
            alignment: AlignmentConfig::default(),
            stored: None,
            time_std: header.time_std,
            vessel: header.vessel,
            accept_mounting: false,
            relay: true,
            points: Vec::new(),
            learning: false,
            learnt: None,
            smoothing: None,
        }
    }

    /// What is to be kept for smoothing, if anything is.
    pub(crate) fn smoothing_plan(&self) -> Option<SmoothingPlan> {
        let period = Span::from_seconds(1.0 / self.output_rate);
        self.smoothing.map(|interval| SmoothingPlan { interval, period })
    }
}
