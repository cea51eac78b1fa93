//! Numbers as decimal text with a fixed number of places: fast, and the same bytes everywhere.

use insd_base::Time;

const POWERS: [f64; 13] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];
/// Integers up to this are exact in an f64.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// Whether trailing zeros are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zeros {
    /// `1.500`
    Kept,
    /// `1.5`
    Trimmed,
}

/// Appends a value with `places` (up to 12) decimal places. What is not finite is left empty.
pub(super) fn push_fixed(text: &mut Vec<u8>, value: f64, places: usize, zeros: Zeros) {
    if !value.is_finite() {
        return;
    }
    let scaled = (value * POWERS[places]).round();
    if scaled.abs() < EXACT {
        push_scaled(text, scaled as i64, places, zeros);
    } else {
        text.extend_from_slice(format!("{value:.places$}").as_bytes());
    }
}

/// Appends a time in seconds, exactly.
pub(super) fn push_time(text: &mut Vec<u8>, time: Time) {
    push_scaled(text, time.as_nanos(), 9, Zeros::Trimmed);
}

/// Appends `value` / 10^`places`.
fn push_scaled(text: &mut Vec<u8>, value: i64, places: usize, zeros: Zeros) {
    let mut digits = [b'0'; 24];
    let mut at = digits.len();
    let mut rest = value.unsigned_abs();
    while rest > 0 || at > digits.len() - places - 1 {
        at -= 1;
        digits[at] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    let (whole, fraction) = digits[at..].split_at(digits.len() - at - places);
    let used = match zeros {
        Zeros::Kept => places,
        Zeros::Trimmed => fraction.iter().rposition(|digit| *digit != b'0').map_or(0, |i| i + 1),
    };
    if value < 0 {
        text.push(b'-');
    }
    text.extend_from_slice(whole);
    if used > 0 {
        text.push(b'.');
        text.extend_from_slice(&fraction[..used]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn fixed(value: f64, places: usize, zeros: Zeros) -> String {
        let mut text = Vec::new();
        push_fixed(&mut text, value, places, zeros);
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn places_signs_and_zeros_are_as_expected() {
        assert_eq!(fixed(-0.05, 3, Zeros::Kept), "-0.050");
        assert_eq!(fixed(-0.05, 3, Zeros::Trimmed), "-0.05");
        assert_eq!(fixed(-0.0001, 3, Zeros::Kept), "0.000");
        assert_eq!(fixed(12.0, 3, Zeros::Trimmed), "12");
        assert_eq!(fixed(1e300, 0, Zeros::Kept).len(), 301);
        assert_eq!(fixed(f64::NAN, 3, Zeros::Kept), "");
    }

    #[test]
    fn times_are_exact_to_the_nanosecond() {
        let mut text = Vec::new();
        push_time(&mut text, Time::from_nanos(-1_000_000_001));
        assert_eq!(text, b"-1.000000001");
    }

    proptest! {
        #[test]
        fn the_text_is_the_value_to_half_a_last_place(value in -1e6..1e6_f64, places in 0..9_usize) {
            let back: f64 = fixed(value, places, Zeros::Trimmed).parse().unwrap();
            prop_assert!((back - value).abs() <= 0.500_001 * 10_f64.powi(-(places as i32)) + 1e-9);
        }
    }
}
