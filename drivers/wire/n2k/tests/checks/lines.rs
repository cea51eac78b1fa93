//! Any bytes as lines of each text format, and frames and messages made of them written and read.

use insd_base::can::CanFrame;
use insd_base::{CanId, UtcTime};
use insd_n2k::text::{actisense, canboat, candump, slcan, ydwg};
use insd_n2k::{BusMessage, fast_packet};

use super::heard;

/// Lines of each format that were read: candump, slcan, ydwg, actisense, canboat.
pub(crate) type Read = [u64; 5];

/// Reads the bytes as lines of every format; then takes them as an identifier and data and writes those.
pub(crate) fn everything(bytes: &[u8]) -> Read {
    let mut read = Read::default();
    for line in bytes.split(|byte| [b'\r', b'\n'].contains(byte)) {
        for (sum, own) in read.iter_mut().zip(line_of_each(line)) {
            *sum += u64::from(own);
        }
    }
    if let Some(frame) = heard::frame(bytes) {
        written(&frame);
    }
    if let Some((head, data)) = bytes.split_first_chunk::<6>() {
        written_whole(*head, data);
    }
    read
}

/// Whether the line is one of each format. What is written of it reads the same.
fn line_of_each(line: &[u8]) -> [bool; 5] {
    [dumped(line), adapted(line), gated(line), told(line), logged(line)]
}

fn dumped(line: &[u8]) -> bool {
    let Some(read) = candump::parse(line) else { return false };
    let time = read.time.unwrap_or(UtcTime::from_nanos(0));
    let text = candump::write(time, read.interface, &read.frame);
    let again = candump::parse(text.as_bytes()).unwrap();
    let micros = UtcTime::from_nanos(time.as_nanos() / 1000 * 1000);
    assert_eq!(
        (again.time, again.interface, again.frame),
        (Some(micros), read.interface, read.frame)
    );
    true
}

fn adapted(line: &[u8]) -> bool {
    let Some(frame) = slcan::parse(line) else { return false };
    assert_eq!(slcan::parse(slcan::write(&frame).as_bytes()), Some(frame));
    true
}

fn gated(line: &[u8]) -> bool {
    let Some(heard) = ydwg::parse(line) else { return false };
    assert_eq!(returned(&heard.frame), Some(heard.frame));
    true
}

/// A frame that was sent to a gateway, as the gateway says it to others.
fn returned(frame: &CanFrame) -> Option<CanFrame> {
    let received = format!("16:29:27.082 R {}", ydwg::write(frame)?);
    ydwg::parse(received.as_bytes()).map(|read| read.frame)
}

fn told(line: &[u8]) -> bool {
    let Some(message) = actisense::parse(line) else { return false };
    assert_eq!(actisense::parse(actisense::write(&message).as_bytes()), Some(message));
    true
}

fn logged(line: &[u8]) -> bool {
    let frame = canboat::parse_frame(line);
    let Some(message) = canboat::parse(line) else {
        assert_eq!(frame, None);
        return false;
    };
    assert!(frame.is_none_or(|frame| frame.data() == message.data));
    let text = canboat::write(UtcTime::from_nanos(0), &message);
    assert_eq!(canboat::parse(text.as_bytes()), Some(message));
    assert_eq!(canboat::parse_frame(text.as_bytes()), frame);
    true
}

fn written(frame: &CanFrame) {
    let time = UtcTime::from_nanos(1_000);
    let line = candump::write(time, "can0", frame);
    let read = candump::parse(line.as_bytes()).unwrap();
    assert_eq!((read.time, read.interface, read.frame), (Some(time), "can0", *frame));
    assert_eq!(slcan::parse(slcan::write(frame).as_bytes()), Some(*frame));
    let gated = matches!(frame.id(), CanId::Extended(_)).then_some(*frame);
    assert_eq!(returned(frame), gated);
}

/// A message: three bytes of a time, source, destination, priority and group, data.
fn written_whole([a, b, c, source, destination, way]: [u8; 6], data: &[u8]) {
    let data = data.get(..data.len().min(fast_packet::MAX_LENGTH)).unwrap_or_default().to_vec();
    let (priority, pgn) = (way & 7, heard::group(way >> 3));
    let message = BusMessage { priority, pgn, source, destination, data };
    assert_eq!(actisense::parse(actisense::write(&message).as_bytes()).as_ref(), Some(&message));
    let time = UtcTime::from_nanos(i64::from(u32::from_be_bytes([a, b, c, 0])) * 1_000_000_000);
    assert_eq!(canboat::parse(canboat::write(time, &message).as_bytes()), Some(message));
}
