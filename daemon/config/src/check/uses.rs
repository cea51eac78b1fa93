//! What of the computer a configuration uses: devices, files, sockets.

use std::net::{IpAddr, SocketAddr};
use std::path::{Path, PathBuf};

use insd_drivers::ports::{Destination, Transport};

use super::finding::ConfigPlace;
use crate::Config;

/// What is at the other end of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeviceKind {
    /// A serial line.
    Serial,
    /// Pulses.
    Pulses,
    /// A file that is read, or a named pipe.
    Read,
    /// A file that is written.
    Written,
    /// A link to a pseudo terminal that is made.
    Made,
}

/// A device or file, and who uses it.
#[derive(Clone, Debug, PartialEq)]
pub struct UsedDevice {
    /// The key that names it.
    pub place: ConfigPlace,
    /// Where it is.
    pub path: PathBuf,
    /// What it is.
    pub kind: DeviceKind,
    /// Whether it is written to.
    pub is_output: bool,
    /// Symbols per second, of a serial line.
    pub baud: Option<u32>,
}

/// An address that is listened at.
#[derive(Clone, Debug, PartialEq)]
pub struct Listener {
    /// The key that names it.
    pub place: ConfigPlace,
    /// Where.
    pub address: SocketAddr,
    /// TCP, else UDP.
    pub tcp: bool,
    /// Group that is joined.
    pub group: Option<IpAddr>,
}

impl Listener {
    /// Whether both cannot be had: the same port of the same address. Datagrams of different groups are
    /// told apart.
    #[must_use]
    pub fn collides(&self, other: &Listener) -> bool {
        let (own, theirs) = (self.address, other.address);
        let same =
            own.ip() == theirs.ip() || own.ip().is_unspecified() || theirs.ip().is_unspecified();
        let ports = own.port() == theirs.port() && own.port() != 0;
        self.tcp == other.tcp && ports && same && self.group == other.group
    }
}

/// All devices and files.
#[must_use]
pub fn devices(config: &Config) -> Vec<UsedDevice> {
    let input = |(place, transport): (ConfigPlace, &Transport)| {
        let device = |key: &str, path: &Path, kind, baud| UsedDevice {
            place: place.clone().key(&format!("transport.{key}")),
            path: path.to_owned(),
            kind,
            is_output: false,
            baud,
        };
        Some(match transport {
            Transport::Serial(own) => {
                device("device", &own.device, DeviceKind::Serial, Some(own.baud))
            }
            Transport::Slcan(own) => {
                device("device", &own.device, DeviceKind::Serial, Some(own.baud))
            }
            Transport::Pps(own) => device("device", &own.device, DeviceKind::Pulses, None),
            Transport::File(own) | Transport::Pipe(own) => {
                device("path", &own.path, DeviceKind::Read, None)
            }
            Transport::Candump(own) => device("path", &own.path, DeviceKind::Read, None),
            _ => return None,
        })
    };
    let output = |(place, destination): (ConfigPlace, &Destination)| {
        let device = |key: &str, path: &Path, kind, baud| UsedDevice {
            place: place.clone().key(&format!("destination.{key}")),
            path: path.to_owned(),
            kind,
            is_output: true,
            baud,
        };
        Some(match destination {
            Destination::Serial(own) => {
                device("device", &own.device, DeviceKind::Serial, Some(own.baud))
            }
            Destination::File(own) => device("path", &own.path, DeviceKind::Written, None),
            Destination::Pty(own) => device("path", &own.path, DeviceKind::Made, None),
            Destination::Udp(_) | Destination::TcpServer(_) => return None,
        })
    };
    let inputs = inputs(config).filter_map(input);
    inputs.chain(destinations(config).filter_map(output)).collect()
}

/// All addresses that are listened at.
#[must_use]
pub fn listeners(config: &Config) -> Vec<Listener> {
    let mut all = Vec::new();
    let mut add = |place: ConfigPlace, address: SocketAddr, tcp: bool, group: Option<IpAddr>| {
        all.push(Listener { place, address, tcp, group });
    };
    for (place, transport) in inputs(config) {
        let place = place.key("transport.bind");
        match transport {
            Transport::Udp(own) => add(place, own.bind, false, own.multicast.map(IpAddr::V4)),
            Transport::TcpServer(own) => add(place, own.bind, true, None),
            Transport::GatewayUdp(own) => add(place, own.bind, false, None),
            _ => {}
        }
    }
    for (place, destination) in destinations(config) {
        if let Destination::TcpServer(own) = destination {
            add(place.key("destination.bind"), own.bind, true, None);
        }
    }
    if config.web.enabled {
        add(ConfigPlace::one("web").key("listen"), config.web.listen, true, None);
    }
    all
}

/// What ports open, with the places of their sections.
pub(super) fn inputs(config: &Config) -> impl Iterator<Item = (ConfigPlace, &Transport)> {
    config.ports.iter().map(|port| (ConfigPlace::of("port", &port.name), &port.transport))
}

/// Where outputs write, with the places of their sections.
pub(super) fn destinations(config: &Config) -> impl Iterator<Item = (ConfigPlace, &Destination)> {
    let own = |output: &'_ crate::OutputSection| ConfigPlace::of("output", &output.name);
    config
        .outputs
        .iter()
        .filter_map(move |output| Some((own(output), output.destination.as_ref()?)))
}
