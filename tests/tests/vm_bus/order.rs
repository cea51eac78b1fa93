//! Whether fast packets were sent as they must be, by a reader that shares nothing with ours.
//!
//! Of each sender: the frames of a message come in order and under one counter, none is missing, no other
//! fast packet of that sender begins before the last frame, and the counter of a group goes on by one from
//! message to message. At a break (the link was lost, the node was told to be silent) a message may end
//! unfinished, and so may one that began before the node could know of the break.

use std::collections::BTreeMap;

use super::tap::Heard;

/// Groups of many frames that are sent in these tests.
const FAST: [u32; 7] = [126_208, 126_464, 126_996, 126_998, 129_029, 129_542, 130_578];

/// How long after a break a node may not know of it, s.
const GRACE: f64 = 0.02;

#[derive(Clone, Copy)]
struct Open {
    begun: f64,
    pgn: u32,
    destination: u8,
    counter: u8,
    next: u8,
    left: usize,
}

/// What one sender has under way, and the last counter of each of its groups.
#[derive(Default)]
struct Sender {
    open: Option<Open>,
    counters: BTreeMap<u32, u8>,
}

/// Checked messages of many frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Order {
    /// Messages that came whole.
    pub(crate) whole: usize,
    /// Messages that ended at a break.
    pub(crate) cut: usize,
}

/// Fails at the first frame that is out of order. Frames of the senders that `of` accepts count.
pub(crate) fn check(frames: &[Heard], breaks: &[f64], of: impl Fn(u8) -> bool) -> Order {
    let mut order = Order::default();
    let mut senders = BTreeMap::<u8, Sender>::new();
    let mut breaks = breaks.iter().copied().peekable();
    let mut last_break = f64::NEG_INFINITY;
    for frame in frames {
        while let Some(time) = breaks.next_if(|time| *time <= frame.at) {
            last_break = time;
            senders.values_mut().for_each(|sender| sender.counters.clear());
        }
        if FAST.contains(&frame.pgn()) && of(frame.source()) {
            let sender = senders.entry(frame.source()).or_default();
            let begins = frame.data()[0] & 31 == 0;
            let cut = sender.open.take_if(|open| begins && open.begun < last_break + GRACE);
            order.cut += usize::from(cut.is_some());
            order.whole += usize::from(sender.take(frame));
        }
    }
    order
}

impl Sender {
    /// True if the message is whole.
    fn take(&mut self, frame: &Heard) -> bool {
        let data = frame.data();
        assert_eq!(data.len(), 8, "a frame of a fast packet is not full: {frame:?}");
        let (counter, index) = (data[0] >> 5, data[0] & 31);
        let mut open = match self.open.take() {
            None => self.begin(frame, counter, index),
            Some(open) => open,
        };
        let key = (frame.pgn(), frame.destination(), counter, index);
        let expected = (open.pgn, open.destination, open.counter, open.next);
        assert_eq!(key, expected, "group, destination, counter, index of {frame:?}");
        let carried = if index == 0 { 6 } else { 7 };
        open.left = open.left.saturating_sub(carried);
        open.next += 1;
        self.open = (open.left > 0).then_some(open);
        self.open.is_none()
    }

    fn begin(&mut self, frame: &Heard, counter: u8, index: u8) -> Open {
        assert_eq!(index, 0, "a message does not begin with its first frame: {frame:?}");
        let pgn = frame.pgn();
        if let Some(last) = self.counters.insert(pgn, counter) {
            assert_eq!(counter, (last + 1) & 7, "the counter of {pgn} at {frame:?}");
        }
        let left = usize::from(frame.data()[1]);
        assert!((1..=223).contains(&left), "{frame:?}");
        Open { begun: frame.at, pgn, destination: frame.destination(), counter, next: 0, left }
    }
}

fn frames(pgn: u32, counter: u8, indices: &[u8]) -> Vec<Heard> {
    let frame = |index: &u8| {
        let data = [counter << 5 | index, 20, 3, 4, 5, 6, 7, 8];
        Heard::new(f64::from(*index), 0x1800_0000 | pgn << 8 | 1, &data)
    };
    indices.iter().map(frame).collect()
}

#[test]
fn messages_in_order_are_counted_and_a_break_may_cut_one() {
    let log = [frames(129_029, 7, &[0, 1, 2]), frames(129_029, 0, &[0, 1, 2])].concat();
    assert_eq!(check(&log, &[], |_| true), Order { whole: 2, cut: 0 });
    let log = [frames(129_029, 7, &[0, 1]), frames(129_029, 0, &[0, 1, 2])].concat();
    let mut late = log.clone();
    late.iter_mut().skip(2).for_each(|frame| frame.at += 10.0);
    assert_eq!(check(&late, &[5.0], |_| true), Order { whole: 1, cut: 1 });
    assert!(std::panic::catch_unwind(|| check(&log, &[], |_| true)).is_err());
    // the node does not know of the break yet
    let log = frames(129_029, 7, &[0, 1, 2]);
    assert_eq!(check(&log, &[0.5], |_| true), Order { whole: 1, cut: 0 });
}

#[test]
fn disorder_of_every_kind_is_found() {
    let wrong = [
        frames(129_029, 0, &[1, 2]),
        frames(129_029, 0, &[0, 2]),
        frames(129_029, 0, &[0, 1, 1]),
        [frames(129_029, 0, &[0, 1]), frames(129_542, 0, &[0])].concat(),
        [frames(129_029, 0, &[0, 1]), frames(129_029, 1, &[2])].concat(),
        [frames(129_029, 0, &[0, 1, 2]), frames(129_029, 2, &[0, 1, 2])].concat(),
    ];
    for log in wrong {
        assert!(std::panic::catch_unwind(|| check(&log, &[], |_| true)).is_err(), "{log:?}");
    }
}
