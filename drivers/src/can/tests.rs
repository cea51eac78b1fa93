//! The task of a port on a bus in memory, in tokio's time, which passes when all wait.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use insd_base::{BusEvent, CanFrame, CanId, Input, PortId, PortState, Span, Stamp, Time, UtcTime};
use tokio::time::sleep;

use super::memory::{MemoryBus, MemoryEnd};
use super::{CanBus, Heard, Sending, SharedSpeaker, Speaker, spawn_on};
use crate::ports::{Clock, PortHandle, Receiver, Surroundings, WAITING_LIMIT, queue};

/// Tokio's time, which tests can stop.
struct TokioTime(tokio::time::Instant);

impl TokioTime {
    #[expect(clippy::disallowed_methods, reason = "tests run on tokio's clock")]
    fn start() -> Arc<dyn Clock> {
        Arc::new(TokioTime(tokio::time::Instant::now()))
    }
}

impl Clock for TokioTime {
    fn now(&self) -> Stamp {
        let nanos = self.0.elapsed().as_nanos() as i64;
        Stamp { monotonic: Time::from_nanos(nanos), system: UtcTime::from_nanos(nanos) }
    }
}

/// What was done with a speaker, with the time in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Done {
    Up(i64),
    Down(i64),
    Event(i64, BusEvent),
    Heard(i64, CanFrame),
    Woken(i64),
    Sent(i64),
    Refused(i64),
}

/// Says what it is given, and tries again so many milliseconds after it was refused.
#[derive(Default)]
struct Script {
    to_say: VecDeque<CanFrame>,
    wake_at: Option<Time>,
    every: Option<i64>,
    done: Vec<Done>,
}

fn millis(time: Time) -> i64 {
    time.as_nanos() / 1_000_000
}

impl Speaker for Script {
    fn up(&mut self, now: Time) {
        self.done.push(Done::Up(millis(now)));
    }
    fn down(&mut self, now: Time) {
        self.done.push(Done::Down(millis(now)));
    }
    fn bus_event(&mut self, event: BusEvent, now: Time) {
        self.done.push(Done::Event(millis(now), event));
    }
    fn hear(&mut self, frame: &CanFrame, now: Time) {
        self.done.push(Done::Heard(millis(now), *frame));
    }
    fn wake(&mut self, now: Time) {
        self.done.push(Done::Woken(millis(now)));
        self.wake_at = self.every.map(|every| now + span(every));
    }
    fn wake_at(&self) -> Option<Time> {
        self.wake_at
    }
    fn next_frame(&mut self, _: Time) -> Option<CanFrame> {
        self.to_say.front().copied()
    }
    fn sent(&mut self, now: Time) {
        self.to_say.pop_front();
        self.done.push(Done::Sent(millis(now)));
    }
    fn refused(&mut self, now: Time) {
        self.done.push(Done::Refused(millis(now)));
    }
}

fn span(millis: i64) -> Span {
    Span::from_nanos(millis * 1_000_000)
}

fn frame(number: u32) -> CanFrame {
    CanFrame::new(CanId::Extended(number), &number.to_le_bytes()).unwrap()
}

struct Bench {
    bus: MemoryBus,
    clock: Arc<dyn Clock>,
    node: SharedSpeaker<Script>,
    receiver: Receiver,
    _port: PortHandle,
}

impl Bench {
    fn new(script: Script) -> Self {
        Self::with(script, true)
    }

    fn with(script: Script, speaks: bool) -> Self {
        let clock = TokioTime::start();
        let (queue, receiver) = queue(WAITING_LIMIT);
        let surroundings = Surroundings { clock: Arc::clone(&clock), queue, judge: None };
        let bus = MemoryBus::new(Arc::clone(&clock));
        let node = SharedSpeaker::new(script);
        let speaker = speaks.then(|| node.for_port());
        let patience = Span::from_seconds(3.0);
        let port = spawn_on(PortId(1), bus.clone(), patience, surroundings, speaker);
        Bench { bus, clock, node, receiver, _port: port }
    }

    fn end(&self) -> MemoryEnd {
        self.bus.end().unwrap()
    }

    fn now(&self) -> i64 {
        millis(self.clock.now().monotonic)
    }

    fn done(&self) -> Vec<Done> {
        self.node.quietly(|script| std::mem::take(&mut script.done))
    }

    fn say(&self, numbers: impl IntoIterator<Item = u32>) {
        self.node.with(|script| script.to_say.extend(numbers.into_iter().map(frame)));
    }

    fn inputs(&mut self) -> Vec<Input> {
        std::iter::from_fn(|| self.receiver.try_recv().ok()).map(|arrival| arrival.input).collect()
    }
}

async fn wait(millis: u64) {
    sleep(Duration::from_millis(millis)).await;
}

