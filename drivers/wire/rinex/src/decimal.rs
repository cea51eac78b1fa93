//! Numbers in columns: decimal fractions, whole numbers, seconds as nanoseconds, and exponents with D or E.
//!
//! A blank field is `Ok(None)`; what is no number is [`NoNumber`].

/// The text of a field is no number of the kind that belongs there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NoNumber;

/// Up to this all whole numbers are exact in f64.
const EXACT: u64 = 1 << 53;

const POWERS: [f64; 16] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// A decimal fraction as it stands: `digits / 10^decimals`.
struct Fraction {
    negative: bool,
    digits: u64,
    decimals: usize,
}

/// Reads digits with at most one point among them; the point may come first or last.
fn fraction(text: &[u8]) -> Result<Fraction, NoNumber> {
    let (negative, body) = match text {
        [b'-', body @ ..] => (true, body),
        [b'+', body @ ..] => (false, body),
        body => (false, body),
    };
    let (mut digits, mut count, mut point) = (0_u64, 0, None);
    for byte in body {
        match byte {
            b'0'..=b'9' => {
                let next =
                    digits.checked_mul(10).and_then(|d| d.checked_add(u64::from(byte - b'0')));
                digits = next.ok_or(NoNumber)?;
                count += 1;
            }
            b'.' if point.is_none() => point = Some(count),
            _ => return Err(NoNumber),
        }
    }
    if count == 0 {
        return Err(NoNumber);
    }
    Ok(Fraction { negative, digits, decimals: count - point.unwrap_or(count) })
}

/// A decimal fraction, correctly rounded.
pub(crate) fn decimal(field: &[u8]) -> Result<Option<f64>, NoNumber> {
    let text = field.trim_ascii();
    if text.is_empty() {
        return Ok(None);
    }
    let Fraction { negative, digits, decimals } = fraction(text)?;
    let power = POWERS.get(decimals).filter(|_| digits < EXACT).ok_or(NoNumber)?;
    // one division of exact numbers: rounded as the text itself would be
    let size = digits as f64 / power;
    Ok(Some(if negative { -size } else { size }))
}

/// A whole number.
pub(crate) fn whole(field: &[u8]) -> Result<Option<i64>, NoNumber> {
    let text = field.trim_ascii();
    if text.is_empty() {
        return Ok(None);
    }
    let Fraction { negative, digits, decimals } = fraction(text)?;
    let size = i64::try_from(digits).ok().filter(|_| decimals == 0).ok_or(NoNumber)?;
    Ok(Some(if negative { -size } else { size }))
}

/// Seconds with any number of decimals as nanoseconds; what is finer is rounded.
pub(crate) fn nanoseconds(field: &[u8]) -> Result<Option<i64>, NoNumber> {
    let text = field.trim_ascii();
    if text.is_empty() {
        return Ok(None);
    }
    let Fraction { negative, digits, decimals } = fraction(text)?;
    let power = |exponent: usize| u32::try_from(exponent).ok().and_then(|e| 10_u64.checked_pow(e));
    let nanos = if decimals <= 9 {
        power(9 - decimals).and_then(|power| digits.checked_mul(power))
    } else {
        power(decimals - 9).map(|power| digits / power + u64::from(digits % power >= power / 2))
    };
    let nanos = nanos.and_then(|nanos| i64::try_from(nanos).ok()).ok_or(NoNumber)?;
    Ok(Some(if negative { -nanos } else { nanos }))
}

/// A number with an exponent after D or E (D19.12), times a power of ten that goes into the exponent, so that
/// kilometres become metres without a rounding of their own.
pub(crate) fn scientific(field: &[u8], shift: i32) -> Result<Option<f64>, NoNumber> {
    let text = field.trim_ascii();
    if text.is_empty() {
        return Ok(None);
    }
    let mark = text.iter().position(|byte| b"DdEe".contains(byte)).unwrap_or(text.len());
    let (mantissa, exponent) = text.split_at(mark);
    fraction(mantissa)?;
    let exponent = match exponent {
        [] => 0,
        [_, digits @ ..] => whole(digits)?.ok_or(NoNumber)?,
    };
    let exponent =
        i32::try_from(exponent).ok().and_then(|e| e.checked_add(shift)).ok_or(NoNumber)?;
    // digits, a sign and a point only: always UTF-8
    let mantissa = str::from_utf8(mantissa).map_err(|_| NoNumber)?;
    let value: f64 = format!("{mantissa}e{exponent}").parse().map_err(|_| NoNumber)?;
    if value.is_finite() { Ok(Some(value)) } else { Err(NoNumber) }
}

/// Writes a number as D19.12 with thirteen digits, divided by ten to the power of `shift`; blank when there is none
/// or the format cannot hold it.
pub(crate) fn push_scientific(out: &mut String, value: Option<f64>, shift: i32) {
    let text =
        value.filter(|value| value.is_finite()).and_then(|value| exponent_form(value, shift));
    out.push_str(&format!("{:>19}", text.unwrap_or_default()));
}

