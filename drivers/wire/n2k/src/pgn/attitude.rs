//! Heading, rate of turn, heave, attitude and magnetic variation.

use super::bits::Number;
use super::kinds::{ANGLE, Choice, DATE, DIRECTION, SID, YAW};
use super::table::{codes, group};
use super::{Sid, millis};

codes! {
    /// Which north a direction counts from.
    North as NORTH, 2 bits;
    /// Geographic north.
    True,
    /// Magnetic north.
    Magnetic,
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

/// Variations' sources by their numbers.
const SOURCES: &[VariationSource] = {
    use VariationSource::{Calculation, Chart, Manual, Table, Wmm};
    &[
        Manual,
        Chart,
        Table,
        Calculation,
        Wmm(2000),
        Wmm(2005),
        Wmm(2010),
        Wmm(2015),
        Wmm(2020),
        Wmm(2025),
    ]
};
/// One of [`VariationSource`].
const VARIATION_SOURCE: Choice<VariationSource> = Choice::new(4, SOURCES);
/// Rate of turn, 1/32 of 1e-6 rad/s.
const RATE: Number = Number::signed(32, 3.2e7).unit("rad/s");
/// Displacement.
const HEAVE: Number = Number::signed(16, 100.0).unit("m");

group! {
    /// 127250 Vessel heading.
    127_250 Heading: Copy, priority 2, every millis(100), least 3;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Clockwise from north, rad, 0 to 2 pi.
    8 heading: Option<f64> = DIRECTION;
    /// Deviation of a magnetic compass, east positive, rad.
    24 deviation: Option<f64> = ANGLE;
    /// Variation of the place, east positive, rad.
    40 variation: Option<f64> = ANGLE;
    /// Which north; `None` if not told, or an error.
    56 reference: Option<North> = NORTH, reserved 6;
}

group! {
    /// 127251 Rate of turn.
    127_251 RateOfTurn: Copy, priority 2, every millis(100), least 5;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Change of heading, rad/s, bow to starboard positive.
    8 rate: Option<f64> = RATE, reserved 24;
}

group! {
    /// 127252 Heave. A later edition is said to have a delay in the reserved bits, which is not read.
    127_252 Heave: Copy, priority 3, every None, least 3;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Displacement from the mean, m, up positive.
    8 heave: Option<f64> = HEAVE, reserved 40;
}

group! {
    /// 127257 Attitude. Many devices leave the yaw out.
    127_257 Attitude: Copy, priority 3, every millis(1000), least 3;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Yaw: heading, rad, -pi to pi; it may be written from any angle.
    8 yaw: Option<f64> = YAW;
    /// Pitch, bow up positive, rad.
    24 pitch: Option<f64> = ANGLE;
    /// Roll, starboard side down positive, rad.
    40 roll: Option<f64> = ANGLE, reserved 8;
}

group! {
    /// 127258 Magnetic variation.
    127_258 MagneticVariation: Copy, priority 7, every millis(1000), least 4;
    /// Links the messages of one epoch.
    0 sid: Sid = SID;
    /// Where it comes from.
    8 source: Option<VariationSource> = VARIATION_SOURCE, reserved 4;
    /// Day for which it holds ("age of service"), days since 1970-01-01.
    16 date: Option<u16> = DATE;
    /// Variation, east positive, rad.
    32 variation: Option<f64> = ANGLE, reserved 16;
}
