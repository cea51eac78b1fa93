//! Parities of words.

use super::super::bits::Bits;
use super::broadcast::WordsRefusal;

/// The data bits of which each of the six parity bits of GPS is the sum, d1 first, and whether it begins with D30* of the word
/// before or with D29* (IS-GPS-200N, table 20-XIV).
const GPS: [(u32, bool); 6] = [
    (mask(&[1, 2, 3, 5, 6, 10, 11, 12, 13, 14, 17, 18, 20, 23]), false),
    (mask(&[2, 3, 4, 6, 7, 11, 12, 13, 14, 15, 18, 19, 21, 24]), true),
    (mask(&[1, 3, 4, 5, 7, 8, 12, 13, 14, 15, 16, 19, 20, 22]), false),
    (mask(&[2, 4, 5, 6, 8, 9, 13, 14, 15, 16, 17, 20, 21, 23]), true),
    (mask(&[1, 3, 5, 6, 7, 9, 10, 14, 15, 16, 17, 18, 21, 22, 24]), true),
    (mask(&[3, 5, 6, 8, 9, 10, 11, 13, 15, 19, 22, 23, 24]), false),
];

/// Generator of BCH(15,11,1), x^4 + x + 1 (BDS-SIS-ICD-B1I 3.0, 5.1).
const BCH: u32 = 0b1_0011;

const fn mask(numbers: &[u32]) -> u32 {
    let (mut mask, mut at) = (0, 0);
    while at < numbers.len() {
        mask |= 1 << (24 - numbers[at]);
        at += 1;
    }
    mask
}

/// The six parity bits of 24 data bits behind a word that ended with two bits.
pub(super) fn gps_parity(data: u32, before: u32) -> u32 {
    GPS.iter().fold(0, |parity, (mask, last)| {
        let begin = if *last { before & 1 } else { before >> 1 & 1 };
        parity << 1 | (((data & mask).count_ones() + begin) & 1)
    })
}

/// The four parity bits of eleven.
pub(super) fn bch_parity(data: u32) -> u32 {
    let mut rest = data << 4;
    for shift in (0..11).rev() {
        if rest >> (shift + 4) & 1 == 1 {
            rest ^= BCH << shift;
        }
    }
    rest
}

/// Ten words of a subframe.
pub(super) fn ten(words: &[u32]) -> Result<&[u32; 10], WordsRefusal> {
    words.first_chunk().ok_or(WordsRefusal::Short { needed: 10, found: words.len() })
}

/// The 240 data bits of a subframe of GPS; before its first word stand two zeros, as the last word of every subframe ends.
///
/// Behind a word that ends with a one the encoder turns the data bits of the next one round. Receivers turn them back; u-blox
/// turns the parity bits round along with them, so that both forms of these are taken.
pub(super) fn gps_data(words: &[u32]) -> Result<Bits, WordsRefusal> {
    let (mut bits, mut before) = (Bits::default(), 0);
    for word in ten(words)? {
        let data = word >> 6 & 0xFF_FFFF;
        let parity = gps_parity(data, before);
        let turned = before & 1 == 1 && parity ^ 63 == word & 63;
        if parity != word & 63 && !turned {
            return Err(WordsRefusal::Damaged);
        }
        bits.push(data.into(), 24);
        before = parity & 3;
    }
    Ok(bits)
}

/// The words of 240 data bits of GPS.
pub(super) fn gps_words(bits: &Bits) -> Vec<u32> {
    let mut before = 0;
    let word = |number: usize| {
        let data = bits.get(number * 24, 24) as u32;
        before = gps_parity(data, before);
        data << 6 | before
    };
    (0..10).map(word).collect()
}

/// The 224 data bits of a subframe of BeiDou: in the first word the last eleven of 26 are guarded, in the others 22 by two codes.
pub(super) fn beidou_data(words: &[u32]) -> Result<Bits, WordsRefusal> {
    let [first, others @ ..] = ten(words)?;
    let mut bits = Bits::default();
    bits.push(u64::from(first >> 4), 26);
    let mut good = bch_parity(first >> 4 & 0x7FF) == first & 15;
    for word in others {
        let data = word >> 8 & 0x3F_FFFF;
        good &= beidou_parity(data) == word & 0xFF;
        bits.push(data.into(), 22);
    }
    if good { Ok(bits) } else { Err(WordsRefusal::Damaged) }
}

/// The eight parity bits of 22: those of the first eleven, then those of the others.
pub(super) fn beidou_parity(data: u32) -> u32 {
    bch_parity(data >> 11) << 4 | bch_parity(data & 0x7FF)
}

/// The words of 224 data bits of BeiDou.
#[cfg(test)]
pub(super) fn beidou_words(bits: &Bits) -> Vec<u32> {
    let first = bits.get(0, 26) as u32;
    let first = first << 4 | bch_parity(first & 0x7FF);
    let others = (0..9).map(|number| bits.get(26 + 22 * number, 22) as u32);
    std::iter::once(first).chain(others.map(|data| data << 8 | beidou_parity(data))).collect()
}

/// Whether the 85 bits of a string of GLONASS agree with its eight parity bits, a Hamming code with a sum over all
/// (GLONASS ICD L1, L2, 5.1, table 4.13). Bit 85 comes first.
pub(super) fn glonass_is_good(bits: &Bits) -> bool {
    hamming(bits) == 0 && (0..85).map(|at| bits.get(at, 1)).sum::<u64>() % 2 == 0
}

/// The sum of the places of all ones in the Hamming code: powers of two are those of parity bits 1 to 7, all others those of
/// bits 9 to 85.
pub(super) fn hamming(bits: &Bits) -> u64 {
    let data = (3_u64..).filter(|place| !place.is_power_of_two()).zip(9..=85);
    let parity = (0..7).map(|power| 1_u64 << power).zip(1..=7);
    let ones = data.chain(parity).filter(|(_, bit)| bits.get(85 - *bit, 1) == 1);
    ones.fold(0, |sum, (place, _)| sum ^ place)
}

/// Writes the parity bits of a string whose bits 1 to 8 are zero.
#[cfg(test)]
pub(super) fn glonass_guard(bits: &mut Bits) {
    use super::super::bits::Field;
    let sum = hamming(bits);
    for power in 0..7 {
        Field::count(84 - power, 1).put_raw(bits, sum >> power & 1);
    }
    let ones = (0..85).map(|at| bits.get(at, 1)).sum::<u64>();
    Field::count(77, 1).put_raw(bits, ones & 1);
}
