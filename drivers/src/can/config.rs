//! What a CAN port is: plain types, readable from a configuration file, as the other ports are.

use std::net::SocketAddr;
use std::path::PathBuf;

use insd_base::CanId;
use insd_n2k::text::slcan;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::ports::Hosts;

/// A CAN port.
#[derive(Clone, Debug, PartialEq)]
pub struct CanConfig {
    /// What is opened.
    pub transport: CanTransport,
    /// Silence after which it is told, seconds.
    pub patience_s: f64,
    /// Whether commands may be written to an adapter at a serial line, which cannot do without. Frames
    /// are only written for a node.
    pub write: bool,
    /// Which frames count; all if there is none.
    pub filters: Vec<CanFilter>,
}

/// What carries the frames.
#[derive(Clone, Debug, PartialEq)]
pub enum CanTransport {
    /// An interface of the kernel.
    Socketcan(Socketcan),
    /// An adapter at a serial line that speaks LAWICEL's language.
    Slcan(Slcan),
    /// A gateway that is called.
    GatewayTcp(GatewayTcp),
    /// A gateway that sends datagrams.
    GatewayUdp(GatewayUdp),
    /// A log of candump, read once to its end at the pace of the consumer.
    Candump(Candump),
}

/// An interface of the kernel.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Socketcan {
    /// Its name, for example `can0`. Bit rate and restart are the system's affair.
    pub interface: String,
}

/// An adapter at a serial line that speaks LAWICEL's language.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Slcan {
    /// Path of the device, best a stable one below `/dev/serial/by-id`.
    pub device: PathBuf,
    /// Symbols per second of the serial line; USB does not mind.
    #[serde(default = "default_baud")]
    pub baud: u32,
    /// Bits per second of the bus: 10, 20, 50, 100, 125, 250, 500, 800 or 1000 thousand.
    #[serde(default = "default_bitrate")]
    pub bitrate: u32,
}

/// A gateway that is called.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GatewayTcp {
    /// Host and port, for example `192.168.4.1:1457`.
    pub address: String,
    /// What it speaks.
    pub format: GatewayFormat,
}

/// A gateway that sends datagrams.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GatewayUdp {
    /// Local address and port.
    #[schemars(extend("format" = "socket"))]
    pub bind: SocketAddr,
    /// Where it listens; without this nothing can be sent.
    #[serde(default)]
    #[schemars(extend("format" = "socket"))]
    pub to: Option<SocketAddr>,
    /// Hosts whose datagrams count: addresses, and networks like `10.0.0.0/24`. Left out: all.
    #[serde(default)]
    pub from: Option<Hosts>,
    /// What it speaks.
    pub format: GatewayFormat,
}

/// The lines of a gateway, see [`insd_n2k::text`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum GatewayFormat {
    /// Lines of a log of candump.
    Candump,
    /// RAW of Yacht Devices.
    Ydwg,
    /// N2K ASCII of Actisense.
    Actisense,
    /// Frames as canboat writes them.
    CanboatPlain,
    /// Whole messages as canboat writes them.
    CanboatFast,
}

/// A log of candump.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Candump {
    /// Where it is.
    pub path: PathBuf,
}

/// Frames that count: those whose identifier has the same bits as this one where the mask has ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CanFilter {
    /// Bits of the identifier.
    pub id: u32,
    /// Ones where they must be the same.
    pub mask: u32,
    /// Whether identifiers of 11 bits are meant, and not of 29.
    #[serde(default)]
    pub standard: bool,
}

impl CanConfig {
    /// All that is wrong with what only CAN ports have, in words.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let mut faults = match &self.transport {
            CanTransport::Socketcan(socketcan) => socketcan.faults(),
            CanTransport::Slcan(slcan) => slcan.faults(),
            _ => Vec::new(),
        };
        let valid = |filter: &CanFilter| filter.can_id(filter.id | filter.mask).is_valid();
        if !self.filters.iter().all(valid) {
            faults.push("filters: expected 29 bits, or 11 of a standard one".to_owned());
        }
        faults
    }
}

