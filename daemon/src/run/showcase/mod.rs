//! The page's side of the journal: from reports and events to snapshots of everything
//! ([`insd_web::snapshot`]).

mod aids;
mod alerts;
mod alignment;
mod docking;
mod engines;
mod learning;
mod meaning;
mod ports;
mod program;
mod rates;
mod sensors;
mod ship;
mod sky;
mod spans;
#[cfg(test)]
mod tests;
mod watched;

use insd_base::{Event, ModeReason, Rejection, Span, Time, UtcTime};
use insd_config::{Config, calendar};
use insd_engine::Output;
use insd_vessel::{Dispute, Names, Obeyed, Product};
use insd_web::Publisher;
use insd_web::snapshot::{
    MAX_MODES, MAX_REJECTIONS, Rejected, ShownMode, ShownTransition, Snapshot,
};

use super::journal::Audience;
use super::report::{Report, Slow};
use crate::logging::Log;

use aids::Aids;
pub(super) use program::{Origin, hash};
use rates::Rates;
use spans::age;

/// Keeps what is shown, and shows it.
pub(super) struct Showcase {
    publisher: Publisher,
    log: Log,
    origin: Origin,
    config: Config,
    shown: Snapshot,
    /// When the mode that is shown changed last, and to which.
    mode_since: Time,
    mode_told: String,
    /// The last change of the source of the solutions.
    source: Option<ship::SourceTold>,
    /// What engines were found to differ in, when that was looked at last.
    disputes: Vec<Dispute>,
    aids: Aids,
    input_rates: Rates,
    sensor_rates: Rates,
    output_rates: Rates,
    /// When each alert changed last, by its identifier.
    alerts: alerts::Changes,
    /// UTC at the last report, if it was known.
    utc: Option<UtcTime>,
    /// When that was.
    now: Time,
}

impl Showcase {
    /// Nothing is shown yet.
    pub(super) fn new(publisher: Publisher, log: Log, config: &Config, origin: Origin) -> Self {
        Showcase {
            publisher,
            log,
            shown: Snapshot { program: origin.program(), ..Snapshot::default() },
            origin,
            config: config.clone(),
            mode_since: Time::START,
            mode_told: String::new(),
            source: None,
            disputes: Vec::new(),
            aids: Aids::default(),
            input_rates: Rates::default(),
            sensor_rates: Rates::default(),
            output_rates: Rates::default(),
            alerts: alerts::Changes::default(),
            utc: None,
            now: Time::START,
        }
    }

    /// An instant of the ship's time line in UTC, if that is known now.
    fn utc(&self, time: Time) -> Option<String> {
        self.utc.map(|utc| calendar::rfc3339_millis(utc.plus(time - self.now)))
    }

    fn hear_event(&mut self, event: &Event) {
        match event {
            Event::ModeChanged { time, from, to, why } => {
                let reason = Some(why.to_string());
                self.shown.mode.reason.clone_from(&reason);
                let from = from.map(|from| from.as_str().to_owned());
                self.enter(*time, from, to.as_str(), reason);
            }
            Event::SourceChanged { time, to, why, .. } => self.source = Some((*time, *to, *why)),
            // what is passed over is counted, and would push all others out of the list
            Event::Rejected { reason: Rejection::RangesInUse, .. } => {}
            Event::Rejected { time, source, aid, reason } => {
                let rejected = Rejected {
                    at_s: time.as_seconds(),
                    utc: self.utc(*time),
                    source: source.name().to_owned(),
                    aid: (*aid).to_owned(),
                    reason: reason.as_str().to_owned(),
                };
                keep(&mut self.shown.rejections, rejected, MAX_REJECTIONS);
            }
            _ => {}
        }
    }

    /// Another mode is shown from here on.
    fn enter(&mut self, time: Time, from: Option<String>, to: &str, reason: Option<String>) {
        if self.mode_told == to {
            return;
        }
        to.clone_into(&mut self.mode_told);
        self.mode_since = time;
        let (at_s, utc, to) = (time.as_seconds(), self.utc(time), to.to_owned());
        keep(&mut self.shown.modes, ShownTransition { at_s, utc, from, to, reason }, MAX_MODES);
    }

    /// The mode as everybody sees it may be another than the engine's, which does not know how late it is:
    /// that change, and the one back, are told with the others.
    fn follow_mode(&mut self, now: Time) {
        let seen = self.shown.after(0.0).mode;
        // before the first word of the engine there is none to differ from
        if seen.name == self.mode_told || self.mode_told.is_empty() {
            return;
        }
        let from = Some(self.mode_told.clone());
        if seen.name == self.shown.mode.name {
            self.enter(now, from, &seen.name, Some(ModeReason::ImuHeard.to_string()));
        } else {
            let since = now + Span::from_seconds(-seen.since_s);
            self.enter(since, from, &seen.name, seen.reason);
        }
    }

    /// Shows how everything stood so long ago, s.
    pub(super) fn show(&mut self, report: &Report, told_ago: f64) {
        self.see_fast(report);
        if let Some(slow) = &report.slow {
            self.see_slow(report, slow);
        }
        self.shown.time.told_ago_s = told_ago;
        self.follow_mode(report.stamp.monotonic);
        self.publisher.publish(self.shown.clone());
    }

