//! Readings as JSON: units stand in the keys, and what is not known is null.

use insd_base::units::DEG;
use insd_base::{FixQuality, LogReference};
use insd_config::calendar;
use insd_intake::decode::{HeadingReading, North, Reading, ShipVelocity};
use insd_intake::status::ShownPart;
use insd_wire::gnss::{EpochTime, GnssPart};
use insd_wire::imu::{ImuMotion, ImuReading};
use serde_json::{Value, json};

/// A reading; `None` of one that says nothing.
pub(super) fn object(reading: &Reading) -> Option<Value> {
    Some(match reading {
        Reading::Gnss(part) => gnss(part),
        Reading::Imu(sample) => imu(sample),
        Reading::Velocity(velocity) => velocity_of(velocity),
        Reading::Heading(heading) => heading_of(heading),
        Reading::Shown(shown) => shown_of(shown),
        Reading::Place(Some(at)) | Reading::Fix(at, _) => json!({
            "quantity": "position", "latitude_deg": number(at.latitude / DEG),
            "longitude_deg": number(at.longitude / DEG),
        }),
        Reading::Range(range) => json!({
            "quantity": "range", "head": range.head, "distance_m": range.distance.and_then(number),
            "std_m": range.std.and_then(number),
        }),
        Reading::Clock(epoch) => json!({ "quantity": "time", "time": time(epoch) }),
        Reading::Pulse(pulse) => json!({ "quantity": "pulse_time", "time": time(&pulse.instant) }),
        _ => return None,
    })
}

/// A number that is one; JSON has no others.
fn number(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

fn numbers(values: impl IntoIterator<Item = Option<f64>>) -> Value {
    values.into_iter().map(|value| value.and_then(number)).collect()
}

fn degrees(angle: Option<f64>) -> Option<f64> {
    angle.and_then(|angle| number(angle / DEG))
}

fn gnss(part: &GnssPart) -> Value {
    let place = part.position.map(|at| (at.latitude, at.longitude));
    let place = place.or(part.horizontal.map(|at| (at.latitude, at.longitude)));
    json!({
        "quantity": "gnss",
        "message": part.kind,
        "time": part.epoch.as_ref().map(time),
        "latitude_deg": degrees(place.map(|(latitude, _)| latitude)),
        "longitude_deg": degrees(place.map(|(_, longitude)| longitude)),
        "height_m": part.position.and_then(|at| number(at.height)),
        "position_std_m": numbers(part.position_std),
        "velocity_ned_mps": numbers(part.velocity),
        "velocity_std_mps": numbers(part.velocity_std),
        "heading_deg": degrees(part.heading),
        "heading_std_deg": degrees(part.heading_std),
        "hdop": part.hdop.and_then(number),
        "satellites": part.satellites,
        "quality": part.quality.map(quality),
    })
}

fn quality(quality: FixQuality) -> &'static str {
    match quality {
        FixQuality::Invalid => "invalid",
        FixQuality::Autonomous => "autonomous",
        FixQuality::Differential => "differential",
        FixQuality::Precise => "precise",
        FixQuality::RtkFixed => "rtk_fixed",
        FixQuality::RtkFloat => "rtk_float",
        FixQuality::Estimated => "estimated",
        FixQuality::Manual => "manual",
        FixQuality::Simulated => "simulated",
    }
}

/// As far as the message tells it: an instant, or the seconds of the day or of the GPS week.
fn time(epoch: &EpochTime) -> Value {
    let utc = match epoch {
        EpochTime::Utc(utc) => Some(*utc),
        EpochTime::Gps(gps) => Some(gps.to_utc(None)),
        EpochTime::TimeOfDay(_) | EpochTime::TimeOfWeek(_) => None,
    };
    let of_week = match epoch {
        EpochTime::TimeOfWeek(nanos) => Some(*nanos as f64 * 1e-9),
        _ => None,
    };
    let of_day = match epoch {
        EpochTime::TimeOfDay(time) => Some(time.as_nanos() as f64 * 1e-9),
        _ => None,
    };
    json!({
        "utc": utc.map(calendar::rfc3339_millis), "second_of_day": of_day,
        "second_of_gps_week": of_week,
    })
}

fn imu(sample: &ImuReading) -> Value {
    let of = |motion: [f64; 3]| numbers(motion.map(Some));
    let (rates, increments) = match sample.motion {
        ImuMotion::Rates { gyro, accel } => (Some((of(gyro), of(accel))), None),
        ImuMotion::Increments { delta_theta, delta_velocity } => {
            (None, Some((of(delta_theta), of(delta_velocity))))
        }
    };
    let (gyro, accel) = rates.unzip();
    let (turn, push) = increments.unzip();
    json!({
        "quantity": "imu",
        "gyro_radps": gyro,
        "accel_mps2": accel,
        "delta_theta_rad": turn,
        "delta_velocity_mps": push,
        "utc": sample.utc.map(calendar::rfc3339_millis),
        "temperature_c": sample.temperature.and_then(number),
        "valid": sample.valid,
        "status": sample.status,
    })
}

fn velocity_of(velocity: &ShipVelocity) -> Value {
    json!({
        "quantity": "velocity",
        "over": match velocity.reference {
            LogReference::Bottom => "bottom",
            LogReference::Water => "water",
        },
        "forward_mps": velocity.velocity[0].and_then(number),
        "starboard_mps": velocity.velocity[1].and_then(number),
        "down_mps": velocity.velocity[2].and_then(number),
        "valid": velocity.valid,
    })
}

fn heading_of(heading: &HeadingReading) -> Value {
    json!({
        "quantity": "heading",
        "heading_deg": degrees(heading.valid.then_some(heading.heading)),
        "std_deg": degrees(heading.std),
        "north": match heading.north {
            North::True => "true",
            North::Corrected => "corrected",
            North::Magnetic => "magnetic",
        },
        "valid": heading.valid,
    })
}

fn shown_of(shown: &ShownPart) -> Value {
    match shown {
        ShownPart::RateOfTurn(rate) => {
            json!({ "quantity": "rate_of_turn", "rate_degps": degrees(*rate) })
        }
        ShownPart::Tilt { roll, pitch } => {
            json!({ "quantity": "tilt", "roll_deg": degrees(*roll), "pitch_deg": degrees(*pitch) })
        }
        ShownPart::Distance { log, trip } => json!({
            "quantity": "distance", "log_m": log.and_then(number), "trip_m": trip.and_then(number),
        }),
    }
}
