//! Nodes of NMEA 2000: the engine's thread hands in what is to be said; the ports' tasks send it.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use insd_base::Time;
use insd_config::{Config, NodeMemory, NodeSection, PortSection, output_file};
use insd_drivers::can::SharedSpeaker;
use insd_n2k::node::{Node, NodeEvent, NodeStatus};
use insd_output::OutputEpoch;
use insd_output::n2k::PgnSchedule;
use insd_web::SECURITY;

/// Time between two looks at what became of a node.
const LOOK: Duration = Duration::from_millis(200);

/// What is said on one bus.
struct Bus {
    port: String,
    voice: PgnSchedule,
    node: SharedSpeaker<Node>,
    geoid: Option<f64>,
    /// Index of its monitoring point.
    point: usize,
}

/// A node and the port it is on.
pub(super) struct NodeOfPort {
    pub(super) port: String,
    pub(super) node: SharedSpeaker<Node>,
    pub(super) state: Option<PathBuf>,
}

/// All buses with a node.
pub(super) struct Buses {
    buses: Vec<Bus>,
}

impl Buses {
    /// The nodes of a configuration, not yet on their buses.
    pub(super) fn new(config: &Config) -> (Self, Vec<NodeOfPort>) {
        let computer = computer();
        let mut named = Vec::new();
        let buses = config.nodes.iter().map(|section| {
            let node = make(section, computer);
            let (port, state) = (section.port.clone(), section.state.clone());
            named.push(NodeOfPort { port, node: node.clone(), state });
            let point = config.point(section.point.as_deref());
            let (voice, geoid) = (PgnSchedule::new(section.voice()), section.geoid_m);
            Bus { port: section.port.clone(), voice, node, geoid, point }
        });
        let buses = Buses { buses: buses.collect() };
        (buses, named)
    }

    /// Nodes obey commands of the bus where this configuration lets them.
    pub(super) fn configure(&self, config: &Config) {
        for bus in &self.buses {
            let port = config.ports.iter().find(|port| port.name == bus.port);
            let allowed = port.is_none_or(PortSection::obeys_bus);
            bus.node.with(|node| node.allow_commands(allowed));
        }
    }

    /// How each node is, by the name of its port.
    pub(super) fn status(&self) -> Vec<(String, NodeStatus)> {
        let status = |bus: &Bus| (bus.port.clone(), bus.node.with(|node| node.status()));
        self.buses.iter().map(status).collect()
    }

    /// Says what is known of the monitoring points at an instant.
    pub(super) fn send(&mut self, epochs: &[OutputEpoch], now: Time) {
        for bus in &mut self.buses {
            let Some(epoch) = epochs.get(bus.point) else { continue };
            let (voice, geoid) = (&mut bus.voice, bus.geoid);
            bus.node.with(|node| {
                let epoch = OutputEpoch { geoid, ..*epoch };
                for (pgn, data) in voice.messages(&epoch, node.transmit()) {
                    node.send(pgn, &data, now);
                }
            });
        }
    }
}

fn make(section: &NodeSection, computer: u64) -> SharedSpeaker<Node> {
    let memory = section.state.as_deref().and_then(remembered).unwrap_or_default();
    let config = section.node(computer, &memory);
    let seed = config.name.bits() ^ u64::from(std::process::id());
    SharedSpeaker::new(Node::new(config, seed))
}

/// Tells what becomes of a node, and remembers what is worth it, for ever.
pub(super) async fn watch(port: String, node: SharedSpeaker<Node>, state: Option<PathBuf>) {
    let mut kept = NodeMemory::default();
    loop {
        tokio::time::sleep(LOOK).await;
        let (events, memory) = node.with(|node| {
            let events: Vec<NodeEvent> = std::iter::from_fn(|| node.poll_event()).collect();
            (events, memory(node))
        });
        for event in events {
            tell(&port, &event);
        }
        if let Some(path) = state.clone()
            && memory.address.is_some()
            && memory != kept
        {
            kept = memory.clone();
            let outcome = tokio::task::spawn_blocking(move || remember(&path, &memory)).await;
            if let Ok(Err(error)) = outcome {
                tracing::warn!(port, %error, "what the node remembers could not be kept");
            }
        }
    }
}

fn tell(port: &str, event: &NodeEvent) {
    match event {
        NodeEvent::Claimed { address } => tracing::info!(port, address, "node: has an address"),
        NodeEvent::SameName { address } => {
            tracing::warn!(port, address, "node: another one has the same NAME");
        }
        NodeEvent::AddressUsed { address } => {
            tracing::warn!(port, address, "node: another one sends from its address");
        }
        NodeEvent::CommandRefused { pgn, by } => {
            let by = by.address;
            tracing::warn!(target: SECURITY, port, pgn, by, "a command to the node is refused");
        }
        NodeEvent::Commanded { .. }
        | NodeEvent::IntervalChanged { .. }
        | NodeEvent::PriorityChanged { .. }
        | NodeEvent::InstallationChanged { .. } => {
            tracing::info!(target: SECURITY, port, ?event, "a command to the node is obeyed");
        }
        NodeEvent::NoneFree => tracing::warn!(port, "node: no address is free, it is quiet"),
        _ => tracing::info!(port, ?event, "node"),
    }
}

fn memory(node: &Node) -> NodeMemory {
    let config = node.config();
    NodeMemory {
        address: node.address(),
        name: Some(config.name),
        installation: Some(config.installation.clone()),
    }
}

/// What is in the file; `None` if there is nothing that could be it.
fn remembered(path: &Path) -> Option<NodeMemory> {
    serde_json::from_str(&fs::read_to_string(path).ok()?).ok()
}

fn remember(path: &Path, memory: &NodeMemory) -> std::io::Result<()> {
    let text = serde_json::to_string(memory)?;
    output_file::replace(path, &format!("{text}\n"))
}

/// A number that no other computer has: of the identity that the system was given when it was installed.
fn computer() -> u64 {
    let id = fs::read_to_string("/etc/machine-id").unwrap_or_default();
    // FNV-1a: a few lines that will never change, as the NAME must not
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3);
    id.trim().bytes().fold(0xCBF2_9CE4_8422_2325, step)
}
