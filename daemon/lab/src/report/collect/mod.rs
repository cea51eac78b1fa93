//! What a report needs of a recording, gathered in one pass and in a bounded room.

pub(crate) mod aids;
pub(crate) mod alerts;
pub(crate) mod berths;
pub(crate) mod border;
pub(crate) mod journal;
pub(crate) mod lane;
pub(crate) mod modes;
pub(crate) mod motion;
pub(crate) mod said;
pub(crate) mod satellites;
pub(crate) mod trust;

use insd_base::{Arrival, Event, Input, Span, Time};
use insd_config::Config;
use insd_engine::Output;
use insd_vessel::{Names, Pipeline, Product, Spoken, words};

use self::aids::Aids;
use self::alerts::Alerts;
use self::berths::Berths;
use self::border::Border;
use self::journal::Journal;
use self::modes::Modes;
use self::motion::Motion;
use self::said::Said;
use self::satellites::Satellites;
use self::trust::Trust;
use super::statistics::Statistics;
use super::times::Times;

/// Spacing of looks at the clocks.
const LOOK: Span = Span::from_nanos(1_000_000_000);

/// What has been gathered.
#[derive(Clone, Debug)]
pub(crate) struct Collected {
    pub(crate) times: Times,
    pub(crate) motion: Motion,
    pub(crate) modes: Modes,
    pub(crate) trust: Trust,
    pub(crate) aids: Aids,
    pub(crate) satellites: Satellites,
    pub(crate) alerts: Alerts,
    pub(crate) berths: Berths,
    pub(crate) border: Border,
    pub(crate) said: Said,
    pub(crate) journal: Journal,
    /// Gaps in the IMU data that were bridged, s.
    pub(crate) imu_gaps: Statistics,
    pub(crate) departures: u64,
    pub(crate) resets: u64,
    looked: Option<Time>,
}

impl Collected {
    /// Nothing yet, of a recording that begins here; solutions will come so often, Hz.
    pub(crate) fn new(start: Time, rate: f64) -> Self {
        Collected {
            times: Times::new(start),
            motion: Motion::new(start, rate),
            modes: Modes::new(start),
            trust: Trust::new(),
            aids: Aids::new(start),
            satellites: Satellites::default(),
            alerts: Alerts::new(start),
            berths: Berths::default(),
            border: Border::new(start),
            said: Said::default(),
            journal: Journal::new(),
            imu_gaps: Statistics::default(),
            departures: 0,
            resets: 0,
            looked: None,
        }
    }

    /// Takes an arrival that the pipeline has handled.
    pub(crate) fn arrival(&mut self, arrival: &Arrival, pipeline: &Pipeline<Config>) {
        let now = arrival.stamp.monotonic;
        if self.looked.is_none_or(|last| now - last >= LOOK) {
            self.looked = Some(now);
            let utc = pipeline.utc_at(now);
            self.times.note(now, utc);
            self.border.clocks(&arrival.stamp, utc);
            self.berths.name(pipeline.outputs().station().berths());
        }
        self.times.note(now, None);
        let station = pipeline.outputs().station();
        if arrival.input == Input::Tick && !station.ports().is_empty() {
            for view in self.alerts.look(now, station.alerts().views()) {
                self.journal.write(now, "alert", words::alert(&view));
            }
        }
    }

    /// Takes what came of an arrival at this moment.
    pub(crate) fn product(&mut self, now: Time, names: &Names, product: &Product) {
        match product {
            Product::Engine(output) => self.engine(now, output),
            Product::Intake(event) => {
                let (kind, text) = words::border(names, event);
                self.journal.write(event.time, kind, text);
                self.border.event(event);
            }
            Product::Spoken(Spoken::Messages(port, messages)) => self.said.take(*port, messages),
            Product::Spoken(Spoken::Epochs(epochs)) => {
                if let Some(heave) = epochs.first().and_then(|epoch| epoch.heave) {
                    self.motion.heave(&heave);
                }
                let docking = epochs.first().and_then(|epoch| epoch.docking);
                docking.iter().for_each(|docking| self.berths.note(docking));
            }
            Product::Order(obeyed) => self.journal.write(now, "order", words::order(obeyed)),
            Product::Vote(vote) => self.journal.write(now, "engines", words::vote(vote)),
            Product::Watch(change) => self.journal.write(now, "watch", words::watch(change)),
            Product::Command(own) => {
                let host = own.who.host.as_deref().unwrap_or("the bridge");
                let outcome = if own.obeyed { "" } else { ", which was refused" };
                let line = format!("{host}: {}{outcome}", words::command(own));
                self.journal.write(now, "command", line);
            }
            Product::Spare(..) => {}
        }
    }

    /// Takes what the engine said at this moment.
    pub(crate) fn engine(&mut self, now: Time, output: &Output) {
        match output {
            Output::Solution(solution) => {
                let passed = self.motion.solution(solution);
                self.modes.solution(solution.time, solution.mode, passed);
                self.trust.solution(solution, passed);
            }
            Output::Innovation(innovation) => {
                self.aids.innovation(now, innovation);
            }
            Output::Satellite(told) => {
                self.aids.satellite(now, told);
                self.satellites.take(told);
            }
            Output::Alignment(_) => {}
            Output::Event(event) => self.event(now, event),
        }
    }

    fn event(&mut self, now: Time, event: &Event) {
        match words::engine(event) {
            (kind, Some(text)) => self.journal.write(now, kind, text),
            (kind, None) => self.journal.count(kind),
        }
        match event {
            Event::Rejected { aid, .. } => self.aids.rejected(now, aid),
            Event::ImuGap { missing, .. } => self.imu_gaps.add(*missing),
            Event::LeftBerth { .. } => self.departures += 1,
            Event::PositionReset { .. } => self.resets += 1,
            _ => {}
        }
        self.modes.event(event);
        self.trust.event(event);
    }

    /// The recording ends.
    pub(crate) fn finish(&mut self) {
        let end = self.times.end();
        self.alerts.finish(end);
        self.border.finish(end);
        self.satellites.finish();
    }
}
