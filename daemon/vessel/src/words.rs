//! Events and states in words.

use insd_base::{AlertOrder, Event, Mode, SatelliteId};
use insd_engine::vote::VoteEvent;
use insd_intake::choice::{Chosen, Quantity, Why};
use insd_intake::clock::{PulseFault, TimeChange, TimeQuality};
use insd_intake::event::{BroadcastFault, Happening, IntakeEvent};
use insd_output::alerts::AlertView;
use insd_wire::nmea::{Acn, AlertCommand, AlertPriority, AlertState};

use crate::names::Names;
use crate::outputs::Commanded;
use crate::pipeline::Obeyed;
use crate::spares::Vote;
use crate::watch::WatchChange;

/// What the system does, in a few words.
#[must_use]
pub fn mode(mode: Mode) -> &'static str {
    match mode {
        Mode::Standby => "no data of the IMU",
        Mode::CoarseAlignment => "levelling and seeking north",
        Mode::FineAlignment => "aligning at the berth",
        Mode::InMotionAlignment => "aligning under way",
        Mode::Aided => "navigating with GNSS",
        Mode::DeadReckoning => "dead reckoning, no GNSS",
        Mode::Inertial => "on the IMU alone",
        Mode::Fault => "fault",
    }
}

fn resumed(gap: f64) -> String {
    format!("goes on from before the restart, over a gap of {gap:.2} s")
}

/// An event of the engine: its kind, and its words unless it is only counted.
#[must_use]
pub fn engine(event: &Event) -> (&'static str, Option<String>) {
    match event {
        Event::ModeChanged { to, why, .. } => ("mode", Some(format!("{}: {why}", mode(*to)))),
        Event::Rejected { .. } => ("measurement rejected", None),
        Event::ImuGap { missing, .. } => {
            ("IMU gap", Some(format!("{missing:.3} s of IMU data were missing and bridged")))
        }
        Event::ImuClock { step, .. } => (
            "IMU clock",
            Some(format!("the clock of the IMU stepped by {step:.2} s; it is set back")),
        ),
        Event::LeftBerth { .. } => ("departure", Some("she left her berth".to_owned())),
        Event::StoredStateUsed { .. } => {
            ("stored state", Some("the sensors have confirmed the stored heading".to_owned()))
        }
        Event::StoredStateDropped { reason, .. } => {
            let reason = reason.as_str().replace('_', " ");
            ("stored state", Some(format!("the stored state is not believed: {reason}")))
        }
        Event::Resumed { gap, .. } => ("restart", Some(resumed(*gap))),
        Event::ResumeConfirmed { .. } => {
            ("restart", Some("the sensors confirm the state before the restart".to_owned()))
        }
        Event::ResumeDropped { reason, .. } => {
            let reason = reason.as_str().replace('_', " ");
            ("restart", Some(format!("the sensors refute the state before the restart: {reason}")))
        }
        Event::InstallationFound { finding, .. } => ("installation", Some(finding.to_string())),
        Event::Judged { stands, .. } => ("sensors", Some(stands.to_string())),
        Event::ReceiverUsed { change, .. } => ("sensors", Some(change.to_string())),
        Event::SatelliteJudged { satellite, is_excluded: true, .. } => (
            "satellite",
            Some(format!("{satellite} is left out: its ranges contradict the others")),
        ),
        Event::SatelliteJudged { satellite, .. } => {
            ("satellite", Some(format!("{satellite} is used again")))
        }
        Event::RtkJudged { turn, .. } => ("RTK", Some(turn.to_string())),
        Event::CompassJudged { why_not: None, .. } => {
            ("antennas", Some("the antennas tell how she stands".to_owned()))
        }
        Event::CompassJudged { why_not: Some(why), .. } => {
            ("antennas", Some(format!("the antennas do not tell how she stands: {why}")))
        }
        Event::RangingJudged { ranging, turn, .. } => {
            ("docking aid", Some(format!("number {}: {turn}", ranging + 1)))
        }
        Event::Learnt { turn, .. } => ("learning", Some(turn.to_string())),
        Event::CameraJudged { turn, .. } => ("camera", Some(turn.to_string())),
        Event::SourceChanged { to, why, .. } => {
            ("source", Some(format!("best source {}: {why}", to.as_str())))
        }
        Event::PositionReset { .. } => {
            let words = "the position was set anew from a source that was kept out for too long";
            ("position reset", Some(words.to_owned()))
        }
    }
}

