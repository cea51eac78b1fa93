//! Everything that types alone cannot refuse.

use crate::berths;
use crate::cameras;
use crate::file::Config;
use crate::fleets;
use crate::rangings;
use crate::spares;
use crate::watches;

/// Names, ranges and references: each fault with its place and what was expected.
pub(super) fn of(config: &Config) -> Vec<String> {
    let mut faults = Vec::new();
    ship(config, &mut faults);
    faults.extend(config.imu.faults("[imu]"));
    faults.extend(config.assumed().faults());
    spares::of(config, &mut faults);
    ports(config, &mut faults);
    for fault in config.intake().faults() {
        let place = if fault.sensor.is_empty() {
            "[[sensor]]".to_owned()
        } else {
            format!("[[sensor]] \"{}\"", fault.sensor)
        };
        faults.push(format!("{place}: {}: expected {}", fault.key, fault.expected));
    }
    outputs(config, &mut faults);
    faults.extend(berths::faults(config));
    faults.extend(rangings::faults(config));
    faults.extend(cameras::faults(config));
    faults.extend(watches::faults(config));
    nodes(config, &mut faults);
    faults.extend(fleets::faults(config));
    faults.extend(
        config
            .state
            .faults()
            .chain(config.learning.faults())
            .chain(config.web.faults())
            .chain(config.log.faults()),
    );
    faults
}

fn ship(config: &Config, faults: &mut Vec<String>) {
    let ship = &config.ship;
    let mut expect = |good: bool, key: &str, expected: &str| {
        if !good {
            faults.push(format!("[ship]: {key}: expected {expected}"));
        }
    };
    let within = |value: Option<f64>, limit: f64| value.is_none_or(|value| value.abs() <= limit);
    expect(within(ship.lat_deg, 90.0), "lat_deg", "-90 to 90");
    expect(within(ship.lon_deg, 180.0), "lon_deg", "-180 to 180");
    let both = ship.lat_deg.is_some() == ship.lon_deg.is_some();
    expect(both, "lat_deg, lon_deg", "both or neither");
    expect(within(Some(ship.height_m), 12_000.0), "height_m", "-12000 to 12000");
    expect((0.1..=1000.0).contains(&ship.rate_hz), "rate_hz", "0.1 to 1000");
    for (key, arm) in [("gnss_lever_m", ship.gnss_lever_m), ("log_lever_m", ship.log_lever_m)] {
        let sound = arm.iter().all(|length| length.abs() <= 1000.0);
        expect(sound, key, "[forward, starboard, down] in m, each within +-1000");
    }
    expect(ship.priority.is_none_or(|priority| priority <= 99), "priority", "0 to 99");
    let sigma = ship.time_std_s.is_none_or(|sigma| (1e-9..=1.0).contains(&sigma));
    expect(sigma, "time_std_s", "1e-9 to 1");
}

fn ports(config: &Config, faults: &mut Vec<String>) {
    for (port, carrier) in config.ports.iter().zip(config.port_configs()) {
        let place = format!("[[port]] \"{}\"", port.name);
        if config.ports.iter().filter(|other| other.name == port.name).count() > 1 {
            faults.push(format!("{place}: name: expected a name that no other port has"));
        }
        faults.extend(carrier.faults().into_iter().map(|fault| format!("{place}: {fault}")));
    }
}

fn nodes(config: &Config, faults: &mut Vec<String>) {
    for node in &config.nodes {
        let place = format!("[[node]] on \"{}\"", node.port);
        let of_port = |other: &&super::NodeSection| other.port == node.port;
        if config.nodes.iter().filter(of_port).count() > 1 {
            faults.push(format!("{place}: port: expected one node for each port"));
        }
        let mut ports = config.ports.iter().zip(config.port_configs());
        let is_bus =
            ports.any(|(port, opened)| port.name == node.port && opened.as_can().is_some());
        if !is_bus {
            faults.push(format!("{place}: port: expected the name of a CAN port"));
        }
        if !node.point.as_ref().is_none_or(|name| config.has_point(name)) {
            faults.push(format!("{place}: point: expected the name of a [[point]]"));
        }
        faults.extend(node.faults().into_iter().map(|fault| format!("{place}: {fault}")));
    }
}

fn outputs(config: &Config, faults: &mut Vec<String>) {
    for point in &config.points {
        let place = format!("[[point]] \"{}\"", point.name);
        if config.points.iter().filter(|other| other.name == point.name).count() > 1 {
            faults.push(format!("{place}: name: expected a name that no other point has"));
        }
        if !point.lever_m.iter().all(|length| length.abs() <= 1000.0) {
            faults.push(format!(
                "{place}: lever_m: expected [forward, starboard, down] in m, each within +-1000"
            ));
        }
    }
    for output in &config.outputs {
        let place = format!("[[output]] \"{}\"", output.name);
        if config.outputs.iter().filter(|other| other.name == output.name).count() > 1 {
            faults.push(format!("{place}: name: expected a name that no other output has"));
        }
        faults.extend(
            output.faults(&config.points).into_iter().map(|fault| format!("{place}: {fault}")),
        );
    }
    if let Some(recording) = &config.recording
        && !(1.0..=1e7).contains(&recording.rotate_s)
    {
        faults.push("[recording]: rotate_s: expected 1 to 1e7".to_owned());
    }
}
