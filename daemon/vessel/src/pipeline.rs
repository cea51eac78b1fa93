//! From what arrives to solutions: intake and engine in one. Daemon and replay run this very code, so
//! that a recording replays to the same bits.

use std::sync::Arc;

use insd_alignment::StoredState;
use insd_base::{
    AlertOrder, Arrival, Counts, Heave, Input, Mode, Motion, Order, ResumeDoubt, Span, Time,
    UtcTime,
};
use insd_engine::{Engine, KeptFault, KeptModel, Output};
use insd_intake::event::IntakeEvent;
use insd_intake::status::IntakeStatus;
use insd_intake::{Intake, Intaken};
use insd_output::WakeUp;
use insd_output::docking::Docking;
use insd_wire::nmea::AlertCommand;

use crate::checkpoints::Checkpoints;
use crate::outputs::{Commanded, Knows, Outputs, Spoken};
use crate::plan::{Change, Plan};
use crate::spares::{Dispute, EngineStatus, FIRST, InUse, Redundancy, Said, Vote};
use crate::watch::{ReferenceWatch, WatchChange, WatchComparison};

/// In a checkpoint the name of the berth that is chosen stands under this name, which is that of no engine.
const BERTH: &str = "";

/// What an arrival led to.
#[derive(Clone, Debug, PartialEq)]
pub enum Product {
    /// Something from the engine.
    Engine(Output),
    /// Something from the border.
    Intake(IntakeEvent),
    /// Something for the ports that are written to.
    Spoken(Spoken),
    /// What became of an order.
    Order(Obeyed),
    /// Something from a spare engine of this name.
    Spare(Arc<str>, Output),
    /// Something about which engine is believed.
    Vote(Vote),
    /// What became of a command of the bridge.
    Command(Commanded),
    /// References that are watched differ, or agree again.
    Watch(WatchChange),
}

/// What became of an order.
#[derive(Clone, Debug, PartialEq)]
pub enum Obeyed {
    /// Another berth was chosen, or none: whether there is such a berth.
    Berth {
        /// Its name; none for the nearest.
        name: Option<String>,
        /// Whether it was done.
        done: bool,
    },
    /// One about an alert: whether there is such an alert that it could be done to.
    Alert {
        /// The alert's identifier.
        identifier: u32,
        /// What was ordered.
        command: AlertOrder,
        /// Whether it was done.
        done: bool,
    },
    /// Another configuration holds; what it changed.
    Configured(Change),
    /// Another configuration was not taken: its faults.
    ConfigurationRefused(String),
    /// Navigation goes on from where the run before ended: the first engine, or a spare.
    Resumed,
    /// It does not, and why.
    NotResumed(ResumeDoubt),
    /// The state of the ship at her berth is on offer.
    StoredStateOffered,
    /// It is not, and why.
    StoredStateRefused(String),
    /// What was learnt of the sensors on earlier voyages is gone on from.
    LearntOffered,
    /// It is not, and why.
    LearntRefused(KeptFault),
    /// Whether what is learnt of the sensors may be used.
    LearntUse(bool),
}

/// Who reads the orders that come as text: this crate knows no format of a file. What it reads may hang on
/// the texts alone, or a recording would not replay.
pub trait OrderReader {
    /// The plan that another configuration makes of the one that holds, and what it changes.
    ///
    /// # Errors
    /// Its faults; what held before still holds.
    fn replan(&mut self, text: &str) -> Result<(Plan, Change), String>;

    /// The state of a ship at her berth.
    ///
    /// # Errors
    /// What is wrong with it.
    fn stored_state(&self, text: &str) -> Result<StoredState, String>;
}

/// Intake, engine and what speaks to the ports.
#[derive(Debug)]
pub struct Pipeline<R> {
    reader: R,
    intake: Intake,
    engine: Engine,
    outputs: Outputs,
    /// The spare engines, if there are any.
    redundancy: Option<Redundancy>,
    watch: ReferenceWatch,
}

impl<R: OrderReader> Pipeline<R> {
    /// A pipeline that knows nothing yet.
    #[must_use]
    pub fn new(plan: Plan, reader: R) -> Self {
        let Plan { intake, engine, spares, outputs, watched } = plan;
        Pipeline {
            reader,
            intake: Intake::new(&intake),
            engine: Engine::new(engine),
            outputs: Outputs::new(outputs),
            redundancy: (!spares.is_empty()).then(|| Redundancy::new(spares)),
            watch: ReferenceWatch::new(watched),
        }
    }

