//! From sections to spare engines, each with an IMU of its own or with that of the first engine.

use insd_base::units::DEG;
use insd_base::{Body, LeverArms};
use insd_engine::EngineConfig;
use insd_engine::vote::Voice;
use insd_intake::config::{IntakeConfig, Role, SensorConfig};
use insd_vessel::{FIRST, Spare};
use nalgebra::Vector3;

use crate::file::Config;
use crate::spare::SpareSection;

/// More engines than these beside the first are of no use.
const MOST: usize = 2;

impl Config {
    /// The engines beside the first, with what the first was told.
    #[must_use]
    pub fn spares(&self, first: &EngineConfig) -> Vec<Spare> {
        self.spares.iter().map(|section| self.spare(section, first)).collect()
    }

    fn spare(&self, section: &SpareSection, first: &EngineConfig) -> Spare {
        let [forward, starboard, down] = section.offset_m;
        let offset = Body::new(forward, starboard, down);
        let imu = section.imu.as_deref().or(self.ship.imu.as_deref());
        Spare {
            name: section.name.clone(),
            intake: self.intake_with(imu, &section.offset_m),
            engine: self.spare_engine(section, first, &offset),
            offset,
            voice: self.voice(section),
        }
    }

    /// What plugs are there for an engine with this IMU.
    fn intake_with(&self, imu: Option<&str>, offset: &[f64; 3]) -> IntakeConfig {
        let mut intake = self.intake();
        for arm in intake.sensors.iter_mut().filter_map(|sensor| sensor.lever_m.as_mut()) {
            // zeros stand for what was not measured
            if *arm != [0.0; 3] {
                arm.iter_mut().zip(offset).for_each(|(length, offset)| *length -= offset);
            }
        }
        for aid in &mut intake.rangings {
            aid.lever.0 -= Vector3::from(*offset);
        }
        intake.imu = imu.map(str::to_owned);
        let is_other = |sensor: &SensorConfig| {
            sensor.kind.role() == Role::Imu && imu.is_some_and(|imu| sensor.name != imu)
        };
        intake.sensors.retain(|sensor| !is_other(sensor));
        intake
    }

    fn spare_engine(
        &self,
        section: &SpareSection,
        first: &EngineConfig,
        offset: &Body,
    ) -> EngineConfig {
        let rate = self.imu(section.imu.as_deref()).map_or(first.imu.rate, |own| own.rate_hz);
        let model = section.model.as_ref().unwrap_or(&self.imu);
        let from_own = |point: &Body| Body(point.0 - offset.0);
        // zeros stand for what was not measured
        let measured = |arm: &Body| if *arm == Body::default() { *arm } else { from_own(arm) };
        let mut models = first.models;
        models.camera.iter_mut().for_each(|own| own.model.lever = from_own(&own.model.lever));
        let mut initial = first.initial;
        initial.iter_mut().for_each(|place| place.height -= offset.0.z);
        EngineConfig {
            imu: model.spec(rate),
            lever_arms: LeverArms {
                gnss: measured(&first.lever_arms.gnss),
                log: measured(&first.lever_arms.log),
            },
            initial,
            models,
            points: std::iter::once(Body::default())
                .chain(first.points.iter().map(from_own))
                .collect(),
            stored: None,
            time_std: self.ship.time_std_s.or_else(|| self.time_std(section.imu.as_deref())),
            ..first.clone()
        }
    }

    fn has_own_imu(&self, section: &SpareSection) -> bool {
        section.imu.is_some() && self.imu_name(section.imu.as_deref()) != self.imu_name(None)
    }

    fn imu_name(&self, imu: Option<&str>) -> Option<&str> {
        self.imu(imu).map(|sensor| sensor.name.as_str())
    }

    fn voice(&self, section: &SpareSection) -> Voice {
        let number = self.sensors.iter().position(|own| section.imu.as_ref() == Some(&own.name));
        let imu = number.filter(|_| self.has_own_imu(section)).map_or(0, |number| number + 1);
        let [forward, starboard, down] = section.offset_m;
        Voice {
            imu,
            mounting_std: section.mounting_std_deg * DEG,
            distance: Body::new(forward, starboard, down).0.norm(),
        }
    }

    fn is_imu(&self, name: &str) -> bool {
        self.sensors.iter().any(|own| own.name == name && own.kind.role() == Role::Imu)
    }
}

/// All that is wrong with the engines' IMUs, each fault with its place.
pub(super) fn of(config: &Config, faults: &mut Vec<String>) {
    let imus = config.sensors.iter().filter(|sensor| sensor.kind.role() == Role::Imu).count();
    let own = config.spares.iter().any(|spare| spare.imu.is_some());
    match &config.ship.imu {
        Some(name) if !config.is_imu(name) => {
            faults.push("[ship]: imu: expected the name of a [[sensor]] that is an IMU".to_owned());
        }
        None if own && imus > 1 => {
            faults.push(
                "[ship]: imu: expected the name of the first engine's IMU, as a spare has its own"
                    .to_owned(),
            );
        }
        _ => {}
    }
    if config.spares.len() > MOST {
        faults.push(format!("[[spare]]: expected at most {MOST}"));
    }
    for spare in &config.spares {
        let place = format!("[[spare]] \"{}\"", spare.name);
        faults.extend(faults_of(spare, config).map(|fault| format!("{place}: {fault}")));
        if let Some(model) = &spare.model {
            faults.extend(model.faults(&format!("{place}: model")));
        }
    }
}

