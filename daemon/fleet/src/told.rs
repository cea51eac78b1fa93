//! What of the snapshot leaves the ship: its own objects with the names of the interface, fewer of them, without
//! what is unknown, and rounded to what their sigmas can bear.

use insd_web::snapshot::{Alert, ShownAlertState, Snapshot};
use serde_json::{Map, Value, json};

/// What of the motion is in the history.
const HISTORY: [&str; 13] = [
    "lat_deg",
    "lon_deg",
    "height_m",
    "speed_kn",
    "course_deg",
    "heading_deg",
    "roll_deg",
    "pitch_deg",
    "sigma_north_m",
    "sigma_east_m",
    "sigma_heading_deg",
    "integrity",
    "hpl_m",
];

/// What of the motion is in the state, beside that.
const STATE: [&str; 8] = [
    "rate_of_turn_deg_min",
    "water_speed_kn",
    "sigma_speed_kn",
    "heading_quality",
    "position_quality",
    "velocity_quality",
    "excluded",
    "freshness",
];

/// Where she is and how she lies: a record of the history.
pub(crate) fn history(snapshot: &Snapshot) -> Map<String, Value> {
    let mut told = Map::new();
    told.insert("time".to_owned(), json!({ "utc": snapshot.time.utc }));
    told.insert("mode".to_owned(), json!({ "name": snapshot.mode.name }));
    if let Some(motion) = motion(snapshot, &HISTORY) {
        told.insert("motion".to_owned(), motion);
    }
    told
}

/// How everything stands: the state.
pub(crate) fn state(snapshot: &Snapshot) -> Map<String, Value> {
    let mut told = Map::new();
    let program = &snapshot.program;
    told.insert("version".to_owned(), json!(snapshot.version));
    told.insert(
        "program".to_owned(),
        json!({ "version": program.version, "simulated": program.simulated, "uptime_s": program.uptime_s.round() }),
    );
    let time = &snapshot.time;
    told.insert("time".to_owned(), json!({ "utc": time.utc, "quality": time.quality }));
    let mode = &snapshot.mode;
    told.insert(
        "mode".to_owned(),
        json!({ "name": mode.name, "since_s": mode.since_s.round(), "reason": mode.reason }),
    );
    let names: Vec<&str> = HISTORY.iter().chain(&STATE).copied().collect();
    if let Some(motion) = motion(snapshot, &names) {
        told.insert("motion".to_owned(), motion);
    }
    let alerts = snapshot.alerts.iter().filter(|own| own.state != ShownAlertState::Normal);
    told.insert("alerts".to_owned(), alerts.map(alert).collect());
    told
}

/// An alert, as the interface has it.
pub(crate) fn alert(alert: &Alert) -> Value {
    let mut value = serde_json::to_value(alert).unwrap_or_default();
    if let Some(object) = value.as_object_mut() {
        // it is told when it changes, and how long ago that was grows old on the way
        object.remove("since_s");
        object.retain(|_, own| !own.is_null());
    }
    value
}

/// The motion, if it may be taken as the present.
fn motion(snapshot: &Snapshot, names: &[&str]) -> Option<Value> {
    let value = serde_json::to_value(snapshot.present()?).ok()?;
    let Value::Object(mut all) = value else { return None };
    let source = all.get("source").and_then(|own| own.get("name")).cloned();
    all.retain(|name, own| names.contains(&name.as_str()) && !own.is_null());
    for (name, own) in &mut all {
        if let Some(number) = own.as_f64() {
            *own = json!(rounded(number, decimals(name)));
        }
    }
    if let Some(source) = source.filter(|own| !own.is_null()) {
        all.insert("source".to_owned(), json!({ "name": source }));
    }
    Some(Value::Object(all))
}

/// A centimetre on the Earth, a millimetre or a thousandth of a degree else.
fn decimals(name: &str) -> i32 {
    if matches!(name, "lat_deg" | "lon_deg") { 7 } else { 3 }
}

fn rounded(number: f64, decimals: i32) -> f64 {
    let scale = 10_f64.powi(decimals);
    (number * scale).round() / scale
}

#[cfg(test)]
mod tests {
    use insd_web::snapshot::{ShownMotion, ShownSource};

    use super::*;

    fn snapshot() -> Snapshot {
        let source = ShownSource { name: "rtk".to_owned(), ..ShownSource::default() };
        let motion = ShownMotion {
            lat_deg: Some(53.512_345_678_9),
            heading_deg: Some(271.323_9),
            sigma_heading_deg: Some(0.051_2),
            source: Some(source),
            ..ShownMotion::default()
        };
        let mut snapshot = Snapshot { motion: Some(motion), ..Snapshot::default() };
        "aided".clone_into(&mut snapshot.mode.name);
        snapshot.time.utc = Some("2026-11-28T12:00:00.000Z".to_owned());
        snapshot
    }

    #[test]
    fn what_is_told_is_the_object_of_the_interface_and_reads_back_as_one() {
        for told in [history(&snapshot()), state(&snapshot())] {
            let back: Snapshot = serde_json::from_value(Value::Object(told)).unwrap();
            let motion = back.motion.unwrap();
            assert_eq!(motion.lat_deg, Some(53.512_345_7));
            assert_eq!(motion.heading_deg, Some(271.324));
            assert_eq!(motion.source.unwrap().name, "rtk");
            assert_eq!((back.mode.name.as_str(), motion.lon_deg), ("aided", None));
        }
    }

    #[test]
    fn a_motion_that_is_old_is_not_told() {
        let old = snapshot().after(3.0);
        assert!(!history(&old).contains_key("motion"));
        assert!(!state(&old).contains_key("motion"));
    }
}
