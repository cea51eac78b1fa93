//! Texts in messages: of fixed length, filled up, and of variable length with a head of two bytes.

use crate::bytes::Bytes;

/// The longest text of variable length that is written, bytes without its head. Three of them fit in
/// a fast packet.
pub const LONGEST_TEXT: usize = 70;

/// What fills the rest of a text of fixed length.
const PADDING: u8 = 0xFF;

/// Reads a text of variable length: its length with the head of two bytes, its encoding (1 ASCII, 0
/// UTF-16), its characters. `None` if it does not fit in what there is. Padding is no text, nor is a
/// text of any other encoding.
pub(crate) fn take_text(bytes: &mut Bytes<'_>) -> Option<String> {
    let length = usize::from(bytes.byte()?);
    let encoding = bytes.byte()?;
    let body = bytes.take(length.checked_sub(2)?)?;
    Some(match encoding {
        1 => plain(body),
        0 => {
            let units = body.chunks_exact(2).map(|pair| crate::bytes::little_endian(pair) as u16);
            let wanted: Vec<u16> = units.take_while(|unit| *unit != 0 && *unit != 0xFFFF).collect();
            String::from_utf16_lossy(&wanted)
        }
        _ => String::new(),
    })
}

/// The text of variable length at the beginning of these bytes.
#[must_use]
pub fn read_text(data: &[u8]) -> Option<String> {
    take_text(&mut Bytes(data))
}

/// Appends a text of variable length, cut to [`LONGEST_TEXT`]; UTF-16 if it is not all ASCII.
pub(crate) fn write_text(data: &mut Vec<u8>, text: &str) {
    let body: Vec<u8> = if text.is_ascii() {
        text.bytes().take(LONGEST_TEXT).collect()
    } else {
        let mut units = Vec::new();
        for character in text.chars() {
            let mut buffer = [0; 2];
            let encoded = character.encode_utf16(&mut buffer);
            if (units.len() + encoded.len()) * 2 > LONGEST_TEXT {
                break;
            }
            units.extend_from_slice(encoded);
        }
        units.into_iter().flat_map(u16::to_le_bytes).collect()
    };
    data.push(body.len() as u8 + 2);
    data.push(u8::from(text.is_ascii()));
    data.extend(body);
}

/// The text of a field of fixed length: up to the padding, without blanks at its end.
pub(crate) fn plain(field: &[u8]) -> String {
    let end = field.iter().position(|byte| matches!(*byte, 0 | PADDING)).unwrap_or(field.len());
    let text = String::from_utf8_lossy(field.get(..end).unwrap_or(field));
    text.trim_end().to_owned()
}

/// A field of `length` bytes with this text, filled up; what is not ASCII becomes a question mark.
pub(crate) fn padded(text: &str, length: usize) -> Vec<u8> {
    let ascii = text.chars().map(|c| if c.is_ascii() { c as u8 } else { b'?' });
    let mut field: Vec<u8> = ascii.take(length).collect();
    field.resize(length, PADDING);
    field
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_survive_the_round_trip_and_are_cut() {
        for text in ["", "bridge, starboard", "Brücke"] {
            let mut data = Vec::new();
            write_text(&mut data, text);
            assert_eq!(read_text(&data).as_deref(), Some(text));
        }
        for long in ["x".repeat(200), "ü".repeat(200), "\u{1F6A2}".repeat(50)] {
            let mut data = Vec::new();
            write_text(&mut data, &long);
            assert!(data.len() <= 72);
            assert!(long.starts_with(&read_text(&data).unwrap()));
        }
    }

    #[test]
    fn broken_texts_are_no_texts() {
        assert_eq!(read_text(&[]), None);
        assert_eq!(read_text(&[1, 1]), None, "shorter than its head");
        assert_eq!(read_text(&[5, 1, b'a']), None, "longer than what there is");
        assert_eq!(read_text(&[4, 0xFF, 0xFF, 0xFF]).as_deref(), Some(""), "as Navico writes it");
    }

    #[test]
    fn fields_of_fixed_length_are_filled_up() {
        assert_eq!(padded("ab", 4), [b'a', b'b', 255, 255]);
        assert_eq!(padded("abcdef", 4), b"abcd");
        assert_eq!(plain(b"ab \xFF\xFF"), "ab");
        assert_eq!(plain(b"ab\0cd"), "ab");
    }
}