/// A command of the bridge about an alert.
#[must_use]
pub fn command(commanded: &Commanded) -> String {
    let Acn { alert, command, .. } = &commanded.command;
    let what = match command {
        AlertCommand::Acknowledge => "acknowledge",
        AlertCommand::Request => "tell again",
        AlertCommand::Transfer => "take over",
        AlertCommand::Silence => "silence",
    };
    format!("{what} alert {}", alert.identifier)
}

/// What became of an order.
#[must_use]
pub fn order(obeyed: &Obeyed) -> String {
    match obeyed {
        Obeyed::Alert { identifier, command, done } => {
            let command = match command {
                AlertOrder::Acknowledge => "acknowledged",
                AlertOrder::Silence => "silenced",
            };
            let refused = if *done { "" } else { ", which could not be done" };
            format!("alert {identifier} {command} on the page{refused}")
        }
        Obeyed::Berth { name: Some(name), done: true } => format!("berth {name} is chosen"),
        Obeyed::Berth { name: Some(name), .. } => format!("there is no berth {name}"),
        Obeyed::Berth { name: None, .. } => "the nearest berth is proposed".to_owned(),
        Obeyed::Configured(change) if change.waiting.is_empty() => {
            "another configuration holds".to_owned()
        }
        Obeyed::Configured(change) => {
            format!(
                "another configuration holds; for the next start: {}",
                change.waiting.join(", ")
            )
        }
        Obeyed::ConfigurationRefused(_) => "a configuration with faults was not taken".to_owned(),
        Obeyed::Resumed => "a state of the run before is gone on from".to_owned(),
        Obeyed::NotResumed(doubt) => {
            format!("what the run before left is no use: {}", doubt.as_str().replace('_', " "))
        }
        Obeyed::StoredStateOffered => "the heading stored at the berth is on offer".to_owned(),
        Obeyed::StoredStateRefused(fault) => format!("the heading stored at the berth: {fault}"),
        Obeyed::LearntOffered => "what was learnt of the sensors is gone on from".to_owned(),
        Obeyed::LearntRefused(fault) => format!("what was learnt of the sensors: {fault}"),
        Obeyed::LearntUse(true) => "what is learnt of the sensors may be used".to_owned(),
        Obeyed::LearntUse(false) => "what is learnt of the sensors is not used".to_owned(),
    }
}

/// What was found of the engines.
#[must_use]
pub fn vote(vote: &Vote) -> String {
    match vote.event {
        VoteEvent::Differ { disagreement, .. } => {
            let (one, other) = disagreement.between;
            let what = disagreement.difference.quantity.as_str();
            format!("{} and {} differ in {what}", vote.name(one), vote.name(other))
        }
        VoteEvent::Wrong { engine, why, .. } => {
            format!("{} is taken as wrong: {}", vote.name(engine), why.as_str().replace('_', " "))
        }
        VoteEvent::Agree { between: (one, other), .. } => {
            format!("{} and {} agree again", vote.name(one), vote.name(other))
        }
        VoteEvent::Switched { from, to, .. } => {
            format!("outputs come from {} instead of {}", vote.name(to), vote.name(from))
        }
    }
}

/// What was found of a reference that is watched.
#[must_use]
pub fn watch(change: &WatchChange) -> String {
    change.comparison.to_string()
}

/// An event of the border: its kind and its words.
#[must_use]
pub fn border(names: &Names, event: &IntakeEvent) -> (&'static str, String) {
    let name = |sensor: usize| names.sensor(sensor);
    match &event.what {
        Happening::Port { port, state } => ("port", format!("{}: {}", names.port(*port), state)),
        Happening::Bus { port, event } => ("CAN bus", format!("{}: {event}", names.port(*port))),
        Happening::Device { sensor, device } => {
            let known = device.name.map_or("NAME not known".to_owned(), |name| name.to_string());
            ("device", format!("{}: address {}, {known}", name(*sensor), device.address))
        }
        Happening::SensorSpeaks { sensor } => ("sensor speaks", name(*sensor).to_owned()),
        Happening::SensorSilent { sensor } => ("sensor silent", name(*sensor).to_owned()),
        Happening::SensorValid { sensor, valid, status } => {
            let validity = if *valid { "valid" } else { "not valid" };
            ("sensor validity", format!("{}: {validity}, status {status:#x}", name(*sensor)))
        }
        Happening::SamplesLost { sensor, count } => {
            ("samples lost", format!("{}: {count} by its counter", name(*sensor)))
        }
        Happening::DeviceClockStepped { sensor, by } => {
            ("device clock", format!("{}: stepped by {by:.3} s and tied anew", name(*sensor)))
        }
        Happening::Ranges { sensor, used } => ("satellites", ranges(name(*sensor), *used)),
        Happening::Satellite { sensor, satellite, fault } => {
            let words = satellite_fault(*satellite, fault.as_ref());
            ("satellites", format!("{}: {words}", name(*sensor)))
        }
        Happening::Base { sensor, news } => ("base", format!("{}: {news}", name(*sensor))),
        Happening::Chosen(chosen) => ("source", choice(chosen, name)),
        Happening::Time(change) => ("time", time(change)),
        Happening::SystemClockStepped { by } => {
            ("system clock", format!("the computer's clock stepped by {:.3} s", by.as_seconds()))
        }
    }
}

