//! Devices, interfaces and addresses: are they there, may they be used, is somebody else using them?

use std::collections::BTreeMap;
use std::fs;
use std::net::{IpAddr, TcpListener, UdpSocket};
use std::os::unix::fs::{FileTypeExt, MetadataExt};
use std::path::{Path, PathBuf};

use insd_config::Config;
use insd_config::check::nearest::nearest;
use insd_config::check::uses::{self, DeviceKind, UsedDevice};
use insd_config::check::{ConfigFinding, ConfigPlace, Severity};
use insd_drivers::ports::{self, Cable, FoundKind, FoundPort, Transport};

use super::files::reason;
use super::people::{Person, Wish, group_name};
use super::processes;

pub(super) fn look(config: &Config, person: &Person, is_running: bool) -> Vec<ConfigFinding> {
    let here = ports::list(Path::new("/"));
    let mut found = Vec::new();
    let mut seen = BTreeMap::<PathBuf, UsedDevice>::new();
    for device in uses::devices(config) {
        if let Some(finding) = device_fault(&device, &here, person) {
            found.push(finding);
            continue;
        }
        if let Ok(real) = fs::canonicalize(&device.path)
            && matches!(device.kind, DeviceKind::Serial | DeviceKind::Pulses)
        {
            if let Some(other) = seen.get(&real).filter(|other| other.path != device.path) {
                found.push(same(&device, other, &real));
            }
            let busy = busy(&device).filter(|_| !is_running);
            if busy.is_none() && !is_running && device.is_output {
                found.extend(plug(&device));
            }
            found.extend(busy);
            seen.entry(real).or_insert(device);
        }
    }
    found.extend(interfaces(config, &here));
    found.extend(addresses(config, &here, is_running));
    found
}

/// The same device under two names.
fn same(device: &UsedDevice, other: &UsedDevice, real: &Path) -> ConfigFinding {
    let section = ConfigPlace { key: None, ..other.place.clone() };
    let cause =
        if device.is_output && !other.is_output { "output-on-input" } else { "device-twice" };
    let (path, real) = (device.path.display(), real.display());
    let text = format!("{path} is {real}, which {section} uses by another name");
    ConfigFinding::new(Severity::Error, cause, device.place.clone(), &text)
}

fn device_fault(device: &UsedDevice, here: &[FoundPort], person: &Person) -> Option<ConfigFinding> {
    let tell = |cause, text: &str, advice: String| {
        Some(ConfigFinding::new(Severity::Error, cause, device.place.clone(), text).advise(advice))
    };
    let path = device.path.display();
    if matches!(device.kind, DeviceKind::Written | DeviceKind::Made) {
        let folder = device.path.parent().unwrap_or(Path::new("/"));
        let data = fs::metadata(folder).ok();
        let sound = data.is_some_and(|data| data.is_dir() && person.may(Wish::Write, &data));
        let text = format!("{} cannot be written to by {}", folder.display(), person.name);
        return if sound {
            None
        } else {
            tell("output-folder", &text, "a folder of insd's own".to_owned())
        };
    }
    let data = match fs::metadata(&device.path) {
        Ok(data) => data,
        Err(error) => {
            let text = format!("{path}: {}", reason(&error).replace("file", "device"));
            return tell("device-absent", &text, meant(device, here));
        }
    };
    let is_device = data.file_type().is_char_device();
    if matches!(device.kind, DeviceKind::Serial | DeviceKind::Pulses) && !is_device {
        return tell("device-kind", &format!("{path} is no device"), meant(device, here));
    }
    let wish = if device.kind == DeviceKind::Read { Wish::Read } else { Wish::Both };
    if person.may(wish, &data) {
        return None;
    }
    let group = group_name(data.gid());
    let text = format!("{path} is for the group {group}, and {} is not in it", person.name);
    let advice = match data.mode() & 0o060 {
        0o060 => format!("sudo usermod -aG {group} {}, then start it again", person.name),
        _ => "a udev rule must give it to a group: docs/service.md".to_owned(),
    };
    tell("device-denied", &text, advice)
}

/// What there is instead of a device that is not there.
fn meant(device: &UsedDevice, here: &[FoundPort]) -> String {
    let kind = if device.kind == DeviceKind::Pulses { FoundKind::Pps } else { FoundKind::Serial };
    let names: Vec<String> = here
        .iter()
        .filter(|port| port.kind == kind)
        .filter_map(|port| port.stable.first().or(port.device.as_ref()))
        .map(|path| path.display().to_string())
        .collect();
    if names.is_empty() {
        return "is it plugged in? `insd ports` finds none of the kind".to_owned();
    }
    format!("there are: {}", names.join(", "))
}

