//! Strings of GLONASS (ICD L1, L2, edition 5.1, 4.4, tables 4.5 and 4.13): 1 to 4, the immediate data.
//!
//! Positions count from bit 85, which comes first: bit n stands at 85 - n. Strings 1 to 4 end to end.

use insd_base::GpsTime;
use insd_base::satellites::{GlonassRecord, SatelliteId};

use super::super::bits::{Bits, Field};
use super::super::kepler::half;
use super::super::state::{StateLayout, vector};
use super::broadcast::WordsRefusal;
use super::checks::glonass_is_good;

/// Bits of a string.
pub(super) const SIZE: usize = 85;

/// Where a bit of a string stands, by its number in the document.
const fn bit(string: usize, number: usize) -> usize {
    (string - 1) * SIZE + 85 - number
}

const NUMBER: Field = Field::count(1, 4);
const LAYOUT: StateLayout = StateLayout {
    position: vector([bit(1, 35), bit(2, 35), bit(3, 35)], 27, 11),
    velocity: vector([bit(1, 64), bit(2, 64), bit(3, 64)], 24, 20),
    acceleration: vector([bit(1, 40), bit(2, 40), bit(3, 40)], 5, 30),
    health: Field::count(bit(2, 80), 1),
    unhealthy: Field::count(bit(3, 65), 1),
    reference: Field::unsigned(bit(2, 76), 7, 900.0),
    gamma: Field::magnitude(bit(3, 79), 11, half(40)),
    tau: Field::magnitude(bit(4, 80), 22, half(30)),
    age: Field::count(bit(4, 53), 5),
};

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

/// The record of strings 1 to 4.
pub(super) fn record(
    satellite: SatelliteId,
    channel: i8,
    bits: &Bits,
    at: (GpsTime, i8),
) -> GlonassRecord {
    LAYOUT.record(satellite, channel, bits, at)
}

/// The words of the strings that say a record.
#[cfg(test)]
pub(super) fn words(record: &GlonassRecord, leap: i8) -> Vec<Vec<u32>> {
    let mut bits = Bits::zeros(4 * SIZE);
    LAYOUT.put(&mut bits, record, leap);
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