/// Frames that have reached an end, without waiting for more.
async fn heard(end: &mut MemoryEnd) -> Vec<CanFrame> {
    let mut frames = Vec::new();
    while let Ok(next) = tokio::time::timeout(Duration::from_millis(1), end.next(false)).await {
        match next.unwrap() {
            Heard::Frame(_, frame) => frames.push(frame),
            other => panic!("{other:?}"),
        }
    }
    frames
}

#[tokio::test(start_paused = true)]
async fn frames_are_told_and_heard_in_order() {
    let mut bench = Bench::new(Script::default());
    let mut other = bench.end();
    wait(10).await;
    for number in 0..1000 {
        assert_eq!(other.try_send(&frame(number)), Ok(Sending::Sent));
    }
    wait(1).await;
    let inputs = bench.inputs();
    let told: Vec<&CanFrame> = inputs
        .iter()
        .filter_map(|input| if let Input::Can(frame) = input { Some(frame) } else { None })
        .collect();
    assert_eq!(told.len(), 1000);
    assert!((0..1000).zip(&told).all(|(number, told)| **told == frame(number)));
    let done = bench.done();
    assert!(matches!(done[0], Done::Up(0)) && done.len() == 1001, "{:?}", done[0]);
    assert!((0..1000).zip(&done[1..]).all(|(n, done)| *done == Done::Heard(10, frame(n))));
}

#[tokio::test(start_paused = true)]
async fn what_is_handed_in_leaves_at_once_and_in_order() {
    let bench = Bench::new(Script::default());
    let mut other = bench.end();
    wait(50).await;
    bench.say(0..100);
    wait(10).await;
    assert_eq!(heard(&mut other).await, (0..100).map(frame).collect::<Vec<_>>());
    let sent = bench.done().into_iter().filter(|done| matches!(done, Done::Sent(50..=56))).count();
    assert_eq!(sent, 100);
}

#[tokio::test(start_paused = true)]
async fn without_a_speaker_nothing_is_written() {
    let mut bench = Bench::with(Script::default(), false);
    let mut other = bench.end();
    bench.say(0..10);
    wait(5000).await;
    assert_eq!(heard(&mut other).await, []);
    assert!(bench.done().is_empty());
    let inputs = bench.inputs();
    let silent = matches!(
        inputs.as_slice(),
        [Input::State(PortState::Open { .. }), Input::State(PortState::Silent { .. })]
    );
    assert!(silent, "{inputs:?}");
}

#[tokio::test(start_paused = true)]
async fn a_speaker_is_woken_when_it_wants_to_the_millisecond() {
    let wake_at = Some(Time::from_nanos(100_000_000));
    let bench = Bench::new(Script { every: Some(250), wake_at, ..Script::default() });
    wait(1000).await;
    let woken = bench.done().split_off(1);
    assert_eq!(woken.len(), 4, "{woken:?}");
    for (woken, due) in woken.iter().zip([100, 350, 600, 850]) {
        let Done::Woken(at) = woken else { panic!("{woken:?}") };
        assert!((due..due + 5).contains(at), "{at} and not {due}");
    }
}

#[tokio::test(start_paused = true)]
async fn a_speaker_that_is_always_due_does_not_stop_the_others() {
    let bench =
        Bench::new(Script { every: Some(0), wake_at: Some(Time::START), ..Script::default() });
    wait(100).await;
    let woken = bench.done().len();
    assert!((50..=102).contains(&woken), "{woken}");
}

#[tokio::test(start_paused = true)]
async fn a_frame_that_is_refused_is_sent_when_there_is_room_and_none_is_lost() {
    let mut bench = Bench::new(Script::default());
    let mut other = bench.end();
    bench.bus.room(Some(3));
    bench.say(0..40);
    wait(10).await;
    let count =
        |done: &[Done], wanted: fn(&Done) -> bool| done.iter().filter(|d| wanted(d)).count();
    let done = bench.done();
    assert_eq!(count(&done, |done| matches!(done, Done::Sent(_))), 3);
    assert_eq!(count(&done, |done| matches!(done, Done::Refused(_))), 1, "asked without end");
    // the storm: room for two, again and again, while others speak
    for number in 0..18 {
        assert_eq!(bench.bus.end().unwrap().try_send(&frame(900 + number)), Ok(Sending::Full));
        bench.bus.room(Some(2));
        wait(10).await;
    }
    bench.bus.room(None);
    wait(10).await;
    assert_eq!(heard(&mut other).await, (0..40).map(frame).collect::<Vec<_>>());
    assert_eq!(bench.inputs().len(), 1, "no trouble is told");
}

