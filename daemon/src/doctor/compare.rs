//! Holds what arrives at a port against what was configured there.

use insd_config::check::{ConfigFinding, ConfigPlace, Severity};
use insd_config::{Config, PortSection};
use insd_drivers::ports::Transport;
use insd_intake::config::{Kind, Role, SensorConfig};
use insd_lab::sniff::report::{PortReport, State};
use insd_wire::stream::Protocol;
use serde::Deserialize;

use super::listen::Heard;

/// Share of damaged frames from which it is told, and the least number of frames that tell it.
const DAMAGED: f64 = 0.01;
const FRAMES: u64 = 20;
/// By how much a measured rate may differ from the configured one.
const NEAR: f64 = 0.05;

/// What `insd sniff` would write.
#[derive(Debug, Default, Deserialize)]
struct Suggested {
    #[serde(default)]
    sensor: Vec<SuggestedSensor>,
}

#[derive(Debug, Deserialize)]
struct SuggestedSensor {
    kind: String,
    rate_hz: Option<f64>,
}

pub(super) fn all(config: &Config, heard: &Heard) -> Vec<ConfigFinding> {
    let mut found = Vec::new();
    for report in &heard.report.ports {
        let Some(port) = config.ports.iter().find(|port| port.name == report.name) else {
            continue;
        };
        found.extend(one(config, port, report, heard.bauds.get(&port.name).copied()));
    }
    found
}

fn one(
    config: &Config,
    port: &PortSection,
    report: &PortReport,
    fitting: Option<u32>,
) -> Vec<ConfigFinding> {
    let place = ConfigPlace::of("port", &port.name).key("transport");
    let hint = report.hints.first().cloned().unwrap_or_default();
    let tell = |severity, cause, text: &str, advice: String| {
        let finding = ConfigFinding::new(severity, cause, place.clone(), text);
        vec![if advice.is_empty() { finding } else { finding.advise(advice) }]
    };
    match &report.state {
        State::Absent { reason } | State::Lost { reason } => {
            return tell(
                Severity::Error,
                "port-closed",
                &format!("cannot be opened: {reason}"),
                hint,
            );
        }
        _ if report.is_mute() => {
            let seconds = report.seconds.unwrap_or_default();
            let text = format!("nothing arrived within {seconds:.0} s");
            return tell(Severity::Warning, "silent", &text, hint);
        }
        _ => {}
    }
    if report.frames == 0 && report.stray > 0 {
        if let (Some(baud), Transport::Serial(line)) = (fitting, &port.transport) {
            let text = format!("nothing can be read at {} baud", line.baud);
            let mut found =
                tell(Severity::Error, "baud-wrong", &text, format!("baud = {baud} can be read"));
            found.iter_mut().for_each(|own| own.place.key = Some("transport.baud".to_owned()));
            return found;
        }
        let text = format!("{} bytes arrived, and none of them can be read", report.bytes);
        return tell(Severity::Error, "unreadable", &text, hint);
    }
    let mut found: Vec<ConfigFinding> = config
        .sensors
        .iter()
        .filter(|sensor| sensor.port == port.name)
        .filter_map(|sensor| against(sensor, report))
        .collect();
    if report.frames >= FRAMES && report.damaged_share() > DAMAGED {
        let percent = report.damaged_share() * 100.0;
        let text = format!("{percent:.1} % of what arrives is damaged");
        found.extend(tell(Severity::Warning, "damaged", &text, hint));
    }
    found
}

