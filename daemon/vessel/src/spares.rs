//! Further engines beside the first: each with its own intake on the same arrivals, compared ten times a
//! second. What the ports are told comes from the one that the voter has chosen, at the place of the first
//! IMU. It all hangs on nothing but the arrivals, so that a recording replays to the same choice.

use std::sync::Arc;

use insd_base::{
    AlignmentStatus, Arrival, Body, Heave, Message, Mode, Motion, Party, Received, Solution, Span,
    Time,
};
use insd_engine::vote::{
    Difference, Disagreement, Doubt, Gyros, Record, Testimony, Voice, VoteEvent, Voter,
};
use insd_engine::{Engine, KeptModel, Output};
use insd_intake::choice::Quantity;
use insd_intake::{Intake, Intaken};
use insd_output::Doubts;

use crate::checkpoints::Checkpoints;
use crate::outputs::Knows;
use crate::plan::Spare;

/// Name of the engine that is no spare.
pub const FIRST: &str = "first";

/// Time between two looks at the engines.
const LOOK: Span = Span::from_nanos(100_000_000);

/// What the voter found, with the names of the engines.
#[derive(Clone, Debug, PartialEq)]
pub struct Vote {
    /// What.
    pub event: VoteEvent,
    names: Arc<[String]>,
}

impl Vote {
    /// Name of an engine by its index in the event.
    #[must_use]
    pub fn name(&self, engine: usize) -> &str {
        self.names.get(engine).map_or("", String::as_str)
    }
}

/// One of the engines, for whoever looks on.
#[derive(Clone, Debug, PartialEq)]
pub struct EngineStatus {
    /// Its name.
    pub name: String,
    /// What it is doing.
    pub mode: Mode,
    /// How the first IMU moves by its account; `None` while it knows nothing.
    pub motion: Option<Motion>,
    /// Whether the outputs come from it.
    pub chosen: bool,
    /// Why it is taken as wrong, if it is.
    pub doubt: Option<Doubt>,
}

/// Two engines that are apart by more than they claim, for whoever looks on.
#[derive(Clone, Debug, PartialEq)]
pub struct Dispute {
    /// Their names.
    pub between: [String; 2],
    /// Where they are farthest apart, beside what they claim.
    pub difference: Difference,
    /// Who is taken as wrong, and why.
    pub wrong: Option<(String, Doubt)>,
}

/// What comes of the spares.
pub(crate) enum Said {
    /// A solution of the engine in use, at the first IMU.
    Solution(Solution),
    /// Something of the spare of this name, at its own IMU.
    Spare(Arc<str>, Output),
}

/// All spares, and who is believed.
#[derive(Debug)]
pub(crate) struct Redundancy {
    names: Arc<[String]>,
    spares: Vec<Running>,
    voter: Voter,
    first: Ears,
    looked: Option<Time>,
    /// Time of the last solution that was handed on.
    handed: Option<Time>,
}

/// A spare at work.
#[derive(Debug)]
struct Running {
    name: Arc<str>,
    intake: Intake,
    engine: Engine,
    /// The first IMU from its own.
    home: Body,
    ears: Ears,
}

/// What an engine has said.
#[derive(Clone, Copy, Debug, Default)]
struct Ears {
    record: Record,
    gyros: Gyros,
    alignment: Option<AlignmentStatus>,
}

impl Ears {
    fn hear(&mut self, output: &Output) {
        self.record.hear(output);
        if let Output::Alignment(status) = output {
            self.alignment = Some(*status);
        }
    }
}

impl Redundancy {
    pub(crate) fn new(spares: Vec<Spare>) -> Self {
        let first = Voice { imu: 0, mounting_std: 0.0, distance: 0.0 };
        let voices = std::iter::once(first).chain(spares.iter().map(|spare| spare.voice));
        let names = spares.iter().map(|spare| spare.name.clone());
        Redundancy {
            names: std::iter::once(FIRST.to_owned()).chain(names).collect(),
            voter: Voter::new(voices.collect()),
            spares: spares.into_iter().map(Running::new).collect(),
            first: Ears::default(),
            looked: None,
            handed: None,
        }
    }

    /// Hears what the first engine is told.
    pub(crate) fn overhear_first(&mut self, received: &Received) {
        self.first.gyros.hear(&received.message);
    }

    /// Hears what the first engine says; gives what of it is to be handed on.
    pub(crate) fn hear_first(&mut self, output: Output) -> Option<Output> {
        self.first.hear(&output);
        match output {
            Output::Solution(solution) => {
                let is_new = self.voter.chosen() == 0 && self.hand(&solution);
                is_new.then(|| Output::Solution(self.covered(&solution)))
            }
            other => Some(other),
        }
    }

    /// What the engine in use says, its claims so wide that they cover the others' where it is not known who is wrong.
    fn covered(&self, solution: &Solution) -> Solution {
        Solution { sigma: self.voter.covered(&solution.sigma), ..*solution }
    }