#[tokio::test(start_paused = true)]
async fn a_speaker_that_is_refused_is_asked_again_when_it_wants_to_be_woken() {
    let wake_at = Some(Time::from_nanos(30_000_000));
    let bench = Bench::new(Script { every: Some(20), wake_at, ..Script::default() });
    bench.bus.room(Some(0));
    bench.say([1]);
    wait(95).await;
    let refused: Vec<i64> = bench
        .done()
        .iter()
        .filter_map(|done| if let Done::Refused(at) = done { Some(*at) } else { None })
        .collect();
    assert_eq!(refused.len(), 5, "{refused:?}");
}

#[tokio::test(start_paused = true)]
async fn what_others_say_is_heard_while_there_is_no_room_to_speak() {
    let mut bench = Bench::new(Script::default());
    let mut other = bench.end();
    wait(1).await;
    bench.say([1]);
    other.try_send(&frame(7)).unwrap();
    bench.bus.room(Some(0));
    wait(1).await;
    assert!(bench.inputs().contains(&Input::Can(frame(7))));
}

#[tokio::test(start_paused = true)]
async fn a_controller_that_is_off_is_left_alone_until_it_is_back() {
    for back in [Some(BusEvent::Restarted), None] {
        let mut bench = Bench::new(Script::default());
        wait(5).await;
        bench.bus.say(BusEvent::BusOff);
        wait(1).await;
        bench.say([1]);
        wait(400).await;
        let told = [Done::Up(0), Done::Event(5, BusEvent::BusOff)];
        assert_eq!(bench.done(), told, "nothing is sent");
        match back {
            Some(event) => bench.bus.say(event),
            None => assert_eq!(bench.end().try_send(&frame(7)), Ok(Sending::Sent)),
        }
        wait(1).await;
        let done = bench.done();
        let at = 406;
        let restarted = Done::Event(at, BusEvent::Restarted);
        match back {
            Some(_) => assert_eq!(done, [restarted, Done::Sent(at)]),
            None => assert_eq!(done, [restarted, Done::Heard(at, frame(7)), Done::Sent(at)]),
        }
        let inputs = bench.inputs();
        assert!(inputs.contains(&Input::Bus(BusEvent::BusOff)));
        assert_eq!(inputs.contains(&Input::Bus(BusEvent::Restarted)), back.is_some());
    }
}

#[tokio::test(start_paused = true)]
async fn a_controller_that_says_no_more_is_tried_after_half_a_second() {
    let bench = Bench::new(Script::default());
    wait(5).await;
    bench.bus.say(BusEvent::BusOff);
    wait(1).await;
    bench.say([1]);
    wait(2000).await;
    let done = bench.done();
    let [_, _, Done::Event(at, BusEvent::Restarted), Done::Sent(_)] = done[..] else {
        panic!("{done:?}")
    };
    assert!((505..510).contains(&at), "{at}");
}

#[tokio::test(start_paused = true)]
async fn a_bus_that_goes_down_and_comes_back_is_told_to_all() {
    let mut bench = Bench::new(Script::default());
    wait(5).await;
    bench.bus.down();
    wait(10_000).await;
    bench.say([1]);
    let up = bench.now();
    bench.bus.up();
    let mut other = bench.end();
    // a bus in memory is waited for as a gateway is
    wait(5000).await;
    assert_eq!(heard(&mut other).await, [frame(1)]);
    let done = bench.done();
    let [Done::Up(0), Done::Down(5), Done::Up(at), Done::Sent(_)] = done[..] else {
        panic!("{done:?}")
    };
    assert!(at - up <= 5000, "{at} after {up}");
    let states: Vec<String> = bench
        .inputs()
        .iter()
        .filter_map(
            |input| if let Input::State(state) = input { Some(state.to_string()) } else { None },
        )
        .collect();
    let kinds: Vec<&str> =
        states.iter().filter_map(|state| state.split([':', ' ']).next()).collect();
    assert_eq!(kinds, ["open", "lost", "absent", "open", "silent"], "{states:?}");
}

#[tokio::test(start_paused = true)]
async fn frames_that_nobody_takes_are_counted() {
    let mut bench = Bench::new(Script::default());
    let mut other = bench.end();
    wait(1).await;
    for number in 0..20_000 {
        other.try_send(&frame(number)).unwrap();
    }
    wait(1).await;
    let mut inputs = bench.inputs();
    // the report of the rest comes a second later
    wait(1500).await;
    inputs.extend(bench.inputs());
    let frames = inputs.iter().filter(|input| matches!(input, Input::Can(_))).count() as u64;
    let dropped: u64 = inputs
        .iter()
        .map(|input| match input {
            Input::State(PortState::Overrun { bytes }) => bytes / crate::ports::FRAME as u64,
            _ => 0,
        })
        .sum();
    assert_eq!(frames + dropped, 20_000);
    assert!(dropped > 10_000);
}
