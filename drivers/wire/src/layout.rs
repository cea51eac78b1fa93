//! Fixed layouts of binary messages as tables: a row for each field, from which struct, reader, writer and documentation follow.
//! Layouts whose fields depend on one another are written out by hand.
//!
//! Readers never panic: a row that lies beyond the end of the bytes is a [`BinaryFault::Short`].

use std::marker::PhantomData;

use crate::binary::BinaryFault;

/// A message: its name, how many bytes it has, and its fields. A row is the field's first byte, its name, type and form. Bytes that
/// no row names are zeros when written and not looked at when read; several rows may share a byte, each with its own bits.
macro_rules! layout {
    (
        $(#[doc = $about:literal])*
        $name:ident, $length:literal bytes $(: $($derive:ident)+)?;
        $(
            $(#[doc = $doc:literal])*
            $at:literal $field:ident: $type:ty = $form:expr;
        )*
    ) => {
        $(#[doc = $about])*
        ///
        /// | byte | field | form |
        /// |---:|---|---|
        $(#[doc = concat!("| ", $at, " | ", stringify!($field), " | `", stringify!($form), "` |")])*
        #[derive(Clone, Copy, Debug, PartialEq $($(, $derive)+)?)]
        pub struct $name {
            $($(#[doc = $doc])* pub $field: $type,)*
        }

        impl $name {
            fn read_fields(bytes: &[u8]) -> Result<Self, $crate::binary::BinaryFault> {
                use $crate::layout::Form;
                let found = bytes.len();
                let short = $crate::binary::BinaryFault::Short { needed: $length, found };
                let bytes = bytes.get(..$length).ok_or(short)?;
                $(let $field: $type = $form.read(bytes.get($at..).ok_or(short)?)?;)*
                Ok($name { $($field),* })
            }

            fn write_fields(&self) -> Vec<u8> {
                use $crate::layout::Form;
                let mut bytes = vec![0; $length];
                $(
                    if let Some(own) = bytes.get_mut($at..) {
                        $form.write(&self.$field, own);
                    }
                )*
                bytes
            }
        }
    };
}
pub(crate) use layout;

/// How a field stands in bytes, of which the first is its own first.
pub(crate) trait Form<T> {
    /// Bytes that it takes.
    fn size(&self) -> usize;
    /// Its value.
    fn read(&self, bytes: &[u8]) -> Result<T, BinaryFault>;
    /// Puts its value into bytes, if there are enough.
    fn write(&self, value: &T, bytes: &mut [u8]);
}

/// A number of a fixed size.
pub(crate) trait Number: Copy + PartialEq {
    /// Bytes that it takes.
    const SIZE: usize;
    /// Of its bytes.
    fn get(bytes: &[u8]) -> Result<Self, BinaryFault>;
    /// Into its bytes.
    fn put(self, bytes: &mut [u8]);
    /// As a real number; of whole numbers beyond 53 bits the nearest.
    fn real(self) -> f64;
    /// The nearest, saturated; NaN is zero where it has no room for it.
    fn of_real(value: f64) -> Self;
    /// The number below.
    fn below(self) -> Self;
}

macro_rules! numbers {
    ($($number:ident $round:ident $below:expr;)*) => {$(
        impl Number for $number {
            const SIZE: usize = size_of::<$number>();

            fn get(bytes: &[u8]) -> Result<Self, BinaryFault> {
                let short = BinaryFault::Short { needed: Self::SIZE, found: bytes.len() };
                let own = bytes.first_chunk::<{ size_of::<$number>() }>().ok_or(short)?;
                Ok($number::from_le_bytes(*own))
            }

            fn put(self, bytes: &mut [u8]) {
                if let Some(own) = bytes.first_chunk_mut::<{ size_of::<$number>() }>() {
                    *own = self.to_le_bytes();
                }
            }

            fn real(self) -> f64 {
                self as f64
            }

            fn of_real(value: f64) -> Self {
                numbers!($round value) as $number
            }

            fn below(self) -> Self {
                let below: fn($number) -> $number = $below;
                below(self)
            }
        }
    )*};
    (whole $value:ident) => { $value.round() };
    (fraction $value:ident) => { $value };
}

numbers! {
    u8 whole |own| own.saturating_sub(1);
    i8 whole |own| own.saturating_sub(1);
    u16 whole |own| own.saturating_sub(1);
    i16 whole |own| own.saturating_sub(1);
    u32 whole |own| own.saturating_sub(1);
    i32 whole |own| own.saturating_sub(1);
    i64 whole |own| own.saturating_sub(1);
    f32 fraction |own| own;
    f64 fraction |own| own;
}

/// A number as it stands.
#[derive(Clone, Copy)]
pub(crate) struct Plain<N> {
    number: PhantomData<N>,
    /// Its most significant byte is first.
    big: bool,
}

/// A number, its least significant byte first.
pub(crate) const fn le<N>() -> Plain<N> {
    Plain { number: PhantomData, big: false }
}

/// A number, its most significant byte first.
pub(crate) const fn be<N>() -> Plain<N> {
    Plain { number: PhantomData, big: true }
}

impl<N: Number> Form<N> for Plain<N> {
    fn size(&self) -> usize {
        N::SIZE
    }

    fn read(&self, bytes: &[u8]) -> Result<N, BinaryFault> {
        match bytes.get(..N::SIZE).filter(|_| self.big) {
            Some(own) => N::get(&own.iter().rev().copied().collect::<Vec<u8>>()),
            None => N::get(bytes),
        }
    }

    fn write(&self, value: &N, bytes: &mut [u8]) {
        value.put(bytes);
        if let Some(own) = bytes.get_mut(..N::SIZE).filter(|_| self.big) {
            own.reverse();
        }
    }
}

impl<N> Plain<N> {
    /// A quantity in steps of a unit.
    pub(crate) const fn steps(self, unit: f64) -> Steps<N> {
        Steps { plain: self, unit }
    }

    /// A time in whole steps, as nanoseconds.
    pub(crate) const fn nanos(self, step: i64) -> Nanos<N> {
        Nanos { plain: self, step }
    }

    /// A quantity of which one number says that it is not known; what is no number is not known either.
    pub(crate) const fn unless(self, unknown: N, unit: f64) -> Unless<N> {
        Unless { steps: self.steps(unit), unknown }
    }

    /// One of several meanings.
    pub(crate) const fn codes<T>(self, read: fn(N) -> T, write: fn(&T) -> N) -> Codes<N, T> {
        Codes { plain: self, read, write }
    }
}

/// A quantity in steps of a unit.
#[derive(Clone, Copy)]
pub(crate) struct Steps<N> {
    plain: Plain<N>,
    unit: f64,
}

impl<N: Number> Form<f64> for Steps<N> {
    fn size(&self) -> usize {
        N::SIZE
    }

    fn read(&self, bytes: &[u8]) -> Result<f64, BinaryFault> {
        Ok(self.plain.read(bytes)?.real() * self.unit)
    }

    fn write(&self, value: &f64, bytes: &mut [u8]) {
        self.plain.write(&N::of_real(value / self.unit), bytes);
    }
}

impl<N> Steps<N> {
    /// A quantity that cannot be beyond a limit either way, by the name that the document gives the field.
    pub(crate) const fn within(self, limit: f64, field: &'static str) -> Within<N> {
        Within { steps: self, limit, field }
    }
}

/// A quantity that cannot be beyond a limit.
#[derive(Clone, Copy)]
pub(crate) struct Within<N> {
    steps: Steps<N>,
    limit: f64,
    field: &'static str,
}

impl<N: Number> Form<f64> for Within<N> {
    fn size(&self) -> usize {
        N::SIZE
    }

    fn read(&self, bytes: &[u8]) -> Result<f64, BinaryFault> {
        let value = self.steps.read(bytes)?;
        // a limit that is a whole number of steps may be beyond itself by the rounding of a double
        let good = value.abs() <= self.limit * (1.0 + 4.0 * f64::EPSILON);
        good.then_some(value.clamp(-self.limit, self.limit))
            .ok_or(BinaryFault::Range { field: self.field })
    }

    fn write(&self, value: &f64, bytes: &mut [u8]) {
        self.steps.write(value, bytes);
    }
}

/// A time in whole steps, as nanoseconds.
#[derive(Clone, Copy)]
pub(crate) struct Nanos<N> {
    plain: Plain<N>,
    step: i64,
}

impl<N: Number + Into<i64> + TryFrom<i64>> Form<i64> for Nanos<N> {
    fn size(&self) -> usize {
        N::SIZE
    }

    fn read(&self, bytes: &[u8]) -> Result<i64, BinaryFault> {
        Ok(self.plain.read(bytes)?.into().saturating_mul(self.step))
    }

    fn write(&self, value: &i64, bytes: &mut [u8]) {
        let steps = value.saturating_add(self.step / 2).div_euclid(self.step);
        let largest = N::of_real(f64::MAX);
        self.plain.write(&N::try_from(steps.max(0)).unwrap_or(largest), bytes);
    }
}

/// A quantity that may be unknown.
#[derive(Clone, Copy)]
pub(crate) struct Unless<N> {
    steps: Steps<N>,
    unknown: N,
}

impl<N: Number> Form<Option<f64>> for Unless<N> {
    fn size(&self) -> usize {
        N::SIZE
    }

    fn read(&self, bytes: &[u8]) -> Result<Option<f64>, BinaryFault> {
        let number = self.steps.plain.read(bytes)?;
        let known = number != self.unknown && number.real().is_finite();
        Ok(known.then(|| number.real() * self.steps.unit))
    }

    fn write(&self, value: &Option<f64>, bytes: &mut [u8]) {
        let number = value.map_or(self.unknown, |value| {
            let number = N::of_real(value / self.steps.unit);
            if number == self.unknown { number.below() } else { number }
        });
        self.steps.plain.write(&number, bytes);
    }
}

/// One of several meanings.
#[derive(Clone, Copy)]
pub(crate) struct Codes<N, T> {
    plain: Plain<N>,
    read: fn(N) -> T,
    write: fn(&T) -> N,
}

impl<N: Number, T> Form<T> for Codes<N, T> {
    fn size(&self) -> usize {
        N::SIZE
    }

    fn read(&self, bytes: &[u8]) -> Result<T, BinaryFault> {
        Ok((self.read)(self.plain.read(bytes)?))
    }

    fn write(&self, value: &T, bytes: &mut [u8]) {
        self.plain.write(&(self.write)(value), bytes);
    }
}

/// Some bits of a byte, from the given one on.
#[derive(Clone, Copy)]
pub(crate) struct Bits<T> {
    from: u8,
    count: u8,
    read: fn(u8) -> T,
    write: fn(&T) -> u8,
}

/// One bit of a byte.
pub(crate) const fn bit(number: u8) -> Bits<bool> {
    bits(number, 1).codes(|raw| raw == 1, |value| u8::from(*value))
}

/// Some bits of a byte, from the given one on.
pub(crate) const fn bits(from: u8, count: u8) -> Bits<u8> {
    Bits { from, count, read: |raw| raw, write: |raw| *raw }
}

impl Bits<u8> {
    /// One of several meanings.
    pub(crate) const fn codes<T>(self, read: fn(u8) -> T, write: fn(&T) -> u8) -> Bits<T> {
        Bits { from: self.from, count: self.count, read, write }
    }
}

impl<T> Bits<T> {
    fn mask(&self) -> u8 {
        ((1_u16 << self.count) - 1) as u8
    }
}

impl<T> Form<T> for Bits<T> {
    fn size(&self) -> usize {
        1
    }

    fn read(&self, bytes: &[u8]) -> Result<T, BinaryFault> {
        let byte = bytes.first().ok_or(BinaryFault::Short { needed: 1, found: 0 })?;
        Ok((self.read)(byte >> self.from & self.mask()))
    }

    fn write(&self, value: &T, bytes: &mut [u8]) {
        if let Some(byte) = bytes.first_mut() {
            *byte |= ((self.write)(value) & self.mask()) << self.from;
        }
    }
}

/// Several fields of the same form one behind the other.
#[derive(Clone, Copy)]
pub(crate) struct Each<F>(pub(crate) F);

impl<T: Copy, F: Form<T>, const N: usize> Form<[T; N]> for Each<F> {
    fn size(&self) -> usize {
        N * self.0.size()
    }

    fn read(&self, bytes: &[u8]) -> Result<[T; N], BinaryFault> {
        let short = BinaryFault::Short { needed: Form::<[T; N]>::size(self), found: bytes.len() };
        let mut values = [None; N];
        for (at, value) in values.iter_mut().enumerate() {
            *value = Some(self.0.read(bytes.get(at * self.0.size()..).ok_or(short)?)?);
        }
        let all: Option<Vec<T>> = values.into_iter().collect();
        all.and_then(|all| all.try_into().ok()).ok_or(short)
    }

    fn write(&self, value: &[T; N], bytes: &mut [u8]) {
        for (own, bytes) in value.iter().zip(bytes.chunks_mut(self.0.size())) {
            self.0.write(own, bytes);
        }
    }
}

#[cfg(test)]
#[allow(unreachable_pub)] // a table makes a public struct
mod tests {
    use super::*;

    layout! {
        /// Every form.
        Sample, 24 bytes;
        /// A number.
        0 plain: u16 = le();
        /// A time, ns.
        2 time: i64 = le::<u16>().nanos(1_000_000);
        /// Three quantities.
        4 three: [f64; 3] = Each(le::<i16>().steps(0.01));
        /// One that may be unknown.
        10 maybe: Option<f64> = le::<u16>().unless(u16::MAX, 0.1);
        /// A flag.
        12 flag: bool = bit(0);
        /// Another part of the same byte.
        12 part: u8 = bits(4, 3);
        /// A number whose most significant byte is first.
        14 turned: u16 = be();
        /// An angle.
        16 angle: f64 = le::<f64>().steps(1.0).within(2.0, "angle");
    }

    const SAMPLE: Sample = Sample {
        plain: 0x1234,
        time: 7_000_000,
        three: [1.0, -2.0, 0.5],
        maybe: None,
        flag: true,
        part: 5,
        turned: 0x5678,
        angle: 1.5,
    };

    #[test]
    fn what_a_table_writes_it_reads_and_bytes_between_its_fields_are_zeros() {
        let bytes = SAMPLE.write_fields();
        assert_eq!(bytes[..14], [0x34, 0x12, 7, 0, 100, 0, 0x38, 0xFF, 50, 0, 0xFF, 0xFF, 0x51, 0]);
        assert_eq!(bytes[14..16], [0x56, 0x78]);
        assert_eq!(Sample::read_fields(&bytes), Ok(SAMPLE));
        assert_eq!(bytes.len(), 24);
    }

    #[test]
    fn bytes_that_end_early_and_values_beyond_their_limit_are_refused() {
        let bytes = SAMPLE.write_fields();
        for length in 0..24 {
            let short = BinaryFault::Short { needed: 24, found: length };
            assert_eq!(Sample::read_fields(&bytes[..length]), Err(short));
        }
        let beyond = Sample { angle: 2.5, ..SAMPLE };
        let fault = BinaryFault::Range { field: "angle" };
        assert_eq!(Sample::read_fields(&beyond.write_fields()), Err(fault));
    }

    #[test]
    fn a_value_that_would_say_unknown_is_written_below_it() {
        for (value, number) in [(Some(1e9), u16::MAX - 1), (Some(12.3), 123), (None, u16::MAX)] {
            let bytes = Sample { maybe: value, ..SAMPLE }.write_fields();
            assert_eq!(u16::from_le_bytes([bytes[10], bytes[11]]), number);
        }
    }
}
