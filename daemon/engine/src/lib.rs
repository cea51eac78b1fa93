//! The engine: messages in, solutions and events out. The daemon, the replay, the campaign and the
//! demo all run this one, so that a recording replays to the same bits.
//!
//! Sans-I/O: [`Engine::handle`] takes one message; then [`Engine::poll_output`] is drained. Pure: no
//! I/O, no clock, no thread, no randomness.

mod alignment_status;
mod antennas;
mod array;
mod blind;
mod checkpoint;
mod checks;
mod clock_step;
mod coarse;
mod config;
mod disturbance;
mod doubts;
mod epochs;
mod eyes;
mod heat;
mod heir;
mod images;
mod learning;
mod ledger;
mod lessons;
mod looks;
mod mode;
mod odds;
mod output;
mod past;
mod receivers;
mod recent;
mod reception;
mod relay;
mod resume;
mod resumption;
mod ship;
mod sky;
mod source;
mod stamps;
mod standings;
mod surveyor;
mod thermometer;
mod trial;
mod twin;
pub mod vote;

use std::collections::VecDeque;
use std::sync::Arc;

use insd_alignment::StoredState;
use insd_base::satellites::{BaseEpoch, SatelliteRanges};
use insd_base::{
    Body, Counts, Event, Finding, ImuSample, ImuSpec, Message, Mode, ModeReason, Received,
    Rejection, RtkSilence, Solution, SolutionSource, Span, StartCondition, Time,
};
use insd_nav::smoothing::KeptEpoch;
use insd_nav::{
    Conditioned, Conditioner, Estimator, HeaveFilter, Increment, NavConfig, Report, Timeline,
};

use alignment_status::StatusTeller;
use antennas::Antennas;
use coarse::Coarse;
pub use config::EngineConfig;
use disturbance::Trace;
use epochs::{due_at, epochs};
pub use insd_learning::{KeptFault, KeptModel, words as learnt_words};
use learning::Learning;
pub use learning::LearningStatus;
use mode::{Facts, Machine};
pub use output::Output;
use receivers::Receivers;
use recent::Recent;
use relay::Relay;
use resumption::Resumption;
use ship::Ship;
use stamps::Stamps;
use standings::Told;
use surveyor::Surveyor;
use twin::Twin;

/// What the engine is doing with the data.
#[derive(Clone, Debug)]
enum Stage {
    /// Finding which way is down.
    Levelling(Box<Coarse>),
    /// A ship on her time line.
    Running(Box<Timeline<Ship>>),
}

/// The mode machine around alignment and navigation.
#[derive(Clone, Debug)]
pub struct Engine {
    config: EngineConfig,
    nav: NavConfig,
    stamps: Stamps,
    twin: Option<Twin<Engine>>,
    conditioner: Conditioner,
    stage: Stage,
    alignment_status: StatusTeller,
    surveyor: Surveyor,
    antennas: Antennas,
    /// What makes the IMU of no use, while something does.
    shunned: Option<Finding>,
    /// What was told of how everybody stands.
    told: Told,
    /// Alignments that were begun anew because GNSS refuted what they found.
    retried: u8,
    recent: Recent,
    receivers: Receivers,
    relay: Relay,
    period: Span,
    next_epoch: Option<i64>,
    last: Option<Increment>,
    /// Heave of the monitoring points, if there are any.
    heave: Option<HeaveFilter>,
    machine: Machine,
    /// The last epoch of satellites.
    last_ranges: Option<Arc<SatelliteRanges>>,
    last_base: Option<Arc<BaseEpoch>>,
    /// The source that was told last, and why there is no RTK.
    source: Option<SolutionSource>,
    no_rtk: Option<RtkSilence>,
    /// When the last sample of the IMU that could be used was received.
    heard: Option<Time>,
    /// The state saved before a crash, while it is on trial.
    resumption: Option<Resumption>,
    learning: Option<Box<Learning>>,
    trace: Trace,
    /// What was kept for smoothing before each time that all was begun anew.
    past: Vec<Arc<KeptEpoch>>,
    counts: Counts,
    outputs: VecDeque<Output>,
}

