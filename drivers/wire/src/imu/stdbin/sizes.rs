//! Which blocks there are, how long each is, and how to cut them out of a telegram.

use crate::binary::{BinaryFault, Reader};

/// Bytes of the block of each bit of a mask; 0 where no block is known.
pub(super) type Sizes = [u8; 32];

/// The blocks of one mask, by bit.
pub(super) type Blocks<'a> = [Option<&'a [u8]>; 32];

/// Navigation mask: attitude, its deviation, heave, smart heave, attitude rates, rotation rates,
/// accelerations, position, its deviation, speed NEU, its deviation, current, its deviation, date,
/// sensor status, algorithm, system and user status of the INS, the same of the AHRS, speeds of
/// heave, surge and sway, speed of the vessel, acceleration NEU, course, temperatures, quaternion, its
/// deviation, raw accelerations, deviation of accelerations, of rotation rates.
pub(super) const NAVIGATION: Sizes = [
    12, 12, 16, 8, 12, 12, 12, 21, // bits 0 to 7
    16, 12, 12, 8, 8, 4, 8, 16, // 8 to 15
    12, 4, 4, 12, 4, 12, 12, 12, // 16 to 23
    8, 12, 16, 12, 12, 12, 12, 0, // 24 to 31
];

/// Extended navigation mask: rotation acceleration, its deviation, raw rotation rates, attitude of the
/// vehicle, its deviation, position of the vehicle, its deviation.
pub(super) const EXTENDED: Sizes = {
    let mut sizes = [0; 32];
    (sizes[0], sizes[1], sizes[2], sizes[3]) = (12, 12, 12, 12);
    (sizes[4], sizes[5], sizes[6]) = (12, 21, 16);
    sizes
};

/// External mask: UTC, GNSS 1, 2 and manual, EM log 1 and 2, USBL 1 to 3, depth, DVL over ground and
/// through water, sound velocity, DMI, LBL 1 to 4, event markers A to C, second DVL over ground and
/// through water, (none), turret angles, VTG 1 and 2, log book.
pub(super) const EXTERNAL: Sizes = [
    5, 46, 46, 46, 13, 13, 49, 49, // bits 0 to 7
    49, 12, 37, 33, 8, 8, 41, 41, // 8 to 15
    41, 41, 9, 9, 9, 37, 33, 0, // 16 to 23
    16, 17, 17, 12, 0, 0, 0, 0, // 24 to 31
];

/// Cuts the blocks of a mask. A bit without a known block ends the search, as its size is not known;
/// the answer says whether that happened.
pub(super) fn cut<'a>(
    mask: u32,
    sizes: &Sizes,
    reader: &mut Reader<'a>,
) -> Result<(Blocks<'a>, bool), BinaryFault> {
    let mut blocks = [None; 32];
    for (bit, (block, size)) in blocks.iter_mut().zip(sizes).enumerate() {
        if mask >> bit & 1 == 0 {
            continue;
        }
        if *size == 0 {
            return Ok((blocks, false));
        }
        *block = Some(reader.take(usize::from(*size))?);
    }
    Ok((blocks, true))
}

/// The numbers of a block of floats, each multiplied by its unit; nothing if one is not finite.
pub(super) fn floats<const N: usize>(block: Option<&[u8]>, units: [f64; N]) -> Option<[f64; N]> {
    let mut reader = Reader::new(block?);
    let mut values = units;
    for value in &mut values {
        *value *= f64::from(reader.be_f32().ok()?);
    }
    values.iter().all(|value| value.is_finite()).then_some(values)
}

/// The whole numbers of a block of words.
pub(super) fn words<const N: usize>(block: Option<&[u8]>) -> Option<[u32; N]> {
    let mut reader = Reader::new(block?);
    let mut words = [0; N];
    for word in &mut words {
        *word = reader.be_u32().ok()?;
    }
    Some(words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_known_blocks_fit_into_the_longest_telegram() {
        let sizes = [NAVIGATION, EXTENDED, EXTERNAL];
        let total: usize = sizes.iter().flatten().map(|size| usize::from(*size)).sum();
        assert!(total + 31 < super::super::LONGEST, "{total}");
    }
}
