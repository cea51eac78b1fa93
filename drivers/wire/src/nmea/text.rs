//! Text in a field, whose reserved characters are written as `^` and two hexadecimal digits.
//!
//! Reserved are `!` `$` `*` `,` `\` `^` `~` and all that is not printable ASCII: `^2C` is a comma. The
//! two digits are those of ISO 8859-1. (IEC 61162-1; the table of reserved characters as public pages
//! of receivers' makers print it. No device is known here that sends one.)
//!
//! A reader takes reserved characters as they stand too, but for `^`. Control characters are refused
//! in either form, as they would do harm where the text is shown.

use std::fmt;

use super::line::Composer;

/// A text of at most `N` characters, each of ISO 8859-1 and none of them a control character.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Text<const N: usize> {
    bytes: [u8; N],
    len: usize,
}

impl<const N: usize> Text<N> {
    /// A text; `None` if it is too long or has a character that cannot be written.
    #[must_use]
    pub fn new(text: &str) -> Option<Self> {
        let mut own = Text::default();
        text.chars().try_for_each(|c| own.push(u8::try_from(c).ok()?))?;
        Some(own)
    }

    /// Whether it has no character.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// How many characters it has.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Its characters.
    pub fn chars(&self) -> impl Iterator<Item = char> {
        self.bytes.iter().take(self.len).map(|byte| char::from(*byte))
    }

    /// The text of a field.
    pub(crate) fn read(field: &str) -> Option<Self> {
        let mut own = Text::default();
        let mut rest = field.as_bytes();
        while let [byte, tail @ ..] = rest {
            let (byte, tail) = match (byte, tail) {
                (b'^', [high, low, tail @ ..]) => {
                    (hexadecimal(*high)? << 4 | hexadecimal(*low)?, tail)
                }
                (b'^', _) => return None,
                _ => (*byte, tail),
            };
            own.push(byte)?;
            rest = tail;
        }
        Some(own)
    }

    fn push(&mut self, byte: u8) -> Option<()> {
        let place = self.bytes.get_mut(self.len).filter(|_| is_shown(byte))?;
        *place = byte;
        self.len += 1;
        Some(())
    }
}

impl<const N: usize> Default for Text<N> {
    fn default() -> Self {
        Text { bytes: [0; N], len: 0 }
    }
}

impl<const N: usize> fmt::Display for Text<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.chars().try_for_each(|c| write!(f, "{c}"))
    }
}

impl<const N: usize> fmt::Debug for Text<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.to_string())
    }
}

impl Composer {
    /// A text as one field.
    pub(crate) fn escaped<const N: usize>(&mut self, text: &Text<N>) {
        self.empty();
        text.chars().for_each(|c| self.push_all(escape(c).as_bytes()));
    }

    /// A text as the last field; what does not fit is left out, from one character on.
    pub(crate) fn escaped_last<const N: usize>(&mut self, text: &Text<N>) {
        self.empty();
        for escaped in text.chars().map(escape) {
            if escaped.len() > self.room() {
                return;
            }
            self.push_all(escaped.as_bytes());
        }
    }
}

/// A character as it stands in a line.
pub(crate) fn escape(character: char) -> String {
    match character {
        '!' | '$' | '*' | ',' | '\\' | '^' | '~' => format!("^{:02X}", u32::from(character)),
        ' '..='~' => character.to_string(),
        _ => format!("^{:02X}", u32::from(character)),
    }
}

/// Whether a character of ISO 8859-1 is none of the control characters.
fn is_shown(byte: u8) -> bool {
    matches!(byte, b' '..=b'~' | 0xA0..)
}

fn hexadecimal(digit: u8) -> Option<u8> {
    char::from(digit).to_digit(16).and_then(|digit| u8::try_from(digit).ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nmea::{NmeaLine, Talker};

    #[test]
    fn reserved_characters_are_escaped_and_come_back() {
        let text = Text::<16>::new("5 > 4, 3° \\ ^!").unwrap();
        let line = NmeaLine::compose(Talker::IN, "XXX", |line| line.escaped(&text));
        assert_eq!(line.as_str(), "$INXXX,5 > 4^2C 3^B0 ^5C ^5E^21*07");
        assert_eq!(Text::read("5 > 4^2C 3^B0 ^5C ^5e^21"), Some(text));
        assert_eq!(text.to_string(), "5 > 4, 3° \\ ^!");
    }

    #[test]
    fn what_cannot_be_written_is_no_text() {
        for text in ["seventeen letters", "tab\t", "\u{2014}", "\u{85}"] {
            assert_eq!(Text::<16>::new(text), None, "{text:?}");
        }
        for field in ["^", "^2", "^2G", "^0D", "^7F", "seventeen letters"] {
            assert_eq!(Text::<16>::read(field), None, "{field}");
        }
    }

    #[test]
    fn the_last_text_of_a_line_is_cut_after_a_whole_character() {
        let text = Text::<90>::new(&format!("{},,", "x".repeat(66))).unwrap();
        let line = NmeaLine::compose(Talker::IN, "XXX", |line| line.escaped_last(&text));
        assert!(line.as_str().contains("xx^2C*"), "{line:?}");
        assert_eq!(line.as_bytes().len(), 81);
    }
}
