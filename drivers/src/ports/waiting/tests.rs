use super::*;

/// A message of so many bytes.
fn message(slot: u16, valid: f64, period: f64, length: usize) -> Outgoing {
    let (valid, period) = (Time::from_seconds(valid), Span::from_seconds(period));
    Outgoing { slot, bytes: vec![b'x'; length], valid, period }
}

/// What is put in and taken out at given times.
struct Bench {
    waiting: Waiting,
    per_byte: Span,
    dropped: Vec<u16>,
}

impl Bench {
    fn new(waiting: Waiting, per_byte: f64) -> Self {
        Bench { waiting, per_byte: Span::from_seconds(per_byte), dropped: Vec::new() }
    }

    fn newest(per_byte: f64) -> Self {
        Bench::new(Waiting::Newest(Newest::default()), per_byte)
    }

    fn put(&mut self, message: Outgoing, now: f64) {
        self.put_into(message, now, usize::MAX);
    }

    fn put_into(&mut self, message: Outgoing, now: f64, limit: usize) {
        let dropped = |message: &Outgoing| self.dropped.push(message.slot);
        self.waiting.put(Arc::new(message), Time::from_seconds(now), limit, dropped);
    }

    fn take(&mut self, at: f64) -> Option<Item> {
        let start = Start { at: Time::from_seconds(at), per_byte: self.per_byte };
        self.waiting.take(start, |message| self.dropped.push(message.slot))
    }

    fn slots(&mut self, at: f64) -> Vec<u16> {
        std::iter::from_fn(|| self.take(at)).map(|item| item.message.slot).collect()
    }
}

#[test]
fn the_newest_takes_the_place_of_the_one_that_waits() {
    let mut bench = Bench::newest(0.0);
    for (slot, valid) in [(1, 0.0), (2, 0.0), (3, 0.0), (2, 0.1)] {
        bench.put(message(slot, valid, 0.2, 10), valid);
    }
    assert_eq!(bench.dropped, [2]);
    let left: Vec<Item> = std::iter::from_fn(|| bench.take(0.1)).collect();
    let slots: Vec<u16> = left.iter().map(|item| item.message.slot).collect();
    assert_eq!(slots, [1, 2, 3]);
    assert_eq!(left[1].message.valid, Time::from_seconds(0.1));
}

#[test]
fn a_line_that_keeps_up_carries_an_epoch_in_the_order_handed_over() {
    // 38400 baud; the slow ones come first
    let mut bench = Bench::newest(1.0 / 3840.0);
    for (slot, period) in [(9, 1.0), (4, 1.0), (7, 0.1), (1, 0.2)] {
        bench.put(message(slot, 5.0, period, 60), 5.01);
    }
    assert_eq!(bench.slots(5.01), [9, 4, 7, 1]);
    assert!(bench.dropped.is_empty());
}

#[test]
fn a_fast_message_overtakes_slow_ones_behind_which_it_would_grow_too_old() {
    let mut bench = Bench::newest(1.0 / 480.0);
    for slot in [1, 2, 3] {
        bench.put(message(slot, 0.0, 1.0, 80), 0.0);
    }
    bench.put(message(4, 0.0, 0.1, 20), 0.0);
    assert_eq!(bench.slots(0.0), [4, 1, 2, 3]);
}

#[test]
fn none_is_taken_that_is_older_than_its_period() {
    let mut bench = Bench::newest(1.0 / 480.0);
    bench.put(message(1, 0.0, 0.1, 20), 0.0);
    bench.put(message(2, 0.0, 1.0, 20), 0.0);
    assert_eq!(bench.slots(0.101), [2]);
    assert_eq!(bench.dropped, [1]);
    assert!(bench.waiting.is_empty());
}

#[test]
fn the_next_one_has_the_place_of_one_that_was_too_old() {
    let mut bench = Bench::newest(0.0);
    bench.put(message(1, 0.0, 0.1, 20), 0.0);
    bench.put(message(2, 0.0, 1.0, 20), 0.0);
    let first = bench.take(0.15).map(|item| item.message.slot);
    bench.put(message(3, 0.15, 1.0, 20), 0.15);
    bench.put(message(1, 0.15, 0.1, 20), 0.15);
    assert_eq!((first, bench.slots(0.15)), (Some(2), vec![1, 3]));
}

#[test]
fn one_that_comes_late_may_wait_for_half_a_period_and_10_ms_at_most() {
    let mut bench = Bench::newest(0.0);
    bench.put(message(1, 0.0, 0.01, 20), 0.5);
    assert_eq!(bench.slots(0.504), [1]);
    bench.put(message(1, 0.0, 0.01, 20), 0.5);
    bench.put(message(2, 0.0, 0.4, 20), 0.5);
    assert_eq!(bench.slots(0.506), [2]);
    bench.put(message(2, 0.0, 0.4, 20), 0.5);
    assert_eq!(bench.slots(0.511), Vec::<u16>::new());
    assert_eq!(bench.dropped, [1, 2]);
}