/// Heave of monitoring points, the first of them the IMU, if there are any.
fn heave_of(imu: &ImuSpec, points: &[Body]) -> Option<HeaveFilter> {
    let others = points.get(1..)?;
    Some(HeaveFilter::new(imu, others))
}

/// A gap in the IMU data after which the ship's attitude is anyone's guess, s.
const LOST: f64 = 60.0;
/// While other sensors are heard, an IMU without a sample for so long is silent, s.
const SILENT: f64 = 2.0;

impl Engine {
    /// An engine that knows nothing yet.
    #[must_use]
    pub fn new(config: EngineConfig) -> Self {
        let mut nav = NavConfig::with_models(config.imu, config.lever_arms, &config.models);
        nav.vessel = config.vessel;
        nav.gnss.delay_std = config.time_std.unwrap_or(nav.gnss.delay_std);
        nav.gnss.stamps_std = nav.gnss.delay_std;
        nav.smoothing = config.smoothing_plan();
        nav.thermal = heat::of_earlier_voyages(config.learnt.as_ref(), &nav);
        Engine {
            stamps: Stamps::new(1.0 / config.imu.rate),
            twin: None,
            conditioner: Conditioner::new(&config.imu),
            stage: Stage::Levelling(Box::new(Coarse::new(&config))),
            alignment_status: StatusTeller::new(&config.imu, config.alignment.accuracy),
            surveyor: Surveyor::new(&config.lever_arms, config.accept_mounting),
            antennas: Antennas::default(),
            period: Span::from_seconds(1.0 / config.output_rate),
            shunned: None,
            told: Told::default(),
            retried: 0,
            recent: Recent::default(),
            receivers: Receivers::default(),
            relay: Relay::default(),
            next_epoch: None,
            last: None,
            heave: heave_of(&config.imu, &config.points),
            machine: Machine::default(),
            last_ranges: None,
            last_base: None,
            source: None,
            no_rtk: None,
            heard: None,
            resumption: None,
            learning: Learning::where_wanted(config.learning, &nav, config.learnt.as_ref()),
            trace: Trace::new(),
            past: Vec::new(),
            counts: Counts::default(),
            outputs: VecDeque::new(),
            nav,
            config,
        }
    }

    /// Offers the state at the last shutdown, as [`EngineConfig::stored`] does, before the first message.
    pub fn offer(&mut self, stored: StoredState) {
        self.config.stored = Some(stored);
    }

    /// Other monitoring points, the first of them the IMU: the heave of others than before begins anew.
    pub fn observe_points(&mut self, points: Vec<Body>) {
        if points != self.config.points {
            self.heave = heave_of(&self.config.imu, &points);
            self.config.points = points;
        }
    }

    /// Takes one message, in order of receipt.
    pub fn handle(&mut self, received: &Received) {
        if let Message::Base(told) = &received.message {
            self.hear_base(told);
            return;
        }
        if let Some(step) = self.stamps.may_have_stepped(received) {
            self.bear_twin(received, step);
        }
        let before = self.outputs.len();
        self.handle_alone(received);
        self.hear_with_twin(received, before);
    }

    fn handle_alone(&mut self, received: &Received) {
        match received.message {
            Message::Imu(sample) => self.handle_imu(&sample, received.receipt),
            _ => {
                self.note_silence(received.receipt);
                self.handle_aid(received);
            }
        }
        self.judge_resumption();
    }

    /// The next solution, innovation or event, until there is none.
    pub fn poll_output(&mut self) -> Option<Output> {
        self.outputs.pop_front()
    }

    /// Counters of everything used, floored, rejected and bridged.
    #[must_use]
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    fn handle_imu(&mut self, told: &ImuSample, receipt: Time) {
        let (sample, step) = self.stamps.corrected(told, receipt);
        if let Some(step) = step {
            self.tell(Event::ImuClock { time: sample.time, step });
        }
        let increment = match self.conditioner.take(&sample) {
            Conditioned::Sample(increment) => {
                self.begin_resumption(increment.from, 0.0);
                increment
            }
            Conditioned::AfterGap(bridge, increment) => {
                self.close_gap(&bridge);
                increment
            }
            Conditioned::Rejected(reason) => return self.count_imu(reason),
        };
        let increment = Increment { celsius: self.felt(increment.to), ..increment };
        self.counts.imu_samples += 1;
        self.surveyor.see_raw(&sample, increment.duration());
        self.heard = Some(receipt);
        self.advance(&increment);
        if self.machine.mode() == Mode::Standby && self.shunned.is_none() {
            self.leave_standby(sample.time);
        }
    }

