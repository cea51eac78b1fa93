//! What PORT on the command line means.

use std::fs;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, ToSocketAddrs};
use std::os::unix::fs::FileTypeExt;
use std::path::{Path, PathBuf};

use insd_drivers::ports::{
    self, File, PortConfig, Pps, Serial, TcpClient, TcpServer, Transport, Udp,
};
use insd_drivers::raw;
use insd_lab::sniff::bus::file::BusFile;
use insd_lab::sniff::{PortToHear, SuggestedTransport as Suggested};

use super::can::{self, Opened};
use super::captured;

/// Rates at which a serial line is listened to when none is given, the most common first.
const BAUDS: [u32; 9] = [115_200, 38_400, 4_800, 9_600, 460_800, 921_600, 230_400, 57_600, 19_200];

/// For how long each of them is tried, s: a sensor that speaks once a second is heard.
const PROBE_S: f64 = 1.3;

/// Rates that a serial line may have.
const RATES: std::ops::RangeInclusive<u32> = 50..=4_000_000;

/// Something to listen to.
#[derive(Clone, Debug, PartialEq)]
pub struct Address {
    /// What is known of it beforehand.
    pub plan: PortToHear,
    /// What is opened.
    pub source: Source,
}

/// What is opened.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// A port.
    Port(Box<PortConfig>),
    /// A raw recording.
    Recording(PathBuf),
    /// A file of a gateway of NMEA 2000.
    Captured(PathBuf, BusFile),
}

impl Address {
    /// Longest time in which it is known whether the port can be opened, s.
    #[must_use]
    pub fn search_s(&self) -> f64 {
        match &self.source {
            Source::Port(config) => match &config.transport {
                Transport::Serial(serial) => serial.probe_bauds.len() as f64 * serial.probe_s,
                _ => 0.0,
            },
            Source::Recording(_) | Source::Captured(..) => 0.0,
        }
    }
}

/// Reads a PORT.
///
/// # Errors
/// In words, what is wrong with it.
pub fn parse(text: &str) -> Result<Address, String> {
    let (transport, timed, suggested) = match text.split_once("://") {
        Some(("udp", rest)) => udp(rest)?,
        Some(("tcp", rest)) => tcp(rest)?,
        Some(("tcp-listen", rest)) => tcp_listen(rest)?,
        Some(("pps", rest)) => pps(rest)?,
        Some(("can", rest)) => can::interface(rest)?,
        Some(("can+tcp", rest)) => can::tcp(rest)?,
        Some(("can+udp", rest)) => can::udp(rest)?,
        Some((scheme, _)) => {
            return Err(format!(
                "`{scheme}://` is none of udp, tcp, tcp-listen, pps, can, can+tcp and can+udp"
            ));
        }
        None if can::is_interface(text) => can::interface(text)?,
        None => return path(text),
    };
    let plan = PortToHear { name: text.to_owned(), timed, transport: suggested };
    Ok(Address { plan, source: Source::Port(Box::new(PortConfig::new(transport))) })
}

fn udp(rest: &str) -> Result<Opened, String> {
    let (interface, address) = match rest.split_once('@') {
        Some((interface, address)) => (Some(interface_address(interface)?), address),
        None => (None, rest),
    };
    let address = socket(address)?;
    let group = match address.ip() {
        IpAddr::V4(group) if group.is_multicast() => Some(group),
        _ => None,
    };
    if interface.is_some() && group.is_none() {
        return Err(format!("{} is no multicast group: no interface is needed", address.ip()));
    }
    // bound to the group, other datagrams for the same port do not come
    let udp = Udp { bind: address, multicast: group, interface, from: None };
    let mut table = format!("kind = \"udp\", bind = \"{address}\"");
    for (key, value) in [("multicast", group), ("interface", interface)] {
        if let Some(value) = value {
            table.push_str(&format!(", {key} = \"{value}\""));
        }
    }
    Ok((Transport::Udp(udp), true, Some(Suggested::Other(format!("{{ {table} }}")))))
}

fn tcp(rest: &str) -> Result<Opened, String> {
    let number = rest.rsplit_once(':').filter(|(host, _)| !host.is_empty());
    let number = number.and_then(|(_, number)| number.parse::<u16>().ok());
    number.filter(|number| *number > 0).ok_or("expected HOST:PORT")?;
    let table = format!("{{ kind = \"tcp-client\", address = \"{rest}\" }}");
    let client = TcpClient { address: rest.to_owned(), ask: None };
    Ok((Transport::TcpClient(client), true, Some(Suggested::Other(table))))
}