#[test]
fn what_is_put_back_is_there_again_unless_a_newer_one_came() {
    let mut bench = Bench::newest(0.0);
    bench.put(message(1, 0.0, 1.0, 10), 0.0);
    bench.put(message(2, 0.0, 1.0, 10), 0.0);
    let one = bench.take(0.0).unwrap();
    bench.waiting.put_back(one, |_| panic!("nothing newer is there"));
    let one = bench.take(0.0).unwrap();
    bench.put(message(1, 0.5, 1.0, 10), 0.5);
    let mut dropped = Vec::new();
    bench.waiting.put_back(one, |message| dropped.push(message.valid));
    assert_eq!(dropped, [Time::START]);
    assert_eq!(bench.slots(0.5), [1, 2], "in its old place");
}

#[test]
fn a_recording_is_kept_in_order_and_the_oldest_make_room() {
    let mut bench = Bench::new(Waiting::All(All::default()), 0.0);
    for number in 0..4_i32 {
        bench.put_into(message(1, number.into(), 0.1, 4), 0.0, 10);
    }
    bench.put_into(message(2, 4.0, 0.1, 11), 0.0, 10);
    assert_eq!(bench.dropped, [1, 1, 2]);
    let taken: Vec<f64> = std::iter::from_fn(|| bench.take(100.0))
        .map(|item| item.message.valid.as_seconds())
        .collect();
    assert_eq!(taken, [2.0, 3.0]);
}

#[test]
fn the_oldest_slots_make_room_where_too_many_bytes_wait() {
    let mut bench = Bench::newest(0.0);
    for slot in 0..4 {
        bench.put_into(message(slot, 0.0, 1.0, 4), 0.0, 10);
    }
    assert_eq!((bench.dropped.clone(), bench.slots(0.0)), (vec![0, 1], vec![2, 3]));
    bench.put(message(7, 0.0, 1.0, 4), 0.0);
    bench.waiting.clear(|message| assert_eq!(message.slot, 7));
    assert!(bench.waiting.is_empty());
}

/// Sentences of a list: slot, period in ms, length.
type List<'a> = &'a [(u16, i64, usize)];

/// Runs a list over a line of so many bytes per second for a minute, and gives for each sentence how many
/// of the messages left, and the longest time between two, ms. Data come 5 ms after their validity.
fn minute(list: List<'_>, bytes_per_second: i64) -> Vec<(f64, i64)> {
    const END: i64 = 60_000;
    let millis = |millis: i64| Time::from_nanos(millis * 1_000_000);
    let mut bench = Bench::newest(1.0 / bytes_per_second as f64);
    let mut left: Vec<Vec<i64>> = vec![Vec::new(); list.len()];
    let mut free = 0;
    for now in 0..END {
        for (slot, period, length) in list.iter().filter(|(_, period, _)| now % period == 5) {
            let valid = (now - 5) as f64 * 1e-3;
            bench.put(message(*slot, valid, *period as f64 * 1e-3, *length), now as f64 * 1e-3);
        }
        if now >= free
            && let Some(item) = bench.take(now as f64 * 1e-3)
        {
            let place = list.iter().position(|(slot, ..)| *slot == item.message.slot).unwrap();
            assert!(millis(now) - item.message.valid <= item.message.period);
            left[place].push(now);
            free = now + item.length() as i64 * 1000 / bytes_per_second;
        }
    }
    let figures = list.iter().zip(&left).map(|((_, period, _), left)| {
        let gaps = left.windows(2).map(|pair| pair[1] - pair[0]);
        (left.len() as f64 * *period as f64 / END as f64, gaps.max().unwrap_or(END))
    });
    figures.collect()
}

#[test]
fn on_an_overfull_line_every_sentence_gets_through_and_the_slow_ones_lose_little() {
    let list: List<'_> = &[
        (1, 100, 20),
        (2, 100, 20),
        (3, 200, 75),
        (4, 200, 45),
        (5, 1000, 40),
        (6, 1000, 75),
        (7, 100, 60),
        (8, 200, 40),
    ];
    // four times what 4800 baud can carry
    let figures = minute(list, 480);
    eprintln!("{figures:.2?}");
    for ((_, period, _), (share, gap)) in list.iter().zip(figures) {
        assert!(share > if *period == 1000 { 0.85 } else { 0.1 }, "{period} ms: {share}");
        assert!(gap <= 2200, "{period} ms: nothing for {gap} ms");
    }
}

#[test]
fn of_sentences_of_one_rate_on_an_overfull_line_none_is_preferred() {
    let list: Vec<(u16, i64, usize)> = (1..9).map(|slot| (slot, 100, 40)).collect();
    let figures = minute(&list, 480);
    let (least, most) = figures.iter().fold((1.0_f64, 0.0_f64), |(least, most), (share, _)| {
        (least.min(*share), most.max(*share))
    });
    assert!(most - least < 0.01, "{figures:?}");
}

#[test]
fn a_fast_sentence_goes_on_while_a_batch_of_slow_ones_leaves() {
    // 44 % of 38400 baud, of which the batch takes 390 ms at once
    let mut list: Vec<(u16, i64, usize)> = (1..7).map(|slot| (slot, 1000, 250)).collect();
    list.push((7, 100, 20));
    for (share, _) in minute(&list, 3840) {
        assert!(share > 0.97, "{share}");
    }
}
