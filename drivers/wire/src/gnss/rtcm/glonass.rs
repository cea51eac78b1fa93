//! 1020: a record of GLONASS.
//!
//! Layout: RTCM 10403.3, the contents of 1020 (DF038, DF040, DF104 to DF136); numbers with a sign have it in their first bit.

use insd_base::GpsTime;
use insd_base::satellites::{Constellation, GlonassRecord, SatelliteId};

use super::super::bits::{Bits, Field};
use super::super::kepler::half;
use super::super::state::{StateLayout, vector};
use super::NUMBER as OF_MESSAGE;
use crate::binary::BinaryFault;

/// Number of the message.
pub(super) const NUMBER: u16 = 1020;

/// Bits up to DF126, the last that is read, and of the whole message.
const LENGTH: usize = 263;
const WHOLE: usize = 360;

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
pub(super) fn read(bits: &Bits, received: GpsTime, leap: i8) -> Result<GlonassRecord, BinaryFault> {
    if bits.len() < LENGTH {
        return Err(BinaryFault::Short { needed: LENGTH.div_ceil(8), found: bits.len() / 8 });
    }
    let satellite = SatelliteId::new(Constellation::Glonass, SATELLITE.raw(bits) as u8)
        .ok_or(BinaryFault::Range { field: "DF038" })?;
    let channel = channel(CHANNEL.raw(bits)).ok_or(BinaryFault::Range { field: "DF040" })?;
    Ok(LAYOUT.record(satellite, channel, bits, (received, leap)))
}

/// The message of a record, without what is not read, with the leap seconds that hold.
pub(super) fn write(record: &GlonassRecord, leap: i8) -> Bits {
    let mut bits = Bits::zeros(WHOLE);
    OF_MESSAGE.put_raw(&mut bits, NUMBER.into());
    SATELLITE.put_raw(&mut bits, record.satellite.number.into());
    CHANNEL.put(&mut bits, f64::from(record.channel) + 7.0);
    LAYOUT.put(&mut bits, record, leap);
    bits
}

/// A frequency channel, -7 to 6, that stands 7 higher.
pub(super) fn channel(raw: u64) -> Option<i8> {
    (raw <= 13).then_some(raw as i8 - 7)
}
