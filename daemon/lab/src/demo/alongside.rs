//! The berth that a scenario ends at: as a configuration has it, and in words.

use anyhow::anyhow;
use insd_base::ImuSpec;
use insd_config::Config;
use insd_nav::angular_rate::rate_variance;
use insd_output::docking::{BerthDesk, Docking, DockingConfig, HullPart};
use insd_simulator::{Scenario, ScenarioBerth};
use serde::Serialize;

/// A ship like others; what the scenario has of its own goes behind it. None of its ports is opened.
const SHIP: &str = include_str!("../../../../systemd/examples/minimal.toml");
/// Names of the points that bow and stern are.
const ENDS: [&str; 2] = ["bow", "stern"];
/// When to be warned: a faster first contact, m/s, and a part that is nearer and still comes nearer, m.
const WARN: (f64, f64) = (0.25, 5.0);

/// What is written behind the ship.
#[derive(Serialize)]
struct Sections<'a> {
    point: [PointTable; 2],
    docking: DockingTable<'a>,
    berth: [&'a ScenarioBerth; 1],
}

/// A `[[point]]`.
#[derive(Serialize)]
struct PointTable {
    name: &'static str,
    lever_m: [f64; 3],
}

/// `[docking]`.
#[derive(Serialize)]
struct DockingTable<'a> {
    bow: &'static str,
    stern: &'static str,
    beam_m: f64,
    contact_speed_mps: f64,
    distance_m: f64,
    berth: &'a str,
}

/// The configuration of the ship of a scenario, and its text: her hull with the IMU amidships, and the berth that she goes to, chosen.
///
/// # Errors
/// What the scenario says of its berth is no berth for a configuration.
pub fn configuration(scenario: &Scenario) -> anyhow::Result<(Config, String)> {
    let sections = scenario.berth().map(|berth| sections(scenario, berth));
    let own = sections.map(|own| toml::to_string(&own)).transpose()?.unwrap_or_default();
    let text = format!("{SHIP}\n{own}");
    let mut config = Config::of_text(&text).map_err(|fault| anyhow!("[berth]: {fault}"))?;
    config.outputs.iter_mut().for_each(|output| output.simulated = true);
    Ok((config, text))
}

fn sections<'a>(scenario: &Scenario, berth: &'a ScenarioBerth) -> Sections<'a> {
    let [length, beam] = scenario.hull();
    let [bow, stern] = ENDS;
    let point = |name, forward: f64| PointTable { name, lever_m: [forward, 0.0, 0.0] };
    Sections {
        point: [point(bow, length / 2.0), point(stern, -length / 2.0)],
        docking: DockingTable {
            bow,
            stern,
            beam_m: beam,
            contact_speed_mps: WARN.0,
            distance_m: WARN.1,
            berth: berth.name(),
        },
        berth: [berth],
    }
}

/// What outputs are told of the berth, on a ship with this IMU.
#[must_use]
pub fn docking(config: &Config, imu: &ImuSpec) -> DockingConfig {
    let rate_sigma = rate_variance(imu).sqrt().hypot(imu.gyro.instability_std);
    DockingConfig { rate_sigma, ..config.output_plan().berths }
}

/// How she stands to the berth, in a line: distances of bow and stern to the fenders, and their speed towards them.
#[must_use]
pub fn line(docking: &Docking, desk: &BerthDesk) -> String {
    let berths = &desk.config().berths;
    let name = berths.get(docking.berth).map_or("", |own| own.name.as_str());
    let point = |part: HullPart| {
        let own = docking.point(part)?;
        let (distance, closing) = (own.distance.value, own.closing.value);
        Some(format!("{} {distance:.2} m at {closing:+.2} m/s", part.as_str()))
    };
    match (docking.state.why(), point(HullPart::Bow).zip(point(HullPart::Stern))) {
        (_, Some((bow, stern))) => format!("{name}: {bow}, {stern}"),
        (why, None) => format!("{name}: not valid, {}", why.unwrap_or("nothing is known")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario;

    #[test]
    fn the_berth_of_a_scenario_is_that_of_the_configuration_and_is_chosen() {
        for word in ["berthing", "berthing-4ant"] {
            let scenario = scenario::find(word, &[]).unwrap().scenario;
            let (config, _) = configuration(&scenario).unwrap();
            let imu = insd_simulator::simulate(&scenario.with_duration(1.0), 1).header.imu;
            let told = docking(&config, &imu);
            assert_eq!(told.chosen.as_deref(), Some(told.berths[0].name.as_str()));
            assert!((told.berths[0].length() - 160.0).abs() < 1.0, "{}", told.berths[0].length());
            assert_eq!(told.hull.unwrap().outline[0], [40.0, -7.0]);
            assert!(told.rate_sigma > 0.0);
        }
    }

    #[test]
    fn a_scenario_without_a_berth_has_a_configuration_without_one() {
        let scenario = scenario::find("coastal-2h-mems", &[]).unwrap().scenario;
        let (config, _) = configuration(&scenario).unwrap();
        assert!(config.berths.is_empty() && config.output_plan().berths.hull.is_none());
    }
}
