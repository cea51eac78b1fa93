//! What is wrong with a port and its types cannot refuse.

use super::{Destination, OutputConfig, PortConfig, Pty, Serial, TcpServer, Transport, Udp};
use crate::ports::Hosts;

/// Longest patience, seconds: a day.
const MAX_SECONDS: f64 = 86_400.0;

impl PortConfig {
    /// All that is wrong with it, in words.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        if !(self.patience_s > 0.0 && self.patience_s <= MAX_SECONDS) {
            faults.push(format!("patience_s: expected more than 0 and at most {MAX_SECONDS}"));
        }
        match &self.transport {
            Transport::Serial(serial) => faults.extend(serial.faults()),
            Transport::TcpServer(server) => faults.extend(server.faults()),
            Transport::Udp(udp) => faults.extend(udp.faults()),
            Transport::Ntrip(ntrip) => faults.extend(ntrip.faults()),
            _ => {}
        }
        faults.extend(self.hosts_fault());
        match self.as_can() {
            Some(can) => faults.extend(can.faults()),
            None if !self.filters.is_empty() => {
                faults.push("filters: expected a CAN port, for only that has filters".to_owned());
            }
            None => {}
        }
        let writable = matches!(
            self.transport,
            Transport::Serial(_)
                | Transport::TcpClient(_)
                | Transport::TcpServer(_)
                | Transport::Slcan(_)
        );
        if self.write && !writable {
            faults.push(
                "write: expected a serial or TCP port, for only those can be written to".to_owned(),
            );
        }
        faults
    }

    /// What is wrong with those who are let in, and those whose commands are obeyed.
    fn hosts_fault(&self) -> Option<String> {
        let from = match &self.transport {
            Transport::Udp(udp) => udp.from.as_ref(),
            Transport::TcpServer(server) => server.from.as_ref().filter(|own| !own.is_empty()),
            Transport::GatewayUdp(gateway) => gateway.from.as_ref(),
            _ => None,
        };
        let commanding = self.commands_from.as_ref().filter(|own| !own.is_empty());
        if from.is_some_and(Hosts::is_empty) {
            Some("from: expected at least one address; left out, all hosts are let in".to_owned())
        } else if commanding.is_some() && !self.transport.is_network() {
            let text = "commands_from: expected a UDP or TCP port, for only those have senders";
            Some(text.to_owned())
        } else if from.zip(commanding).is_some_and(|(from, own)| !from.covers(own)) {
            Some("commands_from: expected hosts that transport.from lists, too".to_owned())
        } else {
            None
        }
    }
}

impl OutputConfig {
    /// All that is wrong with it, in words.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let mut faults = match &self.destination {
            Destination::Serial(serial) => serial.faults(),
            Destination::TcpServer(server) => server.faults().into_iter().collect(),
            Destination::Pty(Pty { baud: Some(0), .. }) => {
                vec!["baud: expected more than 0".to_owned()]
            }
            Destination::Udp(_) | Destination::File(_) | Destination::Pty(_) => Vec::new(),
        };
        if self.waiting_bytes == Some(0) {
            faults.push("waiting_bytes: expected more than 0".to_owned());
        }
        faults
    }
}

impl Serial {
    fn faults(&self) -> Vec<String> {
        let checks = [
            ((5..=8).contains(&self.data_bits), "data_bits: expected 5, 6, 7 or 8"),
            ((1..=2).contains(&self.stop_bits), "stop_bits: expected 1 or 2"),
            (self.baud > 0 && !self.probe_bauds.contains(&0), "baud: expected more than 0"),
            (self.probe_s >= 0.1 && self.probe_s <= 60.0, "probe_s: expected 0.1 to 60"),
        ];
        checks.iter().filter(|(good, _)| !good).map(|(_, fault)| (*fault).to_owned()).collect()
    }
}

impl TcpServer {
    fn faults(&self) -> Option<String> {
        if self.max_clients == 0 {
            Some("max_clients: expected more than 0".to_owned())
        } else if self.max_per_address == 0 {
            Some("max_per_address: expected more than 0".to_owned())
        } else if self.from.as_ref().is_some_and(Hosts::is_empty) {
            let text = "from: expected at least one address; left out, all hosts are let in";
            Some(text.to_owned())
        } else {
            None
        }
    }
}

impl Udp {
    fn faults(&self) -> Option<String> {
        let group = self.multicast?;
        let fits = group.is_multicast() && self.bind.is_ipv4();
        (!fits)
            .then(|| format!("multicast: expected a multicast group that goes with {}", self.bind))
    }
}
