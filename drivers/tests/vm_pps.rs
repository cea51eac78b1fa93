//! The port of pulses on a real kernel's device, in the guest of `tests/vm`.
//!
//! The kernel makes `/dev/pps0` of the interrupt line of the parallel port, and QEMU's parallel port
//! raises that line when its strobe is lowered. So the test raises it when it wants, by writing to the
//! port's registers; and it plugs and unplugs the port by binding and unbinding the driver.

// helpers of tests are not seen as tests
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod clocks;

use std::fs::{self, File};
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::Duration;

use insd_base::{Arrival, Input, PortId, PortState, Pulse, Span, Stamp, Time, UtcTime};
use insd_drivers::ports::{
    Clock, Edge, PortConfig, PortHandle, Pps, Receiver, Surroundings, Transport, WAITING_LIMIT,
    queue, spawn,
};
use insd_intake::clock::{ShipUtc, TimeQuality};
use rustix::time::{ClockId, Timespec, clock_gettime, clock_settime};

use clocks::Clocks;

/// Present in the guest only. Nothing below is to be done to a computer that is used.
const GUEST: &str = "/run/insd-vm";

const DEVICE: &str = "/dev/pps0";

/// The driver of the parallel port, where it is bound and unbound.
const DRIVER: &str = "/sys/bus/pnp/drivers/parport_pc";

/// The control register of the parallel port, and its bits: interrupts on, selected, no reset; strobe.
const CONTROL: u64 = 0x37a;
const IDLE: u8 = 0x1c;
const STROBE: u8 = 0x01;
/// Selected, held in reset, without interrupts.
const MUTE: u8 = 0x08;

/// From the rise of the line to the kernel's time of it, at most.
const LATE: Span = Span::from_nanos(1_000_000);

const SECOND: Duration = Duration::from_secs(1);
const HOUR: i64 = 3600;

/// The parallel port. There is one: tests take turns.
struct Line {
    registers: File,
    function: String,
    _turn: MutexGuard<'static, ()>,
}

impl Line {
    fn new() -> Self {
        static TURN: Mutex<()> = Mutex::new(());
        assert!(Path::new(GUEST).is_dir(), "this needs the guest, see tests/vm/README.md");
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        let registers = File::options().write(true).open("/dev/port").unwrap();
        let functions = fs::read_dir("/sys/bus/pnp/devices").unwrap().flatten();
        // the standard number of a parallel port
        let is_parallel = |path: &Path| {
            fs::read_to_string(path.join("id")).is_ok_and(|id| id.starts_with("PNP0400"))
        };
        let mut parallel = functions.filter(|entry| is_parallel(&entry.path()));
        let function = parallel.next().expect("a parallel port").file_name();
        let line = Line { registers, function: function.into_string().unwrap(), _turn: turn };
        line.plug();
        line
    }

    /// Raises the line and lowers it at once.
    fn raise(&self) {
        self.control(IDLE | STROBE);
        self.control(IDLE);
    }

    fn control(&self, byte: u8) {
        self.registers.write_all_at(&[byte], CONTROL).unwrap();
    }

    fn plug(&self) {
        self.tell_driver("bind", true);
    }

    /// Takes the device away. Mute, or its last word would be an edge more.
    fn unplug(&self) {
        self.control(MUTE);
        self.tell_driver("unbind", false);
    }

    fn tell_driver(&self, word: &str, there: bool) {
        if Path::new(DEVICE).exists() != there {
            fs::write(Path::new(DRIVER).join(word), &self.function).unwrap();
        }
        assert_eq!(Path::new(DEVICE).exists(), there, "{DEVICE} after {word}");
    }
}

/// A port that listens to the line, and what arrives of it.
struct Bench {
    line: Line,
    clock: Arc<Clocks>,
    receiver: Receiver,
    _port: PortHandle,
}

impl Bench {
    /// The port on a line that is there.
    fn open(edge: Edge) -> Self {
        let mut bench = Bench::listen(Line::new(), edge);
        bench.opens();
        bench
    }

    fn listen(line: Line, edge: Edge) -> Self {
        let (queue, receiver) = queue(WAITING_LIMIT);
        let clock = Arc::new(Clocks::start());
        let surroundings = Surroundings { clock: clock.clone(), queue, judge: None };
        let config = PortConfig::new(Transport::Pps(Pps { device: PathBuf::from(DEVICE), edge }));
        assert_eq!(config.faults(), Vec::<String>::new());
        let port = spawn(PortId(1), config, surroundings);
        Bench { line, clock, receiver, _port: port }
    }

