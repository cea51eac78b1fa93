//! Pieces that several makers' sentences share.

use insd_base::units::wrap_two_pi;

use super::decimal::{Form, power_of_ten};
use super::fault::NmeaFault;
use super::fields::Fields;
use super::line::Composer;

/// Writes an angle as degrees.
pub(super) fn degrees(line: &mut Composer, angle: Option<f64>, form: Form) {
    line.number(angle.map(f64::to_degrees), form);
}

/// Writes an angle as degrees with its sign always shown.
pub(super) fn degrees_with_sign(line: &mut Composer, angle: Option<f64>, form: Form) {
    line.with_sign(angle.map(f64::to_degrees), form);
}

/// Writes an angle of any number of turns as degrees in [0, 360), also after rounding, with leading
/// zeros.
pub(super) fn heading(line: &mut Composer, angle: Option<f64>, form: Form) {
    let degrees = angle.map(|angle| rounded(wrap_two_pi(angle).to_degrees(), form.decimals));
    line.number(degrees.map(|degrees| if degrees >= 360.0 { 0.0 } else { degrees }), form);
}

/// Writes a magnitude and the letter of its sign, the positive one first; what rounds to zero is
/// positive. Both are empty if unknown.
pub(super) fn lettered(line: &mut Composer, value: Option<f64>, form: Form, letters: [u8; 2]) {
    line.signed(value.map(|value| rounded(value, form.decimals)), form, letters);
}

/// Writes a status word as eight hexadecimal digits.
pub(super) fn word(line: &mut Composer, word: Option<u32>) {
    line.key(None);
    if let Some(word) = word {
        let digit = |shift: u32| b"0123456789ABCDEF"[(word >> shift & 15) as usize];
        line.push_all(&[28, 24, 20, 16, 12, 8, 4, 0].map(digit));
    }
}

/// The value that a number of so many decimals stands for; never a negative zero.
fn rounded(value: f64, decimals: u8) -> f64 {
    let scale = power_of_ten(decimals) as f64;
    (value * scale).round() / scale + 0.0
}

/// The other direction.
pub(super) fn negated(value: Option<f64>) -> Option<f64> {
    value.map(|value| -value)
}

/// Reads an angle of at most so many degrees either way, rad.
pub(super) fn read_degrees(fields: &mut Fields<'_>, limit: f64) -> Result<Option<f64>, NmeaFault> {
    Ok(fields.number_in(-limit..=limit)?.map(f64::to_radians))
}

/// Reads a number of at most so much either way.
pub(super) fn read_within(fields: &mut Fields<'_>, limit: f64) -> Result<Option<f64>, NmeaFault> {
    fields.number_in(-limit..=limit)
}

/// Reads a status word.
pub(super) fn read_word(fields: &mut Fields<'_>) -> Result<Option<u32>, NmeaFault> {
    fields.convert(word_of)
}

/// The word of one to eight hexadecimal digits.
pub(super) fn word_of(text: &str) -> Option<u32> {
    let plain = text.len() <= 8 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    if plain { u32::from_str_radix(text, 16).ok() } else { None }
}

/// The letter of a text that is one.
pub(crate) fn letter_of(text: &str) -> Option<u8> {
    match text.as_bytes() {
        [letter] => Some(*letter),
        _ => None,
    }
}
