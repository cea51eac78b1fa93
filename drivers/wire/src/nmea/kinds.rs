//! The kinds of values that sentences have: how each stands in its fields.

#[cfg(test)]
pub(super) mod samples;

use std::marker::PhantomData;

use insd_base::units::KNOT;

use super::civil::TimeOfDay;
use super::decimal::Form;
use super::fault::NmeaFault;
use super::fields::Fields;
use super::line::Composer;
use super::parts::letter_of;
use super::parts::{heading, lettered};

/// How a value stands in its fields.
pub(super) trait Kind {
    /// What it is in a struct.
    type Value;

    /// Appends its fields.
    fn write(&self, line: &mut Composer, value: &Self::Value);

    /// Takes its fields, all of them whatever they hold.
    fn read(&self, fields: &mut Fields<'_>) -> Result<Self::Value, NmeaFault>;
}

/// What the unit of a field is.
#[derive(Clone, Copy)]
enum Unit {
    /// So much of that of the value.
    Of(f64),
    /// Degrees, of radians.
    Degrees,
    /// Minutes of arc, of radians.
    Minutes,
}

/// What stands beside a number.
#[derive(Clone, Copy)]
enum Beside {
    Nothing,
    Sign,
    Letter(u8),
    LetterIfKnown(u8),
    SignLetter([u8; 2]),
    RoundedSignLetter([u8; 2]),
}

/// A decimal number. Outside its range it is unknown to the writer and malformed to the reader.
#[derive(Clone, Copy)]
pub(super) struct Decimal {
    form: Form,
    least: f64,
    unit: Unit,
    beside: Beside,
    short: bool,
    reversed: bool,
}

impl Decimal {
    /// A number of so many decimals, of at most so much either way.
    pub(super) const fn signed(decimals: u8, limit: f64) -> Self {
        let form = Form { decimals, width: 1, limit };
        let (unit, beside) = (Unit::Of(1.0), Beside::Nothing);
        Decimal { form, least: -limit, unit, beside, short: false, reversed: false }
    }

    /// A number that is never negative.
    pub(super) const fn magnitude(decimals: u8, limit: f64) -> Self {
        Decimal { least: 0.0, ..Decimal::signed(decimals, limit) }
    }

    /// In a unit that is so much of that of the value.
    pub(super) const fn of(self, unit: f64) -> Self {
        Decimal { unit: Unit::Of(unit), ..self }
    }

    /// In knots, of m/s.
    pub(super) const fn knots(self) -> Self {
        self.of(KNOT)
    }

    /// In degrees, of radians.
    pub(super) const fn degrees(self) -> Self {
        Decimal { unit: Unit::Degrees, ..self }
    }

    /// In minutes of arc, of radians.
    pub(super) const fn minutes(self) -> Self {
        Decimal { unit: Unit::Minutes, ..self }
    }

    /// With at least so many digits before the point.
    pub(super) const fn width(self, width: u8) -> Self {
        Decimal { form: Form { width, ..self.form }, ..self }
    }

    /// With its sign always shown.
    pub(super) const fn with_sign(self) -> Self {
        Decimal { beside: Beside::Sign, ..self }
    }

    /// With a letter in the next field, even if the number is unknown.
    pub(super) const fn with(self, letter: u8) -> Self {
        Decimal { beside: Beside::Letter(letter), ..self }
    }

    /// With a letter in the next field if the number is known.
    pub(super) const fn with_if_known(self, letter: u8) -> Self {
        Decimal { beside: Beside::LetterIfKnown(letter), ..self }
    }

    /// A magnitude, and the letter of its sign in the next field, the positive one first.
    pub(super) const fn lettered(self, letters: [u8; 2]) -> Self {
        Decimal { beside: Beside::SignLetter(letters), ..self }
    }

    /// The same, but what rounds to zero is positive.
    pub(super) const fn lettered_rounded(self, letters: [u8; 2]) -> Self {
        Decimal { beside: Beside::RoundedSignLetter(letters), ..self }
    }

