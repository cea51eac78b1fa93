//! Ports and buses.

use insd_base::{BusEvent, PortState as State, Time};
use insd_config::{Config, OutputSection, PortSection};
use insd_drivers::ports::{AgeStatus, Destination, Transport};
use insd_intake::status::PortStatus;
use insd_web::snapshot::{
    Age, Bus, BusNode, BusState, OutputMessage, Schedule, ShownInput, ShownOutput, ShownPortState,
};

use super::super::outputs::OutputReport;
use super::super::report::Slow;
use super::rates::Rates;
use super::spans::{age, ms};

pub(super) fn inputs(config: &Config, slow: &Slow, rates: &Rates, now: Time) -> Vec<ShownInput> {
    let ports = config.ports.iter().zip(&slow.intake.ports).enumerate();
    let input = |(index, (section, status)): (usize, (&PortSection, &PortStatus))| {
        let attempts = slow.attempts.get(index).copied().unwrap_or_default();
        ShownInput {
            name: status.name.clone(),
            transport: transport(&section.transport).to_owned(),
            what: status.told.what.clone().unwrap_or_default(),
            state: state(status.told.state.as_ref()),
            bytes: status.counts.bytes,
            rate_bytes_s: rates.rate(index),
            age_s: age(now, status.heard),
            frames: status.counts.frames,
            damaged: status.counts.damaged,
            skipped_bytes: status.counts.skipped,
            overrun_bytes: status.told.overrun,
            refused: status.told.refused,
            reopened: attempts.saturating_sub(1),
            last_error: status.told.trouble.clone(),
        }
    };
    ports.map(input).collect()
}

pub(super) fn outputs(config: &Config, slow: &Slow, rates: &Rates) -> Vec<ShownOutput> {
    let output = |(index, report): (usize, &OutputReport)| {
        let is_own = |section: &&OutputSection| {
            report.name == section.name || report.name.starts_with(&format!("{} ", section.name))
        };
        let section = config.outputs.iter().find(is_own);
        let destination = section.and_then(|section| section.destination.as_ref());
        let status = &report.status;
        let capacity = section.and_then(OutputSection::carrier).and_then(|own| own.capacity());
        ShownOutput {
            name: report.name.clone(),
            transport: destination.map_or("lan", transport_out).to_owned(),
            what: what(status.state.as_ref()),
            point: section.and_then(|section| section.point.clone()),
            state: state(status.state.as_ref()),
            sent: status.sent,
            dropped: status.dropped,
            waiting: status.waiting,
            bytes: status.bytes,
            rate_bytes_s: rates.rate(index),
            capacity_bytes_s: capacity,
            age_ms: worst(status.slots.iter().filter_map(|slot| slot.age)),
            messages: messages(report),
            last_error: trouble(status.state.as_ref()),
        }
    };
    slow.outputs.iter().enumerate().map(output).collect()
}

fn messages(report: &OutputReport) -> Vec<OutputMessage> {
    let slots = report.status.slots.iter();
    slots
        .map(|slot| OutputMessage {
            name: report
                .kinds
                .get(usize::from(slot.slot))
                .map_or_else(|| format!("datagram {}", slot.slot), |kind| (*kind).to_owned()),
            rate_hz: None,
            sent: slot.sent,
            dropped: slot.dropped,
            age_ms: slot.age.map(|age| shown_age(&age)),
        })
        .collect()
}

fn worst(ages: impl Iterator<Item = AgeStatus>) -> Option<Age> {
    ages.map(|age| shown_age(&age)).reduce(|one, other| Age {
        last: one.last.max(other.last),
        max: one.max.max(other.max),
        p50: one.p50.max(other.p50),
        p99: one.p99.max(other.p99),
    })
}

fn shown_age(age: &AgeStatus) -> Age {
    Age { last: ms(age.last), max: ms(age.max), p50: ms(age.p50), p99: ms(age.p99) }
}

pub(super) fn schedule(slow: &Slow) -> Schedule {
    let [epochs, late, skipped] = slow.epochs;
    Schedule { epochs, late, skipped }
}

pub(super) fn buses(config: &Config, slow: &Slow) -> Vec<Bus> {
    let ports = config.ports.iter().zip(&slow.intake.ports);
    let buses = ports.filter(|(section, _)| is_bus(&section.transport));
    buses.map(|(_, status)| bus(status, slow)).collect()
}

fn bus(status: &PortStatus, slow: &Slow) -> Bus {
    let node = slow.nodes.iter().find(|(port, _)| *port == status.name).map(|(_, node)| node);
    Bus {
        port: status.name.clone(),
        state: match status.bus.state {
            Some(BusEvent::Active | BusEvent::Restarted) => BusState::Active,
            Some(BusEvent::Warning) => BusState::Warning,
            Some(BusEvent::Passive) => BusState::Passive,
            Some(BusEvent::BusOff) => BusState::Off,
            _ => BusState::Unknown,
        },
        errors: status.bus.errors,
        offs: status.bus.offs,
        dropped: status.bus.dropped,
        rate_hz: None,
        load: None,
        node_state: node.map(|node| node.state.as_str().to_owned()),
        address: node.and_then(|node| node.address),
        name: node.map(|node| format!("{:016X}", node.name.bits())),
        nodes: status
            .nodes
            .iter()
            .map(|(address, name)| BusNode {
                address: *address,
                name: format!("{:016X}", name.bits()),
            })
            .collect(),
    }
}

fn is_bus(transport: &Transport) -> bool {
    matches!(
        transport,
        Transport::Socketcan(_)
            | Transport::Slcan(_)
            | Transport::GatewayTcp(_)
            | Transport::GatewayUdp(_)
            | Transport::Candump(_)
    )
}

fn transport(transport: &Transport) -> &'static str {
    match transport {
        Transport::Serial(_) => "serial",
        Transport::Udp(_) => "udp",
        Transport::TcpClient(_) => "tcp-client",
        Transport::Ntrip(_) => "ntrip",
        Transport::TcpServer(_) => "tcp-server",
        Transport::File(_) => "file",
        Transport::Pipe(_) => "pipe",
        Transport::Pps(_) => "pps",
        Transport::Socketcan(_) => "socketcan",
        Transport::Slcan(_) => "slcan",
        Transport::GatewayTcp(_) => "gateway-tcp",
        Transport::GatewayUdp(_) => "gateway-udp",
        Transport::Candump(_) => "candump",
    }
}

fn transport_out(destination: &Destination) -> &'static str {
    match destination {
        Destination::Serial(_) => "serial",
        Destination::Udp(_) => "udp",
        Destination::TcpServer(_) => "tcp-server",
        Destination::File(_) => "file",
        Destination::Pty(_) => "pty",
    }
}

fn state(state: Option<&State>) -> ShownPortState {
    match state {
        None => ShownPortState::Waiting,
        Some(
            State::Open { .. } | State::Speaking | State::Overrun { .. } | State::Refused { .. },
        ) => ShownPortState::Open,
        Some(State::Absent { .. }) => ShownPortState::Absent,
        Some(State::Lost { .. }) => ShownPortState::Lost,
        Some(State::Silent { .. }) => ShownPortState::Silent,
        Some(State::Ended) => ShownPortState::Ended,
    }
}

/// What is opened, where the state still says so.
fn what(state: Option<&State>) -> String {
    match state {
        Some(State::Open { what }) => what.clone(),
        _ => String::new(),
    }
}

fn trouble(state: Option<&State>) -> Option<String> {
    match state {
        Some(State::Absent { reason } | State::Lost { reason }) => Some(reason.clone()),
        _ => None,
    }
}
