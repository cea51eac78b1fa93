//! Devices: their names, their rates, and two that want the same one.

use std::path::Path;

use insd_drivers::ports::Transport;
use insd_intake::config::{Kind, Role};

use super::found::Found;
use crate::Config;
use crate::check::finding::ConfigPlace;
use crate::check::uses::{self, DeviceKind, UsedDevice};

/// Rates to which devices can be set.
const RATES: [u32; 17] = [
    300, 600, 1200, 2400, 4800, 9600, 19_200, 38_400, 57_600, 115_200, 230_400, 460_800, 500_000,
    921_600, 1_000_000, 2_000_000, 4_000_000,
];
/// Bytes of the shortest sample that an IMU sends: three rates, three accelerations, a checksum.
const SAMPLE: f64 = 30.0;

pub(super) fn look(config: &Config, found: &mut Found) {
    let devices = uses::devices(config);
    for (index, device) in devices.iter().enumerate() {
        name(device, found);
        rate(device, found);
        let earlier = devices.iter().take(index).find(|other| other.path == device.path);
        if let Some(other) = earlier {
            twice(device, other, found);
        }
    }
    for port in &config.ports {
        let place = ConfigPlace::of("port", &port.name);
        let heard = config.sensors.iter().any(|sensor| sensor.port == port.name);
        let has_node = config.nodes.iter().any(|node| node.port == port.name);
        let is_pulse = matches!(port.transport, Transport::Pps(_));
        if !heard && !has_node && !is_pulse && !port.alerts {
            found.warn(
                "port-unused",
                place,
                "no [[sensor]] is on this port: what comes there is not used",
                &format!("`insd sniff` suggests its sections; they say port = \"{}\"", port.name),
            );
        }
    }
    casters(config, found);
    samples(config, found);
}

/// Who measures at the other end of a caster is a base, and not on board.
fn casters(config: &Config, found: &mut Found) {
    let is_caster = |name: &str| {
        let own = config.ports.iter().find(|port| port.name == name);
        own.is_some_and(|port| matches!(port.transport, Transport::Ntrip(_)))
    };
    for sensor in config.sensors.iter().filter(|own| own.kind == Kind::Rtcm) {
        if is_caster(&sensor.port) {
            found.error(
                "caster-on-board",
                ConfigPlace::of("sensor", &sensor.name).key("kind"),
                "corrections of a caster would be taken for a receiver of the ship",
                "kind = \"rtcm_base\"",
            );
        }
    }
}

/// Whether the name can be that of a device of this system.
fn name(device: &UsedDevice, found: &mut Found) {
    if !matches!(device.kind, DeviceKind::Serial | DeviceKind::Pulses) {
        return;
    }
    let text = device.path.display().to_string();
    let upper = text.trim_start_matches(r"\\.\").to_uppercase();
    let number = upper.strip_prefix("COM").and_then(|rest| rest.parse::<u32>().ok());
    if let Some(number) = number {
        let here = number.saturating_sub(1);
        found.error(
            "device-windows",
            device.place.clone(),
            &format!("{text} is a name of Windows"),
            &format!(
                "here a serial line is like /dev/ttyS{here} or /dev/ttyUSB0: see `insd ports`"
            ),
        );
    } else if !device.path.is_absolute() {
        let bare = text.trim_start_matches("./");
        found.error(
            "device-relative",
            device.place.clone(),
            &format!("{text} is no path of a device"),
            &format!("\"/dev/{bare}\"? `insd ports` lists them"),
        );
    } else if numbered(&device.path) {
        found.note(
            "device-numbered",
            device.place.clone(),
            &format!("{text} is whatever was plugged in first"),
            "the path below /dev/serial/by-id stays: `insd ports` lists it",
        );
    }
}

/// A USB serial line by its number.
fn numbered(path: &Path) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
    path.parent() == Some(Path::new("/dev"))
        && name.is_some_and(|name| name.starts_with("ttyUSB") || name.starts_with("ttyACM"))
}

fn rate(device: &UsedDevice, found: &mut Found) {
    let Some(baud) = device.baud.filter(|baud| *baud > 0 && !RATES.contains(baud)) else { return };
    let distance = |rate: &u32| (f64::from(*rate) / f64::from(baud)).ln().abs();
    let near = RATES.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let place = ConfigPlace {
        key: device.place.key.as_ref().map(|key| key.replace(".device", ".baud")),
        ..device.place.clone()
    };
    let text = format!("{baud} baud is no usual rate");
    found.warn("baud-odd", place, &text, &near.map_or(String::new(), |near| format!("{near}?")));
}

fn twice(device: &UsedDevice, other: &UsedDevice, found: &mut Found) {
    let place = device.place.clone();
    let section =
        |device: &UsedDevice| ConfigPlace { key: None, ..device.place.clone() }.to_string();
    let path = device.path.display();
    match (other.is_output, device.is_output) {
        (false, true) => found.error(
            "output-on-input",
            place,
            &format!("{path} is the input {}: it would be written to", section(other)),
            "an output needs a line of its own",
        ),
        _ => found.error(
            "device-twice",
            place,
            &format!("{path} is used by {}, too", section(other)),
            "a device has one reader: several [[sensor]] may name the same port",
        ),
    }
}

/// Whether the samples of an IMU go through its line.
fn samples(config: &Config, found: &mut Found) {
    for sensor in config.sensors.iter().filter(|own| own.kind.role() == Role::Imu) {
        let port = config.ports.iter().find(|port| port.name == sensor.port);
        let Some(Transport::Serial(line)) = port.map(|port| &port.transport) else { continue };
        let capacity = f64::from(line.baud) / f64::from(line.symbols());
        let share = sensor.rate_hz * SAMPLE / capacity.max(1e-9);
        if line.baud > 0 && share > 1.0 {
            let need = RATES.iter().find(|rate| f64::from(**rate) >= f64::from(line.baud) * share);
            found.error(
                "imu-baud",
                ConfigPlace::of("port", &sensor.port).key("transport.baud"),
                &format!(
                    "{} samples a second of the IMU \"{}\" do not go through {} baud",
                    sensor.rate_hz, sensor.name, line.baud
                ),
                &need.map_or(String::new(), |need| format!("at least {need} baud")),
            );
        }
    }
}
