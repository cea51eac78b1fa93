//! What a port is: plain types, readable from a configuration file. Unknown keys are refused; what a
//! type cannot refuse is found by [`PortConfig::faults`] and [`OutputConfig::faults`].

mod as_can;
mod faults;

use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::hosts::Hosts;

use super::ntrip::Ntrip;
use crate::can::{CanFilter, Candump, GatewayTcp, GatewayUdp, Slcan, Socketcan};

/// A port that is listened to.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PortConfig {
    /// What is opened.
    pub transport: Transport,
    /// Silence after which it is told, seconds.
    #[serde(default = "default_patience")]
    pub patience_s: f64,
    /// Whether messages may be written to it, too: to a serial port, and to the peers of a TCP port.
    /// Without this not one byte is ever written.
    /// For CAN: without this an adapter at a serial line is not even told to open its channel.
    #[serde(default)]
    pub write: bool,
    /// Of a CAN port: which frames count; all if there is none.
    #[serde(default)]
    pub filters: Vec<CanFilter>,
    /// Of a network port that is listened to for commands: the hosts whose commands are obeyed. Then it is
    /// told of all bytes who sent them.
    #[serde(default)]
    pub commands_from: Option<Hosts>,
}

/// What a port listens to.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Transport {
    /// A serial line.
    Serial(Serial),
    /// UDP datagrams, each of them one arrival.
    Udp(Udp),
    /// A TCP server that is called.
    TcpClient(TcpClient),
    /// A mount point of an NTRIP caster, which is called: corrections of a base.
    Ntrip(Ntrip),
    /// A TCP server that others call. The bytes of all clients arrive at this one port, each read as
    /// one arrival: two clients that speak at once mix their messages.
    TcpServer(TcpServer),
    /// A file, read once to its end at the pace of the consumer.
    File(File),
    /// A named pipe (FIFO), opened again when its writer has gone.
    Pipe(File),
    /// Pulses per second from a kernel device.
    Pps(Pps),
    /// CAN: an interface of the kernel.
    Socketcan(Socketcan),
    /// CAN: an adapter at a serial line that speaks LAWICEL's language.
    Slcan(Slcan),
    /// CAN: a gateway that is called.
    GatewayTcp(GatewayTcp),
    /// CAN: a gateway that sends datagrams.
    GatewayUdp(GatewayUdp),
    /// CAN: a log of candump, read once to its end at the pace of the consumer.
    Candump(Candump),
}

/// A serial line.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Serial {
    /// Path of the device, best a stable one below `/dev/serial/by-id`.
    pub device: PathBuf,
    /// Symbols per second.
    pub baud: u32,
    /// Bits of a character: 5, 6, 7 or 8.
    #[serde(default = "default_data_bits")]
    pub data_bits: u8,
    /// Parity bit.
    #[serde(default)]
    pub parity: Parity,
    /// Stop bits: 1 or 2.
    #[serde(default = "default_stop_bits")]
    pub stop_bits: u8,
    /// Who holds back whom, and how.
    #[serde(default)]
    pub flow_control: FlowControl,
    /// Electrical standard: for the record, it is not set.
    #[serde(default)]
    pub mode: SerialMode,
    /// Ask the driver to hand over bytes at once. A driver that cannot is used as it is.
    #[serde(default)]
    pub low_latency: bool,
    /// Rates to listen at until one fits. Empty for a fixed rate.
    #[serde(default)]
    pub probe_bauds: Vec<u32>,
    /// For how long to listen at each of them, seconds.
    #[serde(default = "default_probe")]
    pub probe_s: f64,
}

/// The parity bit of a character.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Parity {
    /// There is none.
    #[default]
    None,
    /// An odd number of ones.
    Odd,
    /// An even number of ones.
    Even,
}

/// Flow control of a serial line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FlowControl {
    /// There is none.
    #[default]
    None,
    /// XON and XOFF.
    Software,
    /// RTS and CTS.
    Hardware,
}

/// Electrical standard of a serial line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SerialMode {
    /// RS-232.
    #[default]
    Rs232,
    /// RS-422, of which IEC 61162-1 and -2 are kinds.
    Rs422,
    /// RS-485.
    Rs485,
}

/// UDP datagrams to listen to.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Udp {
    /// Local address and port.
    #[schemars(extend("format" = "socket"))]
    pub bind: SocketAddr,
    /// Group to join.
    #[serde(default)]
    pub multicast: Option<Ipv4Addr>,
    /// Address of the interface on which to join it; the system's choice if left out.
    #[serde(default)]
    pub interface: Option<Ipv4Addr>,
    /// Hosts whose datagrams count: addresses, and networks like `10.0.0.0/24`. Left out: all.
    #[serde(default)]
    pub from: Option<Hosts>,
}

