//! Faults that are told in words, as findings: which section and key they speak of, what stands there, and
//! what was probably meant.

use std::collections::BTreeMap;

use insd_intake::config::Role;
use insd_output::{MessageKind, Profile};

use super::document::Document;
use super::finding::{ConfigFinding, ConfigPlace, Severity};
use super::nearest::{advice, nearest};
use crate::Config;

/// Tables in which a section's own keys may lie.
const INSIDE: [&str; 5] = ["transport", "destination", "lan", "messages", "talkers"];

/// Each fault begins with its section (`[ship]`, `[[sensor]] "gnss"`) and mostly its key.
pub(super) fn findings(
    faults: &[String],
    config: &Config,
    document: &Document<'_>,
) -> Vec<ConfigFinding> {
    let mut told = BTreeMap::<&str, usize>::new();
    let mut findings = Vec::new();
    for fault in faults {
        // the same fault twice is of two sections with one name
        let nth = told.entry(fault).or_default();
        let mut finding = finding(fault, document);
        document.locate(&mut finding, *nth);
        *nth += 1;
        advise(&mut finding, config);
        findings.push(finding);
    }
    findings
}

fn finding(fault: &str, document: &Document<'_>) -> ConfigFinding {
    let (header, rest) = fault.split_once(": ").unwrap_or(("", fault));
    let (section, name) = match header.split_once('"') {
        Some((section, name)) => (section, Some(name.trim_end_matches('"').to_owned())),
        None => (header, None),
    };
    let section = section.trim_end_matches(" on ").trim().to_owned();
    let place = ConfigPlace { section, name, ..ConfigPlace::default() };
    let (mut keys, mut text) = (Vec::new(), rest);
    while let Some((token, after)) = text.split_once(": ") {
        let key = token.split(',').next().unwrap_or_default();
        if token.starts_with("expected") || !key.chars().all(is_of_key) {
            break;
        }
        keys.extend(key.split('.').map(str::to_owned));
        text = after;
    }
    let key = inside(&place, &keys, document);
    let cause = cause(&key, text);
    let place = if key.is_empty() { place } else { place.key(&key) };
    ConfigFinding::new(Severity::Error, cause, place, text).refused()
}

fn is_of_key(c: char) -> bool {
    c.is_ascii_alphanumeric() || "_.-".contains(c)
}

/// The key, with the table in which it lies if it is not the section's own.
fn inside(place: &ConfigPlace, keys: &[String], document: &Document<'_>) -> String {
    let key = keys.join(".");
    let Some(section) = document.section(place, 0) else { return key };
    let Some(first) = keys.first() else { return key };
    let holds = |table: Option<&str>| {
        let steps = table.into_iter().map(str::to_owned).chain([first.clone()]);
        document.at(&section.iter().cloned().chain(steps).collect::<Vec<_>>()).is_some()
    };
    if holds(None) {
        return key;
    }
    let table = INSIDE.into_iter().find(|table| *table != first && holds(Some(table)));
    table.map_or(key.clone(), |table| format!("{table}.{key}"))
}

/// A lasting name for a fault at this key.
fn cause(key: &str, text: &str) -> &'static str {
    match key.split('.').next_back().unwrap_or_default() {
        "name" => "duplicate-name",
        "port" => "unknown-port",
        "point" | "bow" | "stern" | "manifold" if text.contains("name of") => "unknown-point",
        "berth" => "unknown-berth",
        "sensor" => "unknown-sensor",
        "imu" => "unknown-imu",
        "profile" => "unknown-profile",
        "mounting" => "mounting-axes",
        "kind" if text.contains("at least one") => "no-imu",
        "kind" => "kind-transport",
        "lat_deg" | "lon_deg" => "place-range",
        "gnss_lever_m" | "log_lever_m" | "lever_m" => "lever-long",
        "messages" if text.contains('%') => "overload",
        "level" => "log-level",
        _ if text.starts_with("expected one of") => "unknown-word",
        _ => "range",
    }
}

/// What was probably meant.
fn advise(finding: &mut ConfigFinding, config: &Config) {
    let key = finding.place.key.clone().unwrap_or_default();
    let word = finding.value.as_deref().map(|value| value.trim_matches('"').to_owned());
    let section = finding.place.bare();
    let ports = || config.ports.iter().map(|port| port.name.as_str()).collect::<Vec<_>>();
    let known: Vec<&str> = match (section, key.as_str()) {
        ("sensor" | "node", "port") => ports(),
        ("ship" | "spare", "imu") => {
            let imus = config.sensors.iter().filter(|own| own.kind.role() == Role::Imu);
            imus.map(|own| own.name.as_str()).collect()
        }
        ("ranging" | "camera" | "watch", "sensor") => {
            config.sensors.iter().map(|own| own.name.as_str()).collect()
        }
        ("docking" | "ranging", "berth") => {
            config.berths.iter().map(|own| own.name.as_str()).collect()
        }
        (_, "point") | ("docking", "bow" | "stern" | "manifold") => {
            config.points.iter().map(|point| point.name.as_str()).collect()
        }
        (_, "profile") => Profile::all().map(|profile| profile.name).collect(),
        _ => Vec::new(),
    };
    finding.advice = match (finding.cause, word) {
        (_, Some(word)) if !known.is_empty() => advice(&word, &known),
        ("place-range", Some(_)) => swapped(config),
        ("mounting-axes", _) => Some(
            "each direction once, and x, y, z as thumb, first and second finger of the right hand"
                .to_owned(),
        ),
        ("no-imu", _) => Some("`insd sniff PORT` suggests its [[sensor]] section".to_owned()),
        ("unknown-word", _) => kind_of_message(&key),
        _ => None,
    };
    let is_message = ["messages.", "talkers."].iter().any(|table| key.starts_with(table));
    if is_message && finding.cause == "unknown-word" && finding.advice.is_some() {
        "no such message".clone_into(&mut finding.text);
    }
}

/// Latitude and longitude in each other's place.
fn swapped(config: &Config) -> Option<String> {
    let (lat, lon) = config.ship.lat_deg.zip(config.ship.lon_deg)?;
    let fits = lat.abs() > 90.0 && lat.abs() <= 180.0 && lon.abs() <= 90.0;
    fits.then(|| format!("swapped? lat_deg = {lon}, lon_deg = {lat}"))
}

fn kind_of_message(key: &str) -> Option<String> {
    let word = key.split('.').next_back()?;
    let near = nearest(word, MessageKind::all().map(MessageKind::name))?;
    Some(format!("did you mean `{near}`?"))
}
