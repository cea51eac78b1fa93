//! 1020: a record of GLONASS.
//!
//! Layout: RTCM 10403.3, the contents of 1020 (DF038, DF040, DF104 to DF136); numbers with a sign have it in their first bit.

use insd_base::GpsTime;
use insd_base::satellites::{Constellation, GlonassRecord, SatelliteId};

use super::super::bits::{Bits, Field};
use super::super::kepler::{SECOND, half};
use super::super::navigation::nearest_time_of_day;
use crate::binary::Fault;

/// Number of the message.
pub(super) const NUMBER: u16 = 1020;

/// Bits up to DF126, the last that is read.
const LENGTH: usize = 263;

/// Metres of a kilometre.
const KILO: f64 = 1e3;

const SATELLITE: Field = Field::count(12, 6);
/// Channel + 7.
const CHANNEL: Field = Field::count(18, 5);
/// The first bit of B_n.
const HEALTH: Field = Field::count(39, 1);
/// t_b in Moscow's day, s.
const REFERENCE: Field = Field::unsigned(41, 7, 900.0);
const VELOCITY: [Field; 3] = [
    Field::magnitude(48, 24, half(20) * KILO),
    Field::magnitude(104, 24, half(20) * KILO),
    Field::magnitude(160, 24, half(20) * KILO),
];
const POSITION: [Field; 3] = [
    Field::magnitude(72, 27, half(11) * KILO),
    Field::magnitude(128, 27, half(11) * KILO),
    Field::magnitude(184, 27, half(11) * KILO),
];
const ACCELERATION: [Field; 3] = [
    Field::magnitude(99, 5, half(30) * KILO),
    Field::magnitude(155, 5, half(30) * KILO),
    Field::magnitude(211, 5, half(30) * KILO),
];
const GAMMA: Field = Field::magnitude(217, 11, half(40));
/// l_n.
const UNHEALTHY: Field = Field::count(230, 1);
const TAU: Field = Field::magnitude(231, 22, half(30));
const AGE: Field = Field::count(258, 5);

/// Reads the message, with the leap seconds that hold.
pub(super) fn read(bits: &Bits, received: GpsTime, leap: i8) -> Result<GlonassRecord, Fault> {
    if bits.len() < LENGTH {
        return Err(Fault::Short { needed: LENGTH.div_ceil(8), found: bits.len() / 8 });
    }
    let vector = |fields: [Field; 3]| fields.map(|field| field.value(bits));
    let reference = REFERENCE.value(bits) as i64 * SECOND;
    Ok(GlonassRecord {
        satellite: SatelliteId::new(Constellation::Glonass, SATELLITE.raw(bits) as u8)
            .ok_or(Fault::Range { field: "DF038" })?,
        channel: channel(CHANNEL.raw(bits)).ok_or(Fault::Range { field: "DF040" })?,
        reference: nearest_time_of_day(reference, received, leap),
        position: vector(POSITION),
        velocity: vector(VELOCITY),
        acceleration: vector(ACCELERATION),
        clock_offset: -TAU.value(bits),
        clock_drift: GAMMA.value(bits),
        health: (HEALTH.raw(bits) | UNHEALTHY.raw(bits) << 1) as u8,
        age_days: AGE.value(bits),
    })
}

/// A frequency channel, -7 to 6, that stands 7 higher.
pub(super) fn channel(raw: u64) -> Option<i8> {
    (raw <= 13).then_some(raw as i8 - 7)
}