/// A TCP server to call.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TcpClient {
    /// Host and port, for example `192.168.1.20:10110`.
    pub address: String,
    /// A line that is sent when the server has answered, for one that tells nothing unasked; of a server
    /// that is listened to nothing else is ever written. Left out: nothing.
    #[serde(default)]
    pub ask: Option<String>,
}

/// A TCP server to be.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TcpServer {
    /// Local address and port.
    #[schemars(extend("format" = "socket"))]
    pub bind: SocketAddr,
    /// Hosts that are let in: addresses, and networks like `10.0.0.0/24`. Left out: all.
    #[serde(default)]
    pub from: Option<Hosts>,
    /// Clients at one time; more are turned away.
    #[serde(default = "default_clients")]
    pub max_clients: usize,
    /// Clients of one address at one time. The last place of all is never given to an address that has
    /// others.
    #[serde(default = "default_clients_per_address")]
    pub max_per_address: usize,
}

/// A file or named pipe.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// Where it is.
    pub path: PathBuf,
}

/// A pulse per second.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pps {
    /// The kernel's device, for example `/dev/pps0`.
    pub device: PathBuf,
    /// The edge that counts.
    #[serde(default)]
    pub edge: Edge,
}

/// An edge of a pulse, as the kernel names them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    /// The line becomes active.
    #[default]
    Assert,
    /// The line becomes inactive.
    Clear,
}

/// A port that is only written to.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutputConfig {
    /// Where messages go.
    pub destination: Destination,
    /// Bytes that may wait to be written, of a TCP server for each client; the oldest go when there are
    /// more. If left out: 1 MiB for a file, 64 KiB elsewhere, where only the newest of each slot waits.
    #[serde(default)]
    pub waiting_bytes: Option<usize>,
}

/// Where messages are written.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Destination {
    /// A serial line.
    Serial(Serial),
    /// UDP, each message one datagram.
    Udp(UdpOutput),
    /// Clients that call.
    TcpServer(TcpServer),
    /// A file, at its end.
    File(File),
    /// A pseudo terminal that is made: programs read from it as from a serial port.
    Pty(Pty),
}

/// A pseudo terminal to make.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pty {
    /// Path of the symbolic link to it.
    pub path: PathBuf,
    /// Symbols per second of a serial line with 8 data bits, no parity and 1 stop bit, no faster than
    /// which it is written to; as fast as it is read if left out.
    #[serde(default)]
    pub baud: Option<u32>,
}

/// Where datagrams are sent.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UdpOutput {
    /// Address and port of a host, a group, or a network's broadcast.
    #[schemars(extend("format" = "socket"))]
    pub to: SocketAddr,
    /// Routers that a datagram to a group may pass, and one.
    #[serde(default = "default_ttl")]
    pub ttl: u32,
    /// Address of the interface by which to leave to a group; the system's choice if left out.
    #[serde(default)]
    pub interface: Option<Ipv4Addr>,
    /// Whether programs on this computer hear what is sent to a group.
    #[serde(default = "default_loopback")]
    pub loopback: bool,
}

impl PortConfig {
    /// A port as it is if nothing else is said: told silent after 3 s, never written to.
    #[must_use]
    pub fn new(transport: Transport) -> Self {
        PortConfig {
            transport,
            patience_s: default_patience(),
            write: false,
            filters: Vec::new(),
            commands_from: None,
        }
    }
}

impl Transport {
    /// Whether hosts on a network can send to it.
    #[must_use]
    pub fn is_network(&self) -> bool {
        matches!(
            self,
            Transport::Udp(_)
                | Transport::TcpClient(_)
                | Transport::Ntrip(_)
                | Transport::TcpServer(_)
                | Transport::GatewayTcp(_)
                | Transport::GatewayUdp(_)
        )
    }
}

impl OutputConfig {
    /// An output with the usual room for what waits.
    #[must_use]
    pub fn new(destination: Destination) -> Self {
        OutputConfig { destination, waiting_bytes: None }
    }

    /// Bytes per second that the destination can carry; `None` if it has no pace of its own.
    #[must_use]
    pub fn capacity(&self) -> Option<f64> {
        let (baud, symbols) = match &self.destination {
            Destination::Serial(serial) => (serial.baud, serial.symbols()),
            Destination::Pty(pty) => (pty.baud?, Pty::SYMBOLS),
            Destination::Udp(_) | Destination::TcpServer(_) | Destination::File(_) => return None,
        };
        Some(f64::from(baud) / f64::from(symbols))
    }
}

impl Pty {
    /// Symbols of a character: start bit, 8 data bits, stop bit.
    pub(super) const SYMBOLS: u32 = 10;

