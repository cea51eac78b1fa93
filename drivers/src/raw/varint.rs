//! Whole numbers in as few bytes as they need: seven bits in each byte, the lowest first, the top bit
//! set on all but the last (LEB128). Signed numbers are folded first: 0, -1, 1, -2, ... become
//! 0, 1, 2, 3, ...

/// Appends a number.
pub(crate) fn put(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

/// Appends a signed number.
pub(crate) fn put_signed(bytes: &mut Vec<u8>, value: i64) {
    put(bytes, ((value << 1) ^ (value >> 63)) as u64);
}

/// Takes a number off the front; `None` if the bytes end within it or it has more than 64 bits.
pub(crate) fn take(bytes: &mut &[u8]) -> Option<u64> {
    let mut value = 0;
    for shift in (0..64).step_by(7) {
        let (byte, rest) = bytes.split_first()?;
        *bytes = rest;
        let bits = u64::from(byte & 0x7F);
        if bits << shift >> shift != bits {
            return None;
        }
        value |= bits << shift;
        if *byte < 0x80 {
            return Some(value);
        }
    }
    None
}

/// Takes a signed number off the front.
pub(crate) fn take_signed(bytes: &mut &[u8]) -> Option<i64> {
    let folded = take(bytes)?;
    Some((folded >> 1) as i64 ^ -((folded & 1) as i64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_all_sizes_come_back_and_small_ones_take_a_byte() {
        for shift in 0..64 {
            for value in [1_u64 << shift, (1 << shift) - 1, u64::MAX >> shift] {
                for signed in [value as i64, (value as i64).wrapping_neg()] {
                    let mut bytes = Vec::new();
                    put(&mut bytes, value);
                    put_signed(&mut bytes, signed);
                    let mut rest = bytes.as_slice();
                    assert_eq!(take(&mut rest), Some(value));
                    assert_eq!(take_signed(&mut rest), Some(signed));
                    assert!(rest.is_empty());
                }
            }
        }
        let mut bytes = Vec::new();
        put(&mut bytes, 127);
        put_signed(&mut bytes, -64);
        assert_eq!(bytes, [127, 127]);
    }

    #[test]
    fn numbers_that_end_early_or_are_too_long_are_refused() {
        assert_eq!(take(&mut [].as_slice()), None);
        assert_eq!(take(&mut [0x80].as_slice()), None);
        assert_eq!(take(&mut [0xFF; 11].as_slice()), None);
        let mut too_great = [0xFF; 10];
        too_great[9] = 2;
        assert_eq!(take(&mut too_great.as_slice()), None);
    }
}
