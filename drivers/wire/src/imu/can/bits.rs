//! Whole numbers of any width at any bit of a frame.

use super::layout::{ByteOrder, Field};

/// The number that stands at a field, as its bits; `None` if the frame is too short.
pub(super) fn get(data: &[u8], field: &Field) -> Option<u64> {
    let mut value = 0_u64;
    for index in 0..field.width {
        let (byte, bit) = place(field, index);
        let own = u64::from(data.get(byte)? >> bit & 1);
        value |= own << index;
    }
    Some(value)
}

/// Enters the lowest bits of a number at a field; bits beyond the frame or the number are left out.
pub(super) fn put(data: &mut [u8], field: &Field, value: u64) {
    for index in 0..field.width.min(64) {
        let (byte, bit) = place(field, index);
        if let Some(own) = data.get_mut(byte) {
            *own = *own & !(1 << bit) | ((value >> index & 1) as u8) << bit;
        }
    }
}

/// The number as a signed one, if the field is signed.
pub(super) fn signed(value: u64, field: &Field) -> f64 {
    let unused = 64_u32.saturating_sub(field.width.into()).min(63);
    if field.signed { ((value << unused) as i64 >> unused) as f64 } else { value as f64 }
}

/// The bits of the nearest number that the field can hold; zero for what is no number.
pub(super) fn saturated(value: f64, field: &Field) -> u64 {
    let width = u32::from(field.width.clamp(1, 64));
    let mask = u64::MAX >> (64 - width);
    if field.signed {
        let most = (mask >> 1) as i64;
        let own = (value.round() as i64).clamp(-most - 1, most);
        own as u64 & mask
    } else {
        (value.round() as u64).min(mask)
    }
}

/// Byte and bit, counted from its lowest, of a bit of the number, counted from its lowest.
fn place(field: &Field, index: u8) -> (usize, u32) {
    let (start, index) = (u32::from(field.start), u32::from(index));
    match field.order {
        ByteOrder::Little => {
            let at = start + index;
            (at as usize / 8, at % 8)
        }
        ByteOrder::Big => {
            let at = (start + u32::from(field.width)).saturating_sub(1 + index);
            (at as usize / 8, 7 - at % 8)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::What;
    use super::*;
    use proptest::prelude::*;

    fn field(start: u8, width: u8, order: ByteOrder, signed: bool) -> Field {
        Field { start, width, order, signed, ..Field::new(What::Counter, start, width) }
    }

    #[test]
    fn both_orders_of_bytes_read_what_they_say() {
        let data = [0x12, 0x34, 0xF0, 0x00];
        assert_eq!(get(&data, &field(0, 16, ByteOrder::Little, false)), Some(0x3412));
        assert_eq!(get(&data, &field(0, 16, ByteOrder::Big, false)), Some(0x1234));
        assert_eq!(get(&data, &field(4, 12, ByteOrder::Little, false)), Some(0x341));
        assert_eq!(get(&data, &field(4, 12, ByteOrder::Big, false)), Some(0x234));
        assert_eq!(get(&data, &field(24, 16, ByteOrder::Little, false)), None);
    }

    #[test]
    fn the_highest_bit_of_a_signed_number_is_its_sign() {
        let signed_12 = field(0, 12, ByteOrder::Little, true);
        for (bits, value) in [(0xFFF, -1.0), (0x800, -2048.0), (0x7FF, 2047.0)] {
            assert_eq!(signed(bits, &signed_12), value);
        }
        assert_eq!(signed(u64::MAX, &field(0, 64, ByteOrder::Big, true)), -1.0);
    }

    #[test]
    fn what_does_not_fit_is_saturated_and_what_is_no_number_is_zero() {
        let signed_16 = field(0, 16, ByteOrder::Little, true);
        let values = [1e9, -1e9, f64::NAN, -2.6].map(|value| saturated(value, &signed_16));
        assert_eq!(values, [0x7FFF, 0x8000, 0, 0xFFFD]);
        let unsigned_8 = field(0, 8, ByteOrder::Little, false);
        assert_eq!([300.0, -5.0].map(|value| saturated(value, &unsigned_8)), [255, 0]);
    }

    proptest! {
        #[test]
        fn a_number_comes_back_and_its_neighbours_stay(
            start in 0_u8..64,
            width in 1_u8..=64,
            big: bool,
            value: u64,
            before: [u8; 8],
        ) {
            prop_assume!(start + width <= 64);
            let order = if big { ByteOrder::Big } else { ByteOrder::Little };
            let own = field(start, width, order, false);
            let kept = value & (u64::MAX >> (64 - u32::from(width)));
            let mut data = before;
            put(&mut data, &own, value);
            prop_assert_eq!(get(&data, &own), Some(kept));
            put(&mut data, &own, get(&before, &own).unwrap());
            prop_assert_eq!(data, before);
        }
    }
}
