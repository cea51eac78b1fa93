//! From frames to messages: recorded ones, broken ones and arbitrary ones.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use insd_base::can::{CanFrame, CanId};
use insd_base::{Span, Time};
use insd_n2k::fast_packet::split;
use insd_n2k::{Assembled, Assembler, BROADCAST, BusMessage, N2kId};
use proptest::prelude::*;

fn at(milliseconds: i64) -> Time {
    Time::from_nanos(milliseconds * 1_000_000)
}

fn id(pgn: u32, source: u8, destination: u8) -> N2kId {
    N2kId { priority: 6, pgn, source, destination }
}

fn frame(id: N2kId, data: &[u8]) -> CanFrame {
    CanFrame::new(id.compose(), data).unwrap()
}

/// The messages that frames give, one frame a millisecond.
fn take_all(assembler: &mut Assembler, frames: &[CanFrame]) -> Vec<Assembled> {
    let timed = frames.iter().zip(0..);
    timed.filter_map(|(frame, now)| assembler.take(frame, at(now))).collect()
}

/// From canboat's sample candump-fast.txt.
const RECORDED: [(u32, [u8; 8]); 4] = [
    (0x09F2_0101, [0x60, 0x1A, 0x00, 0xB7, 0x06, 0x67, 0x0D, 0x0B]),
    (0x09F2_0101, [0x61, 0x86, 0xBA, 0x04, 0x26, 0x00, 0x10, 0x5F]),
    (0x09F2_0101, [0x62, 0x09, 0x00, 0x00, 0x00, 0x8F, 0x02, 0x7F]),
    (0x09F2_0101, [0x63, 0x00, 0x00, 0x00, 0x00, 0x7F, 0x7F, 0xFF]),
];

fn recorded() -> Vec<CanFrame> {
    let frames = RECORDED.iter();
    frames.map(|(id, data)| CanFrame::new(CanId::Extended(*id), data).unwrap()).collect()
}

#[test]
fn a_recorded_fast_packet_is_one_message_with_the_time_of_its_first_frame() {
    let mut assembler = Assembler::new();
    let messages = take_all(&mut assembler, &recorded());
    assert_eq!(messages.len(), 1);
    let Assembled { message, begun } = &messages[0];
    assert_eq!((message.pgn, message.source, message.priority), (127_489, 1, 2));
    assert_eq!((message.data.len(), message.data[..3].to_vec()), (26, vec![0x00, 0xB7, 0x06]));
    assert_eq!(message.data[23..], [0x00, 0x7F, 0x7F]);
    assert_eq!(*begun, at(0));
}

#[test]
fn frames_missing_twice_or_out_of_order_cost_the_message() {
    for (order, gaps, orphans) in [
        (&[0, 1, 3][..], 1, 0),
        (&[1, 2, 3], 0, 3),
        (&[0, 1, 1, 2, 3], 1, 2),
        (&[0, 2, 1, 3], 1, 2),
    ] {
        let frames: Vec<CanFrame> = order.iter().map(|index| recorded()[*index]).collect();
        let mut assembler = Assembler::new();
        assert_eq!(take_all(&mut assembler, &frames), [], "{order:?}");
        let counts = assembler.counts();
        assert_eq!((counts.gaps, counts.orphans), (gaps, orphans), "{order:?}");
    }
}

#[test]
fn a_new_beginning_replaces_a_message_under_way() {
    let frames: Vec<CanFrame> = [0, 1, 0, 1, 2, 3].iter().map(|index| recorded()[*index]).collect();
    let mut assembler = Assembler::new();
    let messages = take_all(&mut assembler, &frames);
    assert_eq!((messages.len(), messages[0].begun), (1, at(2)));
    assert_eq!(assembler.counts().superseded, 1);
}

#[test]
fn senders_groups_and_counters_do_not_mix() {
    let data: Vec<u8> = (0..20).collect();
    let streams = [(129_029, 1, 0), (129_029, 2, 0), (129_540, 1, 0), (129_029, 1, 1)];
    let split: Vec<Vec<CanFrame>> = streams
        .iter()
        .map(|(pgn, source, sequence)| split(id(*pgn, *source, 255), &data, *sequence).unwrap())
        .collect();
    let mixed: Vec<CanFrame> =
        (0..3).flat_map(|index| split.iter().map(move |frames| frames[index])).collect();
    let messages = take_all(&mut Assembler::new(), &mixed);
    assert_eq!(messages.len(), 4);
    assert!(messages.iter().all(|assembled| assembled.message.data == data));
}

#[test]
fn a_message_whose_sender_falls_silent_is_given_up() {
    let mut assembler = Assembler::new();
    for (index, now) in [(0, 0), (1, 750), (2, 1501)] {
        assert_eq!(assembler.take(&recorded()[index], at(now)), None);
    }
    assert_eq!((assembler.counts().stale, assembler.under_way()), (1, 0));
}

#[test]
fn short_frames_and_impossible_lengths_give_nothing() {
    let fast = id(129_029, 1, BROADCAST);
    let mut assembler = Assembler::new();
    for data in [&[][..], &[0x00], &[0x00, 0], &[0x00, 224, 1, 2, 3, 4, 5, 6], &[0x00, 20, 1]] {
        assert_eq!(assembler.take(&frame(fast, data), at(0)), None);
    }
    assert_eq!((assembler.counts().bad_length, assembler.counts().gaps), (4, 1));
    assert!(assembler.take(&frame(fast, &[0x20, 3, 1, 2, 3]), at(0)).is_some(), "no padding");
    let standard = CanFrame::new(CanId::Standard(5), &[1]).unwrap();
    assert_eq!(assembler.take(&standard, at(0)), None);
    assert_eq!(assembler.counts().foreign, 1);
}