    /// Without a point where it is whole.
    pub(super) const fn short(self) -> Self {
        Decimal { short: true, ..self }
    }

    /// Positive the other way than the value.
    pub(super) const fn reversed(self) -> Self {
        Decimal { reversed: true, ..self }
    }

    /// The number of a value, if it may be written.
    fn number(&self, value: f64) -> Option<f64> {
        let number = match self.unit {
            Unit::Of(unit) => value / unit,
            Unit::Degrees => value.to_degrees(),
            Unit::Minutes => value.to_degrees() * 60.0,
        };
        let number = if self.reversed { -number } else { number };
        (self.least < 0.0 || number >= 0.0).then_some(number)
    }

    fn value(&self, number: f64) -> f64 {
        let value = match self.unit {
            Unit::Of(unit) => number * unit,
            Unit::Degrees => number.to_radians(),
            Unit::Minutes => (number / 60.0).to_radians(),
        };
        if self.reversed { -value } else { value }
    }
}

impl Kind for Decimal {
    type Value = Option<f64>;

    fn write(&self, line: &mut Composer, value: &Option<f64>) {
        let number = value.and_then(|value| self.number(value));
        let whole = number.is_none_or(|number| number.fract() == 0.0);
        let form = if self.short && whole { Form { decimals: 0, ..self.form } } else { self.form };
        match self.beside {
            Beside::Nothing => line.number(number, form),
            Beside::Sign => line.with_sign(number, form),
            Beside::Letter(letter) => {
                line.number(number, form);
                line.letter(letter);
            }
            Beside::LetterIfKnown(letter) => line.measured(number, form, letter),
            Beside::SignLetter(letters) => line.signed(number, form, letters),
            Beside::RoundedSignLetter(letters) => lettered(line, number, form, letters),
        }
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Option<f64>, NmeaFault> {
        let range = self.least..=self.form.limit;
        let number = match self.beside {
            Beside::Nothing | Beside::Sign => fields.number_in(range),
            Beside::Letter(letter) | Beside::LetterIfKnown(letter) => {
                fields.with_unit(range, char::from(letter).encode_utf8(&mut [0; 4]))
            }
            Beside::SignLetter([a, b]) | Beside::RoundedSignLetter([a, b]) => {
                let (mut first, mut second) = ([0; 4], [0; 4]);
                let a: &str = char::from(a).encode_utf8(&mut first);
                let b: &str = char::from(b).encode_utf8(&mut second);
                fields.signed(self.form.limit, [a, b])
            }
        };
        Ok(number?.map(|number| self.value(number)))
    }
}

/// A form without the decimals that would be zeros at the end.
fn shortened(form: Form, number: Option<f64>) -> Form {
    let steps = number.map_or(0.0, |number| (number * 10_f64.powi(form.decimals.into())).round());
    let is_enough = |decimals: &u8| steps % 10_f64.powi((form.decimals - decimals).into()) == 0.0;
    let decimals = (0..form.decimals).find(is_enough).unwrap_or(form.decimals);
    Form { decimals, ..form }
}

/// A direction, rad, in degrees from 0 to a full turn; any number of turns may be written.
#[derive(Clone, Copy)]
pub(super) struct Turn {
    form: Form,
    letter: Option<u8>,
    short: bool,
}

impl Turn {
    /// Of so many decimals.
    pub(super) const fn of(decimals: u8) -> Self {
        Turn { form: Form { decimals, width: 1, limit: 360.0 }, letter: None, short: false }
    }

    /// With three digits before the point.
    pub(super) const fn full_width(self) -> Self {
        Turn { form: Form { width: 3, ..self.form }, ..self }
    }

    /// With a letter in the next field, even if the direction is unknown.
    pub(super) const fn with(self, letter: u8) -> Self {
        Turn { letter: Some(letter), ..self }
    }

    /// Without zeros at its end.
    pub(super) const fn short(self) -> Self {
        Turn { short: true, ..self }
    }
}

impl Kind for Turn {
    type Value = Option<f64>;

