//! UBX messages as JSON.

use insd_wire::gnss::ubx::{
    NavCov, NavDop, NavHpPosLlh, NavPosLlh, NavPvt, NavRelPosNed, NavSol, NavStatus, NavTimeGps,
    NavTimeLs, NavTimeUtc, NavVelNed, RxmRawx, RxmSfrbx, TimTp, UbxCovariance, UbxMessage,
};
use insd_wire::gnss::{EpochTime, PulseTime};
use serde_json::{Value, json};

/// Name and fields of a frame; no fields if it is not read, `refused` and why if it can not be.
pub(crate) fn describe(frame: &[u8]) -> (String, Value) {
    let message = match UbxMessage::read(frame) {
        Ok(message) => message,
        Err(fault) => return ("refused".to_owned(), json!(fault.to_string())),
    };
    let (name, fields) = match &message {
        UbxMessage::NavPvt(message) => ("NAV-PVT", pvt(message)),
        UbxMessage::NavDop(message) => ("NAV-DOP", dop(message)),
        UbxMessage::NavCov(message) => ("NAV-COV", cov(message)),
        UbxMessage::NavHpPosLlh(message) => ("NAV-HPPOSLLH", hpposllh(message)),
        UbxMessage::NavPosLlh(message) => ("NAV-POSLLH", posllh(message)),
        UbxMessage::NavVelNed(message) => ("NAV-VELNED", velned(message)),
        UbxMessage::NavSol(message) => ("NAV-SOL", sol(message)),
        UbxMessage::NavStatus(message) => ("NAV-STATUS", status(message)),
        UbxMessage::NavTimeUtc(message) => ("NAV-TIMEUTC", timeutc(message)),
        UbxMessage::NavRelPosNed(message) => ("NAV-RELPOSNED", relposned(message)),
        UbxMessage::NavTimeGps(message) => ("NAV-TIMEGPS", time_gps(message)),
        UbxMessage::NavTimeLs(message) => ("NAV-TIMELS", time_ls(message)),
        UbxMessage::TimTp(message) => ("TIM-TP", tim_tp(message)),
        UbxMessage::RxmRawx(message) => ("RXM-RAWX", rawx(message)),
        UbxMessage::RxmSfrbx(message) => ("RXM-SFRBX", sfrbx(message)),
        UbxMessage::Other { class, id } => return (format!("{class:02X}-{id:02X}"), Value::Null),
    };
    (name.to_owned(), fields)
}

fn pvt(message: &NavPvt) -> Value {
    let time = message.time;
    let utc = time.utc().map(insd_base::UtcTime::as_nanos);
    let position = message.position;
    json!({
        "iTOW": message.time_of_week, "year": time.date.year, "month": time.date.month,
        "day": time.date.day, "hour": time.clock.0, "min": time.clock.1, "second": time.clock.2,
        "validDate": time.date_valid, "validTime": time.clock_valid,
        "fullyResolved": time.resolved, "tAcc": time.accuracy, "nano": time.nanosecond,
        "utc": utc, "fixType": message.fix.raw(), "gnssFixOk": message.fix_ok,
        "diffSoln": message.differential, "carrSoln": message.carrier.raw(),
        "numSV": message.satellites, "lat": position.map(|position| position.latitude),
        "lon": position.map(|position| position.longitude),
        "height": position.map(|position| position.height), "hMSL": message.height_msl,
        "hAcc": message.horizontal_accuracy, "vAcc": message.vertical_accuracy,
        "velN": message.velocity[0], "velE": message.velocity[1], "velD": message.velocity[2],
        "gSpeed": message.ground_speed, "headMot": message.course,
        "sAcc": message.speed_accuracy, "headAcc": message.heading_accuracy,
        "pDOP": message.pdop, "headVeh": message.heading,
        "magDec": message.declination.map(|one| one.0),
        "magAcc": message.declination.map(|one| one.1),
    })
}

fn dop(message: &NavDop) -> Value {
    json!({
        "iTOW": message.time_of_week, "gDOP": message.geometric, "pDOP": message.position,
        "tDOP": message.time, "vDOP": message.vertical, "hDOP": message.horizontal,
        "nDOP": message.north, "eDOP": message.east,
    })
}

fn cov(message: &NavCov) -> Value {
    let all = |of: Option<UbxCovariance>| of.map(|of| json!([of.north, of.east, of.down]));
    json!({
        "iTOW": message.time_of_week, "posCov": all(message.position),
        "velCov": all(message.velocity),
    })
}

fn hpposllh(message: &NavHpPosLlh) -> Value {
    let position = message.position;
    json!({
        "iTOW": message.time_of_week, "lat": position.map(|position| position.latitude),
        "lon": position.map(|position| position.longitude),
        "height": position.map(|position| position.height), "hMSL": message.height_msl,
        "hAcc": message.horizontal_accuracy, "vAcc": message.vertical_accuracy,
    })
}

fn posllh(message: &NavPosLlh) -> Value {
    json!({
        "iTOW": message.time_of_week, "lat": message.latitude, "lon": message.longitude,
        "height": message.height, "hMSL": message.height_msl,
        "hAcc": message.horizontal_accuracy, "vAcc": message.vertical_accuracy,
    })
}

fn velned(message: &NavVelNed) -> Value {
    json!({
        "iTOW": message.time_of_week, "velN": message.velocity[0], "velE": message.velocity[1],
        "velD": message.velocity[2], "speed": message.speed, "gSpeed": message.ground_speed,
        "heading": message.course, "sAcc": message.speed_accuracy, "cAcc": message.course_accuracy,
    })
}

