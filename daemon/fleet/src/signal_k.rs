//! Records as a delta of Signal K: SI units, radians, paths of its specification.
//! <https://signalk.org/specification/1.7.0/doc/data_model.html>

use std::f64::consts::PI;

use serde_json::{Value, json};

const RADIAN: f64 = PI / 180.0;
const KNOT: f64 = 1852.0 / 3600.0;

/// Numbers: where they stand in a record, path of Signal K, factor to its unit.
const NUMBERS: [(&str, &str, f64); 5] = [
    ("heading_deg", "navigation.headingTrue", RADIAN),
    ("speed_kn", "navigation.speedOverGround", KNOT),
    ("course_deg", "navigation.courseOverGroundTrue", RADIAN),
    ("rate_of_turn_deg_min", "navigation.rateOfTurn", RADIAN / 60.0),
    ("water_speed_kn", "navigation.speedThroughWater", KNOT),
];

/// One delta with an update for each record.
pub(crate) fn delta(ship: &str, records: &[&str]) -> String {
    let records = records.iter().filter_map(|text| serde_json::from_str::<Value>(text).ok());
    let updates: Vec<Value> = records.map(|record| update(&record)).collect();
    json!({ "context": format!("vessels.{ship}"), "updates": updates }).to_string()
}

fn update(record: &Value) -> Value {
    let mut update = json!({ "$source": "insd", "values": values(record) });
    // a time that is not known is left out: the receiver takes its own
    if let Some(utc) = record.pointer("/time/utc").filter(|utc| utc.is_string()) {
        update["timestamp"] = utc.clone();
    }
    update
}

fn values(record: &Value) -> Vec<Value> {
    let motion = |name: &str| record.get("motion")?.get(name)?.as_f64();
    let mut values = Vec::new();
    let mut tell = |path: &str, value: Value| values.push(json!({ "path": path, "value": value }));
    if let Some((latitude, longitude)) = motion("lat_deg").zip(motion("lon_deg")) {
        tell("navigation.position", json!({ "latitude": latitude, "longitude": longitude }));
    }
    for (name, path, factor) in NUMBERS {
        if let Some(number) = motion(name) {
            tell(path, json!(number * factor));
        }
    }
    if let Some((roll, pitch)) = motion("roll_deg").zip(motion("pitch_deg")) {
        let yaw = motion("heading_deg").map(|heading| heading * RADIAN);
        tell(
            "navigation.attitude",
            json!({ "roll": roll * RADIAN, "pitch": pitch * RADIAN, "yaw": yaw }),
        );
    }
    if let Some(alert) = record.get("alert") {
        let id = alert.get("id").and_then(Value::as_u64).unwrap_or_default();
        tell(&format!("notifications.navigation.insd.{id}"), notification(alert));
    }
    values
}

fn notification(alert: &Value) -> Value {
    let word = |name: &str| alert.get(name).and_then(Value::as_str).unwrap_or_default();
    let state = match (word("state"), word("priority")) {
        ("normal" | "rectified", _) => "normal",
        (_, "emergency_alarm") => "emergency",
        (_, "alarm") => "alarm",
        (_, "warning") => "warn",
        _ => "alert",
    };
    json!({ "state": state, "method": ["visual"], "message": word("title") })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_becomes_an_update_in_si_units() {
        let record = r#"{"seq":3,"time":{"utc":"2026-11-28T12:00:00.000Z"},"motion":{"lat_deg":53.5,"lon_deg":8.1,"heading_deg":180.0,"speed_kn":10.0}}"#;
        let delta: Value =
            serde_json::from_str(&delta("urn:mrn:imo:mmsi:211000000", &[record])).unwrap();
        assert_eq!(delta["context"], "vessels.urn:mrn:imo:mmsi:211000000");
        let update = &delta["updates"][0];
        assert_eq!(update["timestamp"], "2026-11-28T12:00:00.000Z");
        let value = |path: &str| {
            let values = update["values"].as_array().unwrap();
            values.iter().find(|own| own["path"] == path).unwrap()["value"].clone()
        };
        assert_eq!(value("navigation.position")["latitude"], 53.5);
        assert!((value("navigation.headingTrue").as_f64().unwrap() - PI).abs() < 1e-12);
        assert!((value("navigation.speedOverGround").as_f64().unwrap() - 5.1444).abs() < 1e-4);
    }

    #[test]
    fn an_alert_that_is_over_is_normal() {
        let record = r#"{"seq":4,"time":{"utc":null},"alert":{"id":10001,"title":"Heading lost","state":"rectified","priority":"warning"}}"#;
        let delta: Value = serde_json::from_str(&delta("a", &[record])).unwrap();
        let own = &delta["updates"][0];
        assert_eq!(own["values"][0]["path"], "notifications.navigation.insd.10001");
        assert_eq!(own["values"][0]["value"]["state"], "normal");
        assert!(own.get("timestamp").is_none());
    }
}
