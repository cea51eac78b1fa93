//! The kinds of fields that groups have.

use std::fmt::Debug;
use std::marker::PhantomData;

use insd_base::units::wrap_pi;

use super::bits::{self, Number, Reader, Writer, place_of};

/// How a field lies in its bits, and which values it has.
pub(super) trait Kind {
    /// What it is in a struct.
    type Value;

    /// How many bits it has.
    fn bits(&self) -> u32;

    /// Takes the value off the contents.
    fn read(&self, fields: &mut Reader<'_>) -> Self::Value;

    /// Appends the value to the contents.
    fn write(&self, fields: &mut Writer, value: &Self::Value);

    /// Its bits, its unit and steps, or its codes, in words.
    fn form(&self) -> String;
}

/// Links the messages of one epoch.
pub(super) const SID: Count<u8> = Count::of(Number::unsigned(8, 1.0));
/// How many there are.
pub(super) const COUNT: Count<u8> = SID;
/// Days since 1970-01-01.
pub(super) const DATE: Count<u16> = Count::of(Number::unsigned(16, 1.0).unit("days"));
/// Time of the day; its second 86400 is a leap second.
pub(super) const TIME: Number = Number::unsigned(32, 1e4).within(0, 864_010_000).unit("s");
/// Speed.
pub(super) const SPEED: Number = Number::unsigned(16, 100.0).unit("m/s");
/// Speed with a sign.
pub(super) const FINE_SPEED: Number = Number::signed(16, 1000.0).unit("m/s");
/// Distance.
pub(super) const DISTANCE: Number = Number::unsigned(32, 1.0).unit("m");
/// Dilution of precision.
pub(super) const DILUTION: Number = Number::signed(16, 100.0);
/// Standard deviation.
pub(super) const DEVIATION: Number = Number::unsigned(16, 100.0).unit("m");
/// Signed angle, up to half a turn.
pub(super) const ANGLE: Angle = Angle { wrapped: false };
/// Signed angle of which any number of turns may be written.
pub(super) const YAW: Angle = Angle { wrapped: true };
/// Direction from 0 to a full turn; any number of turns may be written.
pub(super) const DIRECTION: Direction = Direction;

/// A number in its unit, of whole steps.
impl Kind for Number {
    type Value = Option<f64>;

    fn bits(&self) -> u32 {
        self.bits
    }

    fn read(&self, fields: &mut Reader<'_>) -> Option<f64> {
        fields.number(*self)
    }

    fn write(&self, fields: &mut Writer, value: &Option<f64>) {
        fields.number(*self, *value);
    }

    fn form(&self) -> String {
        Number::form(self)
    }
}

/// A whole number.
pub(super) struct Count<T> {
    number: Number,
    is: PhantomData<T>,
}

impl<T> Count<T> {
    pub(super) const fn of(number: Number) -> Self {
        Count { number, is: PhantomData }
    }
}

impl<T: Copy + Into<i64> + TryFrom<i64>> Kind for Count<T> {
    type Value = Option<T>;

    fn bits(&self) -> u32 {
        self.number.bits
    }

    fn read(&self, fields: &mut Reader<'_>) -> Option<T> {
        fields.steps(self.number).and_then(|steps| T::try_from(steps).ok())
    }

    fn write(&self, fields: &mut Writer, value: &Option<T>) {
        fields.steps(self.number, value.map(T::into));
    }

    fn form(&self) -> String {
        self.number.form()
    }
}

/// An angle in radians, in a field in degrees.
pub(super) struct Degrees(pub(super) Number);

impl Kind for Degrees {
    type Value = Option<f64>;

    fn bits(&self) -> u32 {
        self.0.bits
    }

    fn read(&self, fields: &mut Reader<'_>) -> Option<f64> {
        fields.number(self.0).map(f64::to_radians)
    }

    fn write(&self, fields: &mut Writer, radians: &Option<f64>) {
        fields.number(self.0, radians.map(f64::to_degrees));
    }

