//! Levers and the place.

use insd_intake::config::{Role, SensorConfig};

use super::found::Found;
use crate::check::finding::ConfigPlace;
use crate::{Config, SpareSection};

/// Longer than any ship, m.
const LONGEST: f64 = 500.0;
/// More than half the beam of any ship, with room for a bridge wing, m.
const WIDEST: f64 = 45.0;
/// Higher above the hull's sensors than any mast, m.
const HIGHEST: f64 = 90.0;
/// Heights of an IMU above the ellipsoid between which all seas lie, m.
const HEIGHTS: std::ops::RangeInclusive<f64> = -120.0..=160.0;
/// A log this far above the IMU is above the water, m.
const ABOVE: f64 = -2.0;

pub(super) fn look(config: &Config, found: &mut Found) {
    let ship = &config.ship;
    let place = || ConfigPlace::one("ship");
    let receivers = || config.sensors.iter().filter(|own| own.kind.role() == Role::Gnss);
    antenna(place().key("gnss_lever_m"), &ship.gnss_lever_m, found);
    for sensor in receivers() {
        if let Some(arm) = &sensor.lever_m {
            antenna(ConfigPlace::of("sensor", &sensor.name).key("lever_m"), arm, found);
        }
    }
    let own = |sensor: &SensorConfig| sensor.lever().is_some();
    let unmeasured = receivers().any(|sensor| !own(sensor)) && ship.gnss_lever_m == [0.0; 3];
    if unmeasured {
        found.note(
            "lever-unmeasured",
            place().key("gnss_lever_m"),
            "zeros: the antenna's lever arm counts as not measured, and is estimated under way",
            "measure it: forward, starboard, down, within 0.1 m",
        );
    }
    let shared = receivers().filter(|sensor| !own(sensor)).count();
    if shared > 1 && !unmeasured {
        found.note(
            "lever-shared",
            place().key("gnss_lever_m"),
            "several receivers are taken to share one antenna",
            "give each [[sensor]] its own lever_m",
        );
    }
    log(config, found);
    extent(place().key("log_lever_m"), &ship.log_lever_m, found);
    for point in &config.points {
        let place = ConfigPlace::of("point", &point.name).key("lever_m");
        extent(place.clone(), &point.lever_m, found);
        if point.lever_m == [0.0; 3] {
            found.note("point-zero", place, "zeros: this point is the IMU", "");
        }
    }
    for SpareSection { name, offset_m, .. } in &config.spares {
        extent(ConfigPlace::of("spare", name).key("offset_m"), offset_m, found);
    }
    geography(config, found);
}

fn antenna(place: ConfigPlace, arm: &[f64; 3], found: &mut Found) {
    let [forward, starboard, down] = *arm;
    if down > 0.0 {
        found.warn(
            "lever-sign",
            place.clone(),
            &format!("the antenna is {down} m below the IMU: down is positive"),
            &format!("if it is above: [{forward:?}, {starboard:?}, {:?}]", -down),
        );
    }
    extent(place, arm, found);
}

/// A lever as long as no ship, or across her as she is not wide.
fn extent(place: ConfigPlace, arm: &[f64; 3], found: &mut Found) {
    let [forward, starboard, down] = *arm;
    let length = arm.iter().map(|length| length * length).sum::<f64>().sqrt();
    if length > LONGEST {
        let metres = arm.map(|length| length / 1000.0);
        found.error(
            "lever-long",
            place,
            &format!("{length:.0} m are longer than any ship"),
            &format!("if these are millimetres: {metres:?}"),
        );
    } else if starboard.abs() > WIDEST {
        found.warn(
            "lever-wide",
            place,
            &format!("{} m to the side are beyond the beam of any ship", starboard.abs()),
            &format!("forward comes first: [{starboard:?}, {forward:?}, {down:?}]?"),
        );
    } else if down.abs() > HIGHEST {
        found.warn(
            "lever-high",
            place,
            &format!("{} m up or down are beyond any mast", down.abs()),
            &format!("down comes last: [{down:?}, {starboard:?}, {forward:?}]?"),
        );
    }
}

fn log(config: &Config, found: &mut Found) {
    let mut logs = config.sensors.iter().filter(|own| own.kind.role() == Role::Log);
    let [forward, starboard, down] = config.ship.log_lever_m;
    let place = ConfigPlace::one("ship").key("log_lever_m");
    if logs.next().is_none() {
        return;
    }
    if config.ship.log_lever_m == [0.0; 3] {
        let text = "zeros: the log is taken to be where the IMU is";
        found.note("log-lever", place, text, "measure it: forward, starboard, down");
    } else if down < ABOVE {
        found.warn(
            "log-above",
            place,
            &format!("the log is {} m above the IMU: down is positive", -down),
            &format!("if it is below: [{forward:?}, {starboard:?}, {:?}]", -down),
        );
    }
}

fn geography(config: &Config, found: &mut Found) {
    let ship = &config.ship;
    let place = || ConfigPlace::one("ship");
    if ship.lat_deg == Some(0.0) && ship.lon_deg == Some(0.0) {
        found.warn(
            "place-zero",
            place().key("lat_deg"),
            "0, 0 is a place in the Gulf of Guinea",
            "leave lat_deg and lon_deg out if a receiver tells the place",
        );
    }
    if !HEIGHTS.contains(&ship.height_m) {
        found.warn(
            "height",
            place().key("height_m"),
            &format!("no ship's IMU is {} m above the ellipsoid", ship.height_m),
            "the ellipsoid is within 110 m of the sea: sea level there, and the IMU above it",
        );
    }
}
