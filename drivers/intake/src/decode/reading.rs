//! What frames say.

use insd_base::{GpsTime, LogReference};
use insd_wire::gnss::{EpochTime, GnssPart, PulseTime};
use insd_wire::imu::ImuReading;
use insd_wire::nmea::{PinsdStep, PinsdTracks, Position};

use crate::event::Refusal;
use crate::ranging::HeadDistance;
use crate::satellites::RawReading;
use crate::status::ShownPart;

/// What a frame says.
#[derive(Clone, Debug, PartialEq)]
pub enum Reading {
    /// A sample of an IMU.
    Imu(ImuReading),
    /// A part of a receiver's epoch.
    Gnss(GnssPart),
    /// What a raw message of a receiver says.
    Raw(RawReading),
    /// A frame of a base.
    Base(Vec<u8>),
    /// The time of a pulse.
    Pulse(PulseTime),
    /// A velocity in the ship's axes.
    Velocity(ShipVelocity),
    /// A heading.
    Heading(HeadingReading),
    /// A position that holds at its receipt, and its 1-sigma if one was given, m.
    Fix(Position, Option<f64>),
    /// A position, or that there is none, that is timed by its receipt.
    Place(Option<Position>),
    /// A distance of a docking aid.
    Range(HeadDistance),
    /// Points in an image of a camera.
    Tracks(Box<PinsdTracks>),
    /// How a camera moved.
    Step(Box<PinsdStep>),
    /// UTC beside the fixes of a receiver.
    Clock(EpochTime),
    /// Something that is shown and not used.
    Shown(ShownPart),
    /// A part of the frame is not taken, and why.
    LeftOut(Refusal),
    /// A good frame that says nothing which is used.
    Idle,
}

/// A velocity of the ship, along forward, starboard and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShipVelocity {
    /// Forward, starboard, down, m/s; what the log does not tell is `None`.
    pub velocity: [Option<f64>; 3],
    /// Over ground or through the water.
    pub reference: LogReference,
    /// 1-sigma of each component, m/s.
    pub std: f64,
    /// When, by the log's own account.
    pub gps: Option<GpsTime>,
    /// Time from the measurement to the message, s.
    pub age: f64,
    /// Whether the log stands behind it.
    pub valid: bool,
}

/// A heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadingReading {
    /// Clockwise from north, rad.
    pub heading: f64,
    /// 1-sigma as the sensor claims, rad.
    pub std: Option<f64>,
    /// Which north.
    pub north: North,
    /// Whether the sensor stands behind it.
    pub valid: bool,
}

/// Which north a heading counts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum North {
    /// Geographic north.
    True,
    /// Geographic north, by a magnetic compass and a stated variation.
    Corrected,
    /// Magnetic north; the variation must come from elsewhere.
    Magnetic,
}
