//! The writer: fields into a line, of at most 82 bytes if the sentence is approved.

use std::fmt;

use super::checksum::checksum;
use super::civil::TimeOfDay;
use super::decimal::{Form, power_of_ten, scaled};
use super::position::Position;

/// Longest sentence of the standard, bytes from `$` to line feed (IEC 61162-1).
pub const MAX_LEN: usize = 82;

/// Longest sentence that is written under a maker's own address, bytes from `$` to line feed. The
/// makers set no limit; the tagged sentence of a Nortek log has some 230.
pub const MAX_LEN_OWN: usize = 256;

const HEX: &[u8; 16] = b"0123456789ABCDEF";

/// Bytes of `*hh` CR LF.
const TAIL: usize = 5;

/// Two letters that say what kind of device talks.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Talker([u8; 2]);

impl Talker {
    /// North-seeking gyro compass.
    pub const HE: Talker = Talker(*b"HE");
    /// Integrated navigation.
    pub const IN: Talker = Talker(*b"IN");
    /// Rate-of-turn indicator.
    pub const TI: Talker = Talker(*b"TI");
    /// GPS receiver.
    pub const GP: Talker = Talker(*b"GP");
    /// Receiver of several satellite systems.
    pub const GN: Talker = Talker(*b"GN");
    /// Doppler log.
    pub const VD: Talker = Talker(*b"VD");

    /// A talker of two upper-case letters or digits that is not the `P` of makers.
    #[must_use]
    pub fn new(text: &str) -> Option<Self> {
        match text.as_bytes() {
            [b'P', _] => None,
            [a, b] => {
                let good = |c: &u8| c.is_ascii_uppercase() || c.is_ascii_digit();
                (good(a) && good(b)).then_some(Talker([*a, *b]))
            }
            _ => None,
        }
    }

    /// The two letters.
    #[must_use]
    pub fn as_str(&self) -> &str {
        std::str::from_utf8(&self.0).unwrap_or_default()
    }
}

impl fmt::Debug for Talker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Talker({})", self.as_str())
    }
}

/// A finished sentence, `$` to line feed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct NmeaLine {
    bytes: [u8; MAX_LEN_OWN],
    len: usize,
}

impl NmeaLine {
    /// The bytes for the wire, CR LF included.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        &self.bytes[..self.len]
    }

    /// The sentence as text, without CR LF.
    #[must_use]
    pub fn as_str(&self) -> &str {
        std::str::from_utf8(self.as_bytes()).unwrap_or_default().trim_end()
    }

    /// The same sentence as old devices want it: without `*hh`.
    #[must_use]
    pub fn without_checksum(mut self) -> NmeaLine {
        let end = self.len.saturating_sub(TAIL);
        self.bytes[end..end + 2].copy_from_slice(b"\r\n");
        self.len = end + 2;
        self
    }

    /// Composes a sentence. `fill` writes the fields; it runs again with shorter forms for as long
    /// as they do not fit: first without the optional fields, then with fewer and fewer decimals.
    /// If nothing fits, which no writer of this crate can bring about, the bare address remains.
    pub(crate) fn compose(
        talker: Talker,
        formatter: &str,
        fill: impl Fn(&mut Composer),
    ) -> NmeaLine {
        NmeaLine::try_compose(talker, formatter, fill)
            .unwrap_or_else(|| NmeaLine::bare([talker.as_str(), formatter]))
    }

    /// As [`NmeaLine::compose`], but nothing if nothing fits: for sentences of as many parts as there is
    /// room for.
    pub(crate) fn try_compose(
        talker: Talker,
        formatter: &str,
        fill: impl Fn(&mut Composer),
    ) -> Option<NmeaLine> {
        NmeaLine::shortened([talker.as_str(), formatter], MAX_LEN, fill)
    }

    /// As [`NmeaLine::compose`], for a sentence under a maker's own address (`PSXN`).
    pub(crate) fn compose_own(address: &str, fill: impl Fn(&mut Composer)) -> NmeaLine {
        NmeaLine::shortened([address, ""], MAX_LEN_OWN, fill)
            .unwrap_or_else(|| NmeaLine::bare([address, ""]))
    }

    fn bare(address: [&str; 2]) -> NmeaLine {
        Composer::new(address, MAX_LEN, false, 0).finish()
    }

    fn shortened(
        address: [&str; 2],
        limit: usize,
        fill: impl Fn(&mut Composer),
    ) -> Option<NmeaLine> {
        let shortenings = std::iter::once((true, u8::MAX))
            .chain(std::iter::once((false, u8::MAX)))
            .chain((0..=8).rev().map(|decimals| (false, decimals)));
        for (optional, max_decimals) in shortenings {
            let mut composer = Composer::new(address, limit, optional, max_decimals);
            fill(&mut composer);
            if !composer.overflow {
                return Some(composer.finish());
            }
        }
        None
    }
}