/// What a sensor is configured as against what is spoken at its port.
fn against(sensor: &SensorConfig, report: &PortReport) -> Option<ConfigFinding> {
    let own = sensor.kind.protocol()?;
    let suggested = suggested(report);
    let name = kind_name(sensor.kind);
    let place = |key: &str| ConfigPlace::of("sensor", &sensor.name).key(key);
    if own == Protocol::Nmea && reads(sensor, report) {
        return bare(sensor, report);
    }
    if let Some(same) = suggested.iter().find(|other| other.kind == name) {
        let rate = same.rate_hz.filter(|_| sensor.kind.role() == Role::Imu)?;
        if (rate / sensor.rate_hz - 1.0).abs() <= NEAR {
            return None;
        }
        let text = format!("{rate} samples a second arrive, configured as {}", sensor.rate_hz);
        let finding =
            ConfigFinding::new(Severity::Error, "imu-rate-arrives", place("rate_hz"), &text);
        return Some(finding.advise(format!("rate_hz = {rate:?}")));
    }
    let spoken = report.protocols();
    let names: Vec<&str> = spoken.iter().map(|protocol| protocol.name()).collect();
    if names.is_empty() {
        return None;
    }
    let what = most(report);
    let text = if spoken.contains(&own) {
        format!(
            "this port speaks {}{what}, and nothing of it is for a sensor of this kind",
            names.join(" and ")
        )
    } else {
        format!("this port speaks {}{what}, configured as {name}", names.join(" and "))
    };
    let finding = ConfigFinding::new(Severity::Error, "kind-arrives", place("kind"), &text);
    let role = |kind: &str| kind_of(kind).is_some_and(|kind| kind.role() == sensor.kind.role());
    let fitting = suggested.iter().find(|other| role(&other.kind)).or(suggested.first());
    Some(match fitting {
        Some(other) => finding.advise(format!("kind = \"{}\"", other.kind)),
        None => finding.advise("choose other messages in the device: docs/sensors.md"),
    })
}

/// Whether sentences arrive that such a sensor reads, though it would not be suggested first.
fn reads(sensor: &SensorConfig, report: &PortReport) -> bool {
    let ends: &[&str] = match sensor.kind {
        Kind::NmeaGnss | Kind::NmeaPosition => &["GGA", "GNS", "RMC", "GLL"],
        Kind::Compass => &["HDT", "THS", "HDG", "HDM"],
        Kind::NmeaLog => &["VBW", "VHW"],
        Kind::Manual | Kind::Ranging | Kind::Camera => return true,
        _ => return false,
    };
    report.messages.iter().any(|message| ends.iter().any(|end| message.name.ends_with(end)))
}

/// Sentences that arrive without a checksum, where one is asked for.
fn bare(sensor: &SensorConfig, report: &PortReport) -> Option<ConfigFinding> {
    let is_bare = |reason: &str| reason == "no checksum";
    let refused = report.messages.iter().filter_map(|message| message.refusal.as_ref());
    let bare = refused.filter(|refusal| is_bare(&refusal.reason)).count();
    let used = report.messages.iter().any(|message| message.used > 0);
    (bare > 0 && !used && !sensor.no_checksum).then(|| {
        let place = ConfigPlace::of("sensor", &sensor.name).key("no_checksum");
        let text = "its sentences have no checksum, and are refused";
        ConfigFinding::new(Severity::Error, "no-checksum", place, text)
            .advise("switch the checksum on in the device, or no_checksum = true")
    })
}

/// The message that comes most often.
fn most(report: &PortReport) -> String {
    let most = report.messages.iter().max_by_key(|message| message.count);
    most.map_or(String::new(), |message| format!(" ({})", message.name))
}

fn suggested(report: &PortReport) -> Vec<SuggestedSensor> {
    let texts = report.suggestions.iter().filter(|text| text.contains("[[sensor]]"));
    texts.flat_map(|text| toml::from_str::<Suggested>(text).unwrap_or_default().sensor).collect()
}

fn kind_name(kind: Kind) -> String {
    let value = toml::Value::try_from(kind).ok();
    value.as_ref().and_then(toml::Value::as_str).unwrap_or_default().to_owned()
}

fn kind_of(name: &str) -> Option<Kind> {
    toml::Value::from(name).try_into().ok()
}
