//! Hears all that is sent on an interface, whatever becomes of it, and keeps it.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use insd::clock::Clock;
use socketcan::{CanFrame, CanSocket, EmbeddedFrame, Id, Socket, SocketOptions};

/// How often it is looked whether the tap is to stop.
const TURN: Duration = Duration::from_millis(50);
/// How often an interface that is gone is looked for.
const LOOK: Duration = Duration::from_millis(5);
/// What the kernel says when the interface was deleted.
const GONE: i32 = rustix::io::Errno::NODEV.raw_os_error();
/// Bytes of frames that may wait: more than a test ever leaves waiting.
pub(crate) const BUFFER: usize = 8 << 20;

/// A frame, and when it was heard, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Heard {
    pub(crate) at: f64,
    pub(crate) id: u32,
    bytes: [u8; 8],
    length: usize,
}

impl Heard {
    pub(crate) fn new(at: f64, id: u32, data: &[u8]) -> Self {
        let mut bytes = [0xFF; 8];
        bytes[..data.len()].copy_from_slice(data);
        Heard { at, id, bytes, length: data.len() }
    }

    pub(crate) fn data(&self) -> &[u8] {
        &self.bytes[..self.length]
    }

    pub(crate) fn source(&self) -> u8 {
        self.id as u8
    }

    /// Number of the group. Below format 240 the lower byte is the destination.
    pub(crate) fn pgn(&self) -> u32 {
        let group = self.id >> 8 & 0x3_FFFF;
        if group >> 8 & 0xFF < 240 { group & 0x3_FF00 } else { group }
    }

    pub(crate) fn destination(&self) -> u8 {
        let group = self.id >> 8 & 0x3_FFFF;
        if group >> 8 & 0xFF < 240 { group as u8 } else { 255 }
    }
}

#[derive(Default)]
struct Log {
    frames: Mutex<Vec<Heard>>,
    more: Condvar,
    stop: AtomicBool,
}

/// A tap on an interface.
pub(crate) struct Tap {
    log: Arc<Log>,
    clock: Clock,
    thread: Option<JoinHandle<()>>,
}

impl Tap {
    pub(crate) fn on(name: &str) -> Self {
        let (log, clock) = (Arc::new(Log::default()), Clock::start());
        let first = open(name).unwrap();
        let thread = std::thread::spawn({
            let (log, name) = (Arc::clone(&log), name.to_owned());
            move || listen(&log, &name, first, &clock)
        });
        Tap { log, clock, thread: Some(thread) }
    }

    /// Seconds since it began.
    pub(crate) fn now(&self) -> f64 {
        self.clock.elapsed().as_secs_f64()
    }

    /// All frames so far.
    pub(crate) fn frames(&self) -> Vec<Heard> {
        self.log.frames.lock().unwrap().clone()
    }

    /// Frames since a time.
    pub(crate) fn since(&self, time: f64) -> Vec<Heard> {
        self.frames().into_iter().filter(|frame| frame.at >= time).collect()
    }

    /// Waits for a frame heard since a time that is as wanted; `None` if none comes within the patience.
    pub(crate) fn wait(
        &self,
        since: f64,
        patience: Duration,
        mut wanted: impl FnMut(&Heard) -> bool,
    ) -> Option<Heard> {
        let end = self.clock.elapsed() + patience;
        let mut frames = self.log.frames.lock().unwrap();
        let mut next = frames.partition_point(|frame| frame.at < since);
        loop {
            while let Some(frame) = frames.get(next).copied() {
                next += 1;
                if wanted(&frame) {
                    return Some(frame);
                }
            }
            let left = end.checked_sub(self.clock.elapsed())?;
            frames = self.log.more.wait_timeout(frames, left).unwrap().0;
        }
    }
}

impl Drop for Tap {
    fn drop(&mut self) {
        self.log.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn open(name: &str) -> Option<CanSocket> {
    let socket = CanSocket::open(name).ok()?;
    socket.set_read_timeout(TURN).ok()?;
    socket.as_raw_socket().set_recv_buffer_size(BUFFER).ok()?;
    socket.set_error_filter_drop_all().ok()?;
    Some(socket)
}

fn listen(log: &Log, name: &str, first: CanSocket, clock: &Clock) {
    let mut socket = Some(first);
    while !log.stop.load(Ordering::Relaxed) {
        let Some(own) = &socket else {
            std::thread::sleep(LOOK);
            socket = open(name);
            continue;
        };
        match own.read_frame() {
            Ok(CanFrame::Data(frame)) => {
                let id = match frame.id() {
                    Id::Extended(id) => id.as_raw(),
                    Id::Standard(_) => continue,
                };
                let mut frames = log.frames.lock().unwrap();
                frames.push(Heard::new(clock.elapsed().as_secs_f64(), id, frame.data()));
                log.more.notify_all();
            }
            Ok(_) => {}
            // also "the network is down": the socket hears again when it is up
            Err(error) if error.raw_os_error() != Some(GONE) => {}
            Err(_) => socket = None,
        }
    }
}
