//! Fields of binary messages: a reader that never reads beyond the end, a writer, and why bytes are
//! refused.

use std::fmt;

/// Why the bytes of a binary frame are not the message that they should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BinaryFault {
    /// Not a frame of this protocol: start, length or checksum.
    Frame,
    /// A good frame of a message that is not read here.
    OtherMessage,
    /// The message ends before a field does.
    Short {
        /// Bytes that the field needs.
        needed: usize,
        /// Bytes that there are.
        found: usize,
    },
    /// A field is not in its range.
    Range {
        /// Name of the field as the protocol's document has it.
        field: &'static str,
    },
}

impl fmt::Display for BinaryFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BinaryFault::Frame => f.write_str("not a frame of this protocol"),
            BinaryFault::OtherMessage => f.write_str("another message than expected"),
            BinaryFault::Short { needed, found } => {
                write!(f, "{needed} bytes expected, {found} found")
            }
            BinaryFault::Range { field } => write!(f, "{field} is out of its range"),
        }
    }
}

impl std::error::Error for BinaryFault {}

/// Reads fields one after the other.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

/// One getter for each number: from little endian, from big endian.
macro_rules! getters {
    ($($little:ident $big:ident $number:ty;)*) => {$(
        #[doc = concat!("The next `", stringify!($number), "`, little endian.")]
        ///
        /// # Errors
        /// [`BinaryFault::Short`].
        pub fn $little(&mut self) -> Result<$number, BinaryFault> {
            Ok(<$number>::from_le_bytes(self.array()?))
        }
        #[doc = concat!("The next `", stringify!($number), "`, big endian.")]
        ///
        /// # Errors
        /// [`BinaryFault::Short`].
        pub fn $big(&mut self) -> Result<$number, BinaryFault> {
            Ok(<$number>::from_be_bytes(self.array()?))
        }
    )*};
}

impl<'a> Reader<'a> {
    /// A reader at the first byte.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        Reader { bytes, at: 0 }
    }

    /// The next bytes.
    ///
    /// # Errors
    /// [`BinaryFault::Short`].
    pub fn take(&mut self, length: usize) -> Result<&'a [u8], BinaryFault> {
        let short =
            BinaryFault::Short { needed: self.at.saturating_add(length), found: self.bytes.len() };
        let end = self.at.checked_add(length).ok_or(short)?;
        let taken = self.bytes.get(self.at..end).ok_or(short)?;
        self.at = end;
        Ok(taken)
    }

    /// The next bytes as an array.
    ///
    /// # Errors
    /// [`BinaryFault::Short`].
    pub fn array<const N: usize>(&mut self) -> Result<[u8; N], BinaryFault> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    /// The next byte.
    ///
    /// # Errors
    /// [`BinaryFault::Short`].
    pub fn u8(&mut self) -> Result<u8, BinaryFault> {
        Ok(self.array::<1>()?[0])
    }

    /// The next byte as a signed number.
    ///
    /// # Errors
    /// [`BinaryFault::Short`].
    pub fn i8(&mut self) -> Result<i8, BinaryFault> {
        Ok(i8::from_le_bytes(self.array()?))
    }

    getters! {
        le_u16 be_u16 u16;
        le_i16 be_i16 i16;
        le_u32 be_u32 u32;
        le_i32 be_i32 i32;
        le_u64 be_u64 u64;
        le_i64 be_i64 i64;
        le_f32 be_f32 f32;
        le_f64 be_f64 f64;
    }

    /// Bytes that are left.
    #[must_use]
    pub fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }
}

/// Appends fields one after the other.
#[derive(Clone, Debug, Default)]
pub struct Writer {
    bytes: Vec<u8>,
}

/// One method for each number: to little endian, to big endian.
macro_rules! putters {
    ($($little:ident $big:ident $number:ty;)*) => {$(
        #[doc = concat!("Appends a `", stringify!($number), "`, little endian.")]
        pub fn $little(&mut self, value: $number) -> &mut Self {
            self.put(&value.to_le_bytes())
        }
        #[doc = concat!("Appends a `", stringify!($number), "`, big endian.")]
        pub fn $big(&mut self, value: $number) -> &mut Self {
            self.put(&value.to_be_bytes())
        }
    )*};
}

impl Writer {
    /// A writer that has written nothing.
    #[must_use]
    pub fn new() -> Self {
        Writer::default()
    }

    /// Appends bytes.
    pub fn put(&mut self, bytes: &[u8]) -> &mut Self {
        self.bytes.extend_from_slice(bytes);
        self
    }

    /// Appends a byte.
    pub fn u8(&mut self, value: u8) -> &mut Self {
        self.put(&[value])
    }

    putters! {
        le_u16 be_u16 u16;
        le_i16 be_i16 i16;
        le_u32 be_u32 u32;
        le_i32 be_i32 i32;
        le_u64 be_u64 u64;
        le_i64 be_i64 i64;
        le_f32 be_f32 f32;
        le_f64 be_f64 f64;
    }

    /// What has been written so far.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// All that was written.
    #[must_use]
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }
}

/// `value / unit` as the nearest whole number of a field, which is saturated at its ends; NaN is zero.
#[must_use]
pub fn scaled(value: f64, unit: f64) -> i64 {
    (value / unit).round() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let mut writer = Writer::new();
        writer.u8(7).le_u16(0x1234).be_i32(-5).le_f64(1.5).be_f32(-0.25).put(b"end");
        let mut reader = Reader::new(writer.bytes());
        assert_eq!(reader.u8(), Ok(7));
        assert_eq!(reader.le_u16(), Ok(0x1234));
        assert_eq!(reader.be_i32(), Ok(-5));
        assert_eq!(reader.le_f64(), Ok(1.5));
        assert_eq!(reader.be_f32(), Ok(-0.25));
        assert_eq!(reader.rest(), b"end");
        assert_eq!(reader.be_u32(), Err(BinaryFault::Short { needed: 23, found: 22 }));
        assert_eq!(
            reader.take(usize::MAX),
            Err(BinaryFault::Short { needed: usize::MAX, found: 22 })
        );
    }
}