    /// Takes what arrived, in order of arrival, and hands over all that comes of it.
    pub fn handle(&mut self, arrival: &Arrival, mut product: impl FnMut(Product)) {
        let now = arrival.stamp.monotonic;
        if let Input::Order(order) = &arrival.input {
            product(Product::Order(self.obey(order, now)));
            return;
        }
        if let Some(redundancy) = &mut self.redundancy {
            let first = (&mut self.engine, &self.intake);
            redundancy.look(now, first, |vote| product(Product::Vote(vote)));
        }
        let known = InUse { first: &self.engine, redundancy: self.redundancy.as_ref() };
        self.watch.look(now, || known.motion(), |change| product(Product::Watch(change)));
        self.intake.handle(arrival);
        while let Some(taken) = self.intake.poll_output() {
            match taken {
                Intaken::Event(event) => product(Product::Intake(event)),
                Intaken::Temperature(time, celsius) => self.engine.feel(time, celsius),
                Intaken::Watched(told) => {
                    self.watch.hear(&told, self.in_use().motion().as_ref());
                }
                Intaken::Measured(received) => {
                    self.outputs.hear(&received);
                    self.redundancy.iter_mut().for_each(|own| own.overhear_first(&received));
                    self.engine.handle(&received);
                    self.hand_on(&mut product);
                }
            }
        }
        self.handle_spares(arrival, &mut product);
        if let Input::Storage(faults) = arrival.input {
            self.outputs.note_storage(faults);
        }
        let utc = self.intake.utc_at(now);
        self.outputs.overhear(arrival, utc, |own| product(Product::Command(own)));
        if arrival.input == Input::Tick {
            self.outputs.note_contradicted(self.watch.contradicted(now));
            let known = InUse { first: &self.engine, redundancy: self.redundancy.as_ref() };
            self.outputs.speak(&known, now, utc, |spoken| product(Product::Spoken(spoken)));
        }
    }

    /// Hands on what the first engine says, unless it is the word of a spare that counts.
    fn hand_on(&mut self, product: &mut impl FnMut(Product)) {
        while let Some(output) = self.engine.poll_output() {
            let heard = match &mut self.redundancy {
                Some(spares) => spares.hear_first(output),
                None => Some(output),
            };
            let Some(output) = heard else { continue };
            self.outputs.note(&output);
            product(Product::Engine(output));
        }
    }

    fn handle_spares(&mut self, arrival: &Arrival, product: &mut impl FnMut(Product)) {
        let Some(redundancy) = &mut self.redundancy else { return };
        redundancy.handle(arrival, |said| match said {
            Said::Solution(solution) => product(Product::Engine(Output::Solution(solution))),
            Said::Spare(name, output) => product(Product::Spare(name, output)),
        });
        if let Some(status) = redundancy.alignment() {
            self.outputs.note(&Output::Alignment(status));
        }
    }

    fn obey(&mut self, order: &Order, now: Time) -> Obeyed {
        match order {
            Order::Alert { identifier, command } => {
                let ordered = match command {
                    AlertOrder::Acknowledge => AlertCommand::Acknowledge,
                    AlertOrder::Silence => AlertCommand::Silence,
                };
                let utc = self.intake.utc_at(now);
                let done = self.outputs.obey(*identifier, ordered, now, utc);
                Obeyed::Alert { identifier: *identifier, command: *command, done }
            }
            Order::Configuration(text) => match self.reader.replan(text) {
                Ok((plan, change)) => Obeyed::Configured(self.configure(plan, change)),
                Err(faults) => Obeyed::ConfigurationRefused(faults),
            },
            Order::Checkpoint { age, state } => self.resume(now, *age, state),
            Order::Berth(name) => {
                let done = self.outputs.choose_berth(name.as_deref());
                Obeyed::Berth { name: name.clone(), done }
            }
            Order::StoredState(text) => match self.reader.stored_state(text) {
                Ok(state) => {
                    self.engine.offer(state);
                    Obeyed::StoredStateOffered
                }
                Err(fault) => Obeyed::StoredStateRefused(fault),
            },
            Order::LearntModel(text) => self.go_on_learning(text),
            Order::UseLearnt(is_wanted) => {
                self.engine.use_learnt(*is_wanted);
                self.redundancy.iter_mut().for_each(|own| own.use_learnt(*is_wanted));
                Obeyed::LearntUse(*is_wanted)
            }
        }
    }

    /// Goes on from the checkpoint of the run before.
    fn resume(&mut self, now: Time, age: Span, state: &[u8]) -> Obeyed {
        let Some(checkpoints) = Checkpoints::parse(state) else {
            return Obeyed::NotResumed(ResumeDoubt::Damaged);
        };
        let first = match checkpoints.of(FIRST) {
            Some(own) => self.engine.resume(own, now, age),
            None => Err(ResumeDoubt::Damaged),
        };
        let chosen = checkpoints.of(BERTH).map(String::from_utf8_lossy);
        let spares = self.redundancy.as_mut();
        let resumed = spares.is_some_and(|own| own.resume(&checkpoints, now, age));
        match first {
            Err(doubt) if !resumed => Obeyed::NotResumed(doubt),
            _ => {
                // a berth that is configured no more is not there to be chosen
                if let Some(name) = chosen {
                    self.outputs.choose_berth(Some(&name));
                }
                Obeyed::Resumed
            }
        }
    }

