//! Fields that stand between bits: where each is, how it is signed, what one step of it is.
//!
//! Navigation messages and RTCM are read and written by the same [`Field`]. Nothing here panics: bits beyond the end are zero
//! when read and are not written.

/// How a number says that it is negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sign {
    /// It never is.
    None,
    /// Two's complement.
    Complement,
    /// Its first bit (GLONASS).
    Magnitude,
}

/// A number between bits: up to two pieces, the more significant one first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field {
    pieces: [(usize, usize); 2],
    sign: Sign,
    unit: f64,
}

impl Field {
    const fn new(at: usize, length: usize, sign: Sign, unit: f64) -> Self {
        Field { pieces: [(0, 0), (at, length)], sign, unit }
    }

    /// A number that is never negative, in steps of a unit.
    pub(super) const fn unsigned(at: usize, length: usize, unit: f64) -> Self {
        Self::new(at, length, Sign::None, unit)
    }

    /// A number in two's complement.
    pub(super) const fn signed(at: usize, length: usize, unit: f64) -> Self {
        Self::new(at, length, Sign::Complement, unit)
    }

    /// A number whose first bit is its sign.
    pub(super) const fn magnitude(at: usize, length: usize, unit: f64) -> Self {
        Self::new(at, length, Sign::Magnitude, unit)
    }

    /// A count or a flag word.
    pub(super) const fn count(at: usize, length: usize) -> Self {
        Self::unsigned(at, length, 1.0)
    }

    /// The same with more significant bits that stand elsewhere.
    pub(super) const fn behind(self, at: usize, length: usize) -> Self {
        Field { pieces: [(at, length), self.pieces[1]], ..self }
    }

    fn length(&self) -> usize {
        self.pieces.iter().map(|(_, length)| length).sum()
    }

    /// Its bits as they stand.
    pub(super) fn raw(&self, bits: &Bits) -> u64 {
        self.pieces.iter().fold(0, |value, (at, length)| value << length | bits.get(*at, *length))
    }

    /// Its bits as a whole number with its sign.
    pub(super) fn whole(&self, bits: &Bits) -> i64 {
        let (raw, length) = (self.raw(bits), self.length());
        match self.sign {
            Sign::None => raw as i64,
            Sign::Complement => extended(raw, length),
            Sign::Magnitude => {
                let sign = 1_u64 << length.saturating_sub(1);
                let value = (raw & (sign - 1)) as i64;
                if raw & sign == 0 { value } else { -value }
            }
        }
    }

    /// Its value.
    pub(super) fn value(&self, bits: &Bits) -> f64 {
        self.whole(bits) as f64 * self.unit
    }

    /// Writes the nearest step to a value; what is out of range is cut off.
    pub(super) fn put(&self, bits: &mut Bits, value: f64) {
        let steps = (value / self.unit).round() as i64;
        let sign =
            if self.sign == Sign::Magnitude && steps < 0 { 1 << (self.length() - 1) } else { 0 };
        let steps = if self.sign == Sign::Magnitude { steps.abs() } else { steps };
        self.put_raw(bits, steps as u64 | sign);
    }

    /// Writes its bits as they are.
    pub(super) fn put_raw(&self, bits: &mut Bits, mut raw: u64) {
        for (at, length) in self.pieces.into_iter().rev() {
            bits.set(at, length, raw);
            raw = raw.checked_shr(length as u32).unwrap_or(0);
        }
    }
}

/// A number of some bits in two's complement.
pub(super) fn extended(raw: u64, length: usize) -> i64 {
    let unused = 64_usize.saturating_sub(length).min(63);
    ((raw << unused) as i64) >> unused
}

/// A row of bits, the first of them the most significant of the first byte.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Bits {
    bytes: Vec<u8>,
    length: usize,
}

impl Bits {
    /// All bits of some bytes.
    pub(super) fn of(bytes: &[u8]) -> Self {
        Bits { bytes: bytes.to_vec(), length: bytes.len() * 8 }
    }

    /// So many bits, all zero.
    pub(super) fn zeros(length: usize) -> Self {
        Bits { bytes: vec![0; length.div_ceil(8)], length }
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.length
    }

    fn bit(&self, at: usize) -> u64 {
        let byte = self.bytes.get(at / 8).copied().unwrap_or(0);
        u64::from(byte >> (7 - at % 8) & 1)
    }

    /// Up to 64 bits as a number.
    pub(super) fn get(&self, at: usize, length: usize) -> u64 {
        (at..at.saturating_add(length)).fold(0, |value, at| value << 1 | self.bit(at))
    }

    /// Appends the last bits of a number.
    pub(super) fn push(&mut self, value: u64, length: usize) -> &mut Self {
        for shift in (0..length).rev() {
            if self.length.is_multiple_of(8) {
                self.bytes.push(0);
            }
            let bit = (value.checked_shr(shift as u32).unwrap_or(0) & 1) as u8;
            if let Some(last) = self.bytes.last_mut() {
                *last |= bit << (7 - self.length % 8);
            }
            self.length += 1;
        }
        self
    }

    /// Appends bits of another row.
    pub(super) fn append(&mut self, other: &Bits, at: usize, length: usize) -> &mut Self {
        for at in at..at + length {
            self.push(other.bit(at), 1);
        }
        self
    }

    /// Their bytes, filled up with zeros.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    fn set(&mut self, at: usize, length: usize, value: u64) {
        for (place, shift) in (at..at + length).zip((0..length).rev()) {
            let mask = 1 << (7 - place % 8);
            let byte = &mut self.bytes[place / 8];
            *byte = if value >> shift & 1 == 1 { *byte | mask } else { *byte & !mask };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_in_two_pieces_comes_back_with_its_sign() {
        let fields = [
            Field::signed(13, 9, 0.5).behind(3, 5),
            Field::magnitude(30, 12, 0.25),
            Field::signed(64, 32, 1.0),
        ];
        for value in [-100.0, -0.5, 0.0, 1.0, 300.0] {
            let mut bits = Bits::zeros(96);
            fields.iter().for_each(|field| field.put(&mut bits, value));
            for field in fields {
                assert_eq!(field.value(&bits), (value / field.unit).round() * field.unit);
            }
        }
    }

    #[test]
    fn bits_beyond_the_end_are_zero() {
        let bits = Bits::of(&[0xFF]);
        assert_eq!(bits.get(4, 8), 0xF0);
        assert_eq!(Field::signed(60, 32, 1.0).value(&bits), 0.0);
    }

    #[test]
    fn what_is_pushed_stands_behind_what_was_there() {
        let mut bits = Bits::default();
        bits.push(0b101, 3).push(0x3FF, 10).append(&Bits::of(&[0x0F]), 2, 4);
        assert_eq!(bits.len(), 17);
        assert_eq!(bits.get(0, 17), 0b1_0111_1111_1111_0011);
    }
}
