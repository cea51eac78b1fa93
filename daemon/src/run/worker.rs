//! What runs on the engine's thread.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::Duration;

use anyhow::Context;
use insd_base::{Arrival, Event, Input, Motion, Order, Span, Stamp, StorageFaults, Time};
use insd_config::{Config, OutputFile, stored};
use insd_drivers::ports::Receiver;
use insd_drivers::raw::Recorder;
use insd_drivers::recording::NavWriter;
use insd_engine::Output;
use insd_output::WakeUp;
use insd_vessel::{Obeyed, Pipeline, Product, Spoken};

use super::connections::{Connections, NOWHERE};
use super::control::Control;
use super::fleet::Fleets;
use super::heart::{Heart, Progress};
use super::journal::{Journal, Note};
use super::report::{Alongside, Report, Slow};
use crate::clock::{HostClock, boot_now};
use crate::state::{Kept, Remains, Saver};

/// Longest wait for an arrival: time passes even when nothing comes.
const TURN: Duration = Duration::from_millis(25);
/// Time between two looks of whoever looks on, s.
const SHOWN: f64 = 0.1;
/// Time between two states that are saved, s.
const SAVED: f64 = 0.25;
/// Time between two states of a ship at her berth that are saved, s.
const BERTH_SAVED: f64 = 60.0;
/// Time between the things that are done once a second, s.
const SECOND: f64 = 1.0;
/// An epoch that begins later than this is late.
const PUNCTUAL: Span = Span::from_nanos(1_000_000);
/// Time between two looks at what moves the ship, s.
const SEA: f64 = 10.0;
/// Time between two accounts of what was sent, s.
const ACCOUNT: f64 = 3600.0;

/// What runs on the engine's thread.
pub(super) struct Worker {
    pub(super) pipeline: Pipeline<Config>,
    pub(super) connections: Connections,
    pub(super) receiver: Receiver,
    pub(super) controls: mpsc::Receiver<Control>,
    pub(super) recorder: Option<Recorder>,
    pub(super) saver: Option<Saver>,
    pub(super) fleets: Fleets,
    pub(super) nav: Option<NavWriter<OutputFile>>,
    pub(super) journal: Journal,
    pub(super) clock: HostClock,
    pub(super) heart: Heart,
    pub(super) agenda: Agenda,
    /// Text of the configuration.
    pub(super) text: String,
}

/// When what was done last, and what was counted.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Agenda {
    progress: Progress,
    shown: Option<Time>,
    saved: Option<Time>,
    berth_saved: Option<Time>,
    learnt_saved: Option<Time>,
    ticked: Option<Time>,
    sea: Option<Time>,
    accounted: Option<Time>,
    /// What could not be written at the last look.
    storage: StorageFaults,
    /// Epochs of the outputs, and how many of them began more than a millisecond late.
    epochs: (u64, u64),
}

/// Whether something is due that is done in an interval; if so, it counts as done.
fn is_due(last: &mut Option<Time>, now: Time, interval: f64) -> bool {
    let due = last.is_none_or(|last| (now - last).as_seconds() >= interval);
    if due {
        *last = Some(now);
    }
    due
}

impl Agenda {
    /// Counts an epoch that begins now.
    fn begin(&mut self, due: &WakeUp, now: Time) {
        let is_late = now - due.at > PUNCTUAL;
        self.epochs = (self.epochs.0 + 1, self.epochs.1 + u64::from(is_late));
        if is_late {
            let late = (now - due.at).as_seconds();
            tracing::debug!(why = ?due.why, late, "an epoch begins late");
        }
    }
}

