//! Sentences as tables: a row for each value, from which struct, writer, reader and documentation follow.
//! Sentences whose fields depend on one another are written out by hand.

/// A sentence: `approved` by the standard, a maker's `own`, or a `part`, one of several under the same
/// address. After its name stand its address, the word in its first field if it has one, the bytes of the
/// longest with a ship's values, and what the struct derives beside the usual. Where one value
/// depends on another, methods make what is written of what is told, and what is told of what is read.
///
/// A row is the number of its first field, its name, type and kind, and what else there is to know:
/// - `lenient`: the sentence is good without it, one that is malformed is left out;
/// - `later`: older editions end before it; `too`: it came with the one before.
macro_rules! sentence {
    (
        $(#[doc = $about:literal])*
        $sort:ident $name:ident $address:literal $($word:literal)?, longest $longest:literal
            $(: $($derive:ident)+)? $(, written as $told:ident)? $(, read as $heard:ident)?;
        $(
            $(#[doc = $doc:literal])*
            $number:literal $field:ident: $type:ty = $kind:expr $(, $($how:ident)+)?;
        )*
    ) => {
        $(#[doc = $about])*
        ///
        /// | field | name | form |
        /// |---:|---|---|
        $(#[doc = concat!(
            "| ", $number, " | ", stringify!($field), " | `", stringify!($kind $(, $($how)+)?), "` |",
        )])*
        #[derive(Clone, Copy, Debug, PartialEq $($(, $derive)+)?)]
        pub struct $name {
            $($(#[doc = $doc])* pub $field: $type,)*
        }

        impl $name {
            /// Bytes of the longest sentence with a ship's values, CR LF included.
            pub const LONGEST: usize = $longest;

            pub(super) fn write_fields(&self, line: &mut $crate::nmea::line::Composer) {
                use $crate::nmea::kinds::Kind;
                let told = self $(.$told())?;
                $($kind.write(line, &told.$field);)*
            }

            #[allow(unused_assignments)] // most have no fields of later editions
            pub(super) fn read_fields(
                fields: &mut $crate::nmea::fields::Fields<'_>,
            ) -> Result<Self, $crate::nmea::fault::NmeaFault> {
                use $crate::nmea::kinds::Kind;
                let mut _later = true;
                $(
                    let $field: $type =
                        $crate::nmea::table::read!(fields, _later, $kind, $($($how)+)?)?;
                )*
                Ok($name { $($field),* } $(.$heard())?)
            }

            /// Any fields, as they stand in a line.
            #[cfg(test)]
            pub(crate) fn sample(
                dice: &mut $crate::nmea::kinds::samples::Dice,
            ) -> $crate::nmea::table::Sampled {
                use $crate::nmea::kinds::samples::text;
                let approved = if stringify!($sort) == "approved" { "IN" } else { "" };
                let start = format!("{approved}{}", concat!($address $(, ",", $word)?));
                $crate::nmea::table::Sampled { start, fields: vec![$(($number, text::<$type, _>(&$kind, dice))),*] }
            }
        }

        $crate::nmea::table::$sort! { $name $address $($word)? }
    };
}

/// Reads a row.
macro_rules! read {
    ($fields:ident, $later:ident, $kind:expr,) => {
        $kind.read($fields)
    };
    ($fields:ident, $later:ident, $kind:expr, lenient) => {
        $fields.optional(|own| $kind.read(own))
    };
    ($fields:ident, $later:ident, $kind:expr, later $($how:ident)?) => {{
        $later = $fields.has_more();
        $crate::nmea::table::read!($fields, $later, $kind, too $($how)?)
    }};
    ($fields:ident, $later:ident, $kind:expr, too $($how:ident)?) => {
        if $later {
            $crate::nmea::table::read!($fields, $later, $kind, $($how)?)
        } else {
            Ok(None)
        }
    };
}

/// A sentence of the standard.
macro_rules! approved {
    ($name:ident $formatter:literal) => {
        impl $name {
            /// The three letters after the talker.
            pub const FORMATTER: &'static str = $formatter;

            /// Writes the sentence.
            #[must_use]
            pub fn write(&self, talker: $crate::nmea::Talker) -> $crate::nmea::NmeaLine {
                $crate::nmea::NmeaLine::compose(talker, $formatter, |line| self.write_fields(line))
            }

            /// Reads the sentence.
            ///
            /// # Errors
            /// The first [`crate::nmea::NmeaFault`] of its fields.
            pub fn read(frame: &$crate::nmea::Frame<'_>) -> Result<Self, $crate::nmea::NmeaFault> {
                Self::read_fields(&mut frame.fields_of($formatter)?)
            }
        }
    };
}

/// A sentence of a maker.
macro_rules! own {
    ($name:ident $address:literal $($word:literal)?) => {
        impl $name {
            /// All before the first comma.
            pub const ADDRESS: &'static str = $address;

            /// Writes the sentence.
            #[must_use]
            pub fn write(&self) -> $crate::nmea::NmeaLine {
                $crate::nmea::NmeaLine::compose_own($address, |line| {
                    $(line.text($word);)?
                    self.write_fields(line);
                })
            }

            /// Reads the sentence.
            ///
            /// # Errors
            /// The first [`crate::nmea::NmeaFault`] of its fields.
            pub fn read(frame: &$crate::nmea::Frame<'_>) -> Result<Self, $crate::nmea::NmeaFault> {
                let mut fields = frame.fields_of_own($address)?;
                $(
                    if fields.text()? != $word {
                        return Err($crate::nmea::NmeaFault::OtherSentence);
                    }
                )?
                Self::read_fields(&mut fields)
            }
        }
    };
}

/// One of several sentences under the same address, told apart by a word; who has the address reads and
/// writes the word.
macro_rules! part {
    ($name:ident $address:literal $word:literal) => {
        impl $name {
            /// The word after the address.
            pub const NAME: &'static str = $word;
        }
    };
}

pub(super) use {approved, own, part, read, sentence};

/// Fields of a table as they stand in a line: what stands before them, and the number of the first and the
/// text of each value.
#[cfg(test)]
pub(crate) struct Sampled {
    pub(crate) start: String,
    pub(crate) fields: Vec<(u8, String)>,
}
