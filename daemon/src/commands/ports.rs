//! `insd ports`: what ports the computer has.

use std::fmt::Write as _;
use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

use insd_drivers::ports::{FoundKind, FoundPort, list};
use insd_lab::table::{Align, Table};
use insd_lab::terminal::print;
use serde::Serialize;

/// Options of `insd ports`.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct PortsArgs {
    /// As JSON
    #[arg(long)]
    pub json: bool,
}

/// A port as it is shown.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
struct Shown {
    kind: &'static str,
    /// The system's name.
    name: String,
    /// What to write into a configuration.
    path: String,
    driver: Option<String>,
    /// Numbers of maker and product, as `lsusb` has them.
    vendor: Option<String>,
    product: Option<String>,
    description: Option<String>,
    addresses: Vec<String>,
    /// Of an interface: up, down, unknown.
    state: Option<String>,
    can_open: Option<bool>,
    /// Why not.
    reason: Option<String>,
}

/// Lists the ports.
///
/// # Errors
/// An output that fails.
pub fn run(args: &PortsArgs) -> anyhow::Result<()> {
    let ports: Vec<Shown> = list(Path::new("/")).iter().map(shown).collect();
    let text = if args.json { serde_json::to_string_pretty(&ports)? + "\n" } else { table(&ports) };
    Ok(print(&text)?)
}

fn shown(port: &FoundPort) -> Shown {
    let path = port.stable.first().or(port.device.as_ref());
    Shown {
        kind: match port.kind {
            FoundKind::Serial => "serial",
            FoundKind::Pps => "pps",
            FoundKind::Can => "can",
            FoundKind::Network => "network",
        },
        name: port.name.clone(),
        path: path.map_or_else(|| port.name.clone(), |path| path.display().to_string()),
        driver: port.driver.clone(),
        vendor: port.vendor.clone(),
        product: port.product.clone(),
        description: port.description.clone(),
        addresses: port.addresses.iter().map(ToString::to_string).collect(),
        state: port.state.clone(),
        can_open: port.may_open,
        reason: port.device.as_deref().filter(|_| port.may_open == Some(false)).map(reason),
    }
}

/// Why a device cannot be opened, and what to do about it.
fn reason(device: &Path) -> String {
    match fs::metadata(device) {
        Err(error) => format!("{}: {error}", device.display()),
        Ok(data) => {
            let groups = fs::read_to_string("/etc/group").unwrap_or_default();
            let group = group_name(&groups, data.gid()).unwrap_or_else(|| data.gid().to_string());
            let path = device.display();
            match data.mode() & 0o060 {
                0o060 => format!(
                    "{path} is for the group {group}: sudo usermod -aG {group} USER, then log in again"
                ),
                _ => format!("{path} is for root only: a udev rule must give it to a group"),
            }
        }
    }
}

/// The name of a group in the text of `/etc/group`.
fn group_name(groups: &str, gid: u32) -> Option<String> {
    groups.lines().find_map(|line| {
        let mut fields = line.split(':');
        let name = fields.next()?;
        (fields.nth(1)?.parse() == Ok(gid)).then(|| name.to_owned())
    })
}

fn table(ports: &[Shown]) -> String {
    if ports.is_empty() {
        return "No ports: no serial line, no pulse per second, no CAN, no network.\n\
                Is the adapter plugged in? `sudo dmesg | tail` tells what the system saw.\n"
            .to_owned();
    }
    let left = Align::Left;
    let columns = [
        ("kind", left),
        ("name", left),
        ("usable", left),
        ("driver", left),
        ("id", left),
        ("path in a configuration", left),
    ];
    let mut table = Table::new(&columns);
    for port in ports {
        let id = port.vendor.as_ref().zip(port.product.as_ref());
        table.push(vec![
            port.kind.to_owned(),
            port.name.clone(),
            usable(port),
            port.driver.clone().unwrap_or_default(),
            id.map_or(String::new(), |(vendor, product)| format!("{vendor}:{product}")),
            place(port),
        ]);
    }
    let mut text = table.to_string();
    for port in ports {
        if let Some(reason) = &port.reason {
            let _ = write!(text, "\n{}: {reason}\n", port.name);
        }
    }
    if ports.iter().all(|port| port.kind != "serial") {
        text.push_str("\nNo serial line. Is the adapter plugged in? `sudo dmesg | tail` tells.\n");
    }
    text
}

fn usable(port: &Shown) -> String {
    match (port.can_open, &port.state) {
        (Some(true), _) => "yes".to_owned(),
        (Some(false), _) => "no".to_owned(),
        (None, Some(state)) => state.clone(),
        (None, None) => "unknown".to_owned(),
    }
}

/// The path of a device, the addresses of a network, and what the port calls itself.
fn place(port: &Shown) -> String {
    let own = match port.kind {
        "network" if port.addresses.is_empty() => "no address".to_owned(),
        "network" => port.addresses.join(" "),
        _ => port.path.clone(),
    };
    match &port.description {
        Some(description) => format!("{own}  ({description})"),
        None => own,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn serial(may_open: bool) -> Shown {
        shown(&FoundPort {
            kind: FoundKind::Serial,
            name: "ttyUSB0".to_owned(),
            device: Some("/dev/nonesuch".into()),
            stable: vec!["/dev/serial/by-id/usb-FTDI-if00".into()],
            driver: Some("ftdi_sio".to_owned()),
            vendor: Some("0403".to_owned()),
            product: Some("6001".to_owned()),
            description: Some("FTDI FT232R".to_owned()),
            addresses: Vec::new(),
            state: None,
            may_open: Some(may_open),
        })
    }

    #[test]
    fn the_lasting_name_is_the_one_for_a_configuration() {
        let text = table(&[serial(true)]);
        let row = "serial  ttyUSB0  yes     ftdi_sio  0403:6001  /dev/serial/by-id/usb-FTDI-if00";
        assert!(text.contains(row) && text.contains("(FTDI FT232R)"), "{text}");
    }

    #[test]
    fn a_port_that_cannot_be_opened_says_why() {
        let text = table(&[serial(false)]);
        assert!(text.contains("ttyUSB0: /dev/nonesuch: No such file"), "{text}");
        assert_eq!(group_name("root:x:0:\ndialout:x:20:me,you\n", 20).as_deref(), Some("dialout"));
    }

    #[test]
    fn nothing_is_told_in_a_friendly_way() {
        assert!(table(&[]).contains("Is the adapter plugged in?"));
    }
}
