//! Speed, distance and current.

use super::{North, Sid};

/// How a log measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeedKind {
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

/// The way a ship goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Ahead.
    Forward,
    /// Astern.
    Reverse,
}

/// 128259 Speed, water referenced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Through the water, m/s, not negative.
    pub water: Option<f64>,
    /// Over ground, m/s, not negative.
    pub ground: Option<f64>,
    /// How the speed through the water is measured.
    pub kind: Option<SpeedKind>,
    /// The way the ship goes; many devices do not tell.
    pub direction: Option<Direction>,
}

/// 128275 Distance log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceLog {
    /// Days since 1970-01-01.
    pub date: Option<u16>,
    /// UTC, seconds of the day.
    pub time: Option<f64>,
    /// Distance in all, m.
    pub log: Option<f64>,
    /// Distance since the last reset, m.
    pub trip: Option<f64>,
}

/// 129291 Set and drift, rapid update.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SetDrift {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Which north the set counts from.
    pub reference: Option<North>,
    /// Whither the current flows, rad, 0 to 2 pi.
    pub set: Option<f64>,
    /// Its speed, m/s.
    pub drift: Option<f64>,
}

/// 130578 Vessel speed components: forward and starboard positive, m/s.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct SpeedComponents {
    /// Forward, through the water.
    pub forward_water: Option<f64>,
    /// To starboard, through the water.
    pub starboard_water: Option<f64>,
    /// Forward, over ground.
    pub forward_ground: Option<f64>,
    /// To starboard, over ground.
    pub starboard_ground: Option<f64>,
    /// The stern's to starboard, through the water.
    pub stern_starboard_water: Option<f64>,
    /// The stern's to starboard, over ground.
    pub stern_starboard_ground: Option<f64>,
}
