//! Speed, distance and current.

use super::attitude::NORTH;
use super::kinds::{DATE, DIRECTION, DISTANCE, FINE_SPEED, SID, SPEED, TIME};
use super::table::{codes, group};
use super::{North, Sid, millis};

codes! {
    /// How a log measures.
    SpeedKind as SPEED_KIND, 8 bits;
    /// A paddle wheel.
    PaddleWheel,
    /// A pitot tube.
    PitotTube,
    /// Doppler.
    Doppler,
    /// Correlation of ultrasound.
    Correlation,
    /// Electromagnetic.
    Electromagnetic,
}

codes! {
    /// The way a ship goes.
    Direction as WAY, 4 bits;
    /// Ahead.
    Forward,
    /// Astern.
    Reverse,
}

group! {
    /// 128259 Speed, water referenced.
    ///
    /// canboat.json 8 names the direction but not its numbers, and the field table of 2009 has reserved
    /// bits in its place: the numbers are not verified, and no log at hand has anything but "not
    /// available" here.
    128_259 Speed: Copy, priority 2, every millis(1000), least 3;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Through the water, m/s, not negative.
    8 water: Option<f64> = SPEED;
    /// Over ground, m/s, not negative.
    24 ground: Option<f64> = SPEED;
    /// How the speed through the water is measured.
    40 kind: Option<SpeedKind> = SPEED_KIND;
    /// The way the ship goes; many devices do not tell.
    48 direction: Option<Direction> = WAY, reserved 12;
}

group! {
    /// 128275 Distance log.
    128_275 DistanceLog: Copy, priority 6, every millis(1000), least 2;
    /// Days since 1970-01-01.
    0 date: Option<u16> = DATE;
    /// UTC, seconds of the day.
    16 time: Option<f64> = TIME;
    /// Distance in all, m.
    48 log: Option<f64> = DISTANCE;
    /// Distance since the last reset, m.
    80 trip: Option<f64> = DISTANCE;
}

group! {
    /// 129291 Set and drift, rapid update.
    129_291 SetDrift: Copy, priority 3, every millis(1000), least 4;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Which north the set counts from.
    8 reference: Option<North> = NORTH, reserved 6;
    /// Whither the current flows, rad, 0 to 2 pi.
    16 set: Option<f64> = DIRECTION;
    /// Its speed, m/s.
    32 drift: Option<f64> = SPEED, reserved 16;
}

group! {
    /// 130578 Vessel speed components: forward and starboard positive, m/s. There is no SID.
    130_578 SpeedComponents: Copy Default, priority 2, every millis(250), least 2;
    /// Forward, through the water.
    0 forward_water: Option<f64> = FINE_SPEED;
    /// To starboard, through the water.
    16 starboard_water: Option<f64> = FINE_SPEED;
    /// Forward, over ground.
    32 forward_ground: Option<f64> = FINE_SPEED;
    /// To starboard, over ground.
    48 starboard_ground: Option<f64> = FINE_SPEED;
    /// The stern's to starboard, through the water.
    64 stern_starboard_water: Option<f64> = FINE_SPEED;
    /// The stern's to starboard, over ground.
    80 stern_starboard_ground: Option<f64> = FINE_SPEED;
}
