//! From what arrives to solutions: intake and engine in one. Daemon and replay run this very code, so
//! that a recording replays to the same bits.

use insd_base::{Arrival, Counts, Input, Time, UtcTime};
use insd_engine::{Engine, EngineConfig, Output};
use insd_intake::config::IntakeConfig;
use insd_intake::event::IntakeEvent;
use insd_intake::status::IntakeStatus;
use insd_intake::{Intake, Intaken};

use crate::speaker::{Speaker, Spoken};

/// What an arrival led to.
#[derive(Clone, Debug, PartialEq)]
pub enum Product {
    /// Something from the engine.
    Engine(Output),
    /// Something from the border.
    Intake(IntakeEvent),
    /// Something for the ports that are written to.
    Spoken(Spoken),
}

/// Intake, engine and what speaks to the ports.
#[derive(Debug)]
pub struct Pipeline {
    intake: Intake,
    engine: Engine,
    speaker: Speaker,
}

impl Pipeline {
    /// A pipeline that knows nothing yet.
    #[must_use]
    pub fn new(intake: &IntakeConfig, engine: EngineConfig, speaker: Speaker) -> Self {
        Pipeline { intake: Intake::new(intake), engine: Engine::new(engine), speaker }
    }

    /// Takes what arrived, in order of arrival, and hands over all that comes of it.
    pub fn handle(&mut self, arrival: &Arrival, mut product: impl FnMut(&Intake, Product)) {
        self.intake.handle(arrival);
        while let Some(taken) = self.intake.poll_output() {
            match taken {
                Intaken::Event(event) => product(&self.intake, Product::Intake(event)),
                Intaken::Measured(received) => {
                    self.speaker.hear(&received);
                    self.engine.handle(&received);
                    while let Some(output) = self.engine.poll_output() {
                        self.speaker.note(&output);
                        product(&self.intake, Product::Engine(output));
                    }
                }
            }
        }
        let now = arrival.stamp.monotonic;
        let (intake, utc) = (&self.intake, self.intake.utc_at(now));
        self.speaker.overhear(arrival, utc);
        if arrival.input == Input::Tick {
            self.speaker.speak(&self.engine, now, utc, |spoken| {
                product(intake, Product::Spoken(spoken));
            });
        }
    }

    /// When the next [`Input::Tick`] is wanted: something is then due at a port that is written to.
    #[must_use]
    pub fn next_tick(&self, now: Time) -> Option<Time> {
        self.speaker.next(now, self.intake.utc_at(now))
    }

    /// What speaks to the ports.
    #[must_use]
    pub fn speaker(&self) -> &Speaker {
        &self.speaker
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
