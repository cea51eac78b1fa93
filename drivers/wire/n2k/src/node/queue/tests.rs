use super::*;
use crate::{BROADCAST, N2kId};

const NODE: u8 = 7;

fn at(milliseconds: i64) -> Time {
    Time::from_nanos(milliseconds * 1_000_000)
}

fn message(priority: u8, pgn: u32, data: &[u8]) -> BusMessage {
    BusMessage { priority, pgn, source: NODE, destination: BROADCAST, data: data.to_vec() }
}

/// Sends all that may be sent at this time; the groups, and the first byte, in order.
fn drain(queue: &mut Queue, now: Time) -> Vec<(u32, u8)> {
    let mut sent = Vec::new();
    while let Some(frame) = queue.peek(now) {
        assert_eq!(queue.peek(now), Some(frame), "a look changes nothing");
        sent.push((N2kId::parse(frame.id()).unwrap().pgn, frame.data()[0]));
        queue.sent(now);
    }
    sent
}

#[test]
fn higher_priority_goes_first_and_equal_priority_in_turn() {
    let mut queue = Queue::default();
    for (priority, pgn) in [(6, 130_310), (2, 127_250), (3, 127_257), (2, 127_251)] {
        assert!(queue.push(message(priority, pgn, &[0; 8]), Kind::Stream, at(0)));
    }
    let groups: Vec<u32> = drain(&mut queue, at(0)).iter().map(|(pgn, _)| *pgn).collect();
    assert_eq!(groups, [127_250, 127_251, 127_257, 130_310]);
    assert_eq!((queue.counts().frames, queue.counts().messages, queue.len()), (4, 4, 0));
}

#[test]
fn a_newer_message_takes_the_place_of_the_older_one() {
    let mut queue = Queue::default();
    queue.push(message(2, 127_250, &[1; 8]), Kind::Stream, at(0));
    queue.push(message(2, 127_251, &[2; 8]), Kind::Stream, at(0));
    queue.push(message(2, 127_250, &[3; 8]), Kind::Stream, at(100));
    assert_eq!(drain(&mut queue, at(100)), [(127_250, 3), (127_251, 2)]);
    assert_eq!(queue.counts().replaced, 1);
}

#[test]
fn two_messages_of_one_epoch_both_wait_and_are_replaced_one_by_one() {
    let mut queue = Queue::default();
    for (now, bytes) in [(0, [1, 2]), (100, [3, 4])] {
        for byte in bytes {
            queue.push(message(2, 127_250, &[byte; 8]), Kind::Stream, at(now));
        }
    }
    assert_eq!(drain(&mut queue, at(100)), [(127_250, 3), (127_250, 4)]);
}

#[test]
fn single_frames_of_higher_priority_pass_between_the_frames_of_a_fast_packet() {
    let mut queue = Queue::default();
    queue.push(message(3, 129_029, &[9; 20]), Kind::Stream, at(0));
    queue.peek(at(0)).unwrap();
    queue.sent(at(0));
    queue.push(message(2, 127_250, &[1; 8]), Kind::Stream, at(0));
    queue.push(message(3, 127_257, &[2; 8]), Kind::Stream, at(0));
    queue.push(message(2, 130_578, &[3; 12]), Kind::Stream, at(0));
    queue.push(message(3, 129_029, &[8; 20]), Kind::Stream, at(1));
    let groups: Vec<u32> = drain(&mut queue, at(1)).iter().map(|(pgn, _)| *pgn).collect();
    let expected = [127_250, 129_029, 129_029, 130_578, 130_578, 127_257, 129_029];
    assert_eq!(groups, expected, "the burst ends within the second 129029");
    assert_eq!(drain(&mut queue, at(10)).len(), 2);
}

#[test]
fn a_fast_packet_that_is_begun_is_neither_replaced_nor_dropped() {
    let mut queue = Queue::default();
    queue.push(message(3, 129_029, &[9; 20]), Kind::Stream, at(0));
    queue.peek(at(0)).unwrap();
    queue.sent(at(0));
    queue.push(message(3, 129_029, &[8; 20]), Kind::Stream, at(100));
    for now in (100..5000).step_by(20) {
        if queue.peek(at(now)).is_some() {
            queue.refused(at(now));
        }
    }
    let bytes: Vec<u8> = drain(&mut queue, at(5020)).iter().map(|(_, byte)| *byte).collect();
    assert_eq!(bytes, [1, 2], "the rest of the first; the second expired");
    assert_eq!(queue.counts().expired, 1);
}

#[test]
fn a_refused_first_frame_leaves_the_packet_unbegun() {
    let mut queue = Queue::default();
    queue.push(message(3, 129_029, &[9; 20]), Kind::Stream, at(0));
    queue.peek(at(0)).unwrap();
    queue.refused(at(0));
    queue.push(message(3, 129_029, &[8; 20]), Kind::Stream, at(100));
    assert_eq!(queue.len(), 1);
    assert_eq!(queue.peek(at(100)).unwrap().data()[2], 8);
}

#[test]
fn a_fast_packet_is_not_parted_for_long_by_a_busy_stream() {
    let mut queue = Queue::default();
    queue.push(message(6, 126_996, &[9; 134]), Kind::Reply, at(0));
    queue.peek(at(0)).unwrap();
    queue.sent(at(0));
    let (mut last, mut longest) = (0, 0);
    for now in 0..2000 {
        for pgn in 127_250..127_260 {
            queue.push(message(2, pgn, &[1; 8]), Kind::Stream, at(now));
        }
        for (pgn, _) in drain(&mut queue, at(now)) {
            if pgn == 126_996 {
                longest = longest.max(now - last);
                last = now;
            }
        }
    }
    assert!((50..60).contains(&longest), "{longest} ms");
}

