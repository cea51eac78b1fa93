//! Events in words, for the journal.

use insd_base::units::DEG;
use insd_base::{Event, Fault, Mode, PortState};
use insd_drivers::ports::{BaudJudge, BaudJudgement};
use insd_engine::Output;
use insd_engine::vote::{Doubt, VoteEvent};
use insd_intake::event::{Happening, IntakeEvent};
use insd_vessel::{Change, Commanded, Names, Obeyed, Product, Vote, words};
use insd_web::SECURITY;
use insd_wire::stream::{Cutter, Protocol};

/// Good frames at which a baud rate is taken as right.
const CONVINCED: usize = 3;

/// Tells what is worth telling of a product.
pub fn tell(names: &Names, product: &Product) {
    match product {
        Product::Intake(event) => tell_event(names, event),
        Product::Engine(Output::Event(event)) => tell_engine(event),
        Product::Engine(Output::Alignment(status)) => tracing::debug!("alignment: {status:?}"),
        Product::Order(obeyed) => tell_order(obeyed),
        Product::Spare(name, Output::Event(Event::ModeChanged { time, to, why, .. })) => {
            let at = time.as_seconds();
            tracing::info!(at, engine = %name, mode = to.as_str(), "mode: {why}");
        }
        Product::Spare(name, Output::Event(event)) => tracing::debug!(engine = %name, ?event),
        Product::Vote(vote) => tell_vote(vote),
        Product::Command(commanded) => tell_command(names, commanded),
        Product::Watch(change) if change.comparison.differ => {
            tracing::warn!("{}", words::watch(change));
        }
        Product::Watch(change) => tracing::info!("{}", words::watch(change)),
        Product::Engine(_) | Product::Spoken(_) | Product::Spare(..) => {}
    }
}

fn tell_command(names: &Names, commanded: &Commanded) {
    let Commanded { who, obeyed, strangers, .. } = commanded;
    let (port, host) =
        (names.port(who.port), who.host.as_deref().unwrap_or("on a line of its own"));
    let command = words::command(commanded);
    if who.may_command {
        tracing::info!(target: SECURITY, port, host, command, obeyed, "a command of the bridge");
    } else {
        let text = "a command is refused: its sender is not listed";
        tracing::warn!(target: SECURITY, port, host, command, strangers, "{text}");
    }
}

fn tell_order(obeyed: &Obeyed) {
    match obeyed {
        Obeyed::Alert { .. } | Obeyed::Berth { .. } | Obeyed::LearntUse(_) => {
            tracing::info!(target: SECURITY, "{}", words::order(obeyed));
        }
        Obeyed::Configured(change) if change.is_nothing() => {
            tracing::info!(target: SECURITY, "the configuration is as it was");
        }
        Obeyed::Configured(Change { inputs, outputs, waiting }) => {
            let text = "another configuration holds; navigation goes on";
            tracing::info!(target: SECURITY, inputs, outputs, "{text}");
            for section in waiting {
                tracing::warn!(section, "changed in the file, and waits for the next start");
            }
        }
        Obeyed::ConfigurationRefused(faults) => {
            let text = "the configuration is not taken, the old one holds";
            tracing::error!(target: SECURITY, "{text}: {faults}");
        }
        Obeyed::Resumed => tracing::info!("navigation goes on from where the run before ended"),
        Obeyed::NotResumed(doubt) => {
            let why = doubt.as_str();
            tracing::warn!(why, "navigation begins anew: what the run before left is no use");
        }
        Obeyed::StoredStateOffered => tracing::info!("the heading stored at the berth is on offer"),
        Obeyed::StoredStateRefused(fault) => {
            tracing::warn!(fault, "no heading stored at the berth");
        }
        Obeyed::LearntOffered => tracing::info!("{}", words::order(obeyed)),
        Obeyed::LearntRefused(_) => tracing::warn!("{}", words::order(obeyed)),
    }
}

