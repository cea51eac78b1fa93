//! Fields of bits: least significant bit first, least significant byte first.
//!
//! The largest numbers of a field are not data. All ones (of a signed field the largest positive
//! number) says "not available", the one below "error", the next "reserved": three numbers in fields
//! of 8 bits and more, two in fields of 4 to 7, one in fields of 2 and 3 (canboat.json 8; "NMEA 2000
//! Explained", F. Cassidy). All of them read as `None`, as does a field that lies wholly or partly
//! behind the end of the contents.

use std::f64::consts::PI;

use insd_base::units::wrap_two_pi;

use super::Short;

/// How a number lies in its bits, and which numbers are data.
#[derive(Clone, Copy)]
pub(super) struct Number {
    pub(super) bits: u32,
    /// Steps of one unit: whole numbers that doubles hold exactly, where a resolution like 1e-4 would
    /// not be.
    per_unit: f64,
    least: i64,
    most: i64,
    unit: &'static str,
}

impl Number {
    /// An unsigned number of fewer than 64 bits.
    pub(super) const fn unsigned(bits: u32, per_unit: f64) -> Self {
        Number { bits, per_unit, least: 0, most: largest(bits) as i64 - codes(bits), unit: "" }
    }

    /// A signed number of up to 64 bits. The most negative is not data: it has no opposite.
    pub(super) const fn signed(bits: u32, per_unit: f64) -> Self {
        let largest = largest(bits - 1) as i64;
        Number { bits, per_unit, least: -largest, most: largest - codes(bits), unit: "" }
    }

    /// The same bits, with narrower limits: whole steps.
    pub(super) const fn within(self, least: i64, most: i64) -> Self {
        Number { least, most, ..self }
    }

    /// The same in a unit with a name.
    pub(super) const fn unit(self, unit: &'static str) -> Self {
        Number { unit, ..self }
    }

    /// Its bits, its steps and its unit in words.
    pub(super) fn form(&self) -> String {
        let sign = if self.least < 0 { "i" } else { "u" };
        match (self.per_unit, self.unit) {
            (1.0, "") => format!("{sign}{}", self.bits),
            (1.0, unit) => format!("{sign}{}, {unit}", self.bits),
            (steps, "") => format!("{sign}{}, {:e}", self.bits, steps.recip()),
            (steps, unit) => format!("{sign}{}, {:e} {unit}", self.bits, steps.recip()),
        }
    }
}

/// The largest number of so many bits.
const fn largest(bits: u32) -> u64 {
    u64::MAX >> (64 - bits)
}

/// How many of the largest numbers are not data.
const fn codes(bits: u32) -> i64 {
    match bits {
        0..=1 => 0,
        2..=3 => 1,
        4..=7 => 2,
        _ => 3,
    }
}

/// Signed angle, up to half a turn to the nearest step.
pub(super) const ANGLE: Number = Number::signed(16, 1e4).within(-31_416, 31_416).unit("rad");

/// Steps of 1e-4 rad in a turn, to the nearest.
const TURN: i64 = 62_832;
/// The last step below half a turn.
const LAST_ANGLE: i64 = 31_415;
/// The number of bits of every direction, 0 to 2 pi.
pub(super) const DIRECTION: Number = Number::unsigned(16, 1e4).within(0, TURN).unit("rad");

/// Takes contents apart, field after field.
pub(super) struct Reader<'a> {
    data: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    /// From the first bit; fails if there are fewer bytes than `least`.
    pub(super) fn new(data: &'a [u8], least: usize) -> Result<Self, Short> {
        if data.len() < least {
            return Err(Short { length: data.len(), least });
        }
        Ok(Reader { data, at: 0 })
    }

    /// Steps over bits that say nothing.
    pub(super) fn skip(&mut self, bits: u32) {
        self.at += bits as usize;
    }

    /// Whether so many bits are left.
    pub(super) fn has(&self, bits: u32) -> bool {
        self.at + bits as usize <= self.data.len() * 8
    }

    /// The next bits as they stand; `None` if not all are there.
    fn raw(&mut self, bits: u32) -> Option<u64> {
        let (first, shift) = (self.at / 8, self.at % 8);
        let all_there = self.has(bits);
        self.skip(bits);
        let bytes = self.data.get(first..).filter(|_| all_there)?;
        // the nine bytes that 64 bits can touch
        let joined =
            bytes.iter().take(9).rev().fold(0_u128, |sum, byte| sum << 8 | u128::from(*byte));
        Some((joined >> shift) as u64 & largest(bits))
    }

    /// Whole steps.
    pub(super) fn steps(&mut self, field: Number) -> Option<i64> {
        let unused = 64 - field.bits;
        let raw = self.raw(field.bits)?;
        let signed = field.least < 0;
        let steps = if signed { (raw << unused) as i64 >> unused } else { raw as i64 };
        (field.least..=field.most).contains(&steps).then_some(steps)
    }

    /// A number in its unit.
    pub(super) fn number(&mut self, field: Number) -> Option<f64> {
        self.steps(field).map(|steps| steps as f64 / field.per_unit)
    }

    /// A signed angle, rad, -pi to pi; the step nearest to half a turn is above pi.
    pub(super) fn angle(&mut self) -> Option<f64> {
        self.number(ANGLE).map(|angle| angle.clamp(-PI, PI))
    }

    /// A direction, rad, 0 to 2 pi.
    pub(super) fn direction(&mut self) -> Option<f64> {
        self.number(DIRECTION).map(wrap_two_pi)
    }

    /// One of a list, by its place; a code that is data but not in the list is what `other` makes of
    /// it.
    pub(super) fn choice<T: Copy>(
        &mut self,
        bits: u32,
        list: &[T],
        other: impl FnOnce(u8) -> Option<T>,
    ) -> Option<T> {
        let code = self.raw(bits)?;
        match list.get(code as usize) {
            Some(known) => Some(*known),
            None if code as i64 > largest(bits) as i64 - codes(bits) => None,
            None => other(code as u8),
        }
    }
}

