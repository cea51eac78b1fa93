//! CAN ports on interfaces of a real kernel, in the guest of `tests/vm`.
//!
//! The interfaces are virtual ones, which `ip` makes and deletes, and two controllers that QEMU emulates on
//! one bus. A second socket says what others on the bus would say, and what a controller would.

// helpers of tests are not seen as tests
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod clocks;

use std::collections::VecDeque;
use std::path::Path;
use std::process::Command;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::Duration;

use insd_base::{Arrival, BusEvent, CanFrame, CanId, Input, PortId, PortState, Span, Stamp, Time};
use insd_drivers::can::{CanFilter, SharedSpeaker, Socketcan, Speaker, spawn};
use insd_drivers::ports::{
    Clock, PortConfig, PortHandle, Receiver, Surroundings, Transport, WAITING_LIMIT, queue,
};
use rustix::time::{ClockId, Timespec, clock_gettime, clock_settime};
use socketcan::{CanSocket, Socket};
use tokio::runtime::Runtime;

use clocks::Clocks;

/// Present in the guest only. Nothing below is to be done to a computer that is used.
const GUEST: &str = "/run/insd-vm";

const SECOND: Duration = Duration::from_secs(1);

/// From sending a frame to the kernel's time of it, at most.
const LATE: Span = Span::from_nanos(1_000_000);

/// Flags of the kernel's identifiers.
const EXTENDED: u32 = 0x8000_0000;
const REMOTE: u32 = 0x4000_0000;
const ERROR: u32 = 0x2000_0000;

fn run(program: &str, arguments: &str) {
    let status = Command::new(program).args(arguments.split(' ')).status().unwrap();
    assert!(status.success(), "{program} {arguments}");
}

fn ip(arguments: &str) {
    run("ip", arguments);
}

/// One test at a time, each with interfaces of its own.
fn turn() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    assert!(Path::new(GUEST).is_dir(), "this needs the guest, see tests/vm/README.md");
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A virtual interface that is up.
fn make(name: &str) {
    ip(&format!("link add {name} type vcan"));
    ip(&format!("link set {name} up"));
}

/// Says what others say, and hears what they hear.
struct Other(CanSocket);

impl Other {
    fn on(name: &str) -> Self {
        let socket = CanSocket::open(name).unwrap();
        socket.set_read_timeout(SECOND).unwrap();
        Other(socket)
    }

    /// Writes a frame with this identifier as the kernel has it.
    fn try_say(&self, id: u32, data: &[u8]) -> std::io::Result<()> {
        let mut bytes = [0; 16];
        bytes[..4].copy_from_slice(&id.to_ne_bytes());
        bytes[4] = data.len() as u8;
        bytes[8..8 + data.len()].copy_from_slice(data);
        rustix::io::write(self.0.as_raw_socket(), &bytes)?;
        Ok(())
    }

    fn say(&self, id: u32, data: &[u8]) {
        self.try_say(id, data).unwrap();
    }

    fn number(&self, number: u32) {
        self.say(EXTENDED | 0x09F1_1223, &number.to_be_bytes());
    }

    /// The data of the next frame; `None` after a second without one.
    fn hear(&self) -> Option<Vec<u8>> {
        use socketcan::EmbeddedFrame;
        self.0.read_frame().ok().map(|frame| frame.data().to_vec())
    }
}

fn frame(number: u32) -> CanFrame {
    CanFrame::new(CanId::Extended(0x09F1_1223), &number.to_be_bytes()).unwrap()
}

/// A node that says what it is given, and remembers what became of it.
#[derive(Default)]
struct Sayer {
    to_say: VecDeque<CanFrame>,
    heard: u64,
    refused: u64,
    ups: u64,
    downs: u64,
    events: Vec<BusEvent>,
}

impl Speaker for Sayer {
    fn up(&mut self, _: Time) {
        self.ups += 1;
    }
    fn down(&mut self, _: Time) {
        self.downs += 1;
    }
    fn bus_event(&mut self, event: BusEvent, _: Time) {
        self.events.push(event);
    }
    fn hear(&mut self, _: &CanFrame, _: Time) {
        self.heard += 1;
    }
    fn wake(&mut self, _: Time) {}
    fn wake_at(&self) -> Option<Time> {
        None
    }
    fn next_frame(&mut self, _: Time) -> Option<CanFrame> {
        self.to_say.front().copied()
    }
    fn sent(&mut self, _: Time) {
        self.to_say.pop_front();
    }
    fn refused(&mut self, _: Time) {
        self.refused += 1;
    }
}

