//! Lines of text: what is written is read, and nothing that is read makes a reader panic.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::{CanFrame, CanId, UtcTime};
use insd_n2k::text::{actisense, canboat, candump, slcan, ydwg};
use insd_n2k::{BROADCAST, BusMessage, N2kId};
use proptest::prelude::*;

fn frames() -> impl Strategy<Value = CanFrame> {
    let ids = prop_oneof![
        (0..=CanId::MAX_STANDARD).prop_map(CanId::Standard),
        (0..=CanId::MAX_EXTENDED).prop_map(CanId::Extended),
    ];
    (ids, prop::collection::vec(any::<u8>(), 0..=8))
        .prop_map(|(id, data)| CanFrame::new(id, &data).unwrap())
}

fn messages() -> impl Strategy<Value = BusMessage> {
    let ways = (0..8_u8, 0..0x4_0000_u32, any::<u8>(), any::<u8>());
    (ways, prop::collection::vec(any::<u8>(), 0..=223)).prop_map(|(way, data)| {
        let (priority, pgn, source, destination) = way;
        BusMessage { priority, pgn, source, destination, data }
    })
}

/// Lines that are nearly right: the letters of all formats, in any order.
fn nearly() -> impl Strategy<Value = Vec<u8>> {
    let words = "[0-9A-FRTtrzAa#(). ,:\\[\\]can-]{0,60}";
    prop_oneof![words.prop_map(String::into_bytes), prop::collection::vec(any::<u8>(), 0..80)]
}

proptest! {
    #[test]
    fn a_line_of_a_log_holds_the_frame_and_its_time(
        frame in frames(), micros in 0..4_000_000_000_000_000_i64,
    ) {
        let time = Some(UtcTime::from_nanos(micros * 1000));
        let text = candump::write(UtcTime::from_nanos(micros * 1000), "vcan0", &frame);
        let line = candump::parse(text.as_bytes()).unwrap();
        prop_assert_eq!(line, candump::Line { time, interface: "vcan0", sent: false, frame });
    }

    #[test]
    fn an_adapter_is_told_the_frame(frame in frames()) {
        prop_assert_eq!(slcan::parse(slcan::write(&frame).as_bytes()), Some(frame));
    }

    #[test]
    fn a_gateway_is_asked_for_the_frame_and_says_it_with_its_time(frame in frames()) {
        let line = ydwg::write(&frame);
        prop_assert_eq!(line.is_some(), matches!(frame.id(), CanId::Extended(_)));
        if let Some(line) = line {
            for (sent, way) in [(false, 'R'), (true, 'T')] {
                let said = format!("16:29:27.082 {way} {line}");
                prop_assert_eq!(ydwg::parse(said.as_bytes()), Some(ydwg::Line { sent, frame }));
            }
        }
    }

    #[test]
    fn whole_messages_come_back(message in messages(), millis in 0..4_000_000_000_000_i64) {
        let time = UtcTime::from_nanos(millis * 1_000_000);
        let read = actisense::parse(actisense::write(&message).as_bytes());
        prop_assert_eq!(read.as_ref(), Some(&message));
        prop_assert_eq!(canboat::parse(canboat::write(time, &message).as_bytes()), Some(message));
    }

    #[test]
    fn frames_come_back_from_lines_of_canboat(frame in frames()) {
        let line = canboat::write_frame(UtcTime::from_nanos(0), &frame);
        prop_assert_eq!(line.is_some(), matches!(frame.id(), CanId::Extended(_)));
        if let Some((line, id)) = line.zip(N2kId::parse(frame.id())) {
            prop_assert!(id.destination == BROADCAST || id.pgn & 0xFF == 0);
            prop_assert_eq!(canboat::parse_frame(line.as_bytes()), Some(frame));
        }
    }

    #[test]
    fn no_line_makes_a_reader_panic(line in nearly()) {
        let _ = candump::parse(&line);
        let _ = slcan::parse(&line);
        let _ = ydwg::parse(&line);
        let _ = actisense::parse(&line);
        let _ = canboat::parse(&line);
        let _ = canboat::parse_frame(&line);
    }

    #[test]
    fn a_cut_line_of_an_adapter_is_no_other_frame(frame in frames(), cut in 0..40_usize) {
        let text = slcan::write(&frame);
        let whole = text.trim_end();
        if let Some(part) = whole.get(..cut.min(whole.len().saturating_sub(1))) {
            prop_assert_eq!(slcan::parse(part.as_bytes()), None, "{}", part);
        }
    }
}