/// Changes of what the ship does or knows are worth a line each; refused measurements are counted.
fn tell_engine(event: &Event) {
    match event {
        Event::Rejected { .. } => tracing::debug!(?event, "engine"),
        Event::ModeChanged { time, from, to, why } => {
            let (at, from) = (time.as_seconds(), from.map(Mode::as_str));
            let mode = to.as_str();
            if matches!(to, Mode::Standby | Mode::Fault) {
                tracing::warn!(at, from, mode, "mode: {why}");
            } else {
                tracing::info!(at, from, mode, "mode: {why}");
            }
        }
        Event::ResumeDropped { time, reason } => {
            let (at, why) = (time.as_seconds(), reason.as_str());
            tracing::warn!(at, why, "the state saved before the crash is not believed");
        }
        Event::ImuGap { time, missing } => {
            tracing::warn!(at = time.as_seconds(), missing, "gap in the IMU data bridged");
        }
        Event::ImuClock { time, step } => {
            tracing::warn!(
                at = time.as_seconds(),
                step,
                "the clock of the IMU stepped; it is set back"
            );
        }
        Event::InstallationFound { time, finding } => {
            let (at, paste) = (time.as_seconds(), finding.to_paste());
            tracing::warn!(at, finding = finding.as_str(), paste, "{finding}");
        }
        Event::Judged { time, stands } => {
            let (at, party, standing) =
                (time.as_seconds(), stands.party.as_str(), stands.standing.as_str());
            let fault = stands.fault.map(Fault::as_str);
            tracing::warn!(at, party, standing, fault, "{stands}");
        }
        Event::ReceiverUsed { time, change } => {
            let (at, from, to) = (time.as_seconds(), change.from.as_str(), change.to.as_str());
            tracing::warn!(at, from, to, "{change}");
        }
        Event::PositionReset { .. }
        | Event::RtkJudged { .. }
        | Event::RangingJudged { .. }
        | Event::CameraJudged { .. }
        | Event::Learnt { .. }
        | Event::StoredStateDropped { .. } => {
            let (what, text) = words::engine(event);
            tracing::warn!("{what}: {}", text.unwrap_or_default());
        }
        _ => {
            let (what, text) = words::engine(event);
            tracing::info!("{what}: {}", text.unwrap_or_default());
        }
    }
}

/// Who differs from whom, and whose word goes out.
fn tell_vote(vote: &Vote) {
    match vote.event {
        VoteEvent::Differ { time, disagreement } => {
            let (at, difference) = (time.as_seconds(), disagreement.difference);
            let unit = if difference.quantity.is_angle() { DEG } else { 1.0 };
            let (by, limit) = (difference.value / unit, difference.limit / unit);
            let between = [disagreement.between.0, disagreement.between.1].map(|i| vote.name(i));
            let (what, wrong) = (difference.quantity.as_str(), disagreement.wrong);
            let (wrong, why) = (wrong.map(|(i, _)| vote.name(i)), wrong.map(|(_, d)| d.as_str()));
            let [one, other] = between;
            tracing::warn!(at, one, other, what, by, limit, wrong, why, "engines differ");
        }
        VoteEvent::Wrong { time, engine, why, .. } => {
            let (at, engine, why) = (time.as_seconds(), vote.name(engine), why.as_str());
            tracing::warn!(at, engine, why, "taken as wrong");
        }
        VoteEvent::Agree { time, between } => {
            let (one, other) = (vote.name(between.0), vote.name(between.1));
            tracing::info!(at = time.as_seconds(), one, other, "engines agree again");
        }
        VoteEvent::Switched { time, from, to, why } => {
            let (at, from, to) = (time.as_seconds(), vote.name(from), vote.name(to));
            let why = why.map(Doubt::as_str);
            tracing::warn!(at, from, to, why, "outputs come from another engine");
        }
    }
}

fn tell_port(at: f64, port: &str, state: &PortState) {
    match state {
        PortState::Open { .. } | PortState::Speaking | PortState::Ended => {
            tracing::info!(at, port, "{state}");
        }
        PortState::Absent { .. }
        | PortState::Lost { .. }
        | PortState::Silent { .. }
        | PortState::Overrun { .. } => tracing::warn!(at, port, "{state}"),
        PortState::Refused { host, .. } => {
            tracing::warn!(target: SECURITY, at, port, host, "{state}");
        }
    }
}

