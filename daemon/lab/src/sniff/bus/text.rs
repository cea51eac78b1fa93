//! A bus as text for a terminal.

use std::fmt::Write;

use super::report::{BusReport, DeviceReport};
use crate::table::{Align, Table, significant};

/// Columns of the table of what a device sends.
const GROUPS: [(&str, Align); 7] = [
    ("", Align::Left),
    ("PGN", Align::Right),
    ("message", Align::Left),
    ("count", Align::Right),
    ("Hz", Align::Right),
    ("jitter ms", Align::Right),
    ("last s ago", Align::Right),
];
const READ: [(&str, Align); 1] = [("read", Align::Left)];

/// Columns of the table of other frames.
const OTHERS: [(&str, Align); 6] = [
    ("", Align::Left),
    ("id", Align::Right),
    ("count", Align::Right),
    ("Hz", Align::Right),
    ("jitter ms", Align::Right),
    ("last data", Align::Left),
];

/// How much came, in one line.
pub(in crate::sniff) fn amount(bus: &BusReport, seconds: Option<f64>) -> String {
    let mut parts = vec![match seconds {
        Some(seconds) => format!("{} frames in {seconds:.1} s", bus.frames),
        None => format!("{} frames", bus.frames),
    }];
    if let Some((frames, load)) = bus.frames_per_s.zip(bus.load) {
        parts.push(format!("{frames:.0} frames/s"));
        parts.push(format!("{} % of 250 kbit/s", significant(load * 100.0, 2)));
    }
    if bus.broken > 0 {
        parts.push(format!("{} messages broken", bus.broken));
    }
    parts.extend(bus.events.iter().map(|event| format!("{} {}", event.count, event.name)));
    parts.join(", ")
}

/// The devices with what they send, then all other frames.
pub(in crate::sniff) fn devices(bus: &BusReport) -> String {
    let mut text = String::new();
    for device in &bus.devices {
        let _ = write!(text, "\n{}", heading(device));
        let mut table = Table::new(&[&GROUPS[..], &READ].concat());
        for group in &device.groups {
            let read = match (group.used, group.refused) {
                (true, 0) => "used".to_owned(),
                (true, refused) => format!("{refused} too short"),
                (false, _) => "not needed".to_owned(),
            };
            table.push(vec![
                String::new(),
                group.pgn.to_string(),
                group.title.unwrap_or_default().to_owned(),
                group.count.to_string(),
                number(group.rate_hz, 3),
                number(group.jitter_ms, 2),
                group.age_s.map_or("-".to_owned(), |age| format!("{age:.1}")),
                read,
            ]);
        }
        let _ = write!(text, "{table}");
    }
    if !bus.others.is_empty() {
        let mut table = Table::new(&OTHERS);
        for own in &bus.others {
            let rate = number(own.rate_hz, 3);
            let jitter = number(own.jitter_ms, 2);
            let (count, last) = (own.count.to_string(), own.last.clone());
            table.push(vec![String::new(), own.id.clone(), count, rate, jitter, last]);
        }
        let _ = write!(text, "\n  other frames\n{table}");
    }
    if bus.more > 0 {
        let _ = writeln!(text, "  and {} frames or messages of further kinds", bus.more);
    }
    text
}

/// Who a device is: `  35  Garmin GPS 24xd, GNSS, software 2.10, serial 123, NAME c0...`.
fn heading(device: &DeviceReport) -> String {
    let known = [&device.manufacturer, &device.model].into_iter().flatten().cloned();
    let mut who = known.collect::<Vec<_>>().join(" ");
    if who.is_empty() {
        "a device that has not said who it is".clone_into(&mut who);
    }
    let mut parts = vec![who];
    parts.extend(device.function.clone());
    parts.extend(device.software.iter().map(|version| format!("software {version}")));
    parts.extend(device.serial.iter().map(|serial| format!("serial {serial}")));
    if !device.addresses_before.is_empty() {
        let before: Vec<String> = device.addresses_before.iter().map(u8::to_string).collect();
        parts.push(format!("before at address {}", before.join(", ")));
    }
    let mut text = format!("  {:>3}  {}\n", device.address, parts.join(", "));
    if let Some(name) = &device.name {
        let instance = device.instance.unwrap_or(0);
        let _ = writeln!(text, "       NAME {name}, instance {instance}");
    }
    text
}

fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or("-".to_owned(), |value| significant(value, digits))
}
