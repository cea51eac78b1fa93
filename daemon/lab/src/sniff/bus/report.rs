//! What was found on a CAN bus, as plain data.

use serde::Serialize;

use crate::sniff::tally::Counted;

/// What was found on the bus of one port.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BusReport {
    /// Frames that came.
    pub frames: u64,
    /// Frames per second.
    pub frames_per_s: Option<f64>,
    /// Share of what 250 kbit/s can carry, with the mean number of stuffed bits, 0 to 1.
    pub load: Option<f64>,
    /// Messages of several frames of which one was missing.
    pub broken: u64,
    /// What the controller said of its bus.
    pub events: Vec<Counted>,
    /// Devices of NMEA 2000 by their addresses.
    pub devices: Vec<DeviceReport>,
    /// Frames that are not NMEA 2000, by their identifiers.
    pub others: Vec<IdReport>,
    /// Frames and messages of further devices, kinds and identifiers, that are not told apart.
    pub more: u64,
}

/// One device of NMEA 2000. What it has not said is `None`; most devices say who they are only when
/// they are asked.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeviceReport {
    /// Its address.
    pub address: u8,
    /// Its NAME, 16 hexadecimal digits.
    pub name: Option<String>,
    /// Who made it: a name, or the code in its NAME.
    pub manufacturer: Option<String>,
    /// What it is: its function, else its class.
    pub function: Option<String>,
    /// Number of the device among its like.
    pub instance: Option<u8>,
    /// Model, as the device says.
    pub model: Option<String>,
    /// Version of its software.
    pub software: Option<String>,
    /// Its serial number.
    pub serial: Option<String>,
    /// Addresses that it had before this one.
    pub addresses_before: Vec<u8>,
    /// What it sends.
    pub groups: Vec<GroupReport>,
}

/// Messages of one parameter group from one device.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GroupReport {
    /// Number of the group.
    pub pgn: u32,
    /// Its name, if it is a common one.
    pub title: Option<&'static str>,
    /// How many came.
    pub count: u64,
    /// Messages per second.
    pub rate_hz: Option<f64>,
    /// Standard deviation of the intervals between arrivals, ms.
    pub jitter_ms: Option<f64>,
    /// Time since the last, s.
    pub age_s: Option<f64>,
    /// Whether insd can use it.
    pub used: bool,
    /// Of these, too short to be read.
    pub refused: u64,
}

/// Frames of one identifier.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct IdReport {
    /// The identifier, hexadecimal: 3 digits for one of 11 bits, 8 for one of 29.
    pub id: String,
    /// How many came.
    pub count: u64,
    /// Frames per second.
    pub rate_hz: Option<f64>,
    /// Standard deviation of the intervals between arrivals, ms.
    pub jitter_ms: Option<f64>,
    /// Data of the last one, hexadecimal.
    pub last: String,
}