fn tell_event(names: &Names, event: &IntakeEvent) {
    let at = event.time.as_seconds();
    let name = |sensor: &usize| names.sensor(*sensor).to_owned();
    match &event.what {
        Happening::Port { port, state } => tell_port(at, names.port(*port), state),
        Happening::Bus { port, event } => {
            tracing::warn!(at, port = names.port(*port), "bus: {event}");
        }
        Happening::Device { sensor, device } => {
            let address = device.address;
            let known = device.name.map_or("not known".to_owned(), |name| name.to_string());
            tracing::info!(at, sensor = name(sensor), address, name = known, "device");
        }
        Happening::SensorSpeaks { sensor } => tracing::info!(at, sensor = name(sensor), "speaks"),
        Happening::SensorSilent { sensor } => tracing::warn!(at, sensor = name(sensor), "silent"),
        Happening::SensorValid { sensor, valid, status } => {
            let (sensor, word) = (name(sensor), format!("{status:#06x}"));
            if *valid {
                tracing::info!(at, sensor, status = word, "valid again");
            } else {
                tracing::warn!(at, sensor, status = word, "says that it is not valid");
            }
        }
        Happening::SamplesLost { sensor, count } => {
            tracing::warn!(at, sensor = name(sensor), count, "samples lost");
        }
        Happening::DeviceClockStepped { sensor, by } => {
            tracing::warn!(at, sensor = name(sensor), by, "device clock stepped");
        }
        Happening::Ranges { sensor, used: true } => {
            tracing::info!(at, sensor = name(sensor), "ranges of satellites are used");
        }
        Happening::Ranges { sensor, .. } => {
            tracing::warn!(at, sensor = name(sensor), "no ranges of satellites any more");
        }
        Happening::Satellite { sensor, satellite, fault } => {
            let words = words::satellite_fault(*satellite, fault.as_ref());
            tracing::info!(at, sensor = name(sensor), "satellite {words}");
        }
        Happening::Base { sensor, news } => {
            tracing::info!(at, sensor = name(sensor), "base: {news}");
        }
        Happening::Chosen(chosen) => {
            let source = words::choice(chosen, |sensor| names.sensor(sensor));
            if chosen.to.is_some() {
                tracing::info!(at, "source of {source}");
            } else {
                tracing::warn!(at, "source of {source}");
            }
        }
        Happening::Time(change) => tracing::info!(at, "time: {}", words::time(change)),
        Happening::SystemClockStepped { by } => {
            tracing::warn!(at, by = by.as_seconds(), "system clock stepped");
        }
    }
}

/// Judges the bytes heard at a baud rate: right if they hold a few good frames of any protocol.
pub(super) fn judge() -> BaudJudge {
    BaudJudge::new(|bytes| {
        let mut cutter = Cutter::new(&Protocol::ALL);
        cutter.push(bytes);
        let mut frames = 0;
        while cutter.cut().is_some() {
            frames += 1;
        }
        if frames >= CONVINCED { BaudJudgement::Fits } else { BaudJudgement::Wrong }
    })
}

#[cfg(test)]
mod tests {
    use insd_base::{PortState, Time};
    use insd_intake::choice::{Chosen, Quantity, Why};
    use insd_intake::clock::{TimeChange, TimeQuality};

    use super::*;
    use crate::logging::sink::Sink;
    use insd_base::PortId;

    /// The line that is written of something that happened.
    fn line(what: Happening) -> String {
        let names = Names { ports: vec!["gnss".to_owned()], sensors: vec!["gnss".to_owned()] };
        let sink = Sink::default();
        let own = sink.clone();
        let writer = tracing_subscriber::fmt().with_ansi(false).with_writer(move || own.clone());
        let event = IntakeEvent { time: Time::from_seconds(1.0), what };
        tracing::subscriber::with_default(writer.finish(), || {
            tell(&names, &Product::Intake(event));
        });
        sink.told()
    }

    #[test]
    fn a_device_that_is_absent_is_a_warning_and_one_that_is_there_is_none() {
        let port = PortId(0);
        let reason = "No such file or directory".to_owned();
        let absent = line(Happening::Port { port, state: PortState::Absent { reason } });
        assert!(absent.contains(" WARN ") && absent.contains("No such file"), "{absent}");
        let what = "/dev/ttyS0".to_owned();
        let open = line(Happening::Port { port, state: PortState::Open { what } });
        assert!(open.contains(" INFO "), "{open}");
    }

    #[test]
    fn the_journal_speaks_in_words() {
        let chosen = |from, to, why| {
            line(Happening::Chosen(Chosen { quantity: Quantity::Gnss, from, to, why }))
        };
        let first = chosen(None, Some(0), Why::First);
        assert!(first.contains("source of GNSS: gnss instead of none: the first that is valid"));
        let lost = chosen(Some(0), None, Why::NoneLeft);
        assert!(lost.contains(" WARN ") && lost.contains("there is none left"), "{lost}");
        let time = line(Happening::Time(TimeChange::Quality(TimeQuality::Pulses)));
        let status = line(Happening::SensorValid { sensor: 0, valid: false, status: 0x3FF });
        assert!(status.contains("0x03ff"), "{status}");
        for text in [first, lost, time, status] {
            assert!(
                !["Some(", "None", "{", "Quality("].iter().any(|own| text.contains(own)),
                "{text}"
            );
        }
    }
}