/// Puts contents together, field after field.
#[derive(Default)]
pub(super) struct Writer {
    bytes: Vec<u8>,
    at: usize,
}

impl Writer {
    /// The contents. Bits that were not written are ones.
    pub(super) fn done(self) -> Vec<u8> {
        self.bytes
    }

    /// Bits as they stand.
    fn raw(&mut self, bits: u32, value: u64) {
        for bit in 0..bits {
            let place = self.at + bit as usize;
            if place / 8 == self.bytes.len() {
                self.bytes.push(0xFF);
            }
            if value >> bit & 1 == 0
                && let Some(byte) = self.bytes.get_mut(place / 8)
            {
                *byte &= !(1 << (place % 8));
            }
        }
        self.at += bits as usize;
    }

    /// Bits that are reserved.
    pub(super) fn reserved(&mut self, bits: u32) -> &mut Self {
        self.raw(bits, u64::MAX);
        self
    }

    /// Whole steps.
    pub(super) fn steps(&mut self, field: Number, steps: Option<i64>) -> &mut Self {
        let signed = field.least < 0;
        let not_available = largest(if signed { field.bits - 1 } else { field.bits });
        let data = steps.filter(|steps| (field.least..=field.most).contains(steps));
        self.raw(field.bits, data.map_or(not_available, |steps| steps as u64));
        self
    }

    /// A number in its unit, rounded to the nearest step.
    pub(super) fn number(&mut self, field: Number, value: Option<f64>) -> &mut Self {
        self.steps(field, value.and_then(|value| nearest(value * field.per_unit)))
    }

    /// A signed angle in radians. Half a turn itself is written as the last step below: the nearest
    /// step is above the standard's limit of pi, where strict readers see no angle at all.
    pub(super) fn angle(&mut self, radians: Option<f64>) -> &mut Self {
        let within = radians.filter(|radians| radians.abs() <= PI);
        let steps = within.and_then(|radians| nearest(radians * ANGLE.per_unit));
        self.steps(ANGLE, steps.map(|steps| steps.clamp(-LAST_ANGLE, LAST_ANGLE)))
    }

    /// A direction in radians, wrapped to a full turn.
    pub(super) fn direction(&mut self, radians: Option<f64>) -> &mut Self {
        let steps = radians.and_then(|radians| nearest(wrap_two_pi(radians) * DIRECTION.per_unit));
        // the last half step before a full turn is nearer to north than to any number below it
        self.steps(DIRECTION, steps.map(|steps| steps % TURN))
    }

    /// A code of a list, or "not available".
    pub(super) fn code(&mut self, bits: u32, code: Option<u8>) -> &mut Self {
        self.steps(Number::unsigned(bits, 1.0), code.map(i64::from))
    }
}

/// The nearest whole number; too large ones become the largest, which is no data of any field.
fn nearest(value: f64) -> Option<i64> {
    value.is_finite().then(|| value.round() as i64)
}

/// The place of a value in a list.
pub(super) fn place_of<T: PartialEq>(list: &[T], value: &T) -> Option<u8> {
    list.iter().position(|known| known == value).and_then(|place| u8::try_from(place).ok())
}

#[cfg(test)]
mod tests {
    use super::super::kinds::{DILUTION, SPEED};
    use super::*;

