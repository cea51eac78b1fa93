//! Position, course and speed, sent often.

use super::attitude::NORTH;
use super::bits::Number;
use super::kinds::{DIRECTION, Degrees, SID, SPEED};
use super::table::group;
use super::{North, Sid, millis};

/// Latitude.
const LATITUDE: Degrees =
    Degrees(Number::signed(32, 1e7).within(-900_000_000, 900_000_000).unit("deg"));
/// Longitude.
const LONGITUDE: Degrees =
    Degrees(Number::signed(32, 1e7).within(-1_800_000_000, 1_800_000_000).unit("deg"));

group! {
    /// 129025 Position, rapid update. It has neither a SID nor a time.
    129_025 PositionRapid: Copy, priority 2, every millis(100), least 4;
    /// Geodetic latitude, rad, north positive.
    0 latitude: Option<f64> = LATITUDE;
    /// Longitude, rad, east positive.
    32 longitude: Option<f64> = LONGITUDE;
}

group! {
    /// 129026 Course and speed over ground, rapid update.
    129_026 CourseSpeed: Copy, priority 2, every millis(250), least 4;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Which north the course counts from.
    8 reference: Option<North> = NORTH, reserved 6;
    /// Course over ground, rad, 0 to 2 pi.
    16 course: Option<f64> = DIRECTION;
    /// Speed over ground, m/s.
    32 speed: Option<f64> = SPEED, reserved 16;
}