    fn write(&self, line: &mut Composer, angle: &Option<f64>) {
        if self.form.width > 1 {
            heading(line, *angle, self.form);
        } else if self.short {
            line.degrees(*angle, shortened(self.form, angle.map(f64::to_degrees)).decimals);
        } else {
            line.degrees(*angle, self.form.decimals);
        }
        self.letter.iter().for_each(|letter| line.letter(*letter));
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Option<f64>, NmeaFault> {
        match self.letter {
            Some(letter) => fields.degrees_with(char::from(letter).encode_utf8(&mut [0; 4])),
            None => fields.degrees(),
        }
    }
}

/// A speed that is told twice, in knots and in km/h: the same one, as that in knots has been rounded. The
/// first that is known is read. The letters of the units stand even beside empty numbers.
pub(super) struct KnotsAndKmh(pub(super) Decimal);

/// Metres per second in one kilometre per hour.
const KMH: f64 = 1.0 / 3.6;

impl Kind for KnotsAndKmh {
    type Value = Option<f64>;

    fn write(&self, line: &mut Composer, speed: &Option<f64>) {
        // a speed with a sign is told in both units or in none
        let is_told = |speed: &f64| self.0.least == 0.0 || (speed / KMH).abs() <= self.0.form.limit;
        let fits = speed.filter(is_told);
        let as_told = fits.map(|speed| (speed / KNOT * 100.0).round() / 100.0 * KNOT);
        self.0.knots().with(b'N').write(line, &fits);
        self.0.of(KMH).with(b'K').write(line, &as_told);
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Option<f64>, NmeaFault> {
        let knots = self.0.knots().with(b'N');
        let form = Form { limit: 2.0 * knots.form.limit, ..knots.form };
        let kmh = Decimal { form, least: 2.0 * knots.least, ..knots.of(KMH).with(b'K') };
        let knots = fields.optional(|own| knots.read(own))?;
        Ok(knots.or(fields.optional(|own| kmh.read(own))?))
    }
}

/// A magnitude in three significant digits, of no more decimals than so many, up to a limit.
pub(super) struct Significant(pub(super) Decimal);

impl Kind for Significant {
    type Value = Option<f64>;

    fn write(&self, line: &mut Composer, value: &Option<f64>) {
        let fitting = match value.and_then(|value| self.0.number(value)) {
            Some(number) if number < 0.9995 => 3,
            Some(number) if number < 9.995 => 2,
            Some(number) if number < 99.95 => 1,
            _ => 0,
        };
        let decimals = self.0.form.decimals.min(fitting);
        Decimal { form: Form { decimals, ..self.0.form }, ..self.0 }.write(line, value);
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Option<f64>, NmeaFault> {
        self.0.read(fields)
    }
}

/// A whole number of at least so many digits, up to a greatest.
pub(super) struct Whole<T>(u8, u32, PhantomData<T>);

impl<T> Whole<T> {
    pub(super) const fn of(width: u8, most: u32) -> Self {
        Whole(width, most, PhantomData)
    }
}

impl<T: Copy + Into<u32> + TryFrom<u32>> Kind for Whole<T> {
    type Value = Option<T>;

    fn write(&self, line: &mut Composer, value: &Option<T>) {
        line.whole(value.map(T::into), self.0, self.1);
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Option<T>, NmeaFault> {
        Ok(fields.whole(self.1)?.and_then(|value| T::try_from(value).ok()))
    }
}

/// A time of day, UTC, truncated to so many decimals of a second.
pub(super) struct Clock(pub(super) u8);

impl Kind for Clock {
    type Value = Option<TimeOfDay>;

    fn write(&self, line: &mut Composer, time: &Option<TimeOfDay>) {
        line.time_of_day_to(*time, self.0);
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Option<TimeOfDay>, NmeaFault> {
        fields.time_of_day()
    }
}

/// A latitude, rad, of minutes with so many decimals, and its hemisphere; both empty if unknown.
pub(super) struct Latitude(pub(super) u8);

impl Kind for Latitude {
    type Value = Option<f64>;