    /// A terminal that is written to as fast as it is read.
    #[must_use]
    pub fn new(path: PathBuf) -> Self {
        Pty { path, baud: None }
    }
}

impl UdpOutput {
    /// Datagrams to this address; to a group they pass no router, leave by the interface of the system's
    /// choice, and are heard on this computer.
    #[must_use]
    pub fn new(to: SocketAddr) -> Self {
        UdpOutput { to, ttl: default_ttl(), interface: None, loopback: default_loopback() }
    }
}

impl Serial {
    /// A line with 8 data bits, no parity, 1 stop bit and no flow control.
    #[must_use]
    pub fn new(device: PathBuf, baud: u32) -> Self {
        Serial {
            device,
            baud,
            data_bits: default_data_bits(),
            parity: Parity::None,
            stop_bits: default_stop_bits(),
            flow_control: FlowControl::None,
            mode: SerialMode::Rs232,
            low_latency: false,
            probe_bauds: Vec::new(),
            probe_s: default_probe(),
        }
    }

    /// Symbols of a character with start, parity and stop bits.
    #[must_use]
    pub fn symbols(&self) -> u32 {
        let parity = u32::from(self.parity != Parity::None);
        1 + u32::from(self.data_bits) + parity + u32::from(self.stop_bits)
    }
}

impl TcpServer {
    /// A server at this address, with the usual limits.
    #[must_use]
    pub fn new(bind: SocketAddr) -> Self {
        TcpServer {
            bind,
            from: None,
            max_clients: default_clients(),
            max_per_address: default_clients_per_address(),
        }
    }

    /// Clients that one host may have: of several places one is left for another host.
    #[must_use]
    pub fn share(&self) -> usize {
        self.max_per_address.min(self.max_clients.saturating_sub(1).max(1))
    }
}

fn default_patience() -> f64 {
    3.0
}

fn default_data_bits() -> u8 {
    8
}

fn default_stop_bits() -> u8 {
    1
}

fn default_probe() -> f64 {
    3.0
}

fn default_clients() -> usize {
    32
}

fn default_clients_per_address() -> usize {
    8
}

fn default_ttl() -> u32 {
    1
}

fn default_loopback() -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_port_is_read_from_toml_with_its_defaults() {
        let text = "transport = { kind = \"serial\", device = \"/dev/ttyS0\", baud = 4800 }";
        let config: PortConfig = toml::from_str(text).unwrap();
        let serial = Serial::new(PathBuf::from("/dev/ttyS0"), 4800);
        assert_eq!(config, PortConfig::new(Transport::Serial(serial)));
        assert_eq!(config.faults(), Vec::<String>::new());
    }

    #[test]
    fn an_unknown_key_is_refused() {
        let text = "transport = { kind = \"tcp-client\", address = \"a:1\", adress = \"b:1\" }";
        assert!(toml::from_str::<PortConfig>(text).unwrap_err().to_string().contains("adress"));
    }

    #[test]
    fn all_faults_are_told_together() {
        let text = "patience_s = 0.0\n[transport]\nkind = \"serial\"\ndevice = \"x\"\n\
                    baud = 0\ndata_bits = 9\nstop_bits = 3\nprobe_s = 0.0";
        assert_eq!(toml::from_str::<PortConfig>(text).unwrap().faults().len(), 5);
    }

    #[test]
    fn an_output_carries_what_its_line_can() {
        let capacity = |text: &str| {
            let text = format!("destination = {{ {text} }}");
            toml::from_str::<OutputConfig>(&text).unwrap().capacity()
        };
        let line = "kind = \"serial\", device = \"x\", baud = 4800";
        assert_eq!(capacity(line), Some(480.0));
        assert_eq!(capacity(&format!("{line}, parity = \"even\", stop_bits = 2")), Some(400.0));
        assert_eq!(capacity("kind = \"pty\", path = \"x\""), None);
        assert_eq!(capacity("kind = \"pty\", path = \"x\", baud = 38400"), Some(3840.0));
        assert_eq!(capacity("kind = \"udp\", to = \"239.192.0.4:60004\""), None);
    }

    #[test]
    fn a_group_is_heard_on_this_computer_unless_it_is_said_otherwise() {
        let text = "destination = { kind = \"udp\", to = \"239.192.0.4:60004\" }";
        let to = SocketAddr::from((Ipv4Addr::new(239, 192, 0, 4), 60_004));
        let config: OutputConfig = toml::from_str(text).unwrap();
        assert_eq!(config, OutputConfig::new(Destination::Udp(UdpOutput::new(to))));
        assert!(UdpOutput::new(to).loopback);
    }
}