fn tcp_listen(rest: &str) -> Result<Opened, String> {
    let bind = socket(rest)?;
    let table = format!("{{ kind = \"tcp-server\", bind = \"{bind}\" }}");
    let server = TcpServer::new(bind);
    Ok((Transport::TcpServer(server), true, Some(Suggested::Other(table))))
}

fn pps(rest: &str) -> Result<Opened, String> {
    if !rest.starts_with('/') {
        return Err("expected pps:///dev/ppsN, with three slashes".to_owned());
    }
    let pps = Pps { device: PathBuf::from(rest), edge: ports::Edge::default() };
    Ok((Transport::Pps(pps), true, None))
}

/// An address of this computer or a group, with its port; all addresses if only a port is given.
fn socket(text: &str) -> Result<SocketAddr, String> {
    let expected = || format!("`{text}` is no ADDRESS:PORT");
    let whole = if text.starts_with(':') { format!("0.0.0.0{text}") } else { text.to_owned() };
    if whole.starts_with("localhost:") {
        return whole.to_socket_addrs().ok().and_then(|mut all| all.next()).ok_or_else(expected);
    }
    whole.parse().map_err(|_| expected())
}

/// The address of an interface, given by itself or by the interface's name.
fn interface_address(text: &str) -> Result<Ipv4Addr, String> {
    if let Ok(address) = text.parse() {
        return Ok(address);
    }
    if text == "lo" {
        return Ok(Ipv4Addr::LOCALHOST);
    }
    let found = ports::list(Path::new("/")).into_iter().find(|port| port.name == text);
    let found = found.ok_or_else(|| format!("there is no interface `{text}`: see `insd ports`"))?;
    let v4 = found.addresses.iter().find_map(|address| match address {
        IpAddr::V4(address) => Some(*address),
        IpAddr::V6(_) => None,
    });
    v4.ok_or_else(|| format!("the interface `{text}` has no IPv4 address"))
}

/// A path with or without a baud rate.
fn path(text: &str) -> Result<Address, String> {
    if text.is_empty() {
        return Err("expected a device, a file or an address".to_owned());
    }
    if text == "-" {
        let file = Transport::File(File { path: PathBuf::from("/dev/stdin") });
        let plan = PortToHear { name: "-".to_owned(), timed: true, transport: None };
        return Ok(Address { plan, source: Source::Port(Box::new(PortConfig::new(file))) });
    }
    let whole = Path::new(text);
    let (path, rate) = match text.rsplit_once(',') {
        Some((path, rate)) if !whole.exists() => (Path::new(path), Some(baud(rate)?)),
        _ => (whole, None),
    };
    let kind = fs::metadata(path).ok().map(|data| (data.is_dir(), data.file_type()));
    let is_recording = path.extension().is_some_and(|end| end == raw::EXTENSION);
    let (transport, timed, suggested) = match kind {
        Some((true, _)) => return recording(text, path, rate),
        Some((_, kind)) if kind.is_file() && is_recording => return recording(text, path, rate),
        Some((_, kind)) if kind.is_file() && can::is_log(path) => can::log(path),
        Some((_, kind)) if kind.is_file() => {
            if let Some(format) = captured::format_of(path) {
                return captured(text, path, rate, format);
            }
            let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
            let table = format!("{{ kind = \"file\", path = {} }}", quoted(&whole));
            let file = Transport::File(File { path: path.to_owned() });
            (file, false, Some(Suggested::Other(table)))
        }
        Some((_, kind)) if kind.is_fifo() => {
            let table = format!("{{ kind = \"pipe\", path = {} }}", quoted(path));
            let pipe = Transport::Pipe(File { path: path.to_owned() });
            (pipe, true, Some(Suggested::Other(table)))
        }
        _ => serial(path, rate.flatten()),
    };
    if rate.is_some() && !matches!(transport, Transport::Serial(_)) {
        return Err(format!("{} is no serial line: it has no baud rate", path.display()));
    }
    let plan = PortToHear { name: path.display().to_string(), timed, transport: suggested };
    Ok(Address { plan, source: Source::Port(Box::new(PortConfig::new(transport))) })
}

fn recording(text: &str, path: &Path, rate: Option<Option<u32>>) -> Result<Address, String> {
    if rate.is_some() {
        return Err(format!("{} is a recording: it has no baud rate", path.display()));
    }
    let plan = PortToHear { name: text.to_owned(), timed: true, transport: None };
    Ok(Address { plan, source: Source::Recording(path.to_owned()) })
}

