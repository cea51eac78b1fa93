//! Pulses per second from the kernel's devices, `/dev/ppsN`.
//!
//! The kernel stamps an edge with its realtime clock, which may step. The time on the monotonic clock
//! is found from both clocks, read together just after the edge: only a step between the edge and
//! that reading, some tens of microseconds, could touch it.

use std::io::{Error, ErrorKind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::Duration;

use insd_base::{Pulse, Span, UtcTime};
use pps_time::PpsDevice;
use pps_time::pps::{pps_fdata, pps_ktime};

use super::attempt::{Outcome, Pause, tell};
use super::clock::{both_clocks, monotonic_at};
use super::config::{Edge, Pps};
use super::teller::Teller;

/// Longest wait for one edge, seconds: also how soon the thread stops.
const WAIT_S: i64 = 1;

/// Longest time from an edge to its reading. Beyond, the clock has stepped in between.
const READING: Span = Span::from_nanos(1_500_000_000);

/// Longest sleep of a thread that may be told to stop.
const SLICE: Duration = Duration::from_millis(100);

/// Starts the thread of a pulse. It ends within a second after the flag was set.
pub(super) fn spawn(config: Pps, teller: Teller, attempts: Arc<AtomicU64>) -> Arc<AtomicBool> {
    let stop = Arc::<AtomicBool>::default();
    let flag = Arc::clone(&stop);
    let mut spare = teller.clone();
    let thread = thread::Builder::new().name("pps".to_owned());
    if let Err(error) = thread.spawn(move || run(&config, teller, &attempts, &flag)) {
        spare.absent(format!("no thread: {error}"));
    }
    stop
}

fn run(config: &Pps, mut teller: Teller, attempts: &AtomicU64, stop: &AtomicBool) {
    let mut pause = Pause::default();
    while !stop.load(Ordering::Relaxed) {
        attempts.fetch_add(1, Ordering::Relaxed);
        teller.begin();
        let Some(outcome) = attempt(config, &mut teller, stop) else { return };
        tell(outcome, &mut teller);
        let mut left = pause.after(teller.open_for());
        while !left.is_zero() && !stop.load(Ordering::Relaxed) {
            thread::sleep(left.min(SLICE));
            left = left.saturating_sub(SLICE);
        }
    }
}

/// Listens until the device is lost, or until it is to stop: then there is no outcome.
fn attempt(config: &Pps, teller: &mut Teller, stop: &AtomicBool) -> Option<Outcome> {
    let path = config.device.display();
    let mut device = match open(config) {
        Ok(device) => device,
        Err(error) => return Some(Outcome::Absent(format!("{path}: {error}"))),
    };
    let mut last = newest(&device, config.edge);
    teller.open(path.to_string());
    while !stop.load(Ordering::Relaxed) {
        match device.fetch_timeout(WAIT_S, 0) {
            Ok(data) => last = Some(take(edge(&data, config.edge), last, teller)),
            Err(error) if is_wait(&error) => {}
            Err(error) => return Some(Outcome::Lost(error.to_string())),
        }
        teller.tick();
        if teller.is_silent() {
            // a source that was removed and made again says nothing to those who hold the old one
            device = match open(config) {
                Ok(again) => again,
                Err(error) => return Some(Outcome::Lost(error.to_string())),
            };
            // it counts anew, and may have reached the number of the old one
            last = newest(&device, config.edge);
        }
    }
    None
}

/// Opens the device, and makes sure that it answers as one and can wait for an edge.
fn open(config: &Pps) -> Result<PpsDevice, Error> {
    const CAN_WAIT: u32 = pps_time::pps::PPS_CANWAIT;
    let device = PpsDevice::new(config.device.clone())?;
    if device.get_cap()? & CAN_WAIT == 0 {
        return Err(Error::new(ErrorKind::Unsupported, "it cannot wait for an edge"));
    }
    Ok(device)
}

/// Number of the newest edge so far.
fn newest(device: &PpsDevice, kind: Edge) -> Option<u32> {
    device.fetch_non_blocking().ok().map(|data| edge(&data, kind).1)
}

fn is_wait(error: &Error) -> bool {
    [ErrorKind::TimedOut, ErrorKind::Interrupted, ErrorKind::WouldBlock].contains(&error.kind())
}

/// Time and number of the last edge of this kind.
fn edge(data: &pps_fdata, edge: Edge) -> (UtcTime, u32) {
    match edge {
        Edge::Assert => (utc(data.info.assert_tu), data.info.assert_sequence),
        Edge::Clear => (utc(data.info.clear_tu), data.info.clear_sequence),
    }
}

fn utc(time: pps_ktime) -> UtcTime {
    UtcTime::from_nanos(time.sec.saturating_mul(1_000_000_000).saturating_add(time.nsec.into()))
}

/// Tells the edge if it is a new one. Gives its number. An edge during which the clock stepped is left
/// out: the gap in the numbers tells so.
fn take((edge, sequence): (UtcTime, u32), last: Option<u32>, teller: &mut Teller) -> u32 {
    let stamp = both_clocks(&*teller.clock());
    let time = monotonic_at(stamp, edge, READING).filter(|_| last != Some(sequence));
    if let Some(time) = time {
        teller.pulse(stamp, Pulse { time, sequence });
    }
    sequence
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ports::{Clock, Receiver, WAITING_LIMIT, queue};
    use insd_base::{Input, PortId, Stamp, Time};

    fn stamp(system: i64) -> Stamp {
        let system = UtcTime::from_nanos(system);
        Stamp { monotonic: Time::from_nanos(5_000_000_000), system }
    }

    const EDGE: i64 = 1_800_000_000_000_000_000;

    /// Clocks that stand still. Whoever reads them is interrupted at the reading of this number.
    struct Fixed(Option<u64>, AtomicU64);

    impl Clock for Fixed {
        fn now(&self) -> Stamp {
            let interrupted = self.0 == Some(self.1.fetch_add(1, Ordering::Relaxed));
            stamp(EDGE + if interrupted { 7_000_000 } else { 40_000 })
        }
    }

    fn teller(interrupted: Option<u64>) -> (Teller, Receiver) {
        let (queue, receiver) = queue(WAITING_LIMIT);
        let patience = Some(Span::from_seconds(3.0));
        (
            Teller::new(
                PortId(1),
                Arc::new(Fixed(interrupted, AtomicU64::new(0))),
                queue,
                patience,
            ),
            receiver,
        )
    }

    #[test]
    fn an_edge_is_dated_on_the_monotonic_clock_wherever_the_other_stands() {
        for step in [0, -3_600_000_000_000, 77_000_000_000] {
            let time = monotonic_at(
                stamp(EDGE + step + 40_000),
                UtcTime::from_nanos(EDGE + step),
                READING,
            );
            assert_eq!(time, Some(Time::from_nanos(4_999_960_000)));
        }
    }

    #[test]
    fn an_edge_during_which_the_clock_stepped_is_left_out() {
        for step in [-1_000_000, 2_000_000_000, i64::MIN] {
            let after = stamp(EDGE.saturating_add(step));
            assert_eq!(monotonic_at(after, UtcTime::from_nanos(EDGE), READING), None);
        }
    }

    #[test]
    fn an_edge_is_told_once() {
        let (mut teller, mut receiver) = teller(None);
        let edges = [(7, Some(6)), (7, Some(7)), (8, Some(7))];
        for (sequence, last) in edges {
            assert_eq!(take((UtcTime::from_nanos(EDGE), sequence), last, &mut teller), sequence);
        }
        drop(teller);
        let pulses = std::iter::from_fn(|| receiver.recv_blocking()).map(|arrival| arrival.input);
        let time = Time::from_nanos(4_999_960_000);
        let expected = [7, 8].map(|sequence| Input::Pulse(Pulse { time, sequence }));
        assert_eq!(pulses.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn an_interruption_between_the_readings_of_the_clocks_moves_no_edge() {
        for reading in 0..3 {
            let (mut teller, mut receiver) = teller(Some(reading));
            take((UtcTime::from_nanos(EDGE), 7), Some(6), &mut teller);
            let time = Time::from_nanos(4_999_960_000);
            let pulse = Input::Pulse(Pulse { time, sequence: 7 });
            assert_eq!(receiver.try_recv().unwrap().input, pulse);
        }
    }

    #[test]
    fn the_edge_that_is_asked_for_is_taken() {
        let mut data = pps_fdata::default();
        data.info.assert_sequence = 3;
        data.info.clear_sequence = 4;
        data.info.clear_tu = pps_ktime { sec: 2, nsec: 5, flags: 0 };
        assert_eq!(edge(&data, Edge::Assert), (UtcTime::from_nanos(0), 3));
        assert_eq!(edge(&data, Edge::Clear), (UtcTime::from_nanos(2_000_000_005), 4));
    }
}