/// A port on an interface, and what arrives of it.
struct Bench {
    clock: Arc<Clocks>,
    node: SharedSpeaker<Sayer>,
    receiver: Receiver,
    port: PortHandle,
    runtime: Runtime,
    _turn: MutexGuard<'static, ()>,
}

impl Bench {
    fn on(name: &str) -> Self {
        Self::filtered(turn(), name, Vec::new())
    }

    /// The port on an interface that may not be there.
    fn filtered(turn: MutexGuard<'static, ()>, name: &str, filters: Vec<CanFilter>) -> Self {
        let (queue, receiver) = queue(WAITING_LIMIT);
        let clock = Arc::new(Clocks::start());
        let surroundings = Surroundings { clock: clock.clone(), queue, judge: None };
        let transport = Transport::Socketcan(Socketcan { interface: name.to_owned() });
        let config = PortConfig { filters, patience_s: 3600.0, ..PortConfig::new(transport) };
        assert_eq!(config.faults(), Vec::<String>::new());
        let node = SharedSpeaker::new(Sayer::default());
        let mut builder = tokio::runtime::Builder::new_multi_thread();
        let runtime = builder.worker_threads(1).enable_all().build().unwrap();
        let port = runtime.block_on(async {
            let config = config.as_can().unwrap();
            spawn(PortId(1), config, surroundings, Some(node.for_port()))
        });
        Bench { clock, node, receiver, port, runtime, _turn: turn }
    }

    fn now(&self) -> Time {
        self.clock.now().monotonic
    }

    fn next(&mut self) -> Arrival {
        self.receiver.recv_timeout(10 * SECOND).expect("an arrival")
    }

    /// The next frame; states may come before it.
    fn frame(&mut self) -> (Stamp, CanFrame) {
        loop {
            let arrival = self.next();
            match arrival.input {
                Input::Can(frame) => return (arrival.stamp, frame),
                Input::State(_) => {}
                other => panic!("{other:?} where a frame was to come"),
            }
        }
    }

    fn state(&mut self) -> PortState {
        match self.next().input {
            Input::State(state) => state,
            other => panic!("{other:?} where a state was to come"),
        }
    }

    /// It opens; before that it may be there and down.
    fn opens(&mut self, name: &str) {
        let mut state = self.state();
        while matches!(state, PortState::Absent { .. }) {
            state = self.state();
        }
        assert_eq!(state, PortState::Open { what: name.to_owned() });
    }

    fn is_lost(&mut self) -> String {
        let state = self.state();
        let PortState::Lost { reason } = state else { panic!("{state}") };
        reason
    }

    fn is_absent(&mut self) -> String {
        let state = self.state();
        let PortState::Absent { reason } = state else { panic!("{state}") };
        reason
    }

    fn say(&self, numbers: std::ops::Range<u32>) {
        self.node.with(|sayer| sayer.to_say.extend(numbers.map(frame)));
    }

    /// Keeps the port's task from running for so long.
    fn hold_up(&self, span: Duration) {
        self.runtime.spawn(async move { sleep(span) });
        sleep(Duration::from_millis(5));
    }

    /// Frames, and frames told as dropped by the kernel and by the queue, until there are so many.
    fn count(&mut self, wanted: u64) -> (u64, u64) {
        let (mut frames, mut dropped) = (0, 0);
        while frames + dropped < wanted {
            match self.receiver.recv_timeout(3 * SECOND) {
                Err(_) => break,
                Ok(arrival) => match arrival.input {
                    Input::Can(_) => frames += 1,
                    Input::Bus(BusEvent::Dropped { frames }) => dropped += u64::from(frames),
                    Input::State(PortState::Overrun { bytes }) => dropped += bytes / 16,
                    _ => {}
                },
            }
        }
        (frames, dropped)
    }
}