    fn form(&self) -> String {
        self.0.form()
    }
}

/// See [`ANGLE`].
pub(super) struct Angle {
    wrapped: bool,
}

impl Kind for Angle {
    type Value = Option<f64>;

    fn bits(&self) -> u32 {
        bits::ANGLE.bits
    }

    fn read(&self, fields: &mut Reader<'_>) -> Option<f64> {
        fields.angle()
    }

    fn write(&self, fields: &mut Writer, radians: &Option<f64>) {
        fields.angle(if self.wrapped { radians.map(wrap_pi) } else { *radians });
    }

    fn form(&self) -> String {
        bits::ANGLE.form()
    }
}

/// See [`DIRECTION`].
pub(super) struct Direction;

impl Kind for Direction {
    type Value = Option<f64>;

    fn bits(&self) -> u32 {
        bits::DIRECTION.bits
    }

    fn read(&self, fields: &mut Reader<'_>) -> Option<f64> {
        fields.direction()
    }

    fn write(&self, fields: &mut Writer, radians: &Option<f64>) {
        fields.direction(*radians);
    }

    fn form(&self) -> String {
        bits::DIRECTION.form()
    }
}

/// One of a list, by its number.
pub(super) struct Choice<T: 'static> {
    bits: u32,
    list: &'static [T],
    /// What a number that is data but not in the list stands for, and the way back.
    other: fn(u8) -> Option<T>,
    number: fn(T) -> Option<u8>,
}

impl<T: Copy> Choice<T> {
    /// A list in the order of its numbers.
    pub(super) const fn new(bits: u32, list: &'static [T]) -> Self {
        Choice { bits, list, other: |_| None, number: |_| None }
    }

    /// With a name for numbers that are not in the list.
    pub(super) const fn or(self, other: fn(u8) -> Option<T>, number: fn(T) -> Option<u8>) -> Self {
        Choice { other, number, ..self }
    }

    /// With a number for what is not known: then all numbers are data.
    pub(super) const fn always(self, unknown: T) -> Always<T> {
        Always { choice: self, unknown }
    }
}

impl<T: Copy + PartialEq + Debug> Choice<T> {
    fn number_of(&self, code: T) -> Option<u8> {
        (self.number)(code).or_else(|| place_of(self.list, &code))
    }
}

impl<T: Copy + PartialEq + Debug> Kind for Choice<T> {
    type Value = Option<T>;

    fn bits(&self) -> u32 {
        self.bits
    }

    fn read(&self, fields: &mut Reader<'_>) -> Option<T> {
        fields.choice(self.bits, self.list, self.other)
    }

    fn write(&self, fields: &mut Writer, code: &Option<T>) {
        fields.code(self.bits, code.and_then(|code| self.number_of(code)));
    }

    fn form(&self) -> String {
        let named = self.list.iter().enumerate().map(|(number, code)| format!("{number} {code:?}"));
        format!("{} bits: {}", self.bits, named.collect::<Vec<_>>().join(", "))
    }
}

/// One of a list of which every number is data. Unknown is written as one of them, and read only where
/// the contents end before the field.
pub(super) struct Always<T: 'static> {
    choice: Choice<T>,
    unknown: T,
}

impl<T: Copy + PartialEq + Debug> Kind for Always<T> {
    type Value = Option<T>;

    fn bits(&self) -> u32 {
        self.choice.bits
    }

    fn read(&self, fields: &mut Reader<'_>) -> Option<T> {
        self.choice.read(fields)
    }

    fn write(&self, fields: &mut Writer, code: &Option<T>) {
        let number = self.choice.number_of(code.unwrap_or(self.unknown));
        let all =
            Number::unsigned(self.choice.bits, 1.0).within(0, self.choice.list.len() as i64 - 1);
        fields.steps(all, number.map(i64::from));
    }

    fn form(&self) -> String {
        self.choice.form()
    }
}
