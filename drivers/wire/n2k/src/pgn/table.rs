//! Groups as tables: a row for each field, from which type, reader, writer and documentation follow.

/// A group: its struct and its [`super::Group`]. Its head is number, name, what the struct derives beside
/// the usual, priority and interval where nothing else is said, and how many bytes say something at least.
/// A row is the field's first bit, its name, type and kind, and how many reserved bits stand behind it.
macro_rules! group {
    (
        $(#[doc = $about:literal])*
        $pgn:literal $name:ident $(: $($derive:ident)+)?, priority $priority:literal,
            every $interval:expr, least $least:literal;
        $(
            $(#[doc = $doc:literal])*
            $at:literal $field:ident: $type:ty = $kind:expr $(, reserved $gap:literal)?;
        )*
    ) => {
        $(#[doc = $about])*
        ///
        /// | bit | field | kind |
        /// |---:|---|---|
        $(#[doc = concat!("| ", $at, " | ", stringify!($field), " | ", stringify!($kind), " |")])*
        #[derive(Clone, Debug, PartialEq $($(, $derive)+)?)]
        pub struct $name {
            $($(#[doc = $doc])* pub $field: $type,)*
        }

        impl super::Group for $name {
            const PGN: u32 = $pgn;
            const PRIORITY: u8 = $priority;
            const INTERVAL: Option<insd_base::Span> = $interval;

            fn read(data: &[u8]) -> Result<Self, super::Short> {
                use super::kinds::Kind;
                let mut fields = super::bits::Reader::new(data, $least)?;
                $(
                    let $field: $type = $kind.read(&mut fields);
                    $(fields.skip($gap);)?
                )*
                Ok($name { $($field),* })
            }

            fn write(&self) -> Vec<u8> {
                use super::kinds::Kind;
                let mut fields = super::bits::Writer::default();
                $(
                    $kind.write(&mut fields, &self.$field);
                    $(fields.reserved($gap);)?
                )*
                fields.done()
            }
        }

        impl $name {
            /// What its fields are, in their order.
            #[must_use]
            pub fn rows() -> Vec<super::Row> {
                use super::kinds::Kind;
                vec![$(super::Row {
                    at: $at,
                    bits: $kind.bits(),
                    reserved: 0 $(+ $gap)?,
                    field: stringify!($field),
                    form: $kind.form(),
                    about: concat!($($doc),*).trim(),
                }),*]
            }
        }
    };
}

/// A list of named numbers, in their order from 0: the enum, and the kind of its field. With `..Other`
/// a number that has no name is kept; else it reads as unknown.
macro_rules! codes {
    (
        $(#[$attribute:meta])*
        $name:ident as $kind:ident, $bits:literal bits;
        $($(#[$doc:meta])* $code:ident,)*
        $(.. $other:ident)?
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name {
            $($(#[$doc])* $code,)*
            $(
                /// Another number, as it stands.
                $other(u8),
            )?
        }

        #[doc = concat!("One of [`", stringify!($name), "`], by its number.")]
        pub(super) const $kind: super::kinds::Choice<$name> =
            super::kinds::Choice::new($bits, &[$($name::$code),*])
                $(.or(|number| Some($name::$other(number)), |code| match code {
                    $name::$other(number) => Some(number),
                    _ => None,
                }))?;
    };
}

pub(super) use {codes, group};

/// A field of a group's contents, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its first bit, from the least significant of the first byte.
    pub at: u32,
    /// How many bits it has.
    pub bits: u32,
    /// How many reserved bits stand behind it.
    pub reserved: u32,
    /// Its name in the struct.
    pub field: &'static str,
    /// Its bits, its unit and steps, or its codes.
    pub form: String,
    /// What it is.
    pub about: &'static str,
}
