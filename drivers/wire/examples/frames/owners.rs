//! GSOF, VectorNav's messages and AD2CP's bottom track as JSON.

use insd_wire::gnss::gsof::{GsofRecord, GsofReport, Page};
use insd_wire::imu::vectornav::VnMessage;
use insd_wire::log::ad2cp::Ad2cpBottomTrack;
use serde_json::{Value, json};

/// The records of a report of one page, each as its type and its fields in their order.
pub(crate) fn gsof(frame: &[u8]) -> (String, Value) {
    let page = Page::open(frame);
    match page.and_then(|page| GsofReport::read(&page.records)) {
        Ok(report) => ("GSOF".to_owned(), report.records.iter().map(record).collect()),
        Err(fault) => ("refused".to_owned(), json!(fault.to_string())),
    }
}

fn record(record: &GsofRecord) -> Value {
    match record {
        GsofRecord::Time(own) => json!([
            1,
            own.milliseconds,
            own.week,
            own.satellites,
            own.calculated,
            own.corrected,
            own.initialisation
        ]),
        GsofRecord::Place(own) => json!([2, own.latitude, own.longitude, own.height]),
        GsofRecord::Movement(own) => json!([8, own.flags, own.speed, own.course, own.climb]),
        GsofRecord::Dilutions(own) => {
            let [p, h, v, t] = own.dilutions;
            json!([9, p, h, v, t])
        }
        GsofRecord::Sigma(own) => {
            let [major, minor, orientation] = own.ellipse;
            json!([
                12,
                own.rms,
                own.east,
                own.north,
                own.covariance,
                own.up,
                major,
                minor,
                orientation,
                own.unit_variance,
                own.epochs
            ])
        }
        GsofRecord::Now(own) => json!([16, own.milliseconds, own.week, own.utc_offset, own.flags]),
        GsofRecord::Line(own, _) => {
            let [pitch, yaw, roll] = own.angles;
            json!([
                27,
                own.milliseconds,
                own.flags,
                own.satellites,
                own.mode,
                pitch,
                yaw,
                roll,
                own.length,
                own.dilution
            ])
        }
        GsofRecord::Other(kind, _) => json!([kind]),
    }
}

pub(crate) fn vectornav(frame: &[u8]) -> (String, Value) {
    let own = match VnMessage::read(frame) {
        Ok(own) => own,
        Err(fault) => return ("refused".to_owned(), json!(fault.to_string())),
    };
    let deltas = own.deltas.map(|own| json!([own.interval, own.theta, own.velocity]));
    let fields = json!({
        "timeStartup": own.startup_nanos, "timeGps": own.gps_nanos, "timeStatus": own.time_status,
        "ypr": own.attitude, "yprU": own.attitude_std, "angularRate": own.rate,
        "accel": own.force, "uncompGyro": own.plain_rate, "uncompAccel": own.plain_force,
        "deltas": deltas, "temperature": own.temperature, "sensSat": own.saturated,
        "insStatus": own.ins_status,
    });
    ("VectorNav".to_owned(), fields)
}

pub(crate) fn ad2cp(frame: &[u8]) -> (String, Value) {
    let own = match Ad2cpBottomTrack::read(frame) {
        Ok(own) => own,
        Err(fault) => return ("refused".to_owned(), json!(fault.to_string())),
    };
    let head = own.head;
    let fields = json!({
        "ver": head.version, "config": head.config, "SerialNum": head.serial,
        "clock": head.clock, "usec100": head.fraction, "c_sound": head.sound_speed,
        "temp": head.temperature, "pressure": head.pressure, "heading": head.heading,
        "pitch": head.tilt[0], "roll": head.tilt[1], "beam_config": head.beams,
        "batt": head.battery, "vel_scale": head.exponent, "error": head.error,
        "status": head.status, "ensemble": head.ensemble, "vel": own.velocity,
        "dist": own.distance, "fom": own.merit,
    });
    ("bottom track".to_owned(), fields)
}