fn faults_of(spare: &SpareSection, config: &Config) -> impl Iterator<Item = &'static str> {
    let namesakes = config.spares.iter().filter(|other| other.name == spare.name).count();
    let known = spare.imu.as_ref().is_none_or(|name| config.is_imu(name));
    let near = spare.offset_m.iter().all(|length| length.abs() <= 1000.0);
    let shares_it = spare.offset_m == [0.0; 3] || config.has_own_imu(spare);
    let checks = [
        (
            namesakes == 1 && spare.name != FIRST && !spare.name.is_empty(),
            "name: expected a name that no other engine has; that of the first is \"first\"",
        ),
        (known, "imu: expected the name of a [[sensor]] that is an IMU"),
        (near, "offset_m: expected [forward, starboard, down] in m, each within +-1000"),
        (!known || shares_it, "offset_m: expected zeros, as its IMU is that of the first engine"),
        ((0.0..=10.0).contains(&spare.mounting_std_deg), "mounting_std_deg: expected 0 to 10"),
    ];
    checks.into_iter().filter(|(good, _)| !good).map(|(_, fault)| fault)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHIPPED: &str = include_str!("../../../systemd/examples/survey.toml");

    /// The shipped file with the example of a spare that it holds as comments.
    fn with_spare() -> String {
        let (own, example) = SHIPPED.split_once("# A second IMU").unwrap();
        let (example, rest) = example.split_once("\n\n").unwrap();
        let lines = example.lines().skip(1).map(|line| line.trim_start_matches('#').trim_start());
        let lines = lines.collect::<Vec<_>>().join("\n");
        format!("{own}\n{lines}\n\n{rest}").replace("#imu = \"imu\"", "imu = \"imu\"")
    }

    #[test]
    fn the_example_of_a_spare_is_a_good_one() {
        let config = Config::of_text(&with_spare()).unwrap();
        let first = config.engine();
        let spares = config.spares(&first);
        let [spare] = &spares[..] else { panic!("{spares:?}") };
        assert_eq!((spare.name.as_str(), spare.offset), ("spare", Body::new(-12.0, 2.0, 0.5)));
        assert_eq!(spare.engine.lever_arms.gnss, Body::new(9.0, -1.5, -18.5));
        assert_eq!(spare.engine.points[1], Body::new(12.0, -2.0, -0.5));
        assert_eq!(spare.engine.points.len(), first.points.len() + 1);
        assert_eq!((first.imu.rate, spare.engine.imu.rate), (200.0, 100.0));
        assert_ne!(spare.voice.imu, 0);
        let imus = |intake: &IntakeConfig| {
            let of_imu = intake.sensors.iter().filter(|own| own.kind.role() == Role::Imu);
            (of_imu.count(), intake.imu.clone().unwrap())
        };
        assert_eq!(imus(&config.intake()), (2, "imu".to_owned()));
        assert_eq!(imus(&spare.intake), (1, "imu-2".to_owned()));
    }

    #[test]
    fn a_spare_without_an_imu_of_its_own_has_all_of_the_first() {
        let config = Config::of_text(&format!("{SHIPPED}\n[[spare]]\nname = \"twin\"\n")).unwrap();
        let first = config.engine();
        let spare = config.spares(&first).remove(0);
        assert_eq!((spare.voice.imu, spare.intake), (0, config.intake()));
        let points = EngineConfig { points: first.points.clone(), ..spare.engine };
        assert_eq!(points, first);
    }

    #[test]
    fn faults_of_spares_are_told_together() {
        let spare = |text: &str| format!("[[spare]]\n{text}\n");
        let text = [
            SHIPPED.replace("[ship]", "[ship]\nimu = \"log\""),
            spare("name = \"first\"\nimu = \"gnss\"\nmounting_std_deg = -1.0"),
            spare("name = \"b\"\noffset_m = [2000.0, 0.0, 0.0]"),
            spare("name = \"b\"\noffset_m = [1.0, 0.0, 0.0]"),
        ];
        let message = Config::of_text(&text.join("\n")).unwrap_err();
        for part in [
            "[ship]: imu: expected the name of a [[sensor]] that is an IMU",
            "[[spare]]: expected at most 2",
            "[[spare]] \"first\": name: expected a name that no other engine has",
            "[[spare]] \"first\": imu: expected the name of a [[sensor]] that is an IMU",
            "[[spare]] \"first\": mounting_std_deg: expected 0 to 10",
            "[[spare]] \"b\": name: expected",
            "[[spare]] \"b\": offset_m: expected [forward",
            "[[spare]] \"b\": offset_m: expected zeros",
        ] {
            assert!(message.contains(part), "{part} is not in: {message}");
        }
        let unsaid = with_spare().replace("\nimu = \"imu\" ", "\n# ");
        let message = Config::of_text(&unsaid).unwrap_err();
        assert!(message.contains("[ship]: imu: expected the name of the first"), "{message}");
    }
}