impl fmt::Debug for NmeaLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Line({})", self.as_str())
    }
}

/// A sentence in the making.
#[derive(Debug)]
pub(crate) struct Composer {
    bytes: [u8; MAX_LEN_OWN],
    len: usize,
    /// Bytes that the line may have before its tail.
    room: usize,
    overflow: bool,
    optional: bool,
    max_decimals: u8,
}

impl Composer {
    fn new(address: [&str; 2], limit: usize, optional: bool, max_decimals: u8) -> Self {
        let mut composer = Composer {
            bytes: [0; MAX_LEN_OWN],
            len: 0,
            room: limit.min(MAX_LEN_OWN) - TAIL,
            overflow: false,
            optional,
            max_decimals,
        };
        composer.push(b'$');
        address.iter().for_each(|part| composer.push_all(part.as_bytes()));
        composer
    }

    /// An empty field.
    pub(crate) fn empty(&mut self) {
        self.push(b',');
    }

    /// A field of one letter.
    pub(crate) fn letter(&mut self, letter: u8) {
        self.push(b',');
        self.push(letter);
    }

    /// A field of one letter, empty if unknown.
    pub(crate) fn optional_letter(&mut self, letter: Option<u8>) {
        self.empty();
        letter.iter().for_each(|letter| self.push(*letter));
    }

    /// A number, empty if unknown or outside its form's limit.
    pub(crate) fn number(&mut self, value: Option<f64>, form: Form) {
        self.push(b',');
        self.number_here(value, form);
    }

    /// A number with a key before it if it has one: `VX=1.234`.
    pub(crate) fn tagged(&mut self, key: Option<&str>, value: Option<f64>, form: Form) {
        self.key(key);
        self.number_here(value, form);
    }

    /// A comma and a key if there is one; the value follows.
    pub(crate) fn key(&mut self, key: Option<&str>) {
        self.push(b',');
        if let Some(key) = key {
            self.push_all(key.as_bytes());
            self.push(b'=');
        }
    }

    fn number_here(&mut self, value: Option<f64>, form: Form) {
        let decimals = form.decimals.min(self.max_decimals);
        if let Some(scaled) = value.and_then(|value| scaled(value, decimals, form.limit)) {
            self.push_scaled(scaled, decimals, form.width);
        }
    }

    /// A magnitude and the letter of its sign, both empty if unknown: `1.3,W` is -1.3.
    pub(crate) fn signed(&mut self, value: Option<f64>, form: Form, letters: [u8; 2]) {
        let letter = letters[usize::from(value.is_some_and(|value| value < 0.0))];
        self.measured(value.map(f64::abs), form, letter);
    }

    /// A known text as one field; empty if a byte of it would break the line.
    pub(crate) fn text(&mut self, text: &str) {
        self.push(b',');
        if text.bytes().all(|byte| byte.is_ascii_graphic() && !b",*$!\\^~".contains(&byte)) {
            self.push_all(text.as_bytes());
        }
    }

    /// A number followed by its unit, both empty if unknown.
    pub(crate) fn measured(&mut self, value: Option<f64>, form: Form, unit: u8) {
        let start = self.len;
        self.number(value, form);
        if self.len == start + 1 { self.empty() } else { self.letter(unit) }
    }

    /// An angle of any number of turns, rad, as degrees in [0, 360), also after rounding.
    pub(crate) fn degrees(&mut self, angle: Option<f64>, decimals: u8) {
        self.push(b',');
        let decimals = decimals.min(self.max_decimals);
        let full_turn = 360 * power_of_ten(decimals);
        let degrees = angle.map(|angle| angle.to_degrees() % 360.0);
        if let Some(scaled) = degrees.and_then(|degrees| scaled(degrees, decimals, 360.0)) {
            self.push_scaled(scaled.rem_euclid(full_turn), decimals, 1);
        }
    }