impl Socketcan {
    fn faults(&self) -> Vec<String> {
        let name = &self.interface;
        let good = (1..=15).contains(&name.len()) && !name.contains('/');
        let fault = (!good).then(|| "interface: expected the name of one, such as can0".to_owned());
        fault.into_iter().collect()
    }
}

impl Slcan {
    fn faults(&self) -> Vec<String> {
        let checks = [
            (self.baud > 0, "baud: expected more than 0".to_owned()),
            (
                slcan::BITRATES.contains(&self.bitrate),
                format!("bitrate: expected one of {:?}", slcan::BITRATES),
            ),
        ];
        checks.into_iter().filter(|(good, _)| !good).map(|(_, fault)| fault).collect()
    }
}

impl CanFilter {
    fn can_id(self, id: u32) -> CanId {
        match u16::try_from(id) {
            _ if !self.standard => CanId::Extended(id),
            Ok(id) => CanId::Standard(id),
            Err(_) => CanId::Standard(u16::MAX),
        }
    }

    /// Whether frames with this identifier count.
    #[must_use]
    pub fn accepts(self, id: CanId) -> bool {
        let (bits, standard) = match id {
            CanId::Standard(id) => (u32::from(id), true),
            CanId::Extended(id) => (id, false),
        };
        standard == self.standard && (bits ^ self.id) & self.mask == 0
    }
}

fn default_baud() -> u32 {
    115_200
}

/// That of NMEA 2000.
fn default_bitrate() -> u32 {
    250_000
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ports::PortConfig;

    fn port(text: &str) -> PortConfig {
        toml::from_str(text).unwrap()
    }

    #[test]
    fn every_kind_is_read_from_toml() {
        for text in [
            "transport = { kind = \"socketcan\", interface = \"can0\" }",
            "transport = { kind = \"slcan\", device = \"/dev/ttyACM0\" }\nwrite = true",
            "transport = { kind = \"gateway-tcp\", address = \"a:1457\", format = \"ydwg\" }",
            "transport = { kind = \"gateway-udp\", bind = \"0.0.0.0:60002\", format = \"actisense\" }",
            "transport = { kind = \"candump\", path = \"log\" }\nfilters = [{ id = 0x09F11200, \
             mask = 0x1FFFFF00 }]",
        ] {
            let port = port(text);
            assert_eq!(port.faults(), Vec::<String>::new());
            assert!(port.as_can().is_some());
        }
    }

    #[test]
    fn faults_of_can_ports_are_told() {
        for (text, fault) in [
            ("transport = { kind = \"socketcan\", interface = \"\" }", "interface"),
            ("transport = { kind = \"slcan\", device = \"x\", bitrate = 251000 }", "bitrate"),
            ("transport = { kind = \"socketcan\", interface = \"can0\" }\nwrite = true", "written"),
            (
                "transport = { kind = \"candump\", path = \"x\" }\nfilters = [{ id = 0x800, mask = \
                 0, standard = true }]",
                "filter",
            ),
            (
                "transport = { kind = \"pipe\", path = \"x\" }\nfilters = [{ id = 0, mask = 0 }]",
                "CAN port",
            ),
        ] {
            let faults = port(text).faults();
            assert!(faults.len() == 1 && faults[0].contains(fault), "{text}: {faults:?}");
        }
    }

    #[test]
    fn a_filter_looks_at_its_bits_and_at_the_length_of_the_identifier() {
        let heading = CanFilter { id: 0x09F1_1200, mask: 0x1FFF_FF00, standard: false };
        assert!(heading.accepts(CanId::Extended(0x09F1_1223)));
        assert!(!heading.accepts(CanId::Extended(0x09F1_1323)));
        let all = CanFilter { id: 0, mask: 0, standard: true };
        assert!(all.accepts(CanId::Standard(7)) && !all.accepts(CanId::Extended(7)));
    }
}
