//! Takes little-endian fields off the front of the contents of a message.

/// The bytes that are still to be read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bytes<'a>(pub(crate) &'a [u8]);

impl<'a> Bytes<'a> {
    /// The next bytes; `None`, and nothing is taken, if there are fewer.
    pub(crate) fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    /// An unsigned number of up to eight bytes.
    pub(crate) fn number(&mut self, bytes: usize) -> Option<u64> {
        Some(little_endian(self.take(bytes)?))
    }

    /// A byte.
    pub(crate) fn byte(&mut self) -> Option<u8> {
        self.take(1)?.first().copied()
    }

    /// A number of two bytes.
    pub(crate) fn word(&mut self) -> Option<u16> {
        self.number(2).map(|number| number as u16)
    }

    /// The number of a parameter group: three bytes.
    pub(crate) fn pgn(&mut self) -> Option<u32> {
        self.number(3).map(|number| number as u32)
    }
}

/// The number that these bytes are, the last the most significant. More than eight do not fit.
pub(crate) fn little_endian(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte))
}

/// The three bytes of the number of a parameter group.
pub(crate) fn pgn_bytes(pgn: u32) -> [u8; 3] {
    let [low, middle, high, _] = pgn.to_le_bytes();
    [low, middle, high]
}