    /// Goes on from what was learnt on earlier voyages.
    fn go_on_learning(&mut self, text: &str) -> Obeyed {
        match KeptModel::parse(text) {
            Ok(model) => {
                self.engine.offer_learnt(&model);
                self.redundancy.iter_mut().for_each(|own| own.offer_learnt(&model));
                Obeyed::LearntOffered
            }
            Err(fault) => Obeyed::LearntRefused(fault),
        }
    }

    /// Takes over what may change while the ship sails: alignment and navigation go on.
    fn configure(&mut self, plan: Plan, change: Change) -> Change {
        if change.inputs {
            self.intake = Intake::new(&plan.intake);
            self.watch = ReferenceWatch::new(plan.watched);
        }
        if change.outputs || change.inputs {
            self.outputs.succeed(Outputs::new(plan.outputs));
            self.engine.observe_points(plan.engine.points);
            self.redundancy.iter_mut().for_each(|own| own.configure(&plan.spares, change.inputs));
        }
        change
    }

    /// What the engines need to go on after a crash; `None` while none of them could.
    #[must_use]
    pub fn checkpoint(&self) -> Option<Vec<u8>> {
        let first = self.engine.checkpoint().map(|state| (FIRST.to_owned(), state));
        let spares = self.redundancy.iter().flat_map(Redundancy::checkpoints);
        let mut all: Vec<(String, Vec<u8>)> = first.into_iter().chain(spares).collect();
        let chosen = self.outputs.station().berths().chosen().filter(|_| !all.is_empty());
        all.extend(chosen.map(|name| (BERTH.to_owned(), name.as_bytes().to_vec())));
        Checkpoints(all).bytes()
    }

    /// Who reads its orders, and so knows the configuration that holds.
    #[must_use]
    pub fn reader(&self) -> &R {
        &self.reader
    }

    /// The first engine.
    #[must_use]
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    /// The engine whose word goes out.
    #[must_use]
    pub fn engine_in_use(&self) -> &Engine {
        self.in_use().engine()
    }

    /// What the system does: the mode of the engine whose word goes out.
    #[must_use]
    pub fn mode(&self) -> Mode {
        self.engine_in_use().mode()
    }

    /// How the first IMU moves by the engine in use, at its last sample.
    #[must_use]
    pub fn motion(&self) -> Option<Motion> {
        self.in_use().motion()
    }

    /// How she stands to the berth that is chosen or near, at that sample; `None` where there is none.
    #[must_use]
    pub fn docking(&self, motion: Option<&Motion>, now: Time) -> Option<Docking> {
        self.outputs.station().berths().look(motion, now)
    }

    /// Heave of the first IMU by the engine in use.
    #[must_use]
    pub fn heave(&self) -> Option<Heave> {
        self.in_use().heaves().first().copied().flatten()
    }

    /// How each reference that is watched stands to the others and to what the ship says of herself.
    #[must_use]
    pub fn watched(&self, now: Time) -> Vec<WatchComparison> {
        self.watch.comparisons(now)
    }

    fn in_use(&self) -> InUse<'_> {
        InUse { first: &self.engine, redundancy: self.redundancy.as_ref() }
    }

    /// All engines, the first one first.
    #[must_use]
    pub fn engines(&self) -> Vec<EngineStatus> {
        match &self.redundancy {
            Some(redundancy) => redundancy.engines(&self.engine),
            None => vec![EngineStatus {
                name: FIRST.to_owned(),
                mode: self.engine.mode(),
                motion: self.engine.motion(),
                chosen: true,
                doubt: None,
            }],
        }
    }

    /// Engines that are apart by more than they claim.
    #[must_use]
    pub fn disputes(&self) -> Vec<Dispute> {
        self.redundancy.as_ref().map(Redundancy::disputes).unwrap_or_default()
    }

    /// When the next [`Input::Tick`] is wanted, and why; `None` if never. All else hangs on arrivals.
    #[must_use]
    pub fn wake_up(&self, now: Time) -> Option<WakeUp> {
        self.outputs.next(now, self.intake.utc_at(now))
    }

    /// What is said at the ports.
    #[must_use]
    pub fn outputs(&self) -> &Outputs {
        &self.outputs
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

    /// When each sensor spoke last, in the order of the configuration.
    pub fn heard(&self) -> impl Iterator<Item = Option<Time>> + '_ {
        self.intake.heard()
    }

    /// What the first engine used and rejected.
    #[must_use]
    pub fn counts(&self) -> &Counts {
        self.engine.counts()
    }
}