fn busy(device: &UsedDevice) -> Option<ConfigFinding> {
    let holder = processes::holder(&device.path)?;
    let text = format!(
        "{} is open in another program: {}, process {}",
        device.path.display(),
        holder.name,
        holder.number
    );
    let advice = match holder.name.as_str() {
        "gpsd" => "take it from gpsd's list: USBAUTO=\"false\" in /etc/default/gpsd",
        "ModemManager" => "sudo systemctl disable --now ModemManager",
        _ => "stop that program, or give it another device",
    };
    let finding = ConfigFinding::new(Severity::Error, "device-busy", device.place.clone(), &text);
    Some(finding.advise(advice))
}

/// Whether somebody is at the other end of an output, as far as the control lines tell.
fn plug(device: &UsedDevice) -> Option<ConfigFinding> {
    let place = device.place.clone();
    match ports::cable(&device.path) {
        Ok(Cable::Held) => None,
        Ok(Cable::Quiet) => {
            let text = "nobody at the other end holds DSR, CTS or DCD: is the cable plugged in?";
            let finding = ConfigFinding::new(Severity::Note, "cable-quiet", place, text);
            Some(finding.advise("a cable of two or three wires has none of these lines"))
        }
        Ok(Cable::Unknown) => {
            let text = "whether a cable is plugged in is not known: the driver does not tell";
            Some(ConfigFinding::new(Severity::Note, "cable-unknown", place, text))
        }
        Err(error) => {
            let text = format!("{} cannot be opened: {error}", device.path.display());
            Some(ConfigFinding::new(Severity::Error, "port-closed", place, &text))
        }
    }
}

fn interfaces(config: &Config, here: &[FoundPort]) -> Vec<ConfigFinding> {
    let mut found = Vec::new();
    for port in &config.ports {
        let Transport::Socketcan(own) = &port.transport else { continue };
        let place = ConfigPlace::of("port", &port.name).key("transport.interface");
        let known = here.iter().filter(|other| other.kind == FoundKind::Can);
        let names: Vec<&str> = known.map(|other| other.name.as_str()).collect();
        let state = here.iter().find(|other| other.name == own.interface);
        match state.and_then(|other| other.state.as_deref()) {
            None if state.is_none() => {
                let text = format!("there is no interface {}", own.interface);
                let finding = ConfigFinding::new(Severity::Error, "interface-absent", place, &text);
                let advice = match nearest(&own.interface, names.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => "`insd ports` lists them; docs/service.md sets one up".to_owned(),
                };
                found.push(finding.advise(advice));
            }
            Some("down") => {
                let text = format!("the interface {} is down", own.interface);
                let finding = ConfigFinding::new(Severity::Error, "interface-down", place, &text);
                found.push(finding.advise("its bit rate is the system's affair: docs/service.md"));
            }
            _ => {}
        }
    }
    found
}

fn addresses(config: &Config, here: &[FoundPort], is_running: bool) -> Vec<ConfigFinding> {
    let own: Vec<IpAddr> = here.iter().flat_map(|port| port.addresses.iter().copied()).collect();
    let is_own = |address: IpAddr| {
        let general = address.is_unspecified() || address.is_loopback() || address.is_multicast();
        general || own.contains(&address)
    };
    let mut found = Vec::new();
    for listener in uses::listeners(config) {
        let (address, place) = (listener.address, listener.place);
        if !is_own(address.ip()) {
            let text = format!("{} is no address of this computer", address.ip());
            let all: Vec<String> = own.iter().map(ToString::to_string).collect();
            let advice = format!("0.0.0.0 for all, or one of {}", all.join(", "));
            let finding = ConfigFinding::new(Severity::Error, "address-foreign", place, &text);
            found.push(finding.advise(advice));
        } else if !is_running && let Some(error) = taken(&listener.address, listener.tcp) {
            let text = format!("{address} cannot be listened at: {error}");
            let finding = ConfigFinding::new(Severity::Error, "address-busy", place, &text);
            found.push(finding.advise("another program has it: `ss -lntup` tells which"));
        }
    }
    for port in &config.ports {
        let Transport::Udp(udp) = &port.transport else { continue };
        if let Some(interface) = udp.interface.filter(|own| !is_own(IpAddr::V4(*own))) {
            let place = ConfigPlace::of("port", &port.name).key("transport.interface");
            let text = format!("{interface} is no address of this computer");
            found.push(ConfigFinding::new(Severity::Error, "address-foreign", place, &text));
        }
    }
    found
}

/// What the system says to listening at an address, if it refuses. Groups share their ports.
fn taken(address: &std::net::SocketAddr, tcp: bool) -> Option<std::io::Error> {
    if tcp {
        return TcpListener::bind(address).err();
    }
    let shared = address.ip().is_multicast() || address.ip().is_unspecified();
    if shared { None } else { UdpSocket::bind(address).err() }
}