    /// A whole number of fixed width, empty if unknown or too great for `max`.
    pub(crate) fn whole(&mut self, value: Option<u32>, width: u8, max: u32) {
        let form = Form { decimals: 0, width, limit: f64::from(max) };
        self.number(value.map(f64::from), form);
    }

    /// One hexadecimal digit; no field at all if unknown, as older editions end before it.
    pub(crate) fn hexadecimal(&mut self, value: Option<u8>) {
        if let Some(digit) = value.filter(|value| *value < 16) {
            self.letter(HEX[usize::from(digit)]);
        }
    }

    /// Latitude, hemisphere, longitude, hemisphere: four fields, all empty if unknown.
    pub(crate) fn position(&mut self, position: Option<Position>, decimals: u8) {
        let decimals = decimals.min(self.max_decimals);
        match position.and_then(|position| position.to_minutes(decimals)) {
            Some((latitude, longitude)) => {
                self.minutes(latitude, decimals, 2, [b'N', b'S']);
                self.minutes(longitude, decimals, 3, [b'E', b'W']);
            }
            None => (0..4).for_each(|_| self.empty()),
        }
    }

    /// A latitude and its hemisphere, both empty if unknown.
    pub(crate) fn latitude(&mut self, latitude: Option<f64>, decimals: u8) {
        let position = latitude.map(|latitude| Position { latitude, longitude: 0.0 });
        match position.and_then(|position| position.to_minutes(decimals)) {
            Some((latitude, _)) => self.minutes(latitude, decimals, 2, [b'N', b'S']),
            None => (0..2).for_each(|_| self.empty()),
        }
    }

    /// Whether the field that `write` writes has anything in it.
    pub(crate) fn filled(&mut self, write: impl FnOnce(&mut Composer)) -> bool {
        let start = self.len;
        write(self);
        self.len > start + 1
    }

    /// Fields that go first when the line is too long: `fill` if there is room, else `count` empty.
    pub(crate) fn optional(&mut self, count: u8, fill: impl Fn(&mut Composer)) {
        if self.optional {
            fill(self);
        } else {
            (0..count).for_each(|_| self.empty());
        }
    }

    /// A number that cannot be negative; one that is, is unknown.
    pub(crate) fn magnitude(&mut self, value: Option<f64>, form: Form) {
        self.number(value.filter(|value| *value >= 0.0), form);
    }

    /// A number with its sign always shown.
    pub(crate) fn with_sign(&mut self, value: Option<f64>, form: Form) {
        self.push(b',');
        let decimals = form.decimals.min(self.max_decimals);
        if let Some(scaled) = value.and_then(|value| scaled(value, decimals, form.limit)) {
            if scaled >= 0 {
                self.push(b'+');
            }
            self.push_scaled(scaled, decimals, form.width);
        }
    }

    /// A time of day `hhmmss.ss`, truncated, so that it never runs into the next day.
    pub(crate) fn time_of_day(&mut self, time: Option<TimeOfDay>) {
        self.time_of_day_to(time, 2);
    }

    /// A time of day with so many decimals, truncated.
    pub(crate) fn time_of_day_to(&mut self, time: Option<TimeOfDay>, decimals: u8) {
        match time.filter(|time| time.is_valid()) {
            Some(time) => {
                self.digits(&time.groups());
                self.fraction(time.nanosecond, decimals);
            }
            None => self.empty(),
        }
    }

    /// Text of a fixed form as one field, made of (value, width) groups of digits.
    pub(crate) fn digits(&mut self, groups: &[(u32, u8)]) {
        self.push(b',');
        for (value, width) in groups {
            self.push_scaled(i64::from(*value), 0, *width);
        }
    }

    /// Digits after a point that belong to the field before.
    fn fraction(&mut self, nanos: u32, decimals: u8) {
        let decimals = decimals.min(self.max_decimals);
        if decimals > 0 {
            self.push(b'.');
            let scaled = i64::from(nanos) / power_of_ten(9 - decimals.min(9));
            self.push_scaled(scaled, 0, decimals);
        }
    }

