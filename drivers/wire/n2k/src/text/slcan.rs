//! The language of LAWICEL's CAN232 and CANUSB, which many adapters at a serial line speak ("slcan").
//!
//! A line ends with a carriage return. `tIIILDD..` is a frame with 11 bits, `TIIIIIIIILDD..` one with 29,
//! `r` and `R` are remote frames; four digits more are the adapter's time in milliseconds of a minute, if
//! that is switched on. The host writes the same to send a frame, and the adapter answers `z` or `Z`, or
//! nothing but the end of the line; a bell in place of a line is an error (manuals of CAN232 and CANUSB;
//! `drivers/net/can/slcan` of Linux).

use insd_base::{CanFrame, CanId};

use super::{digits, id, packed};

/// The end of a line.
pub const END: u8 = b'\r';

/// What an adapter says in place of an answer when it could not do what it was asked.
pub const BELL: u8 = 0x07;

/// The bit rates that have a command, bit/s, by their digit.
pub const BITRATES: [u32; 9] =
    [10_000, 20_000, 50_000, 100_000, 125_000, 250_000, 500_000, 800_000, 1_000_000];

/// Reads a line of an adapter that is a data frame.
#[must_use]
pub fn parse(line: &[u8]) -> Option<CanFrame> {
    let text = std::str::from_utf8(line).ok()?.trim_ascii();
    let (kind, rest) = text.split_at_checked(1)?;
    let digits = match kind {
        "t" => 3,
        "T" => 8,
        _ => return None,
    };
    let (number, rest) = rest.split_at_checked(digits)?;
    let (length, rest) = rest.split_at_checked(1)?;
    let length = length.parse::<usize>().ok().filter(|length| *length <= 8)?;
    let (data, time) = rest.split_at_checked(2 * length)?;
    let frame = CanFrame::new(id(number)?, &packed(data)?)?;
    (time.is_empty() || time.len() == 4 && packed(time).is_some()).then_some(frame)
}

/// The line that asks an adapter to send a frame.
#[must_use]
pub fn write(frame: &CanFrame) -> String {
    let kind = if matches!(frame.id(), CanId::Standard(_)) { 't' } else { 'T' };
    let data = frame.data();
    format!("{kind}{}{}{}\r", frame.id(), data.len(), digits(data, ""))
}

/// The lines that set an adapter to work: whatever was half written ends, the channel is closed, no times,
/// the bit rate, the channel is opened. `None` if the rate, bit/s, has no command.
#[must_use]
pub fn open(bitrate: u32) -> Option<String> {
    let digit = BITRATES.iter().position(|known| *known == bitrate)?;
    Some(format!("\rC\rZ0\rS{digit}\rO\r"))
}

/// The line that closes the channel.
pub const CLOSE: &str = "C\r";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lines_of_the_manual_are_read_and_written() {
        let short = CanFrame::new(CanId::Standard(0x100), &[0x11, 0x33]).unwrap();
        assert_eq!(parse(b"t10021133"), Some(short));
        assert_eq!(parse(b"t100211332D12"), Some(short), "with the adapter's time");
        assert_eq!(write(&short), "t10021133\r");
        let long = CanFrame::new(CanId::Extended(0x100), &[0x11, 0x33]).unwrap();
        assert_eq!(parse(b"T0000010021133\r"), Some(long));
        assert_eq!(write(&long), "T0000010021133\r");
        assert_eq!(open(250_000).unwrap(), "\rC\rZ0\rS5\rO\r");
        assert_eq!(open(251_000), None);
    }

    #[test]
    fn answers_and_what_is_no_data_frame_are_refused() {
        let lines = [
            "",
            "z",
            "Z",
            "V1013",
            "F00",
            "r1002",
            "R000001002",
            "t1009",
            "t10021",
            "t10021133Z",
            "t8002113",
            "T2000010021133",
            "t100é",
            "\u{7}",
        ];
        for line in lines {
            assert_eq!(parse(line.as_bytes()), None, "{line}");
        }
    }
}