    fn write(&self, line: &mut Composer, latitude: &Option<f64>) {
        line.latitude(*latitude, self.0);
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Option<f64>, NmeaFault> {
        fields.latitude()
    }
}

/// One field of any other form, both ways; empty if unknown.
pub(super) struct Field<T> {
    pub(super) write: fn(&mut Composer, T),
    pub(super) read: fn(&str) -> Option<T>,
}

impl<T: Copy> Kind for Field<T> {
    type Value = Option<T>;

    fn write(&self, line: &mut Composer, value: &Option<T>) {
        match value {
            Some(value) => (self.write)(line, *value),
            None => line.empty(),
        }
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Option<T>, NmeaFault> {
        fields.convert(self.read)
    }
}

/// What is told by a letter.
pub(super) trait Lettered: Copy {
    fn to_letter(self) -> u8;
    fn of_letter(letter: u8) -> Option<Self>;
}

/// The letter of one of several, empty if unknown.
pub(super) const fn letter<T: Lettered>() -> Field<T> {
    Field {
        write: |line, value| line.letter(value.to_letter()),
        read: |text| letter_of(text).and_then(T::of_letter),
    }
}

/// Yes or no by a letter each.
pub(super) struct Flag(pub(super) u8, pub(super) u8);

/// A valid, V not valid; never empty.
pub(super) const STATUS: Flag = Flag(b'A', b'V');
/// 1 yes, 0 no; never empty.
pub(super) const DIGIT: Flag = Flag(b'1', b'0');

impl Kind for Flag {
    type Value = bool;

    fn write(&self, line: &mut Composer, value: &bool) {
        line.letter(if *value { self.0 } else { self.1 });
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<bool, NmeaFault> {
        match fields.text()?.as_bytes() {
            [letter] if *letter == self.0 => Ok(true),
            [letter] if *letter == self.1 => Ok(false),
            _ => Err(fields.malformed()),
        }
    }
}

/// What is never empty.
pub(super) struct Needed<T>(pub(super) Field<T>);

impl<T: Copy> Kind for Needed<T> {
    type Value = T;

    fn write(&self, line: &mut Composer, value: &T) {
        (self.0.write)(line, *value);
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<T, NmeaFault> {
        self.0.read(fields)?.ok_or_else(|| fields.malformed())
    }
}

/// What is never empty, as one of its values says that it is unknown.
pub(super) struct Otherwise<T>(pub(super) T, pub(super) Field<T>);

impl<T: Copy> Kind for Otherwise<T> {
    type Value = Option<T>;

    fn write(&self, line: &mut Composer, value: &Option<T>) {
        (self.1.write)(line, value.unwrap_or(self.0));
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<Option<T>, NmeaFault> {
        self.1.read(fields)?.map(Some).ok_or_else(|| fields.malformed())
    }
}

/// A value, and a letter that must stand behind it.
pub(super) struct Then<K>(pub(super) K, pub(super) u8);

impl<K: Kind> Kind for Then<K> {
    type Value = K::Value;

    fn write(&self, line: &mut Composer, value: &K::Value) {
        self.0.write(line, value);
        line.letter(self.1);
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<K::Value, NmeaFault> {
        let value = self.0.read(fields)?;
        let is_there = fields.text()?.as_bytes() == [self.1];
        if is_there { Ok(value) } else { Err(fields.malformed()) }
    }
}

/// Three values of one kind.
pub(super) struct Three<K>(pub(super) K);

impl<T: Copy, K: Kind<Value = Option<T>>> Kind for Three<K> {
    type Value = [Option<T>; 3];

    fn write(&self, line: &mut Composer, values: &[Option<T>; 3]) {
        values.iter().for_each(|value| self.0.write(line, value));
    }

    fn read(&self, fields: &mut Fields<'_>) -> Result<[Option<T>; 3], NmeaFault> {
        Ok([self.0.read(fields)?, self.0.read(fields)?, self.0.read(fields)?])
    }
}
