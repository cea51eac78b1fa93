//! The fields of a group as a JSON object, under the names of our structs.

use std::fmt::Debug;

use insd_n2k::pgn::{GnssPosition, Known};
use serde_json::{Value, json};

/// The fields, SI and radians; codes by their names.
pub(crate) fn fields(known: &Known) -> Value {
    match known {
        Known::SystemTime(x) => json!({
            "sid": x.sid, "source": code(x.source), "date": x.date, "time": x.time,
        }),
        Known::Heading(x) => json!({
            "sid": x.sid, "heading": x.heading, "deviation": x.deviation, "variation": x.variation,
            "reference": code(x.reference),
        }),
        Known::RateOfTurn(x) => json!({ "sid": x.sid, "rate": x.rate }),
        Known::Heave(x) => json!({ "sid": x.sid, "heave": x.heave }),
        Known::Attitude(x) => json!({
            "sid": x.sid, "yaw": x.yaw, "pitch": x.pitch, "roll": x.roll,
        }),
        Known::MagneticVariation(x) => json!({
            "sid": x.sid, "source": code(x.source), "date": x.date, "variation": x.variation,
        }),
        Known::TimeDate(x) => json!({
            "date": x.date, "time": x.time, "local_offset": x.local_offset,
        }),
        Known::GnssPosition(x) => fix(x),
        Known::Dops(x) => json!({
            "sid": x.sid, "desired": code(x.desired), "actual": code(x.actual), "hdop": x.hdop,
            "vdop": x.vdop, "tdop": x.tdop,
        }),
        Known::PseudorangeNoise(x) => json!({
            "sid": x.sid, "range_rms": x.range_rms, "major": x.major, "minor": x.minor,
            "orientation": x.orientation, "latitude_std": x.latitude_std,
            "longitude_std": x.longitude_std, "altitude_std": x.altitude_std,
        }),
        motion => of_motion(motion),
    }
}

fn of_motion(known: &Known) -> Value {
    match known {
        Known::Speed(x) => json!({
            "sid": x.sid, "water": x.water, "ground": x.ground, "kind": code(x.kind),
            "direction": code(x.direction),
        }),
        Known::DistanceLog(x) => json!({
            "date": x.date, "time": x.time, "log": x.log, "trip": x.trip,
        }),
        Known::PositionRapid(x) => json!({ "latitude": x.latitude, "longitude": x.longitude }),
        Known::CourseSpeed(x) => json!({
            "sid": x.sid, "reference": code(x.reference), "course": x.course, "speed": x.speed,
        }),
        Known::SetDrift(x) => json!({
            "sid": x.sid, "reference": code(x.reference), "set": x.set, "drift": x.drift,
        }),
        Known::SpeedComponents(x) => json!({
            "forward_water": x.forward_water, "starboard_water": x.starboard_water,
            "forward_ground": x.forward_ground, "starboard_ground": x.starboard_ground,
            "stern_starboard_water": x.stern_starboard_water,
            "stern_starboard_ground": x.stern_starboard_ground,
        }),
        _ => Value::Null,
    }
}

fn fix(fix: &GnssPosition) -> Value {
    let stations: Vec<Value> = fix
        .stations
        .iter()
        .map(|station| json!({ "system": code(station.system), "id": station.id, "age": station.age }))
        .collect();
    json!({
        "sid": fix.sid, "date": fix.date, "time": fix.time, "latitude": fix.latitude,
        "longitude": fix.longitude, "altitude": fix.altitude, "system": code(fix.system),
        "method": code(fix.method), "integrity": code(fix.integrity),
        "satellites": fix.satellites, "hdop": fix.hdop, "pdop": fix.pdop, "geoid": fix.geoid,
        "stations": stations,
    })
}

fn code(value: Option<impl Debug>) -> Option<String> {
    value.map(|value| format!("{value:?}"))
}
