//! 1020: a record of GLONASS.
//!
//! Layout: RTCM 10403.3, the contents of 1020 (DF038, DF040, DF104 to DF136); numbers with a sign have it in their first bit.

use insd_base::GpsTime;
use insd_base::satellites::{Constellation, GlonassRecord, SatelliteId};

use super::super::bits::{Bits, Field};
use super::super::kepler::half;
use super::super::state::{StateLayout, vector};
use crate::binary::Fault;

/// Number of the message.
pub(super) const NUMBER: u16 = 1020;

/// Bits up to DF126, the last that is read.
const LENGTH: usize = 263;

const SATELLITE: Field = Field::count(12, 6);
/// Channel + 7.
const CHANNEL: Field = Field::count(18, 5);
const LAYOUT: StateLayout = StateLayout {
    position: vector([72, 128, 184], 27, 11),
    velocity: vector([48, 104, 160], 24, 20),
    acceleration: vector([99, 155, 211], 5, 30),
    health: Field::count(39, 1),
    unhealthy: Field::count(230, 1),
    reference: Field::unsigned(41, 7, 900.0),
    gamma: Field::magnitude(217, 11, half(40)),
    tau: Field::magnitude(231, 22, half(30)),
    age: Field::count(258, 5),
};

/// Reads the message, with the leap seconds that hold.
pub(super) fn read(bits: &Bits, received: GpsTime, leap: i8) -> Result<GlonassRecord, Fault> {
    if bits.len() < LENGTH {
        return Err(Fault::Short { needed: LENGTH.div_ceil(8), found: bits.len() / 8 });
    }
    let satellite = SatelliteId::new(Constellation::Glonass, SATELLITE.raw(bits) as u8)
        .ok_or(Fault::Range { field: "DF038" })?;
    let channel = channel(CHANNEL.raw(bits)).ok_or(Fault::Range { field: "DF040" })?;
    Ok(LAYOUT.record(satellite, channel, bits, (received, leap)))
}

/// A frequency channel, -7 to 6, that stands 7 higher.
pub(super) fn channel(raw: u64) -> Option<i8> {
    (raw <= 13).then_some(raw as i8 - 7)
}
