//! Lines of can-utils' candump: the log that `candump -l` and `-L` write, and what it shows on a screen.
//!
//! Log: `(1436509052.249713) can0 09F11201#FF8E3B00007FFFFD`, in newer versions with ` R` or ` T` at the
//! end for received and sent (`candump.c`, `lib.c` of linux-can/can-utils, and logs of canboat). Screen:
//! `can0  09F8017F   [8]  E8 AC 51 19 BE AB 6D D5`.

use insd_base::{CanFrame, UtcTime};

use super::{id, is_number, packed, spaced};

/// A line of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line<'a> {
    /// When the kernel had the frame; a screen does not say.
    pub time: Option<UtcTime>,
    /// The interface it came by.
    pub interface: &'a str,
    /// Whether the computer that logged it had sent it.
    pub sent: bool,
    /// The frame.
    pub frame: CanFrame,
}

/// Reads a line of either form.
#[must_use]
pub fn parse(line: &[u8]) -> Option<Line<'_>> {
    let text = std::str::from_utf8(line).ok()?.trim();
    let mut words = text.split_ascii_whitespace();
    if text.starts_with('(') { log(&mut words) } else { screen(&mut words) }
}

fn log<'a>(words: &mut impl Iterator<Item = &'a str>) -> Option<Line<'a>> {
    let time = words.next()?.strip_prefix('(')?.strip_suffix(')')?;
    let time = Some(seconds(time)?);
    let interface = words.next()?;
    let (digits, data) = words.next()?.split_once('#')?;
    let frame = CanFrame::new(id(digits)?, &packed(data)?)?;
    let sent = match words.next() {
        None | Some("R") => false,
        Some("T") => true,
        Some(_) => return None,
    };
    words.next().is_none().then_some(Line { time, interface, sent, frame })
}

fn screen<'a>(words: &mut impl Iterator<Item = &'a str>) -> Option<Line<'a>> {
    let interface = words.next()?;
    let id = id(words.next()?)?;
    let length = words.next()?.strip_prefix('[')?.strip_suffix(']')?;
    let frame = spaced(id, words)?;
    let fits = length.parse() == Ok(frame.data().len());
    fits.then_some(Line { time: None, interface, sent: false, frame })
}

/// Seconds and microseconds since 1970, or since the start of something.
fn seconds(text: &str) -> Option<UtcTime> {
    let (whole, decimals) = text.split_once('.')?;
    if !is_number(whole) || !is_number(decimals) || decimals.len() > 9 {
        return None;
    }
    let nanos = decimals.parse::<i64>().ok()? * 10_i64.pow(9 - decimals.len() as u32);
    let whole = whole.parse::<i64>().ok()?.checked_mul(1_000_000_000)?;
    whole.checked_add(nanos).map(UtcTime::from_nanos)
}

/// A line of a log with its end. The time is cut to microseconds; what is before 1970 is 1970.
#[must_use]
pub fn write(time: UtcTime, interface: &str, frame: &CanFrame) -> String {
    let micros = time.as_nanos().max(0) / 1000;
    let (seconds, micros) = (micros / 1_000_000, micros % 1_000_000);
    let data = super::digits(frame.data(), "");
    format!("({seconds:010}.{micros:06}) {interface} {}#{data}\n", frame.id())
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::CanId;

    #[test]
    fn published_lines_are_read() {
        let line = parse(b"(1436509052.249713) vcan0 044#2A366C2BBA\n").unwrap();
        assert_eq!(line.time, Some(UtcTime::from_nanos(1_436_509_052_249_713_000)));
        assert_eq!((line.interface, line.sent), ("vcan0", false));
        let data = [0x2A, 0x36, 0x6C, 0x2B, 0xBA];
        assert_eq!(Some(line.frame), CanFrame::new(CanId::Standard(0x44), &data));
        let shown = parse(b"  can0  09F8017F   [8]  E8 AC 51 19 BE AB 6D D5").unwrap();
        assert_eq!(shown.frame.id(), CanId::Extended(0x09F8_017F));
        assert!(parse(b"(0.5) can0 123# T").unwrap().sent);
    }

    #[test]
    fn what_is_no_data_frame_of_classic_can_is_refused() {
        for line in [
            "(1.0) can0 123#R",
            "(1.0) can0 123##1112233",
            "(1.0) can0 20000004#0004000000000000",
            "(1.0) can0 123#1",
            "(1.0) can0 123#112233445566778899",
            "(1.0) can0 1234#11",
            "(1.0) can0 +23#11",
            "(1) can0 123#11",
            "(-1.0) can0 123#11",
            "(99999999999999999999.0) can0 123#11",
            "(1.0) can0",
            "# a comment",
            "can0 123 [2] 11",
            "can0 123 [8] remote request",
            "",
        ] {
            assert_eq!(parse(line.as_bytes()), None, "{line}");
        }
        assert_eq!(parse(&[0xFF, 0xFE]), None);
    }
}
