//! The checksum of sentences and TAG blocks.

/// Exclusive or of all bytes, as between `$` and `*`.
#[must_use]
pub fn checksum(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0, |sum, byte| sum ^ byte)
}

/// The checksum that two hexadecimal digits state.
pub(crate) fn stated_checksum(digits: &[u8]) -> Option<u8> {
    match digits {
        [high, low] => Some(hex(*high)? << 4 | hex(*low)?),
        _ => None,
    }
}

fn hex(byte: u8) -> Option<u8> {
    (byte as char).to_digit(16).and_then(|digit| u8::try_from(digit).ok())
}
