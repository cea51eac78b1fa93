//! The binary messages of adapters to NMEA 2000.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_wire::binary::BinaryFault;
use insd_wire::ngt1::{NgtFrame, NgtMessage, look};
use insd_wire::stream::{Cutter, Look, Protocol};
use proptest::prelude::*;

/// Frames of a recording of an adapter on a boat (canboat, `samples/actisense-523.rx.ebl`, out of its `.ebl` wrapping), each beside what
/// `actisense-serial -r` of canboat reads in it: priority, group, source, destination, the adapter's clock, data.
const RECORDED: &str = include_str!("data/ngt1.txt");

fn samples() -> Vec<(Vec<u8>, NgtMessage)> {
    let bytes = |text: &str| -> Vec<u8> {
        let pairs = text.as_bytes().chunks(2).map(|pair| std::str::from_utf8(pair).unwrap());
        pairs.map(|pair| u8::from_str_radix(pair, 16).unwrap()).collect()
    };
    let line = |line: &str| {
        let mut words = line.split(' ');
        let mut next = || words.next().unwrap();
        let frame = bytes(next());
        let mut number = || next().parse::<u32>().unwrap();
        let [priority, pgn, source, destination, clock] = std::array::from_fn(|_| number());
        let [priority, source, destination] =
            [priority, source, destination].map(|own| u8::try_from(own).unwrap());
        let data = bytes(next());
        (frame, NgtMessage { priority, pgn, destination, source, clock, data })
    };
    RECORDED.lines().map(line).collect()
}

#[test]
fn recorded_frames_say_what_canboat_reads_in_them_and_are_written_to_the_byte() {
    let all = samples();
    assert!(all.len() >= 20, "{}", all.len());
    for (frame, message) in all {
        assert_eq!(NgtFrame::read(&frame), Ok(NgtFrame::Received(message.clone())));
        assert_eq!(message.write(), Some(frame));
    }
}

fn message(data: Vec<u8>) -> NgtMessage {
    NgtMessage { priority: 2, pgn: 129_025, destination: 255, source: 0x10, clock: 0x1003, data }
}

#[test]
fn a_byte_that_looks_like_the_end_is_doubled_and_taken_once() {
    let told = message(vec![0x10, 0x03, 0x10, 0x10, 0x02, 0x10]);
    let frame = told.write().unwrap();
    assert_eq!(look(&frame), Look::Frame(frame.len()));
    assert_eq!(NgtFrame::read(&frame), Ok(NgtFrame::Received(told)));
}

#[test]
fn what_is_longer_than_a_message_of_the_bus_is_not_written() {
    assert!(message(vec![0x10; 223]).write().is_some());
    assert_eq!(message(vec![0; 224]).write(), None);
}

#[test]
fn a_frame_that_is_cut_or_flipped_is_none_and_those_around_it_are_found() {
    let frame = message(vec![1, 2, 3, 0x10, 5, 6, 7, 8]).write().unwrap();
    for place in 0..frame.len() {
        for bit in 0..8 {
            let mut bad = frame.clone();
            bad[place] ^= 1 << bit;
            assert_ne!(NgtFrame::read(&bad).ok(), NgtFrame::read(&frame).ok(), "{place} {bit}");
        }
        let cut = &frame[..place];
        assert_eq!(NgtFrame::read(cut), Err(BinaryFault::Frame));
        let stream = [cut, &frame, &frame].concat();
        let mut cutter = Cutter::new(&[Protocol::Ngt1]);
        cutter.push(&stream);
        let mut found = 0;
        while cutter.cut().is_some() {
            found += 1;
        }
        assert!(found >= 1, "{place}");
    }
}

proptest! {
    #[test]
    fn any_message_is_read_as_it_was_written(
        priority in 0..8_u8,
        pgn in 0..0x4_0000_u32,
        destination: u8,
        source: u8,
        clock: u32,
        data in prop::collection::vec(any::<u8>(), 0..224),
    ) {
        let told = NgtMessage { priority, pgn, destination, source, clock, data };
        let frame = told.write().unwrap();
        prop_assert_eq!(look(&frame), Look::Frame(frame.len()));
        prop_assert_eq!(NgtFrame::read(&frame), Ok(NgtFrame::Received(told)));
    }
}
