//! How sensors sit, how fast they speak, and whether their port can carry them.

use insd_drivers::ports::Transport;
use insd_intake::config::{Kind, Role, SensorConfig};

use super::found::Found;
use crate::Config;
use crate::check::finding::ConfigPlace;

/// Samples a second of an IMU that feel a ship's motion and vibration, and are not a slip.
const SAMPLES: std::ops::RangeInclusive<f64> = 20.0..=4000.0;
/// Longest time from a measurement to its first byte that a device has, s.
const LATE: f64 = 0.6;
/// An angle beyond this is not what is left of a right angle, deg.
const LEFT: f64 = 45.0;
/// Sigmas of a heading that a compass may have, deg.
const HEADINGS: std::ops::RangeInclusive<f64> = 0.005..=30.0;

pub(super) fn look(config: &Config, found: &mut Found) {
    for sensor in &config.sensors {
        mounting(sensor, found);
        numbers(config, sensor, found);
        carrier(config, sensor, found);
        unasked(config, sensor, found);
    }
    doubles(config, found);
    if !config.sensors.iter().any(|own| own.kind.role() == Role::Gnss) {
        found.warn(
            "no-receiver",
            ConfigPlace { section: "[[sensor]]".to_owned(), ..ConfigPlace::default() },
            "there is no GNSS receiver: no position but by dead reckoning",
            "kind = \"ubx\", \"sbf\", \"nmea_gnss\" or \"n2k_gnss\"",
        );
    }
}

fn mounting(sensor: &SensorConfig, found: &mut Found) {
    let place = || ConfigPlace::of("sensor", &sensor.name).key("mounting.rotation_deg");
    let angles = sensor.mounting.rotation_deg;
    let Some(worst) = angles.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs())) else { return };
    if worst.abs() > 180.0 {
        let near = angles.map(|angle| (angle + 180.0).rem_euclid(360.0) - 180.0);
        found.error(
            "mounting-angle",
            place(),
            &format!("{worst} deg is no angle of a mounting, which is within 180"),
            &format!("{near:?}?"),
        );
    } else if worst.abs() > LEFT {
        found.warn(
            "mounting-turn",
            place(),
            &format!("{worst} deg is more than what is left of a right angle"),
            "say with `axes` where x, y and z point, and here by how much that is off",
        );
    }
}

fn numbers(config: &Config, sensor: &SensorConfig, found: &mut Found) {
    let place = |key: &str| ConfigPlace::of("sensor", &sensor.name).key(key);
    let role = sensor.kind.role();
    if role == Role::Imu && !SAMPLES.contains(&sensor.rate_hz) {
        let text = format!("{} samples a second are not an IMU's", sensor.rate_hz);
        found.warn("imu-rate", place("rate_hz"), &text, "`insd sniff` measures the rate");
    }
    let is_first = config.ship.imu.as_ref().is_none_or(|name| *name == sensor.name);
    if role == Role::Imu && is_first && config.ship.rate_hz > sensor.rate_hz {
        let text = format!("more solutions than the IMU has samples, {} a second", sensor.rate_hz);
        found.warn("rate-beyond-imu", ConfigPlace::one("ship").key("rate_hz"), &text, "");
    }
    for (key, value) in [("latency_s", sensor.latency_s), ("delay_s", sensor.delay_s)] {
        if value > LATE {
            let text = format!("{value} s is later than any sensor is");
            let advice = format!("the unit is s: {} ms are {}", value, value / 1000.0);
            found.warn("latency", place(key), &text, &advice);
        }
    }
    if role == Role::Heading && !HEADINGS.contains(&sensor.heading_std_deg) {
        let text = format!("{} deg is not how good a compass is", sensor.heading_std_deg);
        found.warn("heading-sigma", place("heading_std_deg"), &text, "1-sigma, in degrees");
    }
    for talker in &sensor.talkers {
        let sound = talker.len() == 2
            && talker.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit());
        if !sound {
            let short: String =
                talker.trim_start_matches('$').to_uppercase().chars().take(2).collect();
            let text = format!("\"{talker}\" is no talker: nothing will be heard");
            let advice = format!("two capital letters: \"{short}\"");
            found.error("talker", place("talkers"), &text, &advice);
        }
    }
}

/// Whether the port can carry such a sensor at all.
fn carrier(config: &Config, sensor: &SensorConfig, found: &mut Found) {
    let port = config.ports.iter().find(|port| port.name == sensor.port);
    if let Some(Transport::Pps(_)) = port.map(|port| &port.transport) {
        found.error(
            "kind-transport",
            ConfigPlace::of("sensor", &sensor.name).key("port"),
            &format!("\"{}\" carries pulses, and no bytes", sensor.port),
            "the port of the receiver's messages; pulses need no [[sensor]]",
        );
    }
}

/// Whether a server is called that tells nothing by itself.
fn unasked(config: &Config, sensor: &SensorConfig, found: &mut Found) {
    let port = config.ports.iter().find(|port| port.name == sensor.port);
    let Some(Transport::TcpClient(client)) = port.map(|port| &port.transport) else { return };
    if sensor.kind.is_signalk() && client.ask.is_none() {
        found.warn(
            "server-unasked",
            ConfigPlace::of("port", &sensor.port).key("transport.ask"),
            "a Signal K server tells nothing unless it is asked",
            "ask = '{\"context\":\"vessels.self\",\"subscribe\":[{\"path\":\"navigation.*\",\"policy\":\"instant\"}]}'",
        );
    }
}

/// Two sensors that read the same frames of the same port.
fn doubles(config: &Config, found: &mut Found) {
    for (index, sensor) in config.sensors.iter().enumerate() {
        let same = |other: &&SensorConfig| {
            other.port == sensor.port
                && other.kind.role() == sensor.kind.role()
                && other.kind.protocol() == sensor.kind.protocol()
                && sensor.kind.protocol().is_some()
                && !told_apart(other, sensor)
        };
        if let Some(other) = config.sensors.iter().take(index).find(same) {
            found.error(
                "sensor-twice",
                ConfigPlace::of("sensor", &sensor.name).key("port"),
                &format!("it reads the same frames as \"{}\"", other.name),
                "each device has its own [[port]], or, in NMEA 0183, its own talkers",
            );
        }
    }
}

fn told_apart(one: &SensorConfig, other: &SensorConfig) -> bool {
    let by_talker = !one.talkers.is_empty()
        && !other.talkers.is_empty()
        && one.talkers.iter().all(|talker| !other.talkers.contains(talker));
    let by_kind = one.kind != other.kind
        && [one, other].iter().any(|own| {
            matches!(
                own.kind,
                Kind::Psxn
                    | Kind::Pashr
                    | Kind::Psat
                    | Kind::Ptnl
                    | Kind::Pfec
                    | Kind::Nortek
                    | Kind::Manual
                    | Kind::Ranging
                    | Kind::Camera
                    | Kind::Rls
            )
        });
    let by_source = one.source.is_some() && other.source.is_some() && one.source != other.source;
    by_talker || by_kind || by_source
}
