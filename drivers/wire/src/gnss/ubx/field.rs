//! Fields that several messages have in common.

use insd_base::Geodetic;

use crate::binary::{BinaryFault, Reader, Writer};
use crate::gnss::EpochTime;

/// Nanoseconds of a millisecond.
const MILLI: i64 = 1_000_000;

/// Milliseconds of a week.
const WEEK: i64 = 604_800_000;

/// Degrees in one step of a latitude or longitude.
const ANGLE: f64 = 1e-7;

/// Reads `iTOW`, ms of the GPS week, as ns.
pub(super) fn time_of_week(reader: &mut Reader<'_>) -> Result<i64, BinaryFault> {
    Ok(i64::from(reader.le_u32()?) * MILLI)
}

/// `iTOW` of ns of the GPS week, to the nearest millisecond.
pub(super) fn milliseconds(time_of_week: i64) -> u32 {
    let rounded = time_of_week.saturating_add(MILLI / 2).div_euclid(MILLI);
    rounded.clamp(0, u32::MAX.into()) as u32
}

/// The epoch of a message that tells no more than `iTOW`.
pub(super) fn epoch(time_of_week: i64) -> Option<EpochTime> {
    (0..WEEK * MILLI).contains(&time_of_week).then_some(EpochTime::TimeOfWeek(time_of_week))
}

/// An accuracy; all ones is how receivers say that they do not know.
pub(super) fn accuracy(raw: u32, unit: f64) -> Option<f64> {
    (raw != u32::MAX).then(|| f64::from(raw) * unit)
}

/// An accuracy for the wire, saturated below the value that says unknown.
pub(super) fn accuracy_raw(value: Option<f64>, unit: f64) -> u32 {
    value.map_or(u32::MAX, |value| ((value / unit).round() as u32).min(u32::MAX - 1))
}

/// A signed number for the wire, saturated.
pub(super) fn signed(value: f64, unit: f64) -> i32 {
    (value / unit).round() as i32
}

/// A dilution of precision, in hundredths on the wire; 99.99 is how receivers say that there is none.
pub(super) fn dilution(raw: u16) -> Option<f64> {
    (raw < 9999).then(|| f64::from(raw) * 0.01)
}

/// A dilution of precision for the wire, saturated below the value that says none.
pub(super) fn dilution_raw(value: Option<f64>) -> u16 {
    value.map_or(9999, |value| ((value / 0.01).round() as u16).min(9998))
}

/// Longitude, latitude (1e-7 deg) and height above the ellipsoid (mm), in the order of the wire, each
/// with more digits below (1e-9 deg, 0.1 mm).
pub(super) fn position(steps: [i32; 3], finer: [i8; 3]) -> Result<Geodetic, BinaryFault> {
    let degrees = |at: usize| f64::from(steps[at]) * ANGLE + f64::from(finer[at]) * 1e-9;
    let (longitude, latitude) = (degrees(0), degrees(1));
    if latitude.abs() > 90.0 {
        return Err(BinaryFault::Range { field: "lat" });
    }
    if longitude.abs() > 180.0 {
        return Err(BinaryFault::Range { field: "lon" });
    }
    let height = f64::from(steps[2]) * 1e-3 + f64::from(finer[2]) * 1e-4;
    Ok(Geodetic::from_degrees(latitude, longitude, height))
}

/// Appends what [`position`] reads as steps.
pub(super) fn put_position(writer: &mut Writer, position: Geodetic) {
    let degrees = |angle: f64| signed(angle.to_degrees(), ANGLE);
    writer.le_i32(degrees(insd_base::units::wrap_pi(position.longitude)));
    writer.le_i32(degrees(position.latitude)).le_i32(signed(position.height, 1e-3));
}

/// Whether a bit is set.
pub(super) fn bit(flags: u8, number: u8) -> bool {
    flags >> number & 1 == 1
}
