//! From what arrives to solutions: intake and engine in one. Daemon and replay run this very code, so
//! that a recording replays to the same bits.

use insd_base::{Arrival, Counts, Time, UtcTime};
use insd_engine::{Engine, EngineConfig, Output};
use insd_intake::config::IntakeConfig;
use insd_intake::event::IntakeEvent;
use insd_intake::status::IntakeStatus;
use insd_intake::{Intake, Intaken};

/// What an arrival led to.
#[derive(Clone, Debug, PartialEq)]
pub enum Product {
    /// Something from the engine.
    Engine(Output),
    /// Something from the border.
    Intake(IntakeEvent),
}

/// Intake and engine.
#[derive(Debug)]
pub struct Pipeline {
    intake: Intake,
    engine: Engine,
}

impl Pipeline {
    /// A pipeline that knows nothing yet.
    #[must_use]
    pub fn new(intake: &IntakeConfig, engine: EngineConfig) -> Self {
        Pipeline { intake: Intake::new(intake), engine: Engine::new(engine) }
    }

    /// Takes what arrived, in order of arrival, and hands over all that comes of it.
    pub fn handle(&mut self, arrival: &Arrival, mut product: impl FnMut(&Intake, Product)) {
        self.intake.handle(arrival);
        while let Some(taken) = self.intake.poll_output() {
            match taken {
                Intaken::Event(event) => product(&self.intake, Product::Intake(event)),
                Intaken::Measured(received) => {
                    self.engine.handle(&received);
                    while let Some(output) = self.engine.poll_output() {
                        product(&self.intake, Product::Engine(output));
                    }
                }
            }
        }
    }

    /// UTC at an instant of the ship's time line, if it is known.
    #[must_use]
    pub fn utc_at(&self, time: Time) -> Option<UtcTime> {
        self.intake.utc_at(time)
    }

    /// Ports, sensors, choices and time.
    #[must_use]
    pub fn status(&self) -> IntakeStatus {
        self.intake.status()
    }

    /// What the engine used and rejected.
    #[must_use]
    pub fn counts(&self) -> &Counts {
        self.engine.counts()
    }
}