/// As ` d.dddddddddddde+xx`; what is too small for two digits of exponent is zero, what is too large is nothing.
fn exponent_form(value: f64, shift: i32) -> Option<String> {
    let text = format!("{value:.12e}");
    let (mantissa, exponent) = text.split_once('e')?;
    let exponent = if value == 0.0 { 0 } else { exponent.parse::<i32>().ok()? - shift };
    match exponent {
        100.. => None,
        -99..100 => Some(format!("{mantissa}e{exponent:+03}")),
        _ => Some("0.000000000000e+00".to_owned()),
    }
}

/// Writes a number as F14.3; blank when there is none, when it is zero to three decimals, which RINEX reads as
/// nothing, or when the field is too narrow.
pub(crate) fn push_observation(out: &mut String, value: Option<f64>) {
    let start = out.len();
    if let Some(value) = value.filter(|value| value.is_finite() && value.abs() >= 0.000_5) {
        out.push_str(&format!("{value:14.3}"));
    }
    if out.len() != start + OBSERVATION {
        out.truncate(start);
        out.push_str(&" ".repeat(OBSERVATION));
    }
}

/// Columns of the number of an observation.
const OBSERVATION: usize = 14;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn numbers_are_read_as_fortran_writes_them() {
        assert_eq!(decimal(b"         .2840"), Ok(Some(0.284)));
        assert_eq!(decimal(b"  -.25000"), Ok(Some(-0.25)));
        assert_eq!(decimal(b" 123456789.507"), Ok(Some(123_456_789.507)));
        assert_eq!(decimal(b"   "), Ok(None));
        assert_eq!(scientific(b"-1.000000000000D-03", 0), Ok(Some(-0.001)));
        assert_eq!(scientific(b" .999999999999e+09", 0), Ok(Some(999_999_999.999)));
        assert_eq!(scientific(b" 1.090894238281e+04", 3), Ok(Some(10_908_942.382_81)));
        assert_eq!(scientific(b"12", 0), Ok(Some(12.0)));
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for text in ["1 2", "1.2.3", "-", ".", "nan", "inf", "1e5", "+-1", "**************", "1_0"]
        {
            assert_eq!(decimal(text.as_bytes()), Err(NoNumber), "{text}");
            assert_eq!(nanoseconds(text.as_bytes()), Err(NoNumber), "{text}");
        }
        for text in ["nan", "e5", "1e", "1e999", "1e1.5", "1e99999999999", "1e+"] {
            assert_eq!(scientific(text.as_bytes(), 3), Err(NoNumber), "{text}");
        }
    }

    #[test]
    fn seconds_keep_their_nanoseconds() {
        assert_eq!(nanoseconds(b" 30.0000000"), Ok(Some(30_000_000_000)));
        assert_eq!(nanoseconds(b"39.9980001"), Ok(Some(39_998_000_100)));
        assert_eq!(nanoseconds(b"0.123456789"), Ok(Some(123_456_789)));
        assert_eq!(nanoseconds(b"0.1234567894999"), Ok(Some(123_456_789)));
        assert_eq!(nanoseconds(b"0.1234567895"), Ok(Some(123_456_790)));
        assert_eq!(nanoseconds(b"0.99999999999999999999999"), Err(NoNumber));
    }

    #[test]
    fn an_observation_is_blank_where_the_format_has_no_room_for_it() {
        for value in [None, Some(0.0), Some(-0.000_4), Some(1e10), Some(-1e9), Some(f64::NAN)] {
            let mut out = "x".to_owned();
            push_observation(&mut out, value);
            assert_eq!(out, "x              ");
        }
    }

    proptest! {
        #[test]
        fn three_decimals_come_back_to_the_bit(thousandths in -999_999_999_999_i64..9_999_999_999_999) {
            let value = thousandths as f64 / 1000.0;
            let mut out = String::new();
            push_observation(&mut out, Some(value));
            prop_assert_eq!(out.len(), OBSERVATION);
            prop_assert_eq!(decimal(out.as_bytes()), Ok(Some(value).filter(|_| thousandths != 0)));
        }

        #[test]
        fn thirteen_digits_come_back_to_the_bit(
            digits in -9_999_999_999_999_i64..=9_999_999_999_999,
            exponent in -80_i32..60,
            shift in 0_i32..4,
        ) {
            let value: f64 = format!("{digits}e{exponent}").parse().unwrap();
            let mut out = String::new();
            push_scientific(&mut out, Some(value), shift);
            prop_assert_eq!(out.len(), 19);
            prop_assert_eq!(scientific(out.as_bytes(), shift), Ok(Some(value)));
        }

        #[test]
        fn any_number_once_written_stays_as_it_is(value: f64, shift in 0_i32..4) {
            let mut first = String::new();
            push_scientific(&mut first, Some(value), shift);
            prop_assert_eq!(first.len(), 19);
            let mut second = String::new();
            push_scientific(&mut second, scientific(first.as_bytes(), shift).unwrap(), shift);
            prop_assert_eq!(first, second);
        }

        #[test]
        fn no_text_makes_the_readers_panic(text: Vec<u8>) {
            let _ = (decimal(&text), whole(&text), nanoseconds(&text), scientific(&text, 3));
        }
    }
}
