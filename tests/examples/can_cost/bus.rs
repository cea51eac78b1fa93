//! The other end of a gateway: what the daemon sends on its bus is counted, and other devices talk.

use std::net::UdpSocket;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{JoinHandle, sleep};
use std::time::Duration;

use insd::clock::Clock;
use insd_base::{CanFrame, UtcTime};
use insd_n2k::text::candump;
use insd_n2k::{N2kId, fast_packet};

/// A moment without a frame after which the threads look whether they shall stop.
const LOOK: Duration = Duration::from_millis(50);

/// Frames of a round of the other devices: groups in single frames, and fast packets with their bytes.
const SINGLE: [u32; 9] =
    [127_245, 127_250, 127_251, 127_257, 127_488, 128_267, 129_025, 129_026, 130_306];
const FAST: [(u32, usize); 2] = [(129_029, 51), (129_038, 28)];
/// Addresses from which each single frame comes.
const SOURCES: [u8; 3] = [10, 11, 12];

/// Frames that came, and the bits they take on a wire.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Counted {
    pub(crate) frames: u64,
    pub(crate) bits: u64,
    /// Frames that other devices sent.
    pub(crate) others: u64,
}

/// A bus on two sockets of this computer.
pub(crate) struct Bus {
    counted: Arc<Mutex<Counted>>,
    stop: Arc<AtomicBool>,
    threads: Vec<JoinHandle<()>>,
    /// Where the daemon listens, and where it sends to.
    pub(crate) ports: [u16; 2],
}

impl Bus {
    /// A bus on which other devices send so many frames a second.
    pub(crate) fn new(background: f64) -> Self {
        let own = UdpSocket::bind("127.0.0.1:0").unwrap();
        own.set_read_timeout(Some(LOOK)).unwrap();
        let free = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let ports = [free, own.local_addr().unwrap().port()];
        let (counted, stop) = (Arc::default(), Arc::default());
        let mut bus = Bus { counted, stop, threads: Vec::new(), ports };
        let speaks = own.try_clone().unwrap();
        let (counted, stop) = (Arc::clone(&bus.counted), Arc::clone(&bus.stop));
        bus.threads.push(std::thread::spawn(move || listen(&own, &counted, &stop)));
        if background > 0.0 {
            let (counted, stop) = (Arc::clone(&bus.counted), Arc::clone(&bus.stop));
            let talk = move || talk(&speaks, free, background, &counted, &stop);
            bus.threads.push(std::thread::spawn(talk));
        }
        bus
    }

    /// What came so far.
    pub(crate) fn counted(&self) -> Counted {
        *self.counted.lock().unwrap()
    }
}

impl Drop for Bus {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        self.threads.drain(..).for_each(|thread| thread.join().unwrap());
    }
}

fn listen(socket: &UdpSocket, counted: &Mutex<Counted>, stop: &AtomicBool) {
    let mut datagram = [0; 2048];
    while !stop.load(Ordering::Relaxed) {
        let Ok(length) = socket.recv(&mut datagram) else { continue };
        for line in datagram[..length].split(|byte| *byte == b'\n') {
            let Some(line) = candump::parse(line) else { continue };
            let mut counted = counted.lock().unwrap();
            counted.frames += 1;
            counted.bits += u64::from(line.frame.wire_bits());
        }
    }
}

/// Says what other devices say, one frame after the other at equal times.
fn talk(socket: &UdpSocket, to: u16, rate: f64, counted: &Mutex<Counted>, stop: &AtomicBool) {
    let clock = Clock::start();
    let mut sent = 0_u64;
    for round in (0..=u8::MAX).cycle() {
        for frame in conversation(round) {
            let wait = sent as f64 / rate - clock.elapsed().as_secs_f64();
            if wait > 0.0 {
                sleep(Duration::from_secs_f64(wait));
            }
            if stop.load(Ordering::Relaxed) {
                return;
            }
            let line = candump::write(UtcTime::from_nanos(0), "can0", &frame);
            // nobody listens yet while the daemon starts
            sent += 1;
            if socket.send_to(line.as_bytes(), ("127.0.0.1", to)).is_ok() {
                counted.lock().unwrap().others += 1;
            }
        }
    }
}

/// A round of 40 frames.
fn conversation(round: u8) -> Vec<CanFrame> {
    let id = |pgn, source| N2kId { priority: 3, pgn, source, destination: 255 };
    let data = |length: usize| (0..length).map(|at| (at as u8).wrapping_mul(37) ^ round);
    let message = |pgn, source, length| {
        fast_packet::split(id(pgn, source), &data(length).collect::<Vec<u8>>(), round & 7).unwrap()
    };
    let single = SOURCES.iter().flat_map(|source| SINGLE.map(|pgn| (pgn, *source, 8)));
    let fast = FAST.iter().map(|(pgn, length)| (*pgn, 13, *length));
    single.chain(fast).flat_map(|(pgn, source, length)| message(pgn, source, length)).collect()
}
