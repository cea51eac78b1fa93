//! The RAW format of gateways of Yacht Devices (YDWG-02, YDEN-02).
//!
//! The gateway writes `17:33:21.107 R 19F51323 01 2F 30 70 00 2F 30 70` for a frame received and the same
//! with `T` for one that it has sent for us; what it is to send is written without time and direction
//! (manual of the YDWG-02, appendix E; checked on logs of canboat). Frames of the bus have 29 bits. By the
//! reports of users (SignalK/signalk-server 1466, 2045) it claims an address of its own and sends all from
//! there, whatever source a frame names; writing was not verified against a device.

use insd_base::{CanFrame, CanId};

use super::{digits, id, is_clock, spaced};

/// A line of a gateway.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    /// Whether the gateway says that it has sent the frame.
    pub sent: bool,
    /// The frame.
    pub frame: CanFrame,
}

/// Reads a line of a gateway.
#[must_use]
pub fn parse(line: &[u8]) -> Option<Line> {
    let text = std::str::from_utf8(line).ok()?;
    let mut words = text.split_ascii_whitespace();
    if !is_clock(words.next()?) {
        return None;
    }
    let sent = match words.next()? {
        "R" => false,
        "T" => true,
        _ => return None,
    };
    Some(Line { sent, frame: frame(&mut words)? })
}

fn frame<'a>(words: &mut impl Iterator<Item = &'a str>) -> Option<CanFrame> {
    let id = id(words.next()?).filter(|id| matches!(id, CanId::Extended(_)))?;
    spaced(id, words)
}

/// The line that asks a gateway to send a frame, with its end; `None` for a frame with 11 bits.
#[must_use]
pub fn write(frame: &CanFrame) -> Option<String> {
    let CanId::Extended(id) = frame.id() else { return None };
    let data = digits(frame.data(), " ");
    let space = if data.is_empty() { "" } else { " " };
    Some(format!("{id:08X}{space}{data}\r\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_lines_are_read() {
        let line = parse(b"16:29:27.082 R 09F8017F 50 C3 B8 13 47 D8 2B C6\r\n").unwrap();
        let data = [0x50, 0xC3, 0xB8, 0x13, 0x47, 0xD8, 0x2B, 0xC6];
        let frame = CanFrame::new(CanId::Extended(0x09F8_017F), &data);
        assert_eq!((line.sent, Some(line.frame)), (false, frame));
        let sent = parse(b"17:33:21.108 T 19F51323 01 02").unwrap();
        assert_eq!(write(&sent.frame).unwrap(), "19F51323 01 02\r\n");
        assert!(sent.sent);
    }

    #[test]
    fn other_lines_are_refused() {
        for line in [
            "",
            "16:29:27.082",
            "16:29:27.082 R",
            "16:29:27.082 X 09F8017F 50",
            "16:29:27.082 R 123 50",
            "16:29:27.082 R 09F8017F 5",
            "16:29:27.082 R 09F8017F 1 2 3 4 5 6 7 8",
            "16:29:27.082 R 09F8017F 01 02 03 04 05 06 07 08 09",
            "16-29-27.082 R 09F8017F 50",
            "1:29:27.082 R 09F8017F 50",
            "09F8017F 50 C3",
        ] {
            assert_eq!(parse(line.as_bytes()), None, "{line}");
        }
    }
}