#[test]
fn pauses_after_refusals_grow_to_twenty_milliseconds() {
    let mut queue = Queue::default();
    queue.push(message(6, 126_996, &[9; 134]), Kind::Reply, at(0));
    queue.peek(at(0)).unwrap();
    queue.sent(at(0));
    let mut now = at(0);
    let mut pauses = Vec::new();
    for _ in 0..7 {
        queue.peek(now).unwrap();
        queue.refused(now);
        assert_eq!(queue.peek(now), None);
        let ready = queue.ready_at().unwrap();
        pauses.push((ready - now).as_nanos() / 1_000_000);
        now = ready;
    }
    assert_eq!(pauses, [1, 2, 4, 8, 16, 20, 20]);
    queue.peek(now).unwrap();
    queue.sent(now);
    queue.peek(now).unwrap();
    queue.refused(now);
    assert_eq!((queue.ready_at().unwrap() - now).as_nanos(), 1_000_000);
}

#[test]
fn no_more_than_eight_frames_go_in_five_milliseconds() {
    let mut queue = Queue::default();
    queue.push(message(6, 126_996, &[9; 134]), Kind::Reply, at(100));
    assert_eq!(drain(&mut queue, at(100)).len(), 8);
    assert_eq!(queue.ready_at(), Some(at(105)));
    assert_eq!(drain(&mut queue, at(104)).len(), 0);
    assert_eq!(drain(&mut queue, at(105)).len(), 8);
    assert_eq!(drain(&mut queue, at(110)).len(), 4);
    assert_eq!(queue.ready_at(), None);
}

#[test]
fn equal_answers_are_one_and_all_answers_are_bounded() {
    let mut queue = Queue::default();
    let answer = |byte: u8| BusMessage { destination: 3, ..message(6, 59_392, &[byte; 8]) };
    for byte in 0..100 {
        queue.push(answer(byte), Kind::Reply, at(0));
        queue.push(answer(byte), Kind::Reply, at(0));
    }
    assert_eq!(queue.len(), MAX_REPLIES);
    let counts = queue.counts();
    assert_eq!((counts.coalesced, counts.crowded), (32, 136));
}

#[test]
fn a_crowded_stream_drops_what_matters_least() {
    let mut queue = Queue::default();
    for pgn in 0..80 {
        let priority = if pgn == 20 { 7 } else { 3 };
        queue.push(message(priority, 127_000 + pgn * 256, &[0; 8]), Kind::Stream, at(0));
    }
    assert_eq!(queue.len(), MAX_STREAM);
    assert!(queue.entries.iter().all(|entry| entry.message.priority == 3));
}

#[test]
fn what_waits_too_long_is_dropped_and_what_is_too_long_never_waits() {
    let mut queue = Queue::default();
    queue.push(message(2, 127_250, &[1; 8]), Kind::Stream, at(0));
    assert_eq!(queue.peek(at(1001)), None);
    assert_eq!(queue.counts().expired, 1);
    assert!(!queue.push(message(2, 127_250, &[1; 9]), Kind::Stream, at(0)));
    assert!(!queue.push(message(2, 129_029, &[1; 224]), Kind::Stream, at(0)));
    assert_eq!(queue.counts().too_long, 2);
}

#[test]
fn a_frame_looked_at_and_never_sent_is_not_sent_stale() {
    let mut queue = Queue::default();
    queue.push(message(3, 129_029, &[9; 20]), Kind::Stream, at(0));
    queue.push(message(2, 127_250, &[1; 8]), Kind::Stream, at(0));
    queue.peek(at(0)).unwrap();
    assert_eq!(queue.peek(at(2000)), None);
    assert_eq!(queue.counts().expired, 2);
}

#[test]
fn a_lost_link_clears_all() {
    let mut queue = Queue::default();
    queue.push(message(3, 129_029, &[9; 20]), Kind::Stream, at(0));
    queue.peek(at(0)).unwrap();
    queue.clear();
    queue.sent(at(0));
    assert_eq!((queue.peek(at(1)), queue.ready_at(), queue.counts().frames), (None, None, 0));
}

#[test]
fn a_fast_packet_whose_first_frame_was_refused_leaves_no_gap_in_the_counters() {
    let mut queue = Queue::default();
    queue.push(message(3, 129_029, &[9; 20]), Kind::Stream, at(0));
    assert_eq!(queue.peek(at(0)).unwrap().data()[0], 0);
    queue.refused(at(0));
    assert_eq!(queue.peek(at(30)).unwrap().data()[0], 0);
    queue.refused(at(30));
    // it has waited for too long; the next one begins where it would have
    queue.push(message(3, 129_029, &[8; 20]), Kind::Stream, at(2000));
    let sent = drain(&mut queue, at(2000));
    assert_eq!(sent.iter().map(|(_, byte)| *byte).collect::<Vec<_>>(), [0, 1, 2]);
    queue.push(message(3, 129_029, &[7; 20]), Kind::Stream, at(2100));
    assert_eq!(drain(&mut queue, at(2100))[0].1, 1 << 5);
}