    /// Raises the line at this time. Gives when it rose: not before it, and up to 0.1 ms after.
    fn raise_at(&self, time: Time) -> Time {
        let wait = time - self.clock.now().monotonic;
        sleep(Duration::from_nanos(wait.as_nanos().max(0).unsigned_abs()));
        let rise = self.clock.now().monotonic;
        self.line.raise();
        rise
    }

    /// Raises the line after each of these pauses, milliseconds. Gives when it rose.
    fn raise_after(&self, pauses: &[u32]) -> Vec<Time> {
        let raise = |pause: &u32| {
            let pause = Span::from_nanos(i64::from(*pause) * 1_000_000);
            self.raise_at(self.clock.now().monotonic + pause)
        };
        pauses.iter().map(raise).collect()
    }

    fn next(&mut self) -> Arrival {
        self.receiver.recv_timeout(10 * SECOND).expect("an arrival")
    }

    /// The next arrival, which is a state.
    fn state(&mut self) -> PortState {
        match self.next().input {
            Input::State(state) => state,
            other => panic!("{other:?} where a state was to come"),
        }
    }

    fn opens(&mut self) {
        assert_eq!(self.state(), PortState::Open { what: DEVICE.to_owned() });
    }

    fn falls_silent(&mut self) {
        let state = self.state();
        let PortState::Silent { span } = state else { panic!("{state}") };
        // the patience, and the wait of one second in which it ended
        assert!((3.0..4.1).contains(&span.as_seconds()), "{span:?}");
    }

    /// The next arrival, which is a pulse; with its stamp.
    fn pulse(&mut self) -> (Stamp, Pulse) {
        let arrival = self.next();
        match arrival.input {
            Input::Pulse(pulse) => (arrival.stamp, pulse),
            other => panic!("{other:?} where a pulse was to come"),
        }
    }

    /// The next arrivals are pulses of these rises of the line, each once. Gives them.
    fn pulses(&mut self, rises: &[Time]) -> Vec<Pulse> {
        let pulses: Vec<Pulse> = rises.iter().map(|rise| self.pulse_of(*rise).1).collect();
        for pair in pulses.windows(2) {
            assert_eq!(pair[1].sequence, pair[0].sequence + 1, "{pulses:?}");
        }
        pulses
    }

    fn pulse_of(&mut self, rise: Time) -> (Stamp, Pulse) {
        let (stamp, pulse) = self.pulse();
        let late = pulse.time - rise;
        assert!(late >= Span::ZERO && late < LATE, "dated {late:?} after the rise");
        assert!(stamp.monotonic > pulse.time, "dated when it was read");
        (stamp, pulse)
    }

    /// Nothing has arrived that was not looked at.
    fn nothing_more(&mut self) {
        let next = self.receiver.try_recv();
        assert!(next.is_err(), "{next:?}");
    }
}

