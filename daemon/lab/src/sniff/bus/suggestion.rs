//! Sections of a configuration for the devices of a bus.

use insd_wire::imu::can::{FrameLayout, Shipped};

use super::report::{BusReport, DeviceReport, GroupReport};
use crate::sniff::{quoted, suggestion::round as rounded};

/// Tables of CAN IMUs by the word of the configuration.
const LAYOUTS: [(&str, Shipped); 3] = [
    ("xsens", Shipped::Xsens),
    ("xsens_increments", Shipped::XsensIncrements),
    ("sbg", Shipped::Sbg),
];

/// Which groups make which sensor: kind, beginning of its name, groups of which one is enough.
const SENSORS: [(&str, &str, &[u32]); 3] = [
    ("n2k_gnss", "gnss", &[129_029]),
    ("n2k_heading", "compass", &[127_250]),
    ("n2k_log", "log", &[130_578, 128_259]),
];

/// Model of a node of insd: who listens to the navigator hears only itself, so it is no sensor.
const OURS: &str = "insd";

/// One section for each sensor on the bus of a port.
pub(in crate::sniff) fn sections(bus: &BusReport, port: &str) -> Vec<String> {
    let of_device = |device| {
        SENSORS.iter().filter_map(move |(kind, role, groups)| {
            let group = find(device, groups)?;
            Some(section(device, group, kind, role, port))
        })
    };
    let others = bus.devices.iter().filter(|device| device.model.as_deref() != Some(OURS));
    others.flat_map(of_device).chain(imu(bus, port)).collect()
}

/// An IMU whose frames, all that it cannot do without, are those of a shipped table.
fn imu(bus: &BusReport, port: &str) -> Option<String> {
    let (word, layout) = LAYOUTS.map(|(word, shipped)| (word, shipped.layout())).into_iter().find(
        |(_, layout)| {
            let needed = layout.frames.iter().filter(|frame| !frame.optional);
            needed.clone().count() > 0
                && needed.filter_map(FrameLayout::can_id).all(|id| rate(bus, &id.to_string()) > 0.0)
        },
    )?;
    let last = layout.frames.iter().rfind(|frame| !frame.optional).and_then(FrameLayout::can_id)?;
    let rate = rounded(rate(bus, &last.to_string()));
    let name = quoted(&format!("imu-{port}"));
    let port = quoted(port);
    Some(format!(
        "[[sensor]] # frames as an IMU of this table sends them, {rate} Hz\nname = {name}\nport = {port}\n\
         kind = \"can_imu\"\nlayout = \"{word}\"\nrate_hz = {rate:?}\n"
    ))
}

/// Frames per second under an identifier; zero if there are none, or too few.
fn rate(bus: &BusReport, id: &str) -> f64 {
    bus.others.iter().find(|own| own.id == id).and_then(|own| own.rate_hz).unwrap_or(0.0)
}

fn find<'a>(device: &'a DeviceReport, groups: &[u32]) -> Option<&'a GroupReport> {
    let is = |pgn: &u32| device.groups.iter().find(|group| group.pgn == *pgn && group.refused == 0);
    groups.iter().find_map(is)
}

fn section(
    device: &DeviceReport,
    group: &GroupReport,
    kind: &str,
    role: &str,
    port: &str,
) -> String {
    let who = [&device.manufacturer, &device.model].into_iter().flatten().cloned();
    let who: Vec<String> = who.chain([format!("PGN {}", group.pgn)]).collect();
    let name = quoted(&format!("{role}-{}-{port}", device.address));
    let port = quoted(port);
    let mut text = format!(
        "[[sensor]] # {}\nname = {name}\nport = {port}\nkind = \"{kind}\"\n",
        who.join(" ")
    );
    match &device.name {
        Some(name) => text.push_str(&format!("device = {{ name = \"{name}\" }}\n")),
        None => {
            text.push_str("# the device has not told its NAME: any device on the bus is heard\n");
        }
    }
    text
}