    fn minutes(&mut self, scaled: i64, decimals: u8, degree_width: u8, hemispheres: [u8; 2]) {
        let degree = 60 * power_of_ten(decimals);
        let magnitude = scaled.abs();
        self.push(b',');
        self.push_scaled(magnitude / degree, 0, degree_width);
        self.push_scaled(magnitude % degree, decimals, 2);
        self.letter(hemispheres[usize::from(scaled < 0)]);
    }

    /// Writes `scaled` / 10^`decimals`; zero has no sign.
    fn push_scaled(&mut self, scaled: i64, decimals: u8, width: u8) {
        let scale = power_of_ten(decimals).unsigned_abs();
        if scaled < 0 {
            self.push(b'-');
        }
        self.push_whole(scaled.unsigned_abs() / scale, width);
        if decimals > 0 {
            self.push(b'.');
            self.push_whole(scaled.unsigned_abs() % scale, decimals);
        }
    }

    fn push_whole(&mut self, mut value: u64, width: u8) {
        let mut digits = [b'0'; 20];
        let mut used = 0;
        while value > 0 || used < usize::from(width).clamp(1, digits.len()) {
            used += 1;
            digits[20 - used] = b'0' + (value % 10) as u8;
            value /= 10;
        }
        self.push_all(&digits[20 - used..]);
    }

    /// Bytes that still fit before the checksum.
    pub(crate) fn room(&self) -> usize {
        self.room - self.len
    }

    pub(crate) fn push_all(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.push(*byte));
    }

    fn push(&mut self, byte: u8) {
        if self.len < self.room {
            self.bytes[self.len] = byte;
            self.len += 1;
        } else {
            self.overflow = true;
        }
    }

    fn finish(mut self) -> NmeaLine {
        let sum = checksum(&self.bytes[1..self.len]);
        let tail = [b'*', HEX[usize::from(sum >> 4)], HEX[usize::from(sum & 15)], b'\r', b'\n'];
        self.bytes[self.len..self.len + TAIL].copy_from_slice(&tail);
        NmeaLine { bytes: self.bytes, len: self.len + TAIL }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORM: Form = Form { decimals: 5, width: 1, limit: 1e9 };

    #[test]
    fn the_guard_drops_optional_fields_first_and_decimals_next() {
        let with = |numbers: usize| {
            let line = NmeaLine::compose(Talker::IN, "XXX", |c| {
                (0..numbers).for_each(|_| c.number(Some(1_234.567_891), FORM));
                c.optional(1, |c| c.number(Some(42.0), FORM));
            });
            line.as_str().to_owned()
        };
        assert!(with(5).contains(",1234.56789,42.00000*"), "{}", with(5));
        assert!(with(6).contains(",1234.56789,*"), "{}", with(6));
        assert!(with(7).contains(",1234.5679,*"), "{}", with(7));
        assert!(with(10).contains(",1234.6,*"), "{}", with(10));
        assert!(with(14).contains(",1235,*"), "{}", with(14));
    }

    #[test]
    fn a_line_that_cannot_fit_says_nothing_rather_than_half() {
        let line = NmeaLine::compose(Talker::IN, "XXX", |c| (0..99).for_each(|_| c.empty()));
        assert_eq!(line.as_str(), "$INXXX*5F");
    }

    #[test]
    fn a_heading_just_below_a_full_turn_is_rounded_to_zero() {
        let line = NmeaLine::compose(Talker::HE, "XXX", |c| {
            c.degrees(Some(359.998_f64.to_radians()), 2);
            c.degrees(Some(-0.001_f64.to_radians()), 2);
        });
        assert!(line.as_str().starts_with("$HEXXX,0.00,0.00*"), "{line:?}");
    }

    #[test]
    fn a_line_without_checksum_has_the_same_fields_and_an_end() {
        let line = NmeaLine::compose(Talker::HE, "XXX", |c| c.letter(b'A'));
        assert_eq!(line.without_checksum().as_bytes(), b"$HEXXX,A\r\n");
    }

    #[test]
    fn zero_has_no_sign() {
        let form = Form { decimals: 1, width: 1, limit: 1e3 };
        let line = NmeaLine::compose(Talker::TI, "XXX", |c| c.number(Some(-0.04), form));
        assert!(line.as_str().starts_with("$TIXXX,0.0*"), "{line:?}");
    }
}