fn step_system_clock(seconds: i64) {
    let now = clock_gettime(ClockId::Realtime);
    let stepped = Timespec { tv_sec: now.tv_sec + seconds, tv_nsec: now.tv_nsec };
    clock_settime(ClockId::Realtime, stepped).unwrap();
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_pulse_is_dated_when_its_line_rose() {
    for edge in [Edge::Assert, Edge::Clear] {
        let mut bench = Bench::open(edge);
        let rises = bench.raise_after(&[1000, 1000, 1000, 730, 1270, 999, 1001, 2500, 1000]);
        sleep(SECOND);
        bench.pulses(&rises);
        bench.nothing_more();
    }
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_stop_of_the_pulses_is_told_once_and_so_is_their_return() {
    let mut bench = Bench::open(Edge::Assert);
    let rises = bench.raise_after(&[1000, 1000, 1000]);
    bench.pulses(&rises);
    sleep(30 * SECOND);
    bench.falls_silent();
    bench.nothing_more();
    let rises = bench.raise_after(&[0, 1000, 1000]);
    assert_eq!(bench.state(), PortState::Speaking);
    bench.pulses(&rises);
    bench.nothing_more();
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_doubled_pulse_is_two_pulses() {
    let mut bench = Bench::open(Edge::Assert);
    // of edges that follow each other before the port could run, the kernel keeps the last
    for between in [300, 100, 30] {
        let rises = bench.raise_after(&[1000, between, 1000]);
        bench.pulses(&rises);
    }
    bench.nothing_more();
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_step_of_the_system_clock_moves_no_pulse() {
    let mut bench = Bench::open(Edge::Assert);
    let mut last = None;
    for step in [0, 0, HOUR, 0, -HOUR, -HOUR, 0, HOUR] {
        sleep(SECOND / 2);
        step_system_clock(step);
        let rises = bench.raise_after(&[500]);
        let (stamp, pulse) = bench.pulse_of(rises[0]);
        if let Some((before, number)) = last.replace((stamp, pulse.sequence)) {
            let before: Stamp = before;
            assert_eq!(pulse.sequence, number + 1);
            let system = (stamp.system.as_nanos() - before.system.as_nanos()) as f64 * 1e-9;
            let stepped = system - (stamp.monotonic - before.monotonic).as_seconds();
            assert!((stepped - step as f64).abs() < 0.1, "the clock did not step");
        }
    }
    bench.nothing_more();
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_device_that_is_not_there_yet_is_opened_when_it_is() {
    let line = Line::new();
    line.unplug();
    let mut bench = Bench::listen(line, Edge::Assert);
    let state = bench.state();
    assert!(matches!(&state, PortState::Absent { reason } if reason.contains(DEVICE)), "{state}");
    sleep(20 * SECOND);
    bench.nothing_more();
    bench.line.plug();
    bench.opens();
    let rises = bench.raise_after(&[0, 1000, 1000]);
    bench.pulses(&rises);
    bench.nothing_more();
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn a_device_that_goes_away_is_lost_and_opened_when_it_is_back() {
    let mut bench = Bench::open(Edge::Assert);
    let rises = bench.raise_after(&[1000, 1000, 1000]);
    bench.pulses(&rises);
    bench.line.unplug();
    sleep(20 * SECOND);
    bench.falls_silent();
    let states = [bench.state(), bench.state()];
    let lost = matches!(states, [PortState::Lost { .. }, PortState::Absent { .. }]);
    assert!(lost, "{states:?}");
    bench.line.plug();
    bench.opens();
    let rises = bench.raise_after(&[0, 1000, 1000]);
    bench.pulses(&rises);
    bench.nothing_more();
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn no_pulse_is_missed_where_a_new_device_counts_as_the_old_one_did() {
    let mut bench = Bench::open(Edge::Assert);
    let mut numbers = Vec::new();
    for _ in 0..3 {
        bench.line.unplug();
        bench.line.plug();
        sleep(10 * SECOND);
        bench.falls_silent();
        let rises = bench.raise_after(&[0]);
        assert_eq!(bench.state(), PortState::Speaking);
        numbers.push(bench.pulses(&rises)[0].sequence);
    }
    assert_eq!(numbers, [numbers[0]; 3], "the new devices count otherwise");
    bench.nothing_more();
}

#[test]
#[ignore = "needs the guest: tests/vm/runner"]
fn the_ships_utc_goes_by_the_pulses_and_not_by_the_system_clock() {
    let mut bench = Bench::open(Edge::Assert);
    let mut ship = ShipUtc::default();
    let begin = bench.clock.now().monotonic;
    let noon = UtcTime::from_civil((2026, 7, 1), (12, 0, 0), 0).unwrap();
    for second in 1..=60 {
        if second == 40 {
            step_system_clock(HOUR);
        }
        let since = Span::from_nanos(second * 1_000_000_000);
        let rise = bench.raise_at(begin + since);
        let (_, pulse) = bench.pulse_of(rise);
        ship.pulse(pulse);
        // the message that names the pulse
        let utc = noon.plus(since);
        let received = pulse.time + Span::from_nanos(200_000_000);
        assert!(ship.message((0, 0), utc.to_gps(), received, Span::ZERO));
        ship.tick(received);
        if second >= 30 {
            let error = ship.utc_at(rise).unwrap().since(utc).as_seconds();
            assert!(error.abs() < 1e-4, "{error} s at {second} s");
        }
    }
    assert_eq!(ship.quality(), TimeQuality::Pulses);
    bench.nothing_more();
}
