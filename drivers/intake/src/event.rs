//! What happened at the border, worth telling the operator.

use std::fmt;
use std::mem::discriminant;

use insd_base::can::BusEvent;
use insd_base::{PortId, PortState, SatelliteId, Span, Time};
use insd_gnss::OrbitRefusal;
use insd_wire::gnss::navigation::WordsRefusal;

use crate::base::BaseNews;
use crate::choice::Chosen;
use crate::clock::TimeChange;
use crate::device::Device;

/// Why a reading of a sensor, or a part of it, was not passed on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Refusal {
    /// The frame's contents are not what its format says.
    Malformed,
    /// A field of a sentence is bad; it is left out, and the rest of the sentence is taken.
    Field,
    /// The device's own status says that it is not valid.
    Invalid,
    /// What the accelerometers sense is not gravity, in the mean of seconds: they are not filled in, not
    /// in the unit that the format says, or broken.
    Gravity,
    /// Its time does not fit what is known, or it comes so soon after the one before that it must have
    /// waited, or have been told already.
    TimeDoubted,
    /// UTC is not known, and nothing else tells when it was.
    NoTime,
    /// Another source of the same quantity is in use.
    NotChosen,
    /// It is magnetic, and no model of the Earth's field was asked for or fits the day.
    Magnetic,
    /// Its axes cannot be turned into the ship's.
    Frame,
    /// A frame of the sample is missing, or a sentence of an image.
    Incomplete,
    /// It is from another device of the bus, or another source of a server, than the one that is listened to.
    OtherDevice,
    /// It is of another ship than this one, or nothing says that it is of this one.
    OtherShip,
    /// An epoch of satellites that was told already, or is older than the one before; an image or a step of the same time again; a value that a server repeats.
    Repeated,
    /// No satellite of an epoch has an orbit that can be used, or nobody knows yet where the antenna is.
    NoOrbit,
    /// What a satellite sent is no part of its message, or no orbit; an event tells which satellite, and why.
    Broadcast,
    /// Where a base says that it is is no place on Earth.
    BasePlace,
    /// A distance of a head that no `[[ranging]]` has.
    UnknownHead,
}

impl Refusal {
    /// A short name for tables: `malformed`, `not_chosen`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Refusal::Malformed => "malformed",
            Refusal::Field => "field",
            Refusal::Invalid => "invalid",
            Refusal::Gravity => "gravity",
            Refusal::TimeDoubted => "time_doubted",
            Refusal::NoTime => "no_time",
            Refusal::NotChosen => "not_chosen",
            Refusal::Magnetic => "magnetic",
            Refusal::Frame => "frame",
            Refusal::Incomplete => "incomplete",
            Refusal::OtherDevice => "other_device",
            Refusal::OtherShip => "other_ship",
            Refusal::Repeated => "repeated",
            Refusal::NoOrbit => "no_orbit",
            Refusal::Broadcast => "broadcast",
            Refusal::BasePlace => "base_place",
            Refusal::UnknownHead => "unknown_head",
        }
    }
}

/// What is wrong with what a satellite broadcasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BroadcastFault {
    /// Its words are refused.
    Words(WordsRefusal),
    /// Its record is refused, or holds no more.
    Orbit(OrbitRefusal),
}

impl fmt::Display for BroadcastFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BroadcastFault::Words(refusal) => write!(f, "its words are refused: {refusal}"),
            BroadcastFault::Orbit(refusal) => write!(f, "{refusal}"),
        }
    }
}

impl BroadcastFault {
    /// Whether it is of the same kind as another: numbers within it may differ.
    #[must_use]
    pub fn is_like(&self, other: &BroadcastFault) -> bool {
        match (self, other) {
            (BroadcastFault::Words(_), BroadcastFault::Words(_)) => true,
            (BroadcastFault::Orbit(own), BroadcastFault::Orbit(other)) => {
                discriminant(own) == discriminant(other)
            }
            _ => false,
        }
    }
}

/// What happened.
#[derive(Clone, Debug, PartialEq)]
pub enum Happening {
    /// A port is in another state.
    Port {
        /// Which.
        port: PortId,
        /// Its state.
        state: PortState,
    },
    /// The controller of a port says something of its CAN bus.
    Bus {
        /// Which.
        port: PortId,
        /// What it says.
        event: BusEvent,
    },
    /// A sensor listens to a device of the bus from now on.
    Device {
        /// Index of the sensor.
        sensor: usize,
        /// The device.
        device: Device,
    },
    /// A sensor speaks for the first time, or again.
    SensorSpeaks {
        /// Index of the sensor.
        sensor: usize,
    },
    /// A sensor has been silent for longer than its patience.
    SensorSilent {
        /// Index of the sensor.
        sensor: usize,
    },
    /// A sensor's own status turned invalid, or valid again.
    SensorValid {
        /// Index of the sensor.
        sensor: usize,
        /// Valid from now on.
        valid: bool,
        /// Its status word, if its format has one.
        status: u32,
    },
    /// A device's counter says that samples are missing.
    SamplesLost {
        /// Index of the sensor.
        sensor: usize,
        /// How many.
        count: u64,
    },
    /// A device's clock stepped (a restart, for instance) and was tied anew.
    DeviceClockStepped {
        /// Index of the sensor.
        sensor: usize,
        /// By how much against the computer's clock, s.
        by: f64,
    },
    /// Ranges of satellites that a receiver measured are used from now on, or not any more.
    Ranges {
        /// Index of the sensor.
        sensor: usize,
        /// Used from now on.
        used: bool,
    },
    /// Something is wrong with what a satellite broadcasts, by one receiver, or not any more.
    Satellite {
        /// Index of the sensor.
        sensor: usize,
        /// Which satellite.
        satellite: SatelliteId,
        /// What is wrong; `None`: nothing any more.
        fault: Option<BroadcastFault>,
    },
    /// Something about a base.
    Base {
        /// Index of the sensor.
        sensor: usize,
        /// What is news of it.
        news: BaseNews,
    },
    /// Another source is used for a quantity.
    Chosen(Chosen),
    /// Something about UTC.
    Time(TimeChange),
    /// The system clock stepped; the time line did not.
    SystemClockStepped {
        /// By how much.
        by: Span,
    },
}

/// Something that happened, and when.
#[derive(Clone, Debug, PartialEq)]
pub struct IntakeEvent {
    /// When it was noticed, on the computer's monotonic clock.
    pub time: Time,
    /// What.
    pub what: Happening,
}
