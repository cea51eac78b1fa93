//! Frames and messages as lines of text: what logs hold, and what gateways and adapters speak.
//!
//! | module | a line is | read | written |
//! |---|---|---|---|
//! | [`candump`] | a frame | logs, and what candump shows on a screen | logs |
//! | [`slcan`] | a frame, or an answer | by an adapter at a serial line (LAWICEL) | frames and commands |
//! | [`ydwg`] | a frame | by gateways of Yacht Devices ("RAW") | frames to be sent |
//! | [`actisense`] | a whole message | by gateways of Actisense ("N2K ASCII") | messages |
//! | [`canboat`] | a frame, or a whole message | logs of canboat ("PLAIN", "FAST") | both |
//!
//! A reader takes a line with or without its end, never panics, and gives `None` for all that is not a
//! line of its format: comments, remote frames, frames of CAN FD, whatever does not fit a CAN frame.

pub mod actisense;
pub mod canboat;
pub mod candump;
pub mod slcan;
pub mod ydwg;

use insd_base::{CanFrame, CanId};

/// Longest contents of a message: a fast packet.
const LONGEST: usize = 223;

/// The identifier of so many hexadecimal digits: three for 11 bits, eight for 29.
fn id(digits: &str) -> Option<CanId> {
    let number = hex(digits, 8)?;
    let id = match digits.len() {
        3 => CanId::Standard(u16::try_from(number).ok()?),
        8 => CanId::Extended(number),
        _ => return None,
    };
    id.is_valid().then_some(id)
}

/// A number of one to so many hexadecimal digits, without a sign.
fn hex(digits: &str, most: usize) -> Option<u32> {
    let plain = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    (plain && digits.len() <= most).then(|| u32::from_str_radix(digits, 16).ok()).flatten()
}

/// A decimal number, without a sign.
fn decimal<N: std::str::FromStr>(digits: &str) -> Option<N> {
    digits.bytes().all(|digit| digit.is_ascii_digit()).then(|| digits.parse().ok()).flatten()
}

/// Pairs of digits, one directly after the other.
fn packed(digits: &str) -> Option<Vec<u8>> {
    let digits = digits.as_bytes();
    let pairs = digits.chunks(2).map(|pair| byte(std::str::from_utf8(pair).ok()?));
    pairs.collect()
}

/// A byte of exactly two digits.
fn byte(digits: &str) -> Option<u8> {
    (digits.len() == 2).then(|| hex(digits, 2)).flatten().and_then(|byte| byte.try_into().ok())
}

/// A frame of an identifier and bytes that are words of two digits each.
fn spaced<'a>(id: CanId, words: impl Iterator<Item = &'a str>) -> Option<CanFrame> {
    let data: Vec<u8> = words.take(9).map(byte).collect::<Option<_>>()?;
    CanFrame::new(id, &data)
}

/// Bytes as pairs of digits with this between them.
fn digits(data: &[u8], between: &str) -> String {
    let pairs: Vec<String> = data.iter().map(|byte| format!("{byte:02X}")).collect();
    pairs.join(between)
}

/// Whether this is a time of day such as `16:29:27.082`, with any number of decimals or none.
fn is_clock(text: &str) -> bool {
    let mut parts = text.splitn(3, ':');
    let two = |part: Option<&str>| part.is_some_and(|part| part.len() == 2 && is_number(part));
    let hours = two(parts.next()) && two(parts.next());
    let seconds = parts.next().unwrap_or_default();
    let (whole, decimals) = seconds.split_once('.').unwrap_or((seconds, "0"));
    hours && two(Some(whole)) && is_number(decimals)
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|digit| digit.is_ascii_digit())
}
