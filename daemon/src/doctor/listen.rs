//! Listens at the configured ports for a while. Not one byte is written.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use insd_base::PortId;
use insd_config::Config;
use insd_config::check::ConfigPlace;
use insd_drivers::ports::{
    self, BaudJudge, BaudJudgement, PortConfig, Serial, Surroundings, Transport, WAITING_LIMIT,
};
use insd_lab::sniff::{PortToHear, SniffReport, Sniffed, is_proof};
use insd_wire::stream::{Cutter, Protocol};

use crate::clock::HostClock;

/// Rates that are tried where nothing can be read at the configured one.
const BAUDS: [u32; 9] = [115_200, 38_400, 4_800, 9_600, 460_800, 921_600, 230_400, 57_600, 19_200];
/// For how long each of them is tried, s: a sensor that speaks once a second is heard.
const PROBE_S: f64 = 1.3;
/// So many bytes without a frame are of a wrong rate.
const WRONG: usize = 4096;
/// Fewer bytes say nothing of a rate.
const ENOUGH: u64 = 32;

/// What was heard.
pub(super) struct Heard {
    /// Of each port by its name.
    pub(super) report: SniffReport,
    /// Rates at which lines can be read that cannot at the configured one, by the name of the port.
    pub(super) bauds: BTreeMap<String, u32>,
}

/// Listens to all ports but those of these sections.
pub(super) fn listen(
    config: &Config,
    without: &[&ConfigPlace],
    span: Duration,
) -> std::io::Result<Heard> {
    let sound = |name: &str| {
        !without.iter().any(|place| place.bare() == "port" && place.name.as_deref() == Some(name))
    };
    let opened = config.ports.iter().zip(config.port_configs());
    let own: Vec<(String, PortConfig)> = opened
        .filter(|(port, opened)| sound(&port.name) && is_heard(&opened.transport))
        .map(|(port, opened)| (port.name.clone(), PortConfig { write: false, ..opened }))
        .collect();
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    let report = runtime.block_on(hear(&own, span));
    let doubtful: Vec<(String, PortConfig)> = report
        .ports
        .iter()
        .filter(|port| port.frames == 0 && port.stray >= ENOUGH)
        .filter_map(|port| own.iter().find(|(name, _)| *name == port.name))
        .filter_map(|(name, opened)| Some((name.clone(), searching(opened)?)))
        .collect();
    let mut bauds = BTreeMap::new();
    if !doubtful.is_empty() {
        let longest = Duration::from_secs_f64(PROBE_S * (BAUDS.len() + 1) as f64);
        let searched = runtime.block_on(hear(&doubtful, longest));
        let found = |port: &insd_lab::sniff::report::PortReport| {
            Some((port.name.clone(), port.baud.filter(|_| port.frames > 0)?))
        };
        bauds.extend(searched.ports.iter().filter_map(found));
    }
    runtime.shutdown_timeout(Duration::from_millis(100));
    Ok(Heard { report, bauds })
}

/// What can be listened to without taking anything away, or opening a door to the network.
fn is_heard(transport: &Transport) -> bool {
    matches!(
        transport,
        Transport::Serial(_)
            | Transport::Udp(_)
            | Transport::TcpClient(_)
            | Transport::Ntrip(_)
            | Transport::Pps(_)
            | Transport::Socketcan(_)
            | Transport::GatewayTcp(_)
            | Transport::GatewayUdp(_)
    )
}

/// A serial line whose rate is found by listening.
fn searching(opened: &PortConfig) -> Option<PortConfig> {
    let Transport::Serial(line) = &opened.transport else { return None };
    let others = BAUDS.into_iter().filter(|rate| *rate != line.baud).collect();
    let line = Serial { probe_bauds: others, probe_s: PROBE_S, ..line.clone() };
    Some(PortConfig { transport: Transport::Serial(line), ..opened.clone() })
}

async fn hear(own: &[(String, PortConfig)], span: Duration) -> SniffReport {
    let clock = HostClock::start();
    let (queue, mut receiver) = ports::queue(WAITING_LIMIT);
    let mut sniffed = Sniffed::new(&Protocol::ALL);
    let mut handles = Vec::new();
    for (id, (name, opened)) in (0..).map(PortId).zip(own) {
        sniffed.announce(id, PortToHear { name: name.clone(), timed: true, transport: None });
        let surroundings =
            Surroundings { clock: Arc::new(clock), queue: queue.clone(), judge: Some(judge()) };
        handles.push(ports::spawn(id, opened.clone(), surroundings));
    }
    let end = tokio::time::sleep(span);
    tokio::pin!(end);
    loop {
        tokio::select! {
            () = &mut end => break,
            Some(arrival) = receiver.recv() => sniffed.take(&arrival),
        }
    }
    sniffed.report(clock.now().monotonic)
}

/// A rate is right at the first good frame.
fn judge() -> BaudJudge {
    BaudJudge::new(|bytes| {
        let mut cutter = Cutter::new(&Protocol::ALL);
        cutter.push(bytes);
        while let Some(cut) = cutter.cut() {
            if is_proof(cut.protocol, cut.bytes) {
                return BaudJudgement::Fits;
            }
        }
        if bytes.len() >= WRONG { BaudJudgement::Wrong } else { BaudJudgement::Unsure }
    })
}
