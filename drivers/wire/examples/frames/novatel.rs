//! Logs of NovAtel as JSON.

use insd_wire::gnss::novatel::{
    AntennaHeading, BestPosition, BestVelocity, InsPva, InsPvax, OemBody, OemLog, RawImu, RawImuX,
    ReceiverClock,
};
use serde_json::{Value, json};

/// Name and fields of a frame; no fields if it is not read, `refused` and why if it can not be.
pub(crate) fn describe(frame: &[u8]) -> (String, Value) {
    let log = match OemLog::read(frame) {
        Ok(log) => log,
        Err(fault) => return ("refused".to_owned(), json!(fault.to_string())),
    };
    let Some(name) = log.name() else { return (log.header.id.to_string(), Value::Null) };
    let mut fields = match &log.body {
        OemBody::Position(body) => position(body),
        OemBody::Velocity(body) => velocity(body),
        OemBody::Heading(body) => heading(body),
        OemBody::Ins(body) => ins(body),
        OemBody::InsExtended(body) => ins_extended(body),
        OemBody::Imu(body) => imu(body),
        OemBody::ImuExtended(body) => imu_extended(body),
        OemBody::Time(body) => time(body),
        OemBody::Other => Value::Null,
    };
    let header = log.header;
    fields["header"] = json!([header.week, header.milliseconds, header.time_status]);
    (name.to_owned(), fields)
}

fn position(body: &BestPosition) -> Value {
    let [lat, lon, hgt] = body.std;
    json!({
        "solution_status": body.status, "position_type": body.kind, "latitude": body.latitude,
        "longitude": body.longitude, "height": body.height_msl, "undulation": body.undulation,
        "datum_id": body.datum, "latitude_std_dev": lat, "longitude_std_dev": lon,
        "height_std_dev": hgt, "diff_age": body.correction_age, "solution_age": body.age,
        "num_svs": body.tracked, "num_soln_svs": body.satellites,
    })
}

fn velocity(body: &BestVelocity) -> Value {
    json!({
        "status": body.status, "type": body.kind, "latency": body.latency,
        "diff_age": body.correction_age, "horizontal_speed": body.ground_speed,
        "ground_track": body.course, "z": body.climb,
    })
}

fn heading(body: &AntennaHeading) -> Value {
    json!({
        "solution_status": body.status, "position_type": body.kind, "b_length": body.length,
        "heading": body.heading, "pitch": body.pitch, "heading_std_dev": body.heading_std,
        "pitch_std_dev": body.pitch_std,
    })
}

fn ins(body: &InsPva) -> Value {
    let [north, east, up] = body.velocity;
    json!({
        "week": body.week, "seconds": body.time_of_week, "latitude": body.latitude,
        "longitude": body.longitude, "height": body.height, "north_vel": north, "east_vel": east,
        "up_vel": up, "roll": body.roll, "pitch": body.pitch, "azimuth": body.azimuth,
        "ins_solution_status": body.status,
    })
}

fn ins_extended(body: &InsPvax) -> Value {
    let [lat, lon, hgt] = body.position_std;
    let [roll, pitch, azimuth] = body.attitude_std;
    json!({
        "ins_solution_status": body.status, "position_type": body.kind,
        "latitude": body.latitude, "longitude": body.longitude, "height": body.height_msl,
        "undulation": body.undulation, "north_vel": body.velocity[0],
        "east_vel": body.velocity[1], "up_vel": body.velocity[2], "roll": body.attitude[0],
        "pitch": body.attitude[1], "azimuth": body.attitude[2], "latitude_std_dev": lat,
        "longitude_std_dev": lon, "height_std_dev": hgt,
        "north_vel_std_dev": body.velocity_std[0], "east_vel_std_dev": body.velocity_std[1],
        "up_vel_std_dev": body.velocity_std[2], "roll_std_dev": roll, "pitch_std_dev": pitch,
        "azimuth_std_dev": azimuth, "extended_sol_stat": body.extended,
        "time_since_update": body.since_update,
    })
}

fn imu(body: &RawImu) -> Value {
    counts(
        body.push,
        body.turn,
        json!({ "gps_week": body.week, "gps_seconds": body.time_of_week, "imu_status": body.status }),
    )
}

fn imu_extended(body: &RawImuX) -> Value {
    let info = u8::from(body.error) | u8::from(body.encrypted) << 1 | u8::from(body.known) << 2;
    counts(
        body.push,
        body.turn,
        json!({
            "imu_status_info": info, "imu_type": body.kind, "gps_week": body.week,
            "gps_seconds": body.time_of_week, "imu_status": body.status,
        }),
    )
}

fn counts(push: [i32; 3], turn: [i32; 3], mut fields: Value) -> Value {
    fields["push"] = json!(push);
    fields["turn"] = json!(turn);
    fields
}

fn time(body: &ReceiverClock) -> Value {
    let [month, day, hour, minute] = body.civil;
    json!({
        "clock_model_status": body.status, "offset": body.offset, "offset_std": body.offset_std,
        "utc_offset": body.utc_offset, "utc_year": body.year, "utc_month": month, "utc_day": day,
        "utc_hour": hour, "utc_minute": minute, "utc_millisecond": body.milliseconds,
        "utc_time_status": body.utc_status,
    })
}
