//! The error model of the IMU: values that no unit has, and the slips of units behind them.

use insd_intake::config::{Kind, Role};

use super::found::Found;
use crate::check::finding::ConfigPlace;
use crate::{Config, ImuModel};

/// What real units have, of a key: least and most; and what the value would be if it were in another unit.
struct Range {
    key: &'static str,
    least: f64,
    most: f64,
    unit: &'static str,
    /// Name of another unit in which data sheets state it, and how many of ours one of it is.
    others: &'static [(&'static str, f64)],
}

/// Radians per second, in degrees per hour.
const RAD_S: f64 = 180.0 / std::f64::consts::PI * 3600.0;
/// Radians per root of a second, in degrees per root of an hour.
const RAD_SQRT_S: f64 = 180.0 / std::f64::consts::PI * 60.0;
/// Thousandths of the normal gravity per root of a hertz, in m/s per root of an hour.
const MG_SQRT_HZ: f64 = 9.806_65e-3 * 60.0;

/// From ring lasers and hemispheric resonators to the units of telephones.
const RANGES: [Range; 8] = [
    Range {
        key: "gyro_bias_std_deg_h",
        least: 1e-5,
        most: 2000.0,
        unit: "deg/h",
        others: &[("in rad/s", RAD_S), ("in deg/s", 3600.0)],
    },
    Range {
        key: "gyro_bias_instability_deg_h",
        least: 1e-5,
        most: 500.0,
        unit: "deg/h",
        others: &[("in rad/s", RAD_S), ("in deg/s", 3600.0)],
    },
    Range {
        key: "angle_random_walk_deg_sqrt_h",
        least: 1e-5,
        most: 5.0,
        unit: "deg/sqrt(h)",
        others: &[("in rad/sqrt(s)", RAD_SQRT_S), ("in deg/h/sqrt(Hz)", 1.0 / 60.0)],
    },
    Range {
        key: "gyro_scale_factor_std_ppm",
        least: 0.1,
        most: 50_000.0,
        unit: "ppm",
        others: &[("a ratio", 1e6)],
    },
    Range {
        key: "accel_bias_std_ug",
        least: 0.5,
        most: 100_000.0,
        unit: "micro-g",
        others: &[("in mg", 1000.0), ("in m/s^2", 1e6 / 9.806_65)],
    },
    Range {
        key: "accel_bias_instability_ug",
        least: 0.05,
        most: 20_000.0,
        unit: "micro-g",
        others: &[("in mg", 1000.0), ("in m/s^2", 1e6 / 9.806_65)],
    },
    Range {
        key: "velocity_random_walk_mps_sqrt_h",
        least: 1e-4,
        most: 5.0,
        unit: "(m/s)/sqrt(h)",
        others: &[("in micro-g/sqrt(Hz)", MG_SQRT_HZ / 1000.0), ("in mg/sqrt(Hz)", MG_SQRT_HZ)],
    },
    Range {
        key: "accel_scale_factor_std_ppm",
        least: 0.1,
        most: 50_000.0,
        unit: "ppm",
        others: &[("a ratio", 1e6)],
    },
];

/// A time constant shorter than this was given in hours or minutes, s.
const SHORT: f64 = 20.0;
/// Micromechanical gyros are worse than this, deg/h.
const MICROMECHANICAL: f64 = 0.05;

pub(super) fn look(config: &Config, found: &mut Found) {
    model(&ConfigPlace::one("imu"), "", &config.imu, found);
    for spare in &config.spares {
        if let Some(own) = &spare.model {
            model(&ConfigPlace::of("spare", &spare.name), "model.", own, found);
        }
    }
    let first = config.sensors.iter().find(|sensor| sensor.kind.role() == Role::Imu);
    let small = first.filter(|imu| matches!(imu.kind, Kind::Mip | Kind::Xbus));
    let bias = config.imu.gyro_bias_std_deg_h;
    if let Some(imu) = small.filter(|_| bias > 0.0 && bias < MICROMECHANICAL) {
        found.warn(
            "imu-grade",
            ConfigPlace::one("imu").key("gyro_bias_std_deg_h"),
            &format!("{bias} deg/h is of a fibre optic or laser gyro; \"{}\" is none", imu.name),
            "write the [imu] section from its own data sheet",
        );
    }
}

fn model(place: &ConfigPlace, inside: &str, model: &ImuModel, found: &mut Found) {
    for (key, value, is_time) in model.values() {
        let at = || place.clone().key(&format!("{inside}{key}"));
        if !value.is_finite() || value < 0.0 {
            continue;
        }
        if is_time {
            if value < SHORT {
                let text = format!("{value} s are too short for a bias");
                let hours = format!("if these are hours: {:?}", value * 3600.0);
                found.warn("imu-time-constant", at(), &text, &hours);
            }
            continue;
        }
        let Some(range) = RANGES.iter().find(|range| range.key == key) else { continue };
        if value == 0.0 {
            let text = "zero: no IMU is without this error, and the filter would believe it";
            found.warn("imu-zero", at(), text, "write what the data sheet says");
        } else if !(range.least..=range.most).contains(&value) {
            let unit = range.unit;
            let text = format!(
                "{value:?} {unit} is of no IMU: real ones have {:?} to {:?}",
                range.least, range.most
            );
            found.error("imu-spec", at(), &text, &range.other(value));
        }
    }
}

impl Range {
    /// What the value would be if it were in another unit.
    fn other(&self, value: f64) -> String {
        let sound =
            |(_, factor): &&(&str, f64)| (self.least..=self.most).contains(&(value * factor));
        match self.others.iter().find(sound) {
            Some((unit, factor)) => {
                format!("if it is {unit}: {}", significant(value * factor))
            }
            None => format!("the unit is {}", self.unit),
        }
    }
}

/// With three significant digits.
fn significant(value: f64) -> String {
    let digits = (2.0 - value.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}