    fn close_gap(&mut self, bridge: &Increment) {
        let missing = bridge.duration();
        self.trace.clear();
        if self.begin_resumption(bridge.to, missing) {
            return self.cross(bridge, missing);
        }
        self.counts.imu_gaps += 1;
        self.tell(Event::ImuGap { time: bridge.to, missing });
        self.cross(bridge, missing);
    }

    fn cross(&mut self, bridge: &Increment, missing: f64) {
        if missing > LOST {
            self.start_over(bridge.to, ModeReason::GapTooLong);
        } else {
            self.advance(bridge);
        }
        self.heave.iter_mut().for_each(|heave| heave.interrupt(missing));
    }

    /// Levels anew, as if nothing had been.
    fn start_over(&mut self, time: Time, why: ModeReason) {
        self.keep_past();
        self.nav = self.nav.with_docket(self.docket().begun_anew(time));
        self.stage = Stage::Levelling(Box::new(Coarse::new(&self.config)));
        self.alignment_status = StatusTeller::new(&self.config.imu, self.config.alignment.accuracy);
        self.surveyor.begin_anew();
        self.next_epoch = None;
        self.resumption = None;
        self.trace.clear();
        self.enter(time, Mode::CoarseAlignment, Facts::default(), Some(why));
    }

    fn count_imu(&mut self, reason: Rejection) {
        match reason {
            Rejection::Duplicate => self.counts.imu_duplicates += 1,
            Rejection::OutOfOrder => self.counts.imu_out_of_order += 1,
            _ => self.counts.imu_out_of_range += 1,
        }
    }

    fn advance(&mut self, increment: &Increment) {
        self.last = Some(*increment);
        self.surveyor.measure(increment);
        match &mut self.stage {
            Stage::Levelling(coarse) => {
                coarse.advance(increment);
                self.try_start();
                self.tell_levelling(increment.to);
                self.tell_installation(increment.to);
            }
            Stage::Running(line) => {
                let mut solutions = Vec::new();
                epochs(self.period, &mut self.next_epoch, increment, line, &mut solutions);
                let reports = line.advance(increment);
                if let Some(time) = due_at(self.period, &mut self.next_epoch, increment.to) {
                    solutions.push(Solution { time, ..line.estimator().solution() });
                }
                self.watch(increment);
                for report in &reports {
                    self.note(report);
                }
                for solution in solutions {
                    self.emit(solution);
                }
                self.tell_alignment();
                self.tell_standings();
                self.tell_installation(increment.to);
                self.consider_another();
                self.tell_of_stored();
            }
        }
    }

    fn tell_levelling(&mut self, now: Time) {
        let Stage::Levelling(coarse) = &self.stage else { return };
        let place = coarse.place();
        if let Some(status) =
            self.alignment_status.levelling(now, coarse.is_moored(), place.as_ref())
        {
            self.outputs.push_back(Output::Alignment(status));
        }
    }

    fn tell_alignment(&mut self) {
        let Stage::Running(line) = &self.stage else { return };
        let (departure, status) = self.alignment_status.look(line.estimator(), line.now());
        if departure.is_some() {
            // an alignment that is begun anew does not find her there
            self.config.start = StartCondition::Underway;
        }
        self.outputs.extend(departure.map(Output::Event));
        self.outputs.extend(status.map(Output::Alignment));
    }