/// A file in which some gateway of a CAN bus has written.
fn captured(
    text: &str,
    path: &Path,
    rate: Option<Option<u32>>,
    format: BusFile,
) -> Result<Address, String> {
    if rate.is_some() {
        return Err(format!("{} is a log of a bus: it has no baud rate", path.display()));
    }
    let transport = format.transport().map(|table| Suggested::Other(table.to_owned()));
    let plan = PortToHear { name: text.to_owned(), timed: false, transport };
    Ok(Address { plan, source: Source::Captured(path.to_owned(), format) })
}

/// A baud rate; `None` if it is to be found.
fn baud(text: &str) -> Result<Option<u32>, String> {
    if text == "auto" {
        return Ok(None);
    }
    let rate = text.parse().ok().filter(|rate| RATES.contains(rate));
    rate.map(Some).ok_or_else(|| {
        format!("`{text}` is no baud rate: expected `auto` or {} to {}", RATES.start(), RATES.end())
    })
}

/// A serial line of this rate, or of one that is to be found, suggested by its lasting name.
fn serial(path: &Path, rate: Option<u32>) -> Opened {
    let found = ports::list(Path::new("/")).into_iter().find(|port| {
        port.device.as_deref() == Some(path) || port.stable.iter().any(|stable| stable == path)
    });
    let stable = found.and_then(|port| port.stable.into_iter().next());
    let device = stable.unwrap_or_else(|| path.to_owned()).display().to_string();
    let mut serial = Serial::new(path.to_owned(), rate.unwrap_or(BAUDS[0]));
    if rate.is_none() {
        serial.probe_bauds = BAUDS.to_vec();
        serial.probe_s = PROBE_S;
    }
    (Transport::Serial(serial), true, Some(Suggested::Serial { device }))
}

fn quoted(path: &Path) -> String {
    insd_lab::sniff::quoted(&path.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn transport(text: &str) -> Transport {
        match parse(text).unwrap().source {
            Source::Port(config) => {
                assert!(!config.write && config.faults().is_empty());
                config.transport
            }
            Source::Recording(path) | Source::Captured(path, _) => panic!("{}", path.display()),
        }
    }

    #[test]
    fn a_device_has_a_rate_or_one_is_searched() {
        let fixed = Serial::new(PathBuf::from("/dev/absent0"), 4800);
        assert_eq!(transport("/dev/absent0,4800"), Transport::Serial(fixed));
        for text in ["/dev/absent0", "/dev/absent0,auto"] {
            let Transport::Serial(serial) = transport(text) else { panic!("{text}") };
            assert_eq!(serial.probe_bauds, BAUDS);
            assert!(parse(text).unwrap().search_s() > 9.0);
        }
    }

    #[test]
    fn a_group_is_joined_and_an_address_is_not() {
        let Transport::Udp(group) = transport("udp://lo@239.192.0.1:60001") else { panic!() };
        assert_eq!(group.multicast, Some(Ipv4Addr::new(239, 192, 0, 1)));
        assert_eq!(group.interface, Some(Ipv4Addr::LOCALHOST));
        let Transport::Udp(plain) = transport("udp://:10110") else { panic!() };
        assert_eq!((plain.bind.to_string().as_str(), plain.multicast), ("0.0.0.0:10110", None));
    }

    #[test]
    fn what_is_suggested_reads_as_what_was_opened() {
        for text in ["udp://127.0.0.1@239.192.0.1:60001", "tcp://a.b:7", "tcp-listen://:7"] {
            let Some(Suggested::Other(table)) = parse(text).unwrap().plan.transport else {
                panic!("{text}")
            };
            let read: PortConfig = toml::from_str(&format!("transport = {table}")).unwrap();
            assert_eq!(read.transport, transport(text));
        }
    }

    #[test]
    fn what_is_no_port_is_told_why() {
        for (text, why) in [
            ("/dev/absent0,115k", "`115k` is no baud rate"),
            ("/dev/absent0,7", "no baud rate"),
            ("udp://10110", "no ADDRESS:PORT"),
            ("udp://lo@127.0.0.1:10110", "no multicast group"),
            ("udp://nonesuch0@239.192.0.1:60001", "no interface `nonesuch0`"),
            ("tcp://somewhere", "HOST:PORT"),
            ("tcp://:0", "HOST:PORT"),
            ("pps://dev/pps0", "three slashes"),
            ("can://", "the name of an interface"),
            ("can+tcp://gateway:1", "FORMAT@"),
            ("usb://can0", "none of udp"),
            ("/,4800", "has no baud rate"),
            ("", "expected a device"),
        ] {
            let told = parse(text).unwrap_err();
            assert!(told.contains(why), "{text}: {told}");
        }
    }
}