    fn see_slow(&mut self, report: &Report, slow: &Slow) {
        let now = report.stamp.monotonic;
        self.input_rates.note(now, slow.intake.ports.iter().map(|port| port.counts.bytes));
        self.sensor_rates.note(now, slow.intake.sensors.iter().map(|sensor| sensor.passed));
        self.output_rates.note(now, slow.outputs.iter().map(|output| output.status.bytes));
        let shown = &mut self.shown;
        shown.sensors = sensors::sensors(&self.config, slow, &self.sensor_rates, now);
        shown.choices = sensors::choices(&self.config, slow);
        shown.sky = sky::sky(&self.config, slow, now);
        shown.inputs = ports::inputs(&self.config, slow, &self.input_rates, now);
        shown.outputs = ports::outputs(&self.config, slow, &self.output_rates);
        shown.buses = ports::buses(&self.config, slow);
        shown.schedule = ports::schedule(slow);
        shown.aids = self.aids.aids(&slow.counts, now);
        shown.samples = aids::samples(&slow.counts);
        shown.recording = program::recording(&self.config, slow);
        self.disputes.clone_from(&slow.disputes);
        shown.watched = slow.watched.iter().map(|own| watched::shown(own, now)).collect();
        shown.estimates = slow.estimates.as_ref().map(engines::estimates);
        shown.standings = engines::standings(&slow.standings);
        shown.installation = engines::installation(&slow.findings);
        shown.learning = slow.learning.as_ref().map(learning::learning);
        if let Some(disturbance) = &slow.disturbance {
            shown.disturbance = Some(engines::disturbance(disturbance));
        }
        shown.saving = slow.saver.as_ref().map(program::saving);
        shown.fleets = slow.fleets.iter().map(program::fleet).collect();
        shown.log.lost = slow.untold;
        shown.log.level = self.log.level();
        shown.log.repeats = self.log.repeats().total();
        shown.events = self.log.recent();
        (shown.time.quality, shown.time.sigma_s) = program::time_quality(&slow.intake.time);
        self.origin.measure(&mut shown.program);
    }

    fn see_fast(&mut self, report: &Report) {
        let (now, stamp) = (report.stamp.monotonic, &report.stamp);
        (self.now, self.utc) = (now, report.utc);
        self.shown.program.uptime_s = now.as_seconds();
        self.shown.time.at_s = now.as_seconds();
        self.shown.time.utc = report.utc.map(calendar::rfc3339_millis);
        self.shown.time.system_utc = Some(calendar::rfc3339_millis(stamp.system));
        self.shown.mode = ShownMode {
            name: report.mode.as_str().to_owned(),
            since_s: (now - self.mode_since).as_seconds(),
            reason: self.shown.mode.reason.take(),
        };
        let motion = report.motion.as_ref();
        self.shown.motion = motion.map(|motion| {
            let told = self.source.as_ref();
            let source = ship::source(&motion.solution, told, now, |t| self.utc(t));
            insd_web::snapshot::ShownMotion {
                source,
                ..ship::motion(motion, report.heave, |t| self.utc(t))
            }
        });
        let alongside = report.alongside.as_ref();
        self.shown.docking = alongside.and_then(|own| docking::docking(&self.config, own));
        let status = report.alignment.as_ref();
        self.shown.alignment = status.map(|own| alignment::alignment(own, now, |t| self.utc(t)));
        self.shown.alerts = self.alerts.alerts(report);
        self.shown.engines = engines::engines(report, &self.disputes);
        let rows = self.shown.sensors.iter_mut().zip(&report.heard);
        rows.for_each(|(row, heard)| row.age_s = age(now, *heard));
    }
}

impl Audience for Showcase {
    fn hear(&mut self, _: &Names, product: &Product) {
        match product {
            Product::Engine(Output::Event(event)) => self.hear_event(event),
            Product::Engine(Output::Innovation(innovation)) => self.aids.note(innovation),
            Product::Engine(Output::Satellite(told)) => self.aids.note_satellite(told),
            Product::Order(Obeyed::Configured(_)) => {
                self.shown.program.configuration_read_at_s = Some(self.now.as_seconds());
            }
            _ => {}
        }
    }

    fn configure(&mut self, config: &Config, text: &str) {
        self.config = config.clone();
        self.shown.program.configuration_hash = Some(program::hash(text));
        self.shown.berths = config.berths.iter().map(|berth| berth.name.clone()).collect();
        self.shown.program.simulated = config.outputs.iter().any(|output| output.simulated);
    }

    fn see(&mut self, report: &Report) {
        let now = self.origin.clock.now().monotonic;
        self.show(report, (now - report.stamp.monotonic).as_seconds().max(0.0));
    }
}

/// Puts something behind the others, and forgets the oldest beyond so many.
fn keep<T>(all: &mut Vec<T>, one: T, most: usize) {
    if all.len() >= most {
        all.remove(0);
    }
    all.push(one);
}
