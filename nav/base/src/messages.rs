//! Messages from sensors. Each carries its time of validity; [`Received`] adds when and from whom
//! it came.

use std::sync::Arc;

use crate::camera::{CameraFrame, VisualOdometry};
use crate::frames::{Body, Geodetic, Ned};
use crate::gnss::GnssFix;
use crate::ranging::RangingReading;
use crate::satellites::{BaseEpoch, CompassReading, RtkEpoch, SatelliteRanges};
use crate::time::Time;

/// Increments of one IMU sampling interval, ending at `time`.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ImuSample {
    /// End of the interval.
    pub time: Time,
    /// Integral of the angular rate with respect to inertial space, each component in body axes, rad.
    pub delta_theta: Body,
    /// Integral of specific force, each component in body axes, m/s.
    pub delta_velocity: Body,
}

/// What a velocity log measures against.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LogReference {
    /// The sea bed.
    Bottom,
    /// The water around the hull.
    Water,
}

/// Velocity from a Doppler or electromagnetic log, body axes at the log; absent components `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogVelocity {
    /// Time of validity.
    pub time: Time,
    /// Forward, m/s.
    pub u: Option<f64>,
    /// Starboard, m/s.
    pub v: Option<f64>,
    /// Down, m/s.
    pub w: Option<f64>,
    /// 1-sigma of each component, m/s.
    pub std: Option<f64>,
    /// Sea bed or water.
    pub reference: LogReference,
}

/// Velocity, position and heading from an external reference, any of them.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ExternalReference {
    /// Time of validity.
    pub time: Time,
    /// Northward velocity over the Earth, m/s.
    pub v_north: Option<f64>,
    /// Eastward velocity over the Earth, m/s.
    pub v_east: Option<f64>,
    /// 1-sigma of the velocity, m/s.
    pub velocity_std: Option<f64>,
    /// Latitude and longitude (height is not used).
    pub position: Option<Geodetic>,
    /// 1-sigma of each horizontal component, m, of what is over within minutes.
    pub position_std: Option<f64>,
    /// 1-sigma of what stays for hours besides, m, as the propagation of Loran over land; `None` where there is no such part.
    pub position_lasting_std: Option<f64>,
    /// True heading, rad.
    pub heading: Option<f64>,
    /// 1-sigma of the heading, rad.
    pub heading_std: Option<f64>,
}

impl ExternalReference {
    /// North and east velocity as a vector without a down component, if both are there.
    #[must_use]
    pub fn velocity(&self) -> Option<Ned> {
        Some(Ned::new(self.v_north?, self.v_east?, 0.0))
    }
}

/// Which sensor a message came from. One of each kind for now; the index tells several apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Source {
    /// Inertial measurement unit.
    Imu(u8),
    /// GNSS receiver.
    Gnss(u8),
    /// Velocity log.
    Log(u8),
    /// External reference.
    Reference(u8),
    /// Base station, which is not on board.
    Base(u8),
    /// Docking aid.
    Ranging(u8),
    /// Camera.
    Camera(u8),
}

impl Source {
    /// Short name for tables and events: `imu`, `gnss`, `log`, `reference`, `base`, `ranging`, `camera`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Source::Imu(_) => "imu",
            Source::Gnss(_) => "gnss",
            Source::Log(_) => "log",
            Source::Reference(_) => "reference",
            Source::Base(_) => "base",
            Source::Ranging(_) => "ranging",
            Source::Camera(_) => "camera",
        }
    }
}

/// Any sensor message.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// IMU increments.
    Imu(ImuSample),
    /// GNSS fix.
    Gnss(GnssFix),
    /// Log velocity.
    Log(LogVelocity),
    /// External reference.
    Reference(ExternalReference),
    /// Ranges of satellites; they are many, and shared by whoever keeps them.
    Ranges(Arc<SatelliteRanges>),
    /// What a base measured: never ranges of the ship.
    Base(Arc<BaseEpoch>),
    /// What an epoch of ranges came to against a base.
    Rtk(RtkEpoch),
    /// What several antennas told of how the hull stands.
    Compass(Arc<CompassReading>),
    /// Distance of a docking aid.
    Ranging(RangingReading),
    /// Points in an image of a camera.
    Camera(Arc<CameraFrame>),
    /// How a camera moved from one image to another.
    Odometry(VisualOdometry),
}

impl Message {
    /// Time of validity.
    #[must_use]
    pub fn time(&self) -> Time {
        match self {
            Message::Imu(m) => m.time,
            Message::Gnss(m) => m.time,
            Message::Log(m) => m.time,
            Message::Reference(m) => m.time,
            Message::Ranges(m) => m.time,
            Message::Base(m) => m.time,
            Message::Rtk(m) => m.time,
            Message::Compass(m) => m.time,
            Message::Ranging(m) => m.time,
            Message::Camera(m) => m.time,
            Message::Odometry(m) => m.time,
        }
    }
}

/// A message with its time of receipt and its source; the time of validity is in the message.
#[derive(Clone, Debug, PartialEq)]
pub struct Received {
    /// When it reached this computer.
    pub receipt: Time,
    /// From whom.
    pub source: Source,
    /// What.
    pub message: Message,
}
