//! The sensors and which of them is used.

use std::collections::BTreeMap;

use insd_base::{Ecef, Time, earth};
use insd_config::Config;
use insd_intake::base::BaseStatus;
use insd_intake::status::{ChoiceStatus, SensorStatus};
use insd_web::snapshot::{Cause, Sensor, SensorState, ShownBase, ShownChoice};

use super::super::report::Slow;
use super::meaning::meaning;
use super::rates::Rates;
use super::spans::age;

pub(super) fn sensors(config: &Config, slow: &Slow, rates: &Rates, now: Time) -> Vec<Sensor> {
    let sections = config.sensors.iter().zip(&slow.intake.sensors).enumerate();
    let sensor = |(index, (section, status)): (usize, (&insd_intake::config::SensorConfig, _))| {
        let status: &SensorStatus = status;
        let own = |choice: &&ChoiceStatus| choice.sensor == Some(index);
        let choices: Vec<&ChoiceStatus> = slow.intake.choices.iter().filter(own).collect();
        Sensor {
            name: status.name.clone(),
            kind: kind(section),
            port: section.port.clone(),
            state: state(status, !choices.is_empty()),
            rate_hz: rates.rate(index),
            age_s: age(now, status.heard),
            status_word: status.heard.map(|_| status.status),
            status: status.heard.map(|_| meaning(section.kind, status.status)).unwrap_or_default(),
            temperature_c: status.temperature,
            used_for: choices.iter().map(|choice| quantity(choice)).collect(),
            why: choices.first().and_then(|choice| why(choice)),
            passed: status.passed,
            lost: status.lost,
            refused: refused(status),
            device: status.device.as_ref().map(|device| match device.name {
                Some(name) => format!("{} {name}", device.address),
                None => device.address.to_string(),
            }),
            base: status.base.as_ref().map(|base| shown_base(base, now)),
            fix: None,
            satellites: None,
        }
    };
    sections.map(sensor).collect()
}

pub(super) fn choices(config: &Config, slow: &Slow) -> Vec<ShownChoice> {
    let choice = |status: &ChoiceStatus| {
        let sensor = status.sensor.and_then(|index| config.sensors.get(index));
        ShownChoice {
            quantity: quantity(status),
            sensor: sensor.map(|sensor| sensor.name.clone()),
            why: why(status),
        }
    };
    slow.intake.choices.iter().map(choice).collect()
}

fn state(status: &SensorStatus, used: bool) -> SensorState {
    match status.valid {
        _ if status.heard.is_none() => SensorState::Waiting,
        _ if status.silent => SensorState::Silent,
        Some(false) => SensorState::Rejected,
        _ if used => SensorState::Valid,
        _ => SensorState::Received,
    }
}

fn refused(status: &SensorStatus) -> Vec<Cause> {
    let refused: &BTreeMap<_, _> = &status.refused;
    refused
        .iter()
        .map(|(reason, count)| Cause { reason: reason.as_str().to_owned(), count: *count })
        .collect()
}

fn quantity(choice: &ChoiceStatus) -> String {
    choice.quantity.as_str().to_owned()
}

fn why(choice: &ChoiceStatus) -> Option<String> {
    choice.why.map(|why| why.as_str().to_owned())
}

fn shown_base(base: &BaseStatus, now: Time) -> ShownBase {
    let place = base.position.map(|place| earth::geodetic(&Ecef(place)));
    ShownBase {
        station: base.station,
        lat_deg: place.map(|place| place.latitude.to_degrees()),
        lon_deg: place.map(|place| place.longitude.to_degrees()),
        height_m: place.map(|place| place.height),
        distance_m: base.distance,
        age_s: age(now, base.newest),
        satellites: u32::from(base.satellites),
        epochs: base.epochs,
    }
}

/// The format, by its word in the configuration.
fn kind(section: &insd_intake::config::SensorConfig) -> String {
    let word = serde_json::to_value(section.kind).ok();
    word.and_then(|word| word.as_str().map(str::to_owned)).unwrap_or_default()
}
