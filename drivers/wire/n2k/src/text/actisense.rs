//! Actisense's "N2K ASCII": whole messages, fast packets put together.
//!
//! `A173321.107 23FF7 1F513 012F3070002F30709F`: time of day, source, destination and priority, parameter
//! group, contents (Actisense's description of the format for the W2K-1; canboatjs). What a gateway is to
//! send is written in the same form, without a time as canboatjs does; the gateway sends it from its own
//! address (canboat/canboat 271). From these descriptions, not verified against a device.

use crate::BusMessage;

use super::{LONGEST, digits, hex, is_number, packed};

/// Reads a line.
#[must_use]
pub fn parse(line: &[u8]) -> Option<BusMessage> {
    let text = std::str::from_utf8(line).ok()?;
    let mut words = text.split_ascii_whitespace();
    let time = words.next()?.strip_prefix('A')?;
    let (clock, decimals) = time.split_once('.')?;
    let way = words.next().filter(|way| way.len() == 5)?;
    let pgn = words.next().filter(|pgn| pgn.len() == 5)?;
    let data = packed(words.next().unwrap_or_default()).filter(|data| data.len() <= LONGEST)?;
    let good = clock.len() == 6 && is_number(clock) && is_number(decimals);
    if !good || words.next().is_some() {
        return None;
    }
    let [_, high, middle, low] = hex(way, 5)?.to_be_bytes();
    // five digits: source, destination, priority
    let source = high << 4 | middle >> 4;
    let destination = middle << 4 | low >> 4;
    let priority = Some(low & 0xF).filter(|priority| *priority <= 7)?;
    let pgn = hex(pgn, 5).filter(|pgn| *pgn <= 0x3_FFFF)?;
    Some(BusMessage { priority, pgn, source, destination, data })
}

/// A line with its end, without a time.
#[must_use]
pub fn write(message: &BusMessage) -> String {
    let BusMessage { priority, pgn, source, destination, data } = message;
    let data = digits(data, "");
    format!("A000000.000 {source:02X}{destination:02X}{priority} {pgn:05X} {data}\r\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_line_is_read() {
        let message = parse(b"A173321.107 23FF7 1F513 012F3070002F30709F\r\n").unwrap();
        let data = vec![0x01, 0x2F, 0x30, 0x70, 0x00, 0x2F, 0x30, 0x70, 0x9F];
        let expected =
            BusMessage { priority: 7, pgn: 128_275, source: 0x23, destination: 0xFF, data };
        assert_eq!(message, expected);
        assert_eq!(write(&expected), "A000000.000 23FF7 1F513 012F3070002F30709F\r\n");
    }

    #[test]
    fn other_lines_are_refused() {
        for line in [
            "",
            "A173321.107",
            "A173321.107 23FF7",
            "A17332.107 23FF7 1F513 01",
            "A173321 23FF7 1F513 01",
            "A173321.107 23FF8 1F513 01",
            "A173321.107 23FF7 4F513 01",
            "A173321.107 23FF7 1F513 012",
            "A173321.107 23FF7 1F513 01 02",
            "A173321.107 é3F7 1F513 01",
        ] {
            assert_eq!(parse(line.as_bytes()), None, "{line}");
        }
        let long = format!("A173321.107 23FF7 1F513 {}", "00".repeat(224));
        assert_eq!(parse(long.as_bytes()), None);
    }
}