fn sol(message: &NavSol) -> Value {
    let ([x, y, z], [vx, vy, vz]) = (message.position, message.velocity);
    json!({
        "iTOW": message.time_of_week, "fTOW": message.fraction, "week": message.week,
        "gpsFix": message.fix.raw(), "gpsfixOK": message.fix_ok, "diffSoln": message.differential,
        "wknSet": message.week_valid, "towSet": message.time_of_week_valid,
        "ecefX": x, "ecefY": y, "ecefZ": z, "pAcc": message.position_accuracy,
        "ecefVX": vx, "ecefVY": vy, "ecefVZ": vz, "sAcc": message.speed_accuracy,
        "pDOP": message.pdop, "numSV": message.satellites,
    })
}

fn status(message: &NavStatus) -> Value {
    json!({
        "iTOW": message.time_of_week, "gpsFix": message.fix.raw(), "gpsFixOk": message.fix_ok,
        "diffSoln": message.differential, "wknSet": message.week_valid,
        "towSet": message.time_of_week_valid, "spoofDetState": message.spoofing,
        "carrSoln": message.carrier.raw(), "ttff": message.to_first_fix,
        "msss": message.since_start,
    })
}

fn timeutc(message: &NavTimeUtc) -> Value {
    json!({
        "iTOW": message.time_of_week, "tAcc": message.accuracy, "nano": message.nanosecond,
        "year": message.year, "month": message.month_day[0], "day": message.month_day[1],
        "hour": message.clock[0], "min": message.clock[1], "sec": message.clock[2],
        "validTOW": message.time_of_week_valid, "validWKN": message.week_valid,
        "validUTC": message.valid, "utcStandard": message.standard,
    })
}

fn relposned(message: &NavRelPosNed) -> Value {
    let ([n, e, d], [fine_n, fine_e, fine_d]) = (message.relative, message.finer);
    json!({
        "iTOW": message.time_of_week, "version": message.version, "refStationID": message.station,
        "relPosN": n + fine_n, "relPosE": e + fine_e, "relPosD": d + fine_d,
        "relPosLength": message.length + message.finer_length,
        "relPosHeading": message.heading, "accN": message.accuracy[0],
        "accE": message.accuracy[1], "accD": message.accuracy[2],
        "accLength": message.length_accuracy, "accHeading": message.heading_accuracy,
        "gnssFixOK": message.fix_ok, "diffSoln": message.differential,
        "relPosValid": message.valid, "carrSoln": message.carrier.raw(),
        "isMoving": message.moving, "refPosMiss": message.position_missing,
        "refObsMiss": message.measurements_missing, "relPosHeadingValid": message.heading_valid,
        "relPosNormalized": message.normalized,
    })
}

fn time_gps(message: &NavTimeGps) -> Value {
    json!({
        "iTOW": message.time_of_week, "fTOW": message.fraction, "week": message.week,
        "leapS": message.leap_seconds, "towValid": message.time_of_week_valid,
        "weekValid": message.week_valid, "tAcc": message.accuracy,
        "gps": message.gps().map(insd_base::GpsTime::as_nanos),
    })
}

fn time_ls(message: &NavTimeLs) -> Value {
    let event = message.event;
    json!({
        "iTOW": message.time_of_week, "srcOfCurrLs": message.source,
        "currLs": message.leap_seconds, "srcOfLsChange": event.map(|event| event.source),
        "lsChange": event.map(|event| event.change),
        "timeToLsEvent": event.map(|event| event.wait),
        "dateOfLsGpsWn": event.map(|event| event.week),
        "dateOfLsGpsDn": event.map(|event| event.day),
    })
}

fn tim_tp(message: &TimTp) -> Value {
    json!({
        "towMS": message.time_of_week, "towSubMS": message.fraction,
        "qErr": message.quantization, "week": message.week, "timeBase": message.utc_base,
        "utc": message.utc_available, "raim": message.raim, "timeRefGnss": message.system,
        "utcStandard": message.utc_standard, "pulse": message.pulse().as_ref().map(instant),
    })
}

fn rawx(message: &RxmRawx) -> Value {
    let measurement = |one: &insd_wire::gnss::ubx::RawMeasurement| {
        json!({
            "prMes": one.pseudorange, "cpMes": one.carrier_phase, "doMes": one.doppler,
            "gnssId": one.signal.system, "svId": one.signal.satellite, "sigId": one.signal.signal,
            "freqId": one.signal.slot, "locktime": one.lock_time, "cno": one.carrier_to_noise,
            "prStd": one.pseudorange_exponent, "cpStd": one.carrier_phase_std,
            "doStd": one.doppler_exponent,
        })
    };
    json!({
        "rcvTow": message.time_of_week, "week": message.week, "leapS": message.leap_seconds,
        "leapSec": message.leap_seconds_valid, "clkReset": message.clock_reset,
        "measurements": message.measurements.iter().map(measurement).collect::<Vec<_>>(),
    })
}

fn sfrbx(message: &RxmSfrbx) -> Value {
    json!({
        "gnssId": message.signal.system, "svId": message.signal.satellite,
        "sigId": message.signal.signal, "freqId": message.signal.slot, "chn": message.channel,
        "version": message.version, "dwrd": message.words,
    })
}

/// Time scale and nanoseconds of a pulse.
pub(crate) fn instant(pulse: &PulseTime) -> Value {
    match pulse.instant {
        EpochTime::Utc(utc) => json!({ "utc": utc.as_nanos() }),
        EpochTime::Gps(gps) => json!({ "gps": gps.as_nanos() }),
        EpochTime::TimeOfWeek(nanos) => json!({ "tow": nanos }),
        EpochTime::TimeOfDay(time) => json!({ "day": time.as_nanos() }),
    }
}
