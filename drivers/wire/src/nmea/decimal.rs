//! Decimal numbers of fixed length, both ways.

/// Form of a numeric field.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Form {
    /// Digits after the point.
    pub(crate) decimals: u8,
    /// Least number of digits before the point.
    pub(crate) width: u8,
    /// Greatest magnitude that the field can carry; beyond it the value is unknown.
    pub(crate) limit: f64,
}

/// Powers of ten that occur as scales.
pub(crate) fn power_of_ten(exponent: u8) -> i64 {
    10_i64.pow(u32::from(exponent.min(9)))
}

/// `value` times 10^`decimals`, rounded half away from zero; `None` if it is not finite or its
/// magnitude exceeds `limit`.
pub(crate) fn scaled(value: f64, decimals: u8, limit: f64) -> Option<i64> {
    let fits = value.abs() <= limit;
    fits.then(|| (value * power_of_ten(decimals) as f64).round() as i64)
}

/// The value of `[+-]digits[.digits]`, without exponent, infinity or NaN; one digit at least.
pub(crate) fn parse(text: &str) -> Option<f64> {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    let plain = digits.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    let some = digits.bytes().any(|b| b.is_ascii_digit());
    if plain && some && text.len() <= 24 { text.parse().ok() } else { None }
}

/// The value of a string of digits.
pub(crate) fn parse_digits(text: &str) -> Option<u32> {
    let plain = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    if plain { text.parse().ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_plain_decimals_are_numbers() {
        for (text, value) in [("0", 0.0), ("-1.5", -1.5), ("+2", 2.0), ("328.", 328.0), (".5", 0.5)]
        {
            assert_eq!(parse(text), Some(value), "{text}");
        }
        for text in ["", "-", ".", "1e5", "inf", "NaN", "1.2.3", " 1", "--1", "0x1"] {
            assert_eq!(parse(text), None, "{text}");
        }
    }

    #[test]
    fn what_is_not_a_number_is_unknown() {
        assert_eq!(scaled(f64::NAN, 2, 1e6), None);
        assert_eq!(scaled(f64::NEG_INFINITY, 2, 1e6), None);
        assert_eq!(scaled(1e7, 2, 1e6), None);
        assert_eq!(scaled(-12.345, 2, 1e6), Some(-1235));
    }
}