    #[test]
    fn bits_are_counted_from_the_least_significant() {
        let mut reader = Reader::new(&[0b1010_0110, 0x12, 0x34], 3).unwrap();
        assert_eq!(reader.raw(3), Some(0b110));
        assert_eq!(reader.raw(3), Some(0b100));
        assert_eq!(reader.raw(10), Some(0x12 << 2 | 0b10));
        assert_eq!(reader.raw(12), None);
        assert_eq!(reader.raw(1), None);
        let mut writer = Writer::default();
        writer.raw(3, 0b110);
        writer.raw(3, 0b100);
        writer.raw(10, 0x12 << 2 | 0b10);
        assert_eq!(writer.done(), [0b1010_0110, 0x12]);
    }

    #[test]
    fn sixty_four_bits_may_begin_anywhere() {
        for shift in 0..8 {
            let mut writer = Writer::default();
            writer.reserved(shift).steps(Number::signed(64, 1.0), Some(-0x0123_4567_89AB_CDEF));
            let bytes = writer.done();
            let mut reader = Reader::new(&bytes, 8).unwrap();
            reader.skip(shift);
            assert_eq!(reader.steps(Number::signed(64, 1.0)), Some(-0x0123_4567_89AB_CDEF));
        }
    }

    #[test]
    fn the_largest_numbers_of_a_field_are_not_data() {
        let read = |field, bytes: &[u8]| Reader::new(bytes, 0).unwrap().steps(field);
        let short = Number::unsigned(16, 1.0);
        assert_eq!(read(short, &[0xFC, 0xFF]), Some(65_532));
        assert_eq!(read(short, &[0xFD, 0xFF]), None);
        assert_eq!(read(short, &[0xFF, 0xFF]), None);
        assert_eq!(read(short, &[0xFF]), None);
        let signed = Number::signed(16, 1.0);
        assert_eq!(read(signed, &[0xFC, 0x7F]), Some(32_764));
        assert_eq!(read(signed, &[0xFD, 0x7F]), None);
        assert_eq!(read(signed, &[0x01, 0x80]), Some(-32_767));
        assert_eq!(read(signed, &[0x00, 0x80]), None);
        assert_eq!(read(Number::unsigned(4, 1.0), &[0x0D]), Some(13));
        assert_eq!(read(Number::unsigned(4, 1.0), &[0x0E]), None);
        assert_eq!(read(Number::unsigned(3, 1.0), &[0x06]), Some(6));
        assert_eq!(read(Number::unsigned(3, 1.0), &[0x07]), None);
    }

    #[test]
    fn numbers_never_round_into_the_codes() {
        let write = |field, value| {
            let mut writer = Writer::default();
            writer.number(field, Some(value));
            writer.done()
        };
        assert_eq!(write(SPEED, 655.324), [0xFC, 0xFF]);
        assert_eq!(write(SPEED, 655.326), [0xFF, 0xFF]);
        assert_eq!(write(SPEED, -0.004), [0, 0]);
        assert_eq!(write(SPEED, -0.006), [0xFF, 0xFF]);
        assert_eq!(write(SPEED, f64::NAN), [0xFF, 0xFF]);
        assert_eq!(write(DILUTION, 327.65), [0xFF, 0x7F]);
        assert_eq!(write(DILUTION, f64::NEG_INFINITY), [0xFF, 0x7F]);
        let long = Number::signed(64, 1.0);
        assert_eq!(write(long, 9.3e18), i64::MAX.to_le_bytes());
        assert_eq!(write(long, -9.3e18), i64::MAX.to_le_bytes());
    }

    #[test]
    fn an_angle_of_half_a_turn_stays_below_pi() {
        let write = |radians| {
            let mut writer = Writer::default();
            writer.angle(Some(radians));
            writer.done()
        };
        assert_eq!(write(PI), 31_415_i16.to_le_bytes());
        assert_eq!(write(-PI), (-31_415_i16).to_le_bytes());
        assert_eq!(write(3.1414), 31_414_i16.to_le_bytes());
        assert_eq!(write(3.141_65), [0xFF, 0x7F]);
        assert_eq!(write(f64::NAN), [0xFF, 0x7F]);
    }

    #[test]
    fn a_direction_just_below_a_full_turn_is_north() {
        let write = |radians| {
            let mut writer = Writer::default();
            writer.direction(Some(radians));
            writer.done()
        };
        assert_eq!(write(std::f64::consts::TAU - 3e-5), [0, 0]);
        assert_eq!(write(6.283_14), 62_831_u16.to_le_bytes());
        assert_eq!(write(-0.1), 61_832_u16.to_le_bytes());
        assert_eq!(write(100.0), 57_522_u16.to_le_bytes());
        let full = Reader::new(&62_832_u16.to_le_bytes(), 2).unwrap().direction().unwrap();
        assert!((0.0..1e-4).contains(&full), "{full}");
    }
}