    /// Compares the engines if it is time to, before anything is made of what arrives now: however its bytes
    /// are split, the look is at the same.
    pub(crate) fn look(
        &mut self,
        now: Time,
        (first, intake): (&mut Engine, &Intake),
        mut say: impl FnMut(Vote),
    ) {
        if self.looked.is_some_and(|last| now - last < LOOK) {
            return;
        }
        self.looked = Some(now);
        let voter = &self.voter;
        let odds = |engine: &mut Engine, index: usize| {
            let (since, excess) = voter.suspicion(index)?;
            engine.odds_of_gyros(since, &excess)
        };
        let told = testimony(first.motion(), intake, &mut self.first, now);
        let first = Testimony { odds: odds(first, 0), ..told };
        let spares = self.spares.iter_mut().enumerate().map(|(index, own)| {
            let told = testimony(own.motion(), &own.intake, &mut own.ears, now);
            Testimony { odds: odds(&mut own.engine, index + 1), ..told }
        });
        let said: Vec<Testimony> = std::iter::once(first).chain(spares).collect();
        for event in self.voter.look(now, &said) {
            say(Vote { event, names: Arc::clone(&self.names) });
        }
    }

    /// Takes what arrived, after the first engine.
    pub(crate) fn handle(&mut self, arrival: &Arrival, mut say: impl FnMut(Said)) {
        for index in 0..self.spares.len() {
            let chosen = self.voter.chosen() == index + 1;
            let mut outputs = Vec::new();
            if let Some(spare) = self.spares.get_mut(index) {
                spare.handle(arrival, |name, home, output| {
                    outputs.push((Arc::clone(name), *home, output));
                });
            }
            for (name, home, output) in outputs {
                if let (true, Output::Solution(solution)) = (chosen, &output)
                    && self.hand(solution)
                {
                    say(Said::Solution(self.covered(&moved(solution, &home))));
                }
                say(Said::Spare(name, output));
            }
        }
    }

    /// Lets the spares go on from what the run before has left of them; whether any does.
    pub(crate) fn resume(&mut self, left: &Checkpoints, now: Time, age: Span) -> bool {
        let mut resumed = false;
        for spare in &mut self.spares {
            let own = left.of(&spare.name);
            resumed |= own.is_some_and(|state| spare.engine.resume(state, now, age).is_ok());
        }
        resumed
    }

    /// Offers the spares what was learnt of what they share with the first engine; their IMUs are others.
    pub(crate) fn offer_learnt(&mut self, model: &KeptModel) {
        let mut shared = model.clone();
        shared.imu = None;
        self.spares.iter_mut().for_each(|own| own.engine.offer_learnt(&shared));
    }

    /// Whether what is learnt may be used.
    pub(crate) fn use_learnt(&mut self, is_wanted: bool) {
        self.spares.iter_mut().for_each(|own| own.engine.use_learnt(is_wanted));
    }

    /// What the spares need to go on.
    pub(crate) fn checkpoints(&self) -> impl Iterator<Item = (String, Vec<u8>)> + '_ {
        let own = |spare: &Running| Some((spare.name.to_string(), spare.engine.checkpoint()?));
        self.spares.iter().filter_map(own)
    }

    /// Takes over other points and, if they have changed, other ports and sensors.
    pub(crate) fn configure(&mut self, spares: &[Spare], inputs: bool) {
        for (own, next) in self.spares.iter_mut().zip(spares) {
            own.engine.observe_points(next.engine.points.clone());
            if inputs {
                own.intake = Intake::new(&next.intake);
            }
        }
    }

    /// How the alignment of the engine in use stands.
    pub(crate) fn alignment(&self) -> Option<AlignmentStatus> {
        self.chosen().map_or(self.first.alignment, |spare| spare.ears.alignment)
    }

    pub(crate) fn engines(&self, first: &Engine) -> Vec<EngineStatus> {
        let spares = self.spares.iter().map(|spare| (spare.engine.mode(), spare.motion()));
        let engines = std::iter::once((first.mode(), first.motion())).chain(spares).enumerate();
        engines
            .map(|(index, (mode, motion))| EngineStatus {
                name: self.name(index),
                mode,
                motion,
                chosen: self.voter.chosen() == index,
                doubt: self.voter.doubt(index),
            })
            .collect()
    }

    pub(crate) fn disputes(&self) -> Vec<Dispute> {
        let named = |own: Disagreement| Dispute {
            between: [self.name(own.between.0), self.name(own.between.1)],
            difference: own.difference,
            wrong: own.wrong.map(|(engine, doubt)| (self.name(engine), doubt)),
        };
        self.voter.disagreements().map(named).collect()
    }

    fn name(&self, engine: usize) -> String {
        self.names.get(engine).cloned().unwrap_or_default()
    }

    /// The engine in use, if it is not the first.
    fn chosen(&self) -> Option<&Running> {
        self.spares.get(self.voter.chosen().checked_sub(1)?)
    }

    /// Whether a solution is newer than what was handed on; it then is.
    fn hand(&mut self, solution: &Solution) -> bool {
        let newer = self.handed.is_none_or(|last| solution.time > last);
        if newer {
            self.handed = Some(solution.time);
        }
        newer
    }
}