/// Whether ranges of satellites by a receiver are used.
fn ranges(name: &str, used: bool) -> String {
    if used {
        format!("{name}: the ranges of its satellites are used, not its fixes")
    } else {
        format!("{name}: no ranges of its satellites are used any more")
    }
}

/// What is wrong with what a satellite broadcasts.
#[must_use]
pub fn satellite_fault(satellite: SatelliteId, fault: Option<&BroadcastFault>) -> String {
    fault.map_or_else(
        || format!("{satellite}: what it broadcasts is good again"),
        |fault| format!("{satellite}: {fault}"),
    )
}

/// Another source in words.
#[must_use]
pub fn choice<'a>(chosen: &Chosen, name: impl Fn(usize) -> &'a str) -> String {
    let from = chosen.from.map_or("none", &name);
    let to = chosen.to.map_or("none", &name);
    format!("{}: {to} instead of {from}: {}", quantity(chosen.quantity), why(chosen.why))
}

/// A quantity with several sources.
#[must_use]
pub fn quantity(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Inertial => "inertial",
        Quantity::Gnss => "GNSS",
        Quantity::BottomVelocity => "velocity over the sea bed",
        Quantity::WaterVelocity => "velocity through the water",
        Quantity::Heading => "heading",
        Quantity::Position => "position",
    }
}

/// Why a source is used.
#[must_use]
pub fn why(why: Why) -> &'static str {
    match why {
        Why::First => "the first that is valid",
        Why::Silent => "the one before fell silent",
        Why::Invalid => "the one before says that it is not valid",
        Why::Better => "it is better, and has been valid for a while",
        Why::NoneLeft => "there is none left",
    }
}

/// How UTC is known.
#[must_use]
pub fn time_quality(quality: TimeQuality) -> &'static str {
    match quality {
        TimeQuality::Unknown => "not known",
        TimeQuality::Messages => "from the receipt of messages, to milliseconds or tens of them",
        TimeQuality::Pulses => "from pulses, to microseconds",
    }
}

/// Something about UTC.
#[must_use]
pub fn time(change: &TimeChange) -> String {
    match change {
        TimeChange::Quality(quality) => format!("UTC {}", time_quality(*quality)),
        TimeChange::Stepped { by } => format!("UTC stepped by {by:.3} s"),
        TimeChange::Rollover { weeks } => {
            format!("the receiver is {weeks} weeks behind: corrected")
        }
        TimeChange::LeapSecond => "a leap second was inserted".to_owned(),
        TimeChange::Doubted { late } => format!("an epoch was refused, late by {late:.3} s"),
        TimeChange::Pulse(PulseFault::Off { by }) => format!("a pulse was off by {by:.6} s"),
        TimeChange::Pulse(PulseFault::Lost) => "no pulses for a while".to_owned(),
        TimeChange::Pulse(PulseFault::Unlocked) => {
            "the pulses do not fit the messages and are labelled anew".to_owned()
        }
    }
}

/// How an alert stands.
#[must_use]
pub fn alert(view: &AlertView) -> String {
    let more = match view.escalation {
        0 => String::new(),
        times => format!(", raised again {times} times"),
    };
    let (priority, state) = (priority(view.priority), alert_state(view.state));
    format!("{} {}, {priority}: {state}{more}", view.identifier, view.title)
}

/// How urgent an alert is.
#[must_use]
pub fn priority(priority: AlertPriority) -> &'static str {
    match priority {
        AlertPriority::EmergencyAlarm => "emergency alarm",
        AlertPriority::Alarm => "alarm",
        AlertPriority::Warning => "warning",
        AlertPriority::Caution => "caution",
    }
}

fn alert_state(state: AlertState) -> &'static str {
    match state {
        AlertState::Unacknowledged => "raised, not acknowledged",
        AlertState::Silenced => "silenced",
        AlertState::Acknowledged => "active, known",
        AlertState::Transferred => "taken over by the bridge",
        AlertState::Rectified => "rectified, never acknowledged",
        AlertState::Normal => "over",
    }
}