fn step_system_clock(seconds: i64) {
    let now = clock_gettime(ClockId::Realtime);
    let stepped = Timespec { tv_sec: now.tv_sec + seconds, tv_nsec: now.tv_nsec };
    clock_settime(ClockId::Realtime, stepped).unwrap();
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_frame_is_dated_when_the_kernel_had_it_however_late_it_is_read() {
    let turn = turn();
    make("vcan1");
    let mut bench = Bench::filtered(turn, "vcan1", Vec::new());
    bench.opens("vcan1");
    let other = Other::on("vcan1");
    let mut latest = Span::ZERO;
    for number in 0..40 {
        sleep(Duration::from_millis(100));
        if number % 4 == 3 {
            bench.hold_up(SECOND / 20);
        }
        if number % 10 == 5 {
            step_system_clock(if number == 15 { -3600 } else { 3600 });
        }
        let sent = bench.now();
        other.number(number);
        let (stamp, heard) = bench.frame();
        assert_eq!(heard, frame(number));
        let late = stamp.monotonic - sent;
        assert!(late >= Span::ZERO && late < LATE, "dated {late:?} after it was sent");
        latest = latest.max(late);
        let read = bench.now() - stamp.monotonic;
        assert!(number % 4 != 3 || read > Span::from_nanos(40_000_000), "read after {read:?}");
    }
    println!("frames are dated within {latest:?}");
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn own_frames_and_remote_frames_are_not_heard_and_filters_hold() {
    let turn = turn();
    make("vcan2");
    let heading = CanFilter { id: 0x09F1_1200, mask: 0x1FFF_FF00, standard: false };
    let short = CanFilter { id: 0x100, mask: 0x700, standard: true };
    let mut bench = Bench::filtered(turn, "vcan2", vec![heading, short]);
    bench.opens("vcan2");
    let other = Other::on("vcan2");
    bench.say(0..3);
    for number in 0..3_u32 {
        assert_eq!(other.hear().unwrap(), number.to_be_bytes());
    }
    other.say(EXTENDED | 0x09F1_1323, &[1]);
    other.say(EXTENDED | REMOTE | 0x09F1_1223, &[]);
    other.say(0x200, &[2]);
    other.say(EXTENDED | 0x100, &[3]);
    other.say(0x123, &[4]);
    other.say(EXTENDED | 0x09F1_12FE, &[]);
    let expected = [(CanId::Standard(0x123), &[4][..]), (CanId::Extended(0x09F1_12FE), &[])];
    for (id, data) in expected {
        assert_eq!(bench.frame().1, CanFrame::new(id, data).unwrap());
    }
    sleep(SECOND);
    assert!(bench.receiver.try_recv().is_err());
    assert_eq!(bench.node.with(|sayer| sayer.heard), 2);
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn what_the_controller_says_is_told_and_nothing_is_sent_while_it_is_off() {
    let turn = turn();
    make("vcan3");
    let mut bench = Bench::filtered(turn, "vcan3", Vec::new());
    bench.opens("vcan3");
    let other = Other::on("vcan3");
    let state = |state: u8| [0, state, 0, 0, 0, 0, 0, 0];
    for (class, data, event) in [
        (0x204, state(0x08), BusEvent::Warning),
        (0x204, state(0x20), BusEvent::Passive),
        (0x204, state(0x40), BusEvent::Active),
        (0x88, state(0), BusEvent::Error { class: 0x88 }),
        (0x40, state(0), BusEvent::BusOff),
    ] {
        other.say(ERROR | class, &data);
        assert_eq!(bench.next().input, Input::Bus(event));
    }
    bench.say(0..1);
    sleep(SECOND / 4);
    other.say(ERROR | 0x100, &[0; 8]);
    let restarted = bench.now();
    assert_eq!(bench.next().input, Input::Bus(BusEvent::Restarted));
    assert_eq!(other.hear().unwrap(), 0_u32.to_be_bytes());
    assert!(bench.now() - restarted < Span::from_nanos(20_000_000));
    let events = bench.node.with(|sayer| std::mem::take(&mut sayer.events));
    assert_eq!(events.len(), 6, "{events:?}");
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn an_interface_that_goes_down_is_lost_and_heard_again_when_it_is_up() {
    let turn = turn();
    make("vcan4");
    let mut bench = Bench::filtered(turn, "vcan4", Vec::new());
    bench.opens("vcan4");
    for round in 1..=3 {
        ip("link set vcan4 down");
        assert!(bench.is_lost().contains("down"));
        assert!(bench.is_absent().starts_with("vcan4: Network is down"));
        sleep(20 * SECOND);
        bench.say(0..1);
        let other = Other::on("vcan4");
        ip("link set vcan4 up");
        let up = bench.now();
        bench.opens("vcan4");
        let back = bench.now() - up;
        assert!(back < Span::from_nanos(1_000_000_000), "after {back:?}");
        println!("up again: heard after {back:?}");
        // the other's socket was told that the interface was down, too
        let _ = other.hear();
        other.number(round);
        assert_eq!(bench.frame().1, frame(round));
        let counts = bench.node.with(|sayer| (sayer.ups, sayer.downs, sayer.to_say.len()));
        assert_eq!(counts, (u64::from(round) + 1, round.into(), 0));
    }
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn an_interface_that_is_deleted_and_made_anew_is_found_by_its_name() {
    let mut bench = Bench::on("vcan5");
    assert!(bench.is_absent().starts_with("vcan5: "));
    sleep(10 * SECOND);
    assert!(bench.receiver.try_recv().is_err(), "absence is told once");
    assert!((45..=52).contains(&bench.port.attempts()), "{} attempts", bench.port.attempts());
    for pause in [30 * SECOND, SECOND, Duration::ZERO] {
        make("vcan5");
        let up = bench.now();
        bench.opens("vcan5");
        let back = bench.now() - up;
        assert!(back < Span::from_nanos(1_000_000_000), "after {back:?}");
        println!("made anew: heard after {back:?}");
        let other = Other::on("vcan5");
        other.number(5);
        assert_eq!(bench.frame().1, frame(5));
        ip("link delete vcan5");
        bench.is_lost();
        bench.is_absent();
        sleep(pause);
    }
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_flood_is_heard_to_the_last_frame() {
    const FRAMES: u32 = 20_000;
    let turn = turn();
    make("vcan6");
    let mut bench = Bench::filtered(turn, "vcan6", Vec::new());
    bench.opens("vcan6");
    let other = Other::on("vcan6");
    let flood = std::thread::spawn(move || {
        for number in 0..FRAMES {
            other.number(number);
            if number % 4 == 3 {
                sleep(Duration::from_millis(2));
            }
        }
    });
    for number in 0..FRAMES {
        assert_eq!(bench.frame().1, frame(number));
    }
    flood.join().unwrap();
    assert_eq!(bench.node.with(|sayer| sayer.heard), u64::from(FRAMES));
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn frames_that_the_kernel_drops_are_counted() {
    const FRAMES: u32 = 20_000;
    let turn = turn();
    make("vcan7");
    let mut bench = Bench::filtered(turn, "vcan7", Vec::new());
    bench.opens("vcan7");
    let other = Other::on("vcan7");
    bench.hold_up(5 * SECOND);
    for number in 0..FRAMES {
        other.number(number);
    }
    sleep(6 * SECOND);
    // the kernel tells with the next frame how many there were before it
    other.number(FRAMES);
    let (frames, dropped) = bench.count(u64::from(FRAMES) + 1);
    println!("{frames} frames heard, {dropped} counted as dropped");
    assert_eq!(frames + dropped, u64::from(FRAMES) + 1);
    assert!(dropped > 1000);
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn frames_leave_in_order_and_none_is_lost_when_the_devices_queue_is_full() {
    const FRAMES: u32 = 2000;
    let turn = turn();
    for name in ["can0", "can1"] {
        ip(&format!("link set {name} type can bitrate 250000 restart-ms 100"));
        ip(&format!("link set {name} txqueuelen 10 up"));
    }
    // the emulated controllers send in no time: so slow as a bus, with room for ten frames of 16 bytes
    run("tc", "qdisc add dev can0 root tbf rate 128kbit burst 32 limit 160");
    let mut bench = Bench::filtered(turn, "can0", Vec::new());
    bench.opens("can0");
    let far = Other::on("can1");
    // another program of this computer fills the queue of the same device
    let greedy = Other::on("can0");
    let mut denied = 0;
    let mut numbers = Vec::new();
    for round in 0..FRAMES / 100 {
        for number in 0..40 {
            denied += u32::from(greedy.try_say(EXTENDED | 0x1F00_0000, &[number]).is_err());
        }
        bench.say(100 * round..100 * (round + 1));
        while numbers.len() < 100 * (round as usize + 1) {
            let heard = far.hear().expect("a frame");
            numbers.extend(<[u8; 4]>::try_from(heard).map(u32::from_be_bytes));
        }
    }
    assert_eq!(numbers, (0..FRAMES).collect::<Vec<_>>());
    let refused = bench.node.with(|sayer| sayer.refused);
    println!("refused {refused} times; another program was denied {denied} frames");
    assert!(refused > 0);
}