/// From canboat, analyzer/tests/iso-tp-test.in, shortened to its first three packets and 19 bytes.
const ANNOUNCED: [[u8; 8]; 4] = [
    [0x20, 0x13, 0x00, 0x03, 0xFF, 0x04, 0xFA, 0x01],
    [0x01, 0xAA, 0xFF, 0x12, 0x08, 0x39, 0x0A, 0x7E],
    [0x02, 0x61, 0x1C, 0x0C, 0x00, 0x00, 0x00, 0x00],
    [0x03, 0x02, 0x09, 0xDC, 0x17, 0x5A, 0x79, 0x1C],
];

fn transfer(destination: u8) -> Vec<CanFrame> {
    let mut frames = Vec::new();
    for (index, data) in ANNOUNCED.iter().enumerate() {
        let pgn = if index == 0 { 60_416 } else { 60_160 };
        let mut data = *data;
        if index == 0 && destination != BROADCAST {
            data[0] = 16;
        }
        frames.push(frame(id(pgn, 23, destination), &data));
    }
    frames
}

#[test]
fn announced_and_overheard_transfers_are_messages() {
    for destination in [BROADCAST, 40] {
        let messages = take_all(&mut Assembler::new(), &transfer(destination));
        assert_eq!(messages.len(), 1);
        let BusMessage { pgn, source, destination: to, data, .. } = &messages[0].message;
        assert_eq!((*pgn, *source, *to, data.len()), (129_540, 23, destination, 19));
        assert_eq!((data[0], data[18], messages[0].begun), (0xAA, 0x5A, at(0)));
    }
}

#[test]
fn a_gap_ends_an_announced_transfer_and_waits_in_an_addressed_one() {
    let missing = |destination| -> Vec<CanFrame> {
        let frames = transfer(destination);
        [0, 1, 3, 2, 3].iter().map(|index| frames[*index]).collect()
    };
    let mut assembler = Assembler::new();
    assert_eq!(take_all(&mut assembler, &missing(BROADCAST)), []);
    assert_eq!(assembler.counts().gaps, 1);
    assert_eq!(take_all(&mut Assembler::new(), &missing(40)).len(), 1, "sent again as asked");
}

#[test]
fn an_aborted_or_contradictory_transfer_gives_nothing() {
    let abort = [0xFF, 3, 255, 255, 255, 0x04, 0xFA, 0x01];
    let mut frames = transfer(40);
    frames.insert(2, frame(id(60_416, 40, 23), &abort));
    let mut assembler = Assembler::new();
    assert_eq!(take_all(&mut assembler, &frames), []);
    assert_eq!((assembler.counts().aborted, assembler.counts().orphans), (1, 2));
    let wrong = [0x20, 0x05, 0x00, 0x02, 0xFF, 0x04, 0xFA, 0x01];
    assembler.take(&frame(id(60_416, 23, 255), &wrong), at(0));
    assert_eq!(assembler.counts().bad_length, 1);
}

/// Frames that are likely to mean something to an assembler.
fn any_frame() -> impl Strategy<Value = CanFrame> {
    let groups = prop_oneof![
        Just(60_416_u32),
        Just(60_160),
        Just(129_029),
        Just(126_996),
        Just(126_208),
        0..0x3_FFFF_u32
    ];
    let data = prop_oneof![
        prop::collection::vec(any::<u8>(), 0..=8),
        (prop::sample::select(vec![16_u8, 17, 19, 32, 255]), 0..30_u8, 0..5_u8)
            .prop_map(|(kind, length, packets)| vec![kind, length, 0, packets, 255, 4, 250, 1]),
        (0..40_u8).prop_map(|head| vec![head, 14, 1, 2, 3, 4, 5, 6]),
    ];
    (groups, 0..4_u8, prop::sample::select(vec![255_u8, 0, 1, 2]), data)
        .prop_map(|(pgn, source, destination, data)| frame(id(pgn, source, destination), &data))
}

proptest! {
    #[test]
    fn any_frames_are_taken_without_panic_and_in_bounded_memory(
        frames in prop::collection::vec((any_frame(), 0..300_i64), 0..600),
    ) {
        let mut assembler = Assembler::new();
        let mut now = Time::START;
        for (frame, pause) in frames {
            now = now + Span::from_nanos(pause * 1_000_000);
            if let Some(assembled) = assembler.take(&frame, now) {
                prop_assert!(assembled.message.data.len() <= 1785);
                prop_assert!(assembled.begun <= now);
            }
            prop_assert!(assembler.under_way() <= 80);
        }
    }

    #[test]
    fn what_is_split_is_put_together_again(
        data in prop::collection::vec(any::<u8>(), 1..=223),
        sequence in 0..8_u8,
        source in 0..252_u8,
    ) {
        let id = id(126_996, source, BROADCAST);
        let frames = split(id, &data, sequence).unwrap();
        let messages = take_all(&mut Assembler::new(), &frames);
        prop_assert_eq!(messages.len(), 1);
        prop_assert_eq!(&messages[0].message.data, &data);
    }
}
