//! RLS: position and heading by a local position reference, CyScan or RadaScan.
//!
//! From the makers' manuals (Guidance Marine, `CyScan` installer's manual, `RadaScan` installation manual and `RadaScan View`
//! installer's manual, "DP message types", formats NMEA0183R and NMEA0183P, which differ in what is resolved, not in how it stands). The
//! address has neither a talker nor the letter of a maker's own sentences. Of the status word they say no more than that it has up to 16 bits.

use super::kinds::{Decimal, Field, STATUS, Turn};
use super::line::Composer;
use super::table::sentence;

const METRES: Decimal = Decimal::signed(2, 9999.99).width(3).with_sign();

/// Four hexadecimal digits.
const WORD: Field<u16> = Field { write: write_word, read: word_of };

sentence! {
    /// Where a vessel is in the axes of the targets ashore, and how she lies to them.
    own Rls "RLS", longest 44: Default;
    /// Along the axis A, m: north, where the targets were entered by northings and eastings.
    1 a: Option<f64> = METRES;
    /// Along the axis B, m: then east.
    2 b: Option<f64> = METRES;
    /// Whether the position is available.
    3 position_valid: bool = STATUS;
    /// Bearing of the vessel from the axis A, rad: then her true heading.
    4 bearing: Option<f64> = Turn::of(3).full_width();
    /// Whether the bearing is available.
    5 bearing_valid: bool = STATUS;
    /// Status word.
    6 status: Option<u16> = WORD;
}

fn write_word(line: &mut Composer, word: u16) {
    line.key(None);
    line.push_all(&[12, 8, 4, 0].map(|shift| b"0123456789ABCDEF"[usize::from(word >> shift & 15)]));
}

fn word_of(text: &str) -> Option<u16> {
    let plain = text.len() == 4 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    if plain { u16::from_str_radix(text, 16).ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nmea::Sentence;

    #[test]
    fn a_line_of_the_form_that_the_makers_print_is_read_and_written_to_the_byte() {
        let rls = Rls {
            a: Some(-12.34),
            b: Some(105.6),
            position_valid: true,
            bearing: Some(271.5_f64.to_radians()),
            bearing_valid: false,
            status: Some(0x00A1),
        };
        let line = rls.write();
        assert!(line.as_str().starts_with("$RLS,-012.34,+105.60,A,271.500,V,00A1*"), "{line:?}");
        assert_eq!(line.as_bytes().len(), 42);
        let (talker, read) = Sentence::read(line.as_bytes()).unwrap();
        assert_eq!(talker, None);
        assert_eq!(read.write(crate::nmea::Talker::IN), line);
    }
}
