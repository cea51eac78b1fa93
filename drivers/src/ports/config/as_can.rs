//! Ports that are CAN ports.

use super::{PortConfig, Transport};
use crate::can::{CanConfig, CanTransport};

impl PortConfig {
    /// The CAN port that this port is; `None` if it is of another kind.
    #[must_use]
    pub fn as_can(&self) -> Option<CanConfig> {
        let transport = match self.transport.clone() {
            Transport::Socketcan(socketcan) => CanTransport::Socketcan(socketcan),
            Transport::Slcan(slcan) => CanTransport::Slcan(slcan),
            Transport::GatewayTcp(gateway) => CanTransport::GatewayTcp(gateway),
            Transport::GatewayUdp(gateway) => CanTransport::GatewayUdp(gateway),
            Transport::Candump(candump) => CanTransport::Candump(candump),
            _ => return None,
        };
        let PortConfig { patience_s, write, filters, .. } = self;
        Some(CanConfig {
            transport,
            patience_s: *patience_s,
            write: *write,
            filters: filters.clone(),
        })
    }
}
