//! CAN buses on the command line.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::net::SocketAddr;
use std::path::Path;

use insd_drivers::can::{Candump, GatewayFormat, GatewayTcp, GatewayUdp, Socketcan};
use insd_drivers::ports::Transport;
use insd_lab::sniff::{SuggestedTransport as Suggested, quoted};
use insd_n2k::text::candump;

/// What is opened, whether its times are those of receipt, and what to write into a configuration.
pub(super) type Opened = (Transport, bool, Option<Suggested>);

/// Longest name of an interface.
const NAME: usize = 15;
/// Lines and bytes of a file that are looked at to find out what it is.
const LINES: usize = 20;
const BYTES: u64 = 4096;

/// Whether a text can only be the name of a CAN interface: `can0`, `vcan1`, `slcan0`.
pub(super) fn is_interface(text: &str) -> bool {
    let digits = text.trim_start_matches(|c: char| c.is_ascii_alphabetic());
    let kind = text.strip_suffix(digits).unwrap_or_default();
    let numbered = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit());
    numbered && kind.ends_with("can") && !Path::new(text).exists()
}

/// An interface of the kernel.
pub(super) fn interface(name: &str) -> Result<Opened, String> {
    if name.is_empty() || name.len() > NAME || name.contains('/') {
        return Err(format!("`{name}`: expected the name of an interface, such as can0"));
    }
    let table = format!("{{ kind = \"socketcan\", interface = {} }}", quoted(name));
    let transport = Transport::Socketcan(Socketcan { interface: name.to_owned() });
    Ok((transport, true, Some(Suggested::Other(table))))
}

/// A gateway that is called.
pub(super) fn tcp(rest: &str) -> Result<Opened, String> {
    let (word, format, address) = gateway(rest)?;
    let table =
        format!("{{ kind = \"gateway-tcp\", address = {}, format = \"{word}\" }}", quoted(address));
    let transport = Transport::GatewayTcp(GatewayTcp { address: address.to_owned(), format });
    Ok((transport, true, Some(Suggested::Other(table))))
}

/// A gateway that sends datagrams to this address.
pub(super) fn udp(rest: &str) -> Result<Opened, String> {
    let (word, format, address) = gateway(rest)?;
    let bind: SocketAddr =
        address.parse().map_err(|_| format!("`{address}` is no ADDRESS:PORT of this computer"))?;
    let table = format!("{{ kind = \"gateway-udp\", bind = \"{bind}\", format = \"{word}\" }}");
    let transport = Transport::GatewayUdp(GatewayUdp { bind, to: None, from: None, format });
    Ok((transport, true, Some(Suggested::Other(table))))
}

fn gateway(rest: &str) -> Result<(&str, GatewayFormat, &str), String> {
    let (word, address) = rest.split_once('@').ok_or("expected FORMAT@ADDRESS:PORT")?;
    let format = serde_json::from_value(serde_json::Value::from(word))
        .map_err(|error| format!("`{word}` is no format of a gateway: {error}"))?;
    Ok((word, format, address))
}

/// Whether a file is a log of candump: its first lines are.
pub(super) fn is_log(path: &Path) -> bool {
    use std::io::Read;
    let Ok(file) = File::open(path) else { return false };
    let mut lines = BufReader::new(file.take(BYTES)).lines().take(LINES).map_while(Result::ok);
    lines.any(|line| candump::parse(line.as_bytes()).is_some())
}

/// A log of candump.
pub(super) fn log(path: &Path) -> Opened {
    (Transport::Candump(Candump { path: path.to_owned() }), false, None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interface_is_known_by_its_name() {
        for name in ["can0", "vcan1", "slcan12", "vxcan0"] {
            assert!(is_interface(name), "{name}");
        }
        for name in ["can", "ttyUSB0", "/dev/can0", "scan.log", "can0,115200"] {
            assert!(!is_interface(name), "{name}");
        }
    }

    #[test]
    fn a_log_is_known_by_its_lines() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bus.log");
        std::fs::write(&path, "(1.000000) can0 09F11201#FF8E3B00007FFFFD\n").unwrap();
        assert!(is_log(&path));
        std::fs::write(&path, "$HETHS,316.70,E*1A\n").unwrap();
        assert!(!is_log(&path));
    }
}
