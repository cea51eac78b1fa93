//! The engine: messages in, solutions and events out. The daemon, the replay, the campaign and the
//! demo all run this one, so that a recording replays to the same bits.
//!
//! Sans-I/O: [`Engine::handle`] takes one message; then [`Engine::poll_output`] is drained.

use insd_base::VoyageHeader;
use insd_base::{Counts, Event, Geodetic, ImuSpec, LeverArms, Received, Solution, StartCondition};

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
        }
    }
}

/// What leaves the engine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output {
    /// The state of the ship at an output epoch.
    Solution(Solution),
    /// Something worth telling.
    Event(Event),
}

/// The mode machine around alignment and navigation.
#[derive(Debug)]
pub struct Engine {
    counts: Counts,
}

impl Engine {
    /// An engine that knows nothing yet.
    #[must_use]
    pub fn new(_config: EngineConfig) -> Self {
        Engine { counts: Counts::default() }
    }

    /// Takes one message, in order of receipt.
    pub fn handle(&mut self, _received: &Received) {}

    /// The next solution or event, until there is none.
    pub fn poll_output(&mut self) -> Option<Output> {
        None
    }

    /// Counters of everything used, floored, rejected and bridged.
    #[must_use]
    pub fn counts(&self) -> &Counts {
        &self.counts
    }
}