impl Worker {
    /// Works until it is told to stop.
    pub(super) fn run(mut self, remains: Remains, stop: &AtomicBool) -> anyhow::Result<()> {
        let text = std::mem::take(&mut self.text);
        self.tell_configuration(&text);
        self.go_on_from(remains)?;
        while !stop.load(Ordering::Relaxed) {
            match self.receiver.recv_timeout(self.patience()) {
                Ok(arrival) => self.take(&arrival)?,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            let now = self.clock.now();
            let due = self.pipeline.wake_up(now.monotonic);
            if let Some(due) = due.filter(|due| due.at <= now.monotonic) {
                self.agenda.begin(&due, now.monotonic);
                self.take(&Arrival { stamp: now, port: NOWHERE, input: Input::Tick })?;
            }
            while let Ok(control) = self.controls.try_recv() {
                self.obey(control)?;
            }
            self.attend(&now)?;
        }
        self.finish()
    }

    /// Offers the engine what the run before has left.
    fn go_on_from(&mut self, remains: Remains) -> anyhow::Result<()> {
        for fault in &remains.faults {
            tracing::warn!(fault, "left by the run before, and no use");
        }
        if self.pipeline.reader().learning.enabled {
            // before the navigation of the run before, which brings what it has learnt along
            if let Some(text) = remains.learnt {
                self.order(Order::LearntModel(text))?;
            }
            if !self.pipeline.reader().learning.is_used {
                self.order(Order::UseLearnt(false))?;
            }
        }
        if let Some((age, state)) = remains.navigation
            && self.order(Order::Checkpoint { age, state })? == Some(Obeyed::Resumed)
        {
            return Ok(());
        }
        if let Some(text) = remains.berth {
            self.order(Order::StoredState(text))?;
        }
        Ok(())
    }

    /// How long to wait for an arrival: until something is due.
    fn patience(&self) -> Duration {
        let now = self.clock.now().monotonic;
        let wait =
            |due: WakeUp| Duration::from_nanos((due.at - now).as_nanos().max(0).unsigned_abs());
        self.pipeline.wake_up(now).map_or(TURN, wait).min(TURN)
    }

    /// What is done now and then.
    fn attend(&mut self, now: &Stamp) -> anyhow::Result<()> {
        let time = now.monotonic;
        if self.agenda.progress.is_sound(time) {
            self.heart.beat();
        }
        let is_second = is_due(&mut self.agenda.ticked, time, SECOND);
        if is_second {
            self.tick(now);
            self.look_at_disk(now)?;
        }
        if is_due(&mut self.agenda.saved, time, SAVED) {
            self.save(now);
        }
        if is_second || is_due(&mut self.agenda.shown, time, SHOWN) {
            let with_sea = is_second && is_due(&mut self.agenda.sea, time, SEA);
            let report = self.report(now, is_second, with_sea);
            self.journal.tell(Note::Report(Box::new(report)));
        }
        if is_due(&mut self.agenda.accounted, time, ACCOUNT) {
            self.connections.outputs.tell();
        }
        Ok(())
    }

    /// Tells the pipeline when something cannot be written any more, or can again.
    fn look_at_disk(&mut self, now: &Stamp) -> anyhow::Result<()> {
        let faults = StorageFaults {
            recording: self.recorder.as_ref().is_some_and(|own| own.state().is_failing()),
            state: self.saver.as_ref().is_some_and(|own| own.state().fault.is_some()),
            fleet: self.fleets.is_failing(),
        };
        if faults == self.agenda.storage {
            return Ok(());
        }
        self.agenda.storage = faults;
        self.take(&Arrival { stamp: *now, port: NOWHERE, input: Input::Storage(faults) })
    }

    fn tick(&mut self, now: &Stamp) {
        self.agenda.progress.note(self.pipeline.counts(), now.monotonic);
        if let Some(recorder) = &mut self.recorder {
            recorder.tick(now.monotonic);
        }
        self.connections.time_out.send(now, self.pipeline.utc_at(now.monotonic));
    }

    /// Saves what the next start may go on from.
    fn save(&mut self, now: &Stamp) {
        let Some(saver) = &self.saver else { return };
        if let Some(state) = self.pipeline.checkpoint() {
            saver.navigation(Kept { made: boot_now(now), state });
        }
        if is_due(&mut self.agenda.berth_saved, now.monotonic, BERTH_SAVED) {
            self.save_berth(now.monotonic);
        }
        let interval = self.pipeline.reader().learning.interval_s;
        if is_due(&mut self.agenda.learnt_saved, now.monotonic, interval) {
            self.save_learnt();
        }
    }

    /// Saves what is learnt of the sensors, once there is anything.
    fn save_learnt(&self) {
        let learnt = self.pipeline.engine().learnt().filter(|own| !own.is_empty());
        if let (Some(saver), Some(model)) = (&self.saver, learnt) {
            saver.learnt(model);
        }
    }

    fn save_berth(&self, now: Time) {
        let state = self.pipeline.engine().stored_state();
        let (Some(saver), Some(state)) = (&self.saver, state) else { return };
        let utc = self.pipeline.utc_at(now).map(insd_config::calendar::rfc3339).unwrap_or_default();
        match stored::text(&state, &utc) {
            Ok(text) => saver.berth(text),
            Err(error) => tracing::warn!(%error, "the state at the berth cannot be put into words"),
        }
    }

    fn report(&self, now: &Stamp, is_second: bool, with_sea: bool) -> Report {
        let (pipeline, outputs) = (&self.pipeline, self.pipeline.outputs());
        let motion = pipeline.motion();
        let docking = pipeline.docking(motion.as_ref(), now.monotonic);
        let plan = |own: &Motion| outputs.station().berths().plan(own);
        let outline = motion.as_ref().filter(|_| docking.is_some()).map(plan).unwrap_or_default();
        Report {
            stamp: *now,
            utc: self.pipeline.utc_at(now.monotonic),
            mode: pipeline.mode(),
            motion,
            heave: pipeline.heave(),
            alongside: docking.map(|docking| Alongside { docking, outline }),
            alignment: outputs.alignment(),
            alerts: outputs.station().alerts().views().collect(),
            engines: pipeline.engines(),
            heard: pipeline.heard().collect(),
            slow: is_second.then(|| Box::new(self.slow(now.monotonic, with_sea))),
        }
    }

    fn slow(&self, now: Time, with_sea: bool) -> Slow {
        let (epochs, late) = self.agenda.epochs;
        Slow {
            intake: self.pipeline.status(),
            attempts: self.connections.attempts(),
            counts: self.pipeline.counts().clone(),
            outputs: self.connections.outputs.status(),
            nodes: self.connections.buses.status(),
            recorder: self.recorder.as_ref().map(Recorder::state),
            saver: self.saver.as_ref().map(Saver::state),
            fleets: self.fleets.status(),
            disputes: self.pipeline.disputes(),
            watched: self.pipeline.watched(now),
            estimates: self.pipeline.engine_in_use().estimates(),
            sky: self.pipeline.engine_in_use().sky(),
            standings: self.pipeline.engine_in_use().standings().collect(),
            findings: self.pipeline.engine_in_use().findings().to_vec(),
            learning: self.pipeline.engine_in_use().learning(),
            disturbance: with_sea.then(|| self.pipeline.engine_in_use().disturbance()).flatten(),
            epochs: [epochs, late, self.pipeline.outputs().station().skipped()],
            untold: self.journal.lost(),
        }
    }

    fn obey(&mut self, control: Control) -> anyhow::Result<()> {
        let obeyed = match control.order {
            Order::Configuration(text) => self.configure(text)?,
            order => self.order(order)?,
        };
        if let Some(obeyed) = obeyed {
            // who asked may have stopped waiting
            let _ = control.reply.send(obeyed);
        }
        Ok(())
    }

    /// Another configuration: what it has otherwise is closed, what has arrived there until then is taken
    /// under the old one, and only then does the new one hold.
    fn configure(&mut self, text: String) -> anyhow::Result<Option<Obeyed>> {
        let Ok(next) = Config::of_text(&text) else {
            return self.order(Order::Configuration(text));
        };
        let (next, change) = next.succeeding(self.pipeline.reader());
        if change.inputs || change.outputs {
            self.connections.close_changed(&next);
            while let Ok(arrival) = self.receiver.try_recv() {
                self.take(&arrival)?;
            }
        }
        let obeyed = self.order(Order::Configuration(text.clone()))?;
        self.tell_configuration(&text);
        let made = self.pipeline.outputs().station().ports();
        self.connections.reopen(self.pipeline.reader(), made);
        Ok(obeyed)
    }

    fn tell_configuration(&self, text: &str) {
        let (config, text) = (Box::new(self.pipeline.reader().clone()), text.to_owned());
        self.journal.tell(Note::Configuration(config, text));
    }

    /// Gives the pipeline an order, which is recorded like all that arrives; what became of it.
    fn order(&mut self, order: Order) -> anyhow::Result<Option<Obeyed>> {
        let arrival =
            Arrival { stamp: self.clock.now(), port: NOWHERE, input: Input::Order(order) };
        let mut obeyed = None;
        self.handle(&arrival, &mut |own| obeyed = Some(own.clone()))?;
        Ok(obeyed)
    }

    fn take(&mut self, arrival: &Arrival) -> anyhow::Result<()> {
        if !Connections::is_input(arrival) {
            self.connections.outputs.note(arrival);
            return Ok(());
        }
        self.handle(arrival, &mut |_| {})
    }

    fn handle(&mut self, arrival: &Arrival, obeyed: &mut dyn FnMut(&Obeyed)) -> anyhow::Result<()> {
        if let Some(recorder) = &mut self.recorder {
            recorder.record(arrival);
        }
        let connections = &mut self.connections;
        let (nav, journal, clock) = (&mut self.nav, &self.journal, &self.clock);
        let mut written = Ok(());
        self.pipeline.handle(arrival, |product| match product {
            Product::Engine(Output::Solution(solution)) => {
                if let (Some(nav), true) = (nav.as_mut(), written.is_ok()) {
                    written = nav.write(&solution);
                }
            }
            Product::Engine(Output::Satellite(told)) => {
                nav.iter_mut().for_each(|nav| nav.hear_satellite(&told));
            }
            Product::Spoken(Spoken::Messages(port, messages)) => connections.send(port, &messages),
            Product::Spoken(Spoken::Epochs(epochs)) => {
                connections.buses.send(&epochs, clock.now().monotonic);
            }
            product => {
                match &product {
                    Product::Order(own) => obeyed(own),
                    Product::Engine(Output::Event(Event::SatelliteJudged {
                        satellite,
                        is_excluded,
                        ..
                    })) => nav.iter_mut().for_each(|nav| nav.leave_out(*satellite, *is_excluded)),
                    _ => {}
                }
                journal.tell(Note::Product(product));
            }
        });
        written.context("cannot write the solution")
    }

    fn finish(self) -> anyhow::Result<()> {
        let now = self.clock.now();
        self.save_berth(now.monotonic);
        self.save_learnt();
        if let (Some(saver), Some(state)) = (&self.saver, self.pipeline.checkpoint()) {
            saver.navigation(Kept { made: boot_now(&now), state });
        }
        if let Some(saver) = self.saver {
            saver.finish();
        }
        self.connections.outputs.tell();
        let skipped = self.pipeline.outputs().station().skipped();
        let (epochs, late) = self.agenda.epochs;
        tracing::info!(epochs, late, skipped, "epochs, and those begun more than 1 ms late");
        if let Some(recorder) = self.recorder {
            let state = recorder.finish();
            let (bytes, files) = (state.written.bytes, state.written.files);
            let (left_out, fault) = (state.written.dropped, state.fault.map(|own| own.to_string()));
            tracing::info!(bytes, files, left_out, fault, "recording ended");
        }
        match self.nav {
            Some(nav) => nav.finish().context("cannot write the solution")?.finish(),
            None => Ok(()),
        }
    }
}