    /// Starts the ship at the beginning of the levelling window and lets her sail through it.
    fn try_start(&mut self) {
        let Stage::Levelling(coarse) = &mut self.stage else { return };
        let Some((level, kinematics)) = coarse.ready() else {
            if coarse.is_stale() {
                **coarse = Coarse::new(&self.config);
            }
            return;
        };
        if self.surveyor.refuses_samples() {
            **coarse = Coarse::new(&self.config);
            return;
        }
        let stored = self.config.stored.as_ref();
        let ship = Ship::aligning(&self.nav, &level, &kinematics, &self.config.alignment, stored);
        let mut line = Timeline::new(ship, level.time);
        let fresh = Coarse::new(&self.config);
        let (increments, messages) = std::mem::replace(&mut **coarse, fresh).into_data();
        let mut reports: Vec<Report> =
            messages.iter().filter_map(|received| line.measure(received)).collect();
        for increment in &increments {
            reports.extend(line.advance(increment));
        }
        self.stage = Stage::Running(Box::new(line));
        for report in &reports {
            self.note(report);
        }
    }

    fn handle_aid(&mut self, received: &Received) {
        let source = received.source;
        if self.is_from_the_future(received) {
            self.reject(received, source.name(), Rejection::OutOfRange);
            return;
        }
        if let Err(reason) = self.recent.admit(source, &received.message) {
            self.reject(received, source.name(), reason);
            return;
        }
        if let Message::Ranges(told) = &received.message {
            self.hear_satellites(told);
        }
        if let Message::Compass(reading) = &received.message {
            self.hear_antennas(reading);
        }
        let widened = self.as_well_as_they_sit(received);
        let Some(received) = &self.as_used(widened.as_ref().unwrap_or(received)) else { return };
        let (checked, faults) = checks::checked(received, self.config.vessel);
        for aid in faults {
            self.reject(received, aid, Rejection::OutOfRange);
        }
        let checked = self.surveyor.completed(&checked);
        self.alignment_status.hear(&checked);
        self.relay.hear(&checked);
        self.surveyor.hear(&self.unrefuted(&checked));
        self.heed_frozen();
        let Some(checked) = self.believed(received, &checked) else { return };
        match &mut self.stage {
            Stage::Levelling(coarse) => coarse.observe(&checked),
            Stage::Running(line) => {
                if let Some(report) = line.measure(&checked) {
                    self.note(&report);
                }
                self.look_at_log(&checked);
            }
        }
    }

    /// Whether a message claims a time that the IMU is nowhere near.
    fn is_from_the_future(&self, received: &Received) -> bool {
        match &self.stage {
            Stage::Levelling(_) => false,
            Stage::Running(line) => (received.message.time() - line.now()).as_seconds() > LOST,
        }
    }

    fn emit(&mut self, solution: Solution) {
        if !checks::is_sound(&solution) {
            self.enter(solution.time, Mode::Fault, Facts::default(), None);
            self.start_over(solution.time, ModeReason::StartedOver);
            return;
        }
        self.surveyor.see(&solution);
        let judged = self.judged(solution);
        self.enter(judged.time, judged.mode, self.facts(), None);
        self.tell_source(&judged);
        if self.shunned.is_none() {
            self.outputs.push_back(Output::Solution(judged));
        }
    }

    /// Takes the mode as it is now, and tells a change.
    fn enter(&mut self, time: Time, to: Mode, facts: Facts, why: Option<ModeReason>) {
        let to = if self.shunned.is_some() { Mode::Standby } else { to };
        if let Some(event) = self.machine.enter(time, to, facts, why) {
            self.tell(event);
        }
    }

    fn facts(&self) -> Facts {
        match &self.stage {
            Stage::Levelling(_) => Facts::default(),
            Stage::Running(line) => Facts::of(line.estimator()),
        }
    }

    /// The IMU is heard, for the first time or again.
    fn leave_standby(&mut self, time: Time) {
        let to = match &self.stage {
            Stage::Levelling(_) => Mode::CoarseAlignment,
            Stage::Running(line) => line.estimator().solution().mode,
        };
        let why = self.resumption.as_ref().map(|_| ModeReason::Resumed);
        self.enter(time, to, self.facts(), why);
    }

    /// While others are heard, an IMU that is not has failed.
    fn note_silence(&mut self, receipt: Time) {
        let silent = self.heard.is_some_and(|heard| (receipt - heard).as_seconds() > SILENT);
        if silent {
            self.enter(receipt, Mode::Standby, self.facts(), None);
        }
    }

    fn tell(&mut self, event: Event) {
        self.outputs.push_back(Output::Event(event));
    }
}