impl Running {
    fn new(spare: Spare) -> Self {
        Running {
            name: spare.name.into(),
            intake: Intake::new(&spare.intake),
            engine: Engine::new(spare.engine),
            home: Body(-spare.offset.0),
            ears: Ears::default(),
        }
    }

    /// Takes what arrived. What its intake notices, that of the first engine tells.
    fn handle(&mut self, arrival: &Arrival, mut say: impl FnMut(&Arc<str>, &Body, Output)) {
        self.intake.handle(arrival);
        while let Some(taken) = self.intake.poll_output() {
            let received = match taken {
                Intaken::Measured(received) => received,
                Intaken::Temperature(time, celsius) => {
                    self.engine.feel(time, celsius);
                    continue;
                }
                Intaken::Event(_) | Intaken::Watched(_) => continue,
            };
            self.ears.gyros.hear(&received.message);
            self.engine.handle(&loosened(&received, &self.home));
            while let Some(output) = self.engine.poll_output() {
                self.ears.hear(&output);
                say(&self.name, &self.home, output);
            }
        }
    }

    /// How the first IMU moves by its account.
    fn motion(&self) -> Option<Motion> {
        self.engine.motion().map(|motion| at_home(&motion, &self.home))
    }
}

/// A position from elsewhere, as of a berth, is that of the first IMU. By how much it is wrong for another
/// hangs on the heading: by no more than the way between them, which its sigma is made to say.
#[must_use]
pub fn loosened(received: &Received, home: &Body) -> Received {
    let mut received = received.clone();
    if let Message::Reference(reference) = &mut received.message
        && reference.position.is_some()
    {
        let distance = home.0.xy().norm();
        reference.position_std = reference.position_std.map(|std| std.hypot(distance));
    }
    received
}

fn testimony(motion: Option<Motion>, intake: &Intake, ears: &mut Ears, now: Time) -> Testimony {
    let imu = intake.in_use(Quantity::Inertial);
    let imu_valid = imu.is_some_and(|status| status.valid != Some(false));
    let refused = ears.record.refused(now);
    Testimony { motion, imu_valid, refused, turned: ears.gyros.take(), odds: None }
}

/// A motion at another point; of the same point to the bit.
fn at_home(motion: &Motion, home: &Body) -> Motion {
    if *home == Body::default() { *motion } else { motion.at_point(home) }
}

fn moved(solution: &Solution, home: &Body) -> Solution {
    let motion =
        Motion { solution: *solution, acceleration: None, covariance: None, current: None };
    at_home(&motion, home).solution
}

/// The engine whose word goes out.
pub(crate) struct InUse<'a> {
    pub(crate) first: &'a Engine,
    pub(crate) redundancy: Option<&'a Redundancy>,
}

impl<'a> InUse<'a> {
    pub(crate) fn engine(&self) -> &'a Engine {
        self.spare().map_or(self.first, |spare| &spare.engine)
    }

    fn spare(&self) -> Option<&'a Running> {
        self.redundancy?.chosen()
    }
}

impl Knows for InUse<'_> {
    fn motion(&self) -> Option<Motion> {
        let motion = self.spare().map_or_else(|| self.first.motion(), Running::motion)?;
        let covered = self.redundancy.map(|own| own.covered(&motion.solution));
        Some(Motion { solution: covered.unwrap_or(motion.solution), ..motion })
    }

    fn heaves(&self) -> Vec<Option<Heave>> {
        let of_spare = |spare: &Running| spare.engine.heaves().into_iter().skip(1).collect();
        self.spare().map_or_else(|| self.first.heaves(), of_spare)
    }

    /// Those of the engine in use, and of the IMUs of all: one that is wrong is, whoever is believed.
    fn doubts(&self) -> Doubts {
        let spares = self.redundancy.iter().flat_map(|own| &own.spares).map(|spare| &spare.engine);
        let all: Vec<&Engine> = std::iter::once(self.first).chain(spares).collect();
        let of_imus = all.iter().flat_map(|engine| engine.findings());
        let of_imus: Vec<_> = of_imus.filter(|found| found.doubts_imu()).copied().collect();
        let (of_imus, own) = (Doubts::of(&of_imus), Doubts::of(self.engine().findings()));
        // all hear the same but for their IMUs: what one finds contradicted and another does not is the IMU
        let in_doubt = all.iter().filter(|engine| engine.is_in_doubt()).count();
        let is_found = all.iter().any(|engine| engine.excluded().contains(Party::Imu));
        Doubts {
            mounting: own.mounting || of_imus.mounting,
            bad_data: own.bad_data || of_imus.bad_data,
            imu: is_found || (1..all.len()).contains(&in_doubt),
            ..own
        }
    }

    fn engines_differ(&self) -> bool {
        self.redundancy.is_some_and(|own| own.voter.disagreements().next().is_some())
    }
}
