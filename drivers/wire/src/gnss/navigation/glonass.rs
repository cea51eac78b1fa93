//! Strings of GLONASS (ICD L1, L2, edition 5.1, 4.4, tables 4.5 and 4.13): 1 to 4, the immediate data.
//!
//! Positions count from bit 85, which comes first: bit n stands at 85 - n. Strings 1 to 4 end to end.

use insd_base::satellites::{GlonassRecord, SatelliteId};
use insd_base::{GpsTime, Span};

use super::super::bits::{Bits, Field};
use super::super::kepler::{SECOND, half};
use super::broadcast::WordsRefusal;
use super::checks::glonass_is_good;

/// Bits of a string.
pub(super) const SIZE: usize = 85;

/// Metres of a kilometre.
const KILO: f64 = 1e3;

/// Nanoseconds of a day.
const DAY: i64 = 86_400 * SECOND;

/// Moscow's time - UTC, ns.
const MOSCOW: i64 = 10_800 * SECOND;

/// Where a bit of a string stands, by its number in the document.
const fn bit(string: usize, number: usize) -> usize {
    (string - 1) * SIZE + 85 - number
}

const NUMBER: Field = Field::count(1, 4);
const POSITION: [Field; 3] = [
    Field::magnitude(bit(1, 35), 27, half(11) * KILO),
    Field::magnitude(bit(2, 35), 27, half(11) * KILO),
    Field::magnitude(bit(3, 35), 27, half(11) * KILO),
];
const VELOCITY: [Field; 3] = [
    Field::magnitude(bit(1, 64), 24, half(20) * KILO),
    Field::magnitude(bit(2, 64), 24, half(20) * KILO),
    Field::magnitude(bit(3, 64), 24, half(20) * KILO),
];
const ACCELERATION: [Field; 3] = [
    Field::magnitude(bit(1, 40), 5, half(30) * KILO),
    Field::magnitude(bit(2, 40), 5, half(30) * KILO),
    Field::magnitude(bit(3, 40), 5, half(30) * KILO),
];
/// B_n: its first bit alone says that the satellite is not to be used.
const HEALTH: Field = Field::count(bit(2, 80), 1);
/// l_n of string 3: the same.
const UNHEALTHY: Field = Field::count(bit(3, 65), 1);
/// t_b: reference time in Moscow's day, s.
const REFERENCE: Field = Field::unsigned(bit(2, 76), 7, 900.0);
const GAMMA: Field = Field::magnitude(bit(3, 79), 11, half(40));
const TAU: Field = Field::magnitude(bit(4, 80), 22, half(30));
const AGE: Field = Field::count(bit(4, 53), 5);

/// Number and bits of a string.
pub(super) fn string(words: &[u32]) -> Result<(u8, Bits), WordsRefusal> {
    let words: &[u32; 3] =
        words.first_chunk().ok_or(WordsRefusal::Short { needed: 3, found: words.len() })?;
    let mut all = Bits::default();
    words.iter().for_each(|word| _ = all.push(u64::from(*word), 32));
    let mut bits = Bits::default();
    bits.append(&all, 0, SIZE);
    if glonass_is_good(&bits) {
        Ok((NUMBER.raw(&bits) as u8, bits))
    } else {
        Err(WordsRefusal::Damaged)
    }
}

/// The instant nearest to another at which Moscow has a time of day.
pub(in crate::gnss) fn nearest_time_of_day(time_of_day: i64, near: GpsTime, leap: i8) -> GpsTime {
    let moscow = near.as_nanos().saturating_add(MOSCOW - i64::from(leap) * SECOND);
    let ahead = time_of_day.saturating_sub(moscow.rem_euclid(DAY)).rem_euclid(DAY);
    near.plus(Span::from_nanos(if ahead > DAY / 2 { ahead - DAY } else { ahead }))
}

/// The record of strings 1 to 4.
pub(super) fn record(
    satellite: SatelliteId,
    channel: i8,
    bits: &Bits,
    (received, leap): (GpsTime, i8),
) -> GlonassRecord {
    let vector = |fields: [Field; 3]| fields.map(|field| field.value(bits));
    let reference = REFERENCE.value(bits) as i64 * SECOND;
    GlonassRecord {
        satellite,
        channel,
        reference: nearest_time_of_day(reference, received, leap),
        position: vector(POSITION),
        velocity: vector(VELOCITY),
        acceleration: vector(ACCELERATION),
        clock_offset: -TAU.value(bits),
        clock_drift: GAMMA.value(bits),
        health: (HEALTH.raw(bits) | UNHEALTHY.raw(bits) << 1) as u8,
        age_days: AGE.value(bits),
    }
}

/// The words of the strings that say a record.
#[cfg(test)]
pub(super) fn words(record: &GlonassRecord, leap: i8) -> Vec<Vec<u32>> {
    let mut bits = Bits::zeros(4 * SIZE);
    let groups = [
        (POSITION, record.position),
        (VELOCITY, record.velocity),
        (ACCELERATION, record.acceleration),
    ];
    for (fields, values) in groups {
        fields.iter().zip(values).for_each(|(field, value)| field.put(&mut bits, value));
    }
    let moscow = record.reference.as_nanos() + MOSCOW - i64::from(leap) * SECOND;
    REFERENCE.put(&mut bits, (moscow.rem_euclid(DAY) / SECOND) as f64);
    TAU.put(&mut bits, -record.clock_offset);
    GAMMA.put(&mut bits, record.clock_drift);
    AGE.put(&mut bits, record.age_days);
    HEALTH.put_raw(&mut bits, u64::from(record.health));
    UNHEALTHY.put_raw(&mut bits, u64::from(record.health) >> 1);
    let string = |number: usize| {
        let mut own = Bits::default();
        own.append(&bits, number * SIZE, SIZE);
        NUMBER.put_raw(&mut own, number as u64 + 1);
        super::checks::glonass_guard(&mut own);
        own.push(0, 11);
        (0..3).map(|word| own.get(word * 32, 32) as u32).collect()
    };
    (0..4).map(string).collect()
}
