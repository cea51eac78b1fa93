//! All that is opened: ports in and out, buses, the clock that is told the time.

use insd_base::{Arrival, PortId};
use insd_config::{Config, PortSection};
use insd_drivers::can;
use insd_drivers::ports::{self, Outgoing, PortConfig, PortHandle, Surroundings};
use insd_output::{Port, PortMessage};
use tokio::runtime::Handle;

use super::bus::{self, Buses, NodeOfPort};
use super::outputs::Outputs;
use super::time_out::TimeOut;

/// The port of what comes from our own clock and from the operator: none of the configuration.
pub(super) const NOWHERE: PortId = PortId(u16::MAX);

/// Numbers of what is written to; all below are ports that are listened to.
const FIRST_OUTPUT: u16 = 0x8000;
/// The number of the socket of chronyd.
const CHRONY: u16 = u16::MAX - 1;

/// Everything that is open.
pub(super) struct Connections {
    inputs: Vec<Input>,
    nodes: Vec<NodeOfPort>,
    pub(super) outputs: Outputs,
    pub(super) buses: Buses,
    pub(super) time_out: TimeOut,
    surroundings: Surroundings,
    runtime: Handle,
}

/// A port that is listened to, and what it was opened as.
struct Input {
    section: PortSection,
    config: PortConfig,
    /// Held to keep it open.
    handle: PortHandle,
}

impl Connections {
    /// Opens everything. To be called inside the runtime.
    pub(super) fn open(
        config: &Config,
        made: &[Port],
        surroundings: &Surroundings,
        runtime: &Handle,
    ) -> Self {
        let (buses, nodes) = Buses::new(config);
        for node in &nodes {
            tokio::spawn(bus::watch(node.port.clone(), node.node.clone(), node.state.clone()));
        }
        let mut connections = Connections {
            inputs: Vec::new(),
            nodes,
            outputs: Outputs::new(FIRST_OUTPUT),
            buses,
            time_out: TimeOut::open(config, CHRONY, surroundings),
            surroundings: surroundings.clone(),
            runtime: runtime.clone(),
        };
        connections.reopen(config, made);
        connections
    }

    /// Whether something arrived at a port on which the navigation depends.
    pub(super) fn is_input(arrival: &Arrival) -> bool {
        arrival.port.0 < FIRST_OUTPUT || arrival.port == NOWHERE
    }

    /// Closes what the next configuration has otherwise.
    pub(super) fn close_changed(&mut self, next: &Config) {
        let wanted = next.ports.iter().zip(next.port_configs());
        // ports are known by their place in the list: from the first that differs on all are others
        let same = self.inputs.iter().zip(wanted).take_while(|(own, (section, config))| {
            own.section == **section && own.config == *config
        });
        let same = same.count();
        self.inputs.truncate(same);
        self.outputs.close_changed(next);
    }

    /// Opens what is not open yet.
    pub(super) fn reopen(&mut self, config: &Config, made: &[Port]) {
        let _guard = self.runtime.enter();
        self.buses.configure(config);
        let open = self.inputs.len();
        let sections = config.ports.iter().zip(config.port_configs());
        for ((section, port), id) in sections.zip((0..).map(PortId)).skip(open) {
            let handle = self.listen(id, section, port.clone());
            self.inputs.push(Input { section: section.clone(), config: port, handle });
        }
        self.outputs.open(config, made, &self.surroundings);
    }

    /// Hands the messages of an epoch over, never waiting: to the output of this index, or to a caster behind them.
    pub(super) fn send(&mut self, port: usize, messages: &[PortMessage]) {
        let Some(caster) = port.checked_sub(self.outputs.count()) else {
            return self.outputs.send(port, messages);
        };
        let mut casters =
            self.inputs.iter().filter(|input| input.section.told_position().is_some());
        let Some(caster) = casters.nth(caster) else { return };
        for PortMessage { slot, content, valid, period, .. } in messages {
            let bytes = content.to_bytes();
            // a sentence without a position tells a caster nothing
            if bytes.split(|byte| *byte == b',').nth(2).is_some_and(|latitude| !latitude.is_empty())
            {
                let (slot, valid, period) = (*slot, *valid, *period);
                caster.handle.offer(Outgoing { slot, bytes, valid, period });
            }
        }
    }

    /// How often it was tried to open each port that is listened to.
    pub(super) fn attempts(&self) -> Vec<u64> {
        self.inputs.iter().map(|input| input.handle.attempts()).collect()
    }

    /// Opens what is listened to. CAN ports with a node are given it.
    fn listen(&self, id: PortId, section: &PortSection, port: PortConfig) -> PortHandle {
        let surroundings = self.surroundings.clone();
        let node = self.nodes.iter().find(|node| node.port == section.name);
        match port.as_can().zip(node) {
            Some((bus, node)) => can::spawn(id, bus, surroundings, Some(node.node.for_port())),
            None => ports::spawn(id, port, surroundings),
        }
    }
}
