//! The lines that canboat's programs write: "PLAIN", one frame each, and "FAST", one message each.
//!
//! `2023-06-13T10:39:46.245Z,2,130306,16,255,8,ad,92,01,d1,a3,fa,ff,ff`: time, priority, parameter group,
//! source, destination, number of bytes, bytes (`parseRawFormatPlain` and `parseRawFormatFast` of canboat's
//! `common/parse.c`, and its logs). The two look alike: a whole message of up to eight bytes and a frame
//! of a longer one cannot be told apart on a line, so whoever reads must be told which it is.

use insd_base::{CanFrame, UtcTime};

use crate::{BusMessage, N2kId};

use super::{LONGEST, byte, decimal};

/// Reads a line of "FAST": a whole message.
#[must_use]
pub fn parse(line: &[u8]) -> Option<BusMessage> {
    let text = std::str::from_utf8(line).ok()?.trim_ascii();
    let mut fields = text.split(',');
    // of the many forms of time it is only asked that it begins like a date or a clock
    fields.next().filter(|time| time.starts_with(|first: char| first.is_ascii_digit()))?;
    let priority = fields.next().and_then(decimal).filter(|priority| *priority <= 7)?;
    let pgn = fields.next().and_then(decimal).filter(|pgn: &u32| *pgn <= 0x3_FFFF)?;
    let source = fields.next().and_then(decimal)?;
    let destination = fields.next().and_then(decimal)?;
    let length = fields.next().and_then(decimal).filter(|length| *length <= LONGEST)?;
    let data: Vec<u8> = fields.map(lax_byte).collect::<Option<_>>()?;
    (data.len() == length).then_some(BusMessage { priority, pgn, source, destination, data })
}

/// Old logs leave out a leading zero.
fn lax_byte(digits: &str) -> Option<u8> {
    byte(digits).or_else(|| byte(&format!("0{digits}")))
}

/// Reads a line of "PLAIN": a frame.
#[must_use]
pub fn parse_frame(line: &[u8]) -> Option<CanFrame> {
    let BusMessage { priority, pgn, source, destination, data } = parse(line)?;
    let id = N2kId { priority, pgn, source, destination };
    CanFrame::new(id.compose(), &data)
}

/// A line of "PLAIN" with its end; `None` for a frame with 11 bits.
#[must_use]
pub fn write_frame(time: UtcTime, frame: &CanFrame) -> Option<String> {
    let N2kId { priority, pgn, source, destination } = N2kId::parse(frame.id())?;
    let data = frame.data().to_vec();
    Some(write(time, &BusMessage { priority, pgn, source, destination, data }))
}

/// A line with its end. The time is cut to milliseconds.
#[must_use]
pub fn write(time: UtcTime, message: &BusMessage) -> String {
    let ((year, month, day), nanos) = time.to_civil();
    let millis = nanos / 1_000_000;
    let (hour, minute) = (millis / 3_600_000, millis / 60_000 % 60);
    let (second, millis) = (millis / 1000 % 60, millis % 1000);
    let BusMessage { priority, pgn, source, destination, data } = message;
    let bytes: String = data.iter().map(|byte| format!(",{byte:02x}")).collect();
    format!(
        "{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}.{millis:03}Z,\
         {priority},{pgn},{source},{destination},{}{bytes}\n",
        data.len()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::CanId;

    const WIND: &str = "2023-06-13T10:39:46.245Z,2,130306,16,255,8,ad,92,01,d1,a3,fa,ff,ff\n";

    #[test]
    fn a_line_of_a_log_is_read_and_written() {
        let message = parse(WIND.as_bytes()).unwrap();
        assert_eq!((message.priority, message.pgn, message.source), (2, 130_306, 16));
        assert_eq!((message.destination, message.data.len()), (255, 8));
        let time = UtcTime::from_civil((2023, 6, 13), (10, 39, 46), 245_000_000).unwrap();
        assert_eq!(write(time, &message), WIND);
        let frame = parse_frame(WIND.as_bytes()).unwrap();
        assert_eq!(frame.id(), CanId::Extended(0x09FD_0210));
        assert_eq!(write_frame(time, &frame).unwrap(), WIND);
    }

    #[test]
    fn a_message_of_more_than_eight_bytes_is_no_frame() {
        let line = "2022-01-06-15:52:52.893,7,129285,15,255,9,1,2,3,4,5,6,7,8,9";
        assert_eq!(parse(line.as_bytes()).unwrap().data, [1, 2, 3, 4, 5, 6, 7, 8, 9]);
        assert_eq!(parse_frame(line.as_bytes()), None);
    }

    #[test]
    fn other_lines_are_refused() {
        for line in [
            "",
            "# comment",
            "2022,8,129285,15,255,1,01",
            "2022,7,262144,15,255,1,01",
            "2022,7,129285,256,255,1,01",
            "2022,7,129285,15,255,2,01",
            "2022,7,129285,15,255,1,01,02",
            "2022,7,129285,15,255,1,001",
            "2022,+7,129285,15,255,1,01",
            "2022,7,129285,15,255",
        ] {
            assert_eq!(parse(line.as_bytes()), None, "{line}");
        }
    }
}
