//! Ports that are listened to.

use insd_drivers::can::CanFilter;
use insd_drivers::ports::{Hosts, Ntrip, Transport};
use insd_output::{MessageKind, OutputPortConfig, Rate};
use schemars::JsonSchema;
use serde::Deserialize;

/// One port that is listened to.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PortSection {
    /// Its name.
    pub name: String,
    /// What is opened.
    pub transport: Transport,
    /// Silence after which it is told, s.
    #[serde(default = "three")]
    pub patience_s: f64,
    /// Whether an adapter (slcan) may be told to open its channel: the only thing that is written
    /// without a node.
    #[serde(default)]
    pub write: bool,
    /// Whether commands about our alerts (ACN) are obeyed that come from here: the bridge's alert
    /// management.
    #[serde(default)]
    pub alerts: bool,
    /// Of a network port: the hosts whose commands are obeyed, addresses and networks like `10.0.0.0/24`:
    /// those about our alerts, and of a gateway those to our node. Left out: nobody's. A serial line needs
    /// no list.
    pub commands_from: Option<Hosts>,
    /// Of a CAN port: which frames count. Left out: those that its sensors and its node need, on an
    /// interface of the kernel.
    pub filters: Option<Vec<CanFilter>>,
}

fn three() -> f64 {
    3.0
}

impl PortSection {
    /// What a caster that wants to know where the ship is is told, and how often.
    #[must_use]
    pub fn told_position(&self) -> Option<OutputPortConfig> {
        let Transport::Ntrip(Ntrip { gga_s, .. }) = &self.transport else { return None };
        let kind = MessageKind::named("GGA").filter(|_| *gga_s > 0.0)?;
        let messages = vec![(kind, Rate::from_hertz(1.0 / gga_s))];
        Some(OutputPortConfig { messages, ..OutputPortConfig::default() })
    }

    /// The hosts whose commands are obeyed, if it is a network port that is listened to for commands.
    pub(crate) fn commanders(&self) -> Option<Hosts> {
        let is_asked = self.alerts && self.transport.is_network();
        self.commands_from.clone().or(is_asked.then(Hosts::default))
    }

    /// Whether the node on it obeys commands of the bus: over a gateway only if all who can send there are
    /// listed.
    #[must_use]
    pub fn obeys_bus(&self) -> bool {
        let listed = self.commands_from.as_ref();
        match &self.transport {
            Transport::GatewayUdp(gateway) => {
                let from = gateway.from.as_ref();
                listed.zip(from).is_some_and(|(listed, from)| listed.covers(from))
            }
            Transport::GatewayTcp(gateway) => {
                let host = gateway.address.rsplit_once(':').and_then(|(host, _)| {
                    host.trim_start_matches('[').trim_end_matches(']').parse().ok()
                });
                listed.zip(host).is_some_and(|(listed, host)| listed.contains(host))
            }
            _ => true,
        }
    }
}
