//! Doppler and electromagnetic logs with formats of their own (those that speak NMEA are there).

pub mod ad2cp;
pub mod pd0;
pub mod pd6;

use insd_base::{LogReference, UtcTime};

/// Axes of a log's velocity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LogFrame {
    /// Along the beams, towards the transducer positive.
    Beam,
    /// The instrument's own axes: x, y in the plane of the transducer, z.
    Instrument,
    /// Forward, starboard, down of the ship.
    Ship,
    /// East, north, up, by the instrument's own compass.
    Earth,
}

/// One velocity of a log: three components, or four beams.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogReading {
    /// Components in the order of the frame, m/s; invalid ones `None`. Three frames leave the last empty.
    /// Of the ship with respect to the reference; along beams, of the reference towards the transducer.
    pub velocity: [Option<f64>; 4],
    /// Axes.
    pub frame: LogFrame,
    /// Sea bed or water.
    pub reference: LogReference,
    /// 1-sigma as the log claims, m/s.
    pub std: Option<f64>,
    /// UTC of the measurement, if the log tells it.
    pub utc: Option<UtcTime>,
    /// Time from the measurement to the message as the log tells it, s.
    pub age: Option<f64>,
}
