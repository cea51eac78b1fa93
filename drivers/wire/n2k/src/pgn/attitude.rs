//! Heading, rate of turn, heave, attitude and magnetic variation.

use super::Sid;

/// Which north a direction counts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum North {
    /// Geographic north.
    True,
    /// Magnetic north.
    Magnetic,
}

/// 127250 Vessel heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heading {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Clockwise from north, rad, 0 to 2 pi.
    pub heading: Option<f64>,
    /// Deviation of a magnetic compass, east positive, rad.
    pub deviation: Option<f64>,
    /// Variation of the place, east positive, rad.
    pub variation: Option<f64>,
    /// Which north; `None` if not told, or an error.
    pub reference: Option<North>,
}

/// 127251 Rate of turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateOfTurn {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Change of heading, rad/s, bow to starboard positive.
    pub rate: Option<f64>,
}

/// 127252 Heave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heave {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Displacement from the mean, m, up positive.
    pub heave: Option<f64>,
}

/// 127257 Attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Yaw: heading, rad, -pi to pi.
    pub yaw: Option<f64>,
    /// Pitch, bow up positive, rad.
    pub pitch: Option<f64>,
    /// Roll, starboard side down positive, rad.
    pub roll: Option<f64>,
}

/// Where a variation comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariationSource {
    /// Typed in.
    Manual,
    /// A chart.
    Chart,
    /// A table.
    Table,
    /// A calculation that is not named.
    Calculation,
    /// World Magnetic Model of this year: 2000, 2005, 2010, 2015, 2020 or 2025.
    Wmm(u16),
}

/// 127258 Magnetic variation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MagneticVariation {
    /// Links the messages of one epoch.
    pub sid: Sid,
    /// Where it comes from.
    pub source: Option<VariationSource>,
    /// Day for which it holds ("age of service"), days since 1970-01-01.
    pub date: Option<u16>,
    /// Variation, east positive, rad.
    pub variation: Option<f64>,
}
