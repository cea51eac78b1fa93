//! A writer on a thread of its own, so that a slow disk delays nobody.

use std::io;
use std::mem;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, JoinHandle};

use insd_base::{Arrival, Span, Time};

use super::error::RawWriteError;
use super::writer::{RawWriter, RawWritten, payload};

/// Arrivals that may wait for the disk: a minute of a busy ship.
const QUEUE: usize = 16 * 1024;
/// Bytes of payload that may wait for the disk.
const QUEUE_BYTES: usize = 16 * 1024 * 1024;
/// After a failure of the disk it is left alone for so long.
const RETRY_AFTER: Span = Span::from_nanos(5_000_000_000);

/// Records on a thread of its own. No call waits for the disk, apart from [`Recorder::finish`] and
/// the drop. Arrivals for which there is no room, because the disk is slow or fails, are left out of
/// the recording, which tells how many.
#[derive(Debug)]
pub struct Recorder {
    sender: Option<SyncSender<Message>>,
    thread: Option<JoinHandle<()>>,
    shared: Arc<Shared>,
    /// Arrivals left out since the last that was taken.
    dropped: u64,
}

/// How a recording is going.
#[derive(Clone, Debug, Default)]
pub struct RecorderState {
    /// What is on the disk, and what was left out.
    pub written: RawWritten,
    /// Why nothing is recorded at present, or why old files stay. Cleared when the disk works again.
    pub fault: Option<Arc<RawWriteError>>,
}

impl RecorderState {
    /// Whether the disk does not take what arrives.
    #[must_use]
    pub fn is_failing(&self) -> bool {
        self.fault.as_deref().is_some_and(|fault| !matches!(fault, RawWriteError::TooLong { .. }))
    }
}

#[derive(Debug)]
enum Message {
    /// An arrival, and how many before it were left out.
    Arrival(u64, Arrival),
    /// What time it is, on the monotonic clock.
    Tick(Time),
    /// So many arrivals were left out, and none will come after them.
    Dropped(u64),
}

/// What the two threads share.
#[derive(Debug, Default)]
struct Shared {
    /// Bytes of payload in the queue.
    bytes: AtomicUsize,
    state: Mutex<RecorderState>,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, RecorderState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Recorder {
    /// Starts the thread.
    ///
    /// # Errors
    /// The system grants no thread.
    pub fn start(writer: RawWriter) -> io::Result<Self> {
        Self::with_queue(writer, QUEUE)
    }

    pub(crate) fn with_queue(writer: RawWriter, queue: usize) -> io::Result<Self> {
        let (sender, receiver) = sync_channel(queue);
        let shared = Arc::new(Shared::default());
        let worker = Worker { writer, shared: Arc::clone(&shared), failed: None };
        let thread =
            Builder::new().name("recorder".to_owned()).spawn(move || worker.run(&receiver))?;
        Ok(Recorder { sender: Some(sender), thread: Some(thread), shared, dropped: 0 })
    }

    /// Records an arrival, or counts it as left out.
    pub fn record(&mut self, arrival: &Arrival) {
        let bytes = payload(&arrival.input);
        let waiting = self.shared.bytes.fetch_add(bytes, Ordering::Relaxed);
        let dropped = mem::take(&mut self.dropped);
        let is_room = waiting + bytes <= QUEUE_BYTES;
        let sent = is_room && self.send(Message::Arrival(dropped, arrival.clone()));
        if !sent {
            self.shared.bytes.fetch_sub(bytes, Ordering::Relaxed);
            self.dropped = dropped.saturating_add(1);
        }
    }

    /// Tells the time, on the monotonic clock of the stamps: to be called once a second or so, as what
    /// has waited for a second goes to the disk then, even if nothing arrives any more.
    pub fn tick(&mut self, now: Time) {
        // where there is no room the disk is at work as it is
        self.send(Message::Tick(now));
    }

    /// How it is going.
    #[must_use]
    pub fn state(&self) -> RecorderState {
        let mut state = self.shared.state().clone();
        state.written.dropped = state.written.dropped.saturating_add(self.dropped);
        state
    }

    /// Writes what is waiting, and ends. Waits for the disk.
    #[must_use]
    pub fn finish(mut self) -> RecorderState {
        self.close();
        self.state()
    }

    fn send(&self, message: Message) -> bool {
        let Some(sender) = &self.sender else { return false };
        !matches!(
            sender.try_send(message),
            Err(TrySendError::Full(_) | TrySendError::Disconnected(_))
        )
    }

    fn close(&mut self) {
        if let Some(sender) = self.sender.take()
            && self.dropped > 0
            && sender.send(Message::Dropped(self.dropped)).is_ok()
        {
            self.dropped = 0;
        }
        if let Some(thread) = self.thread.take() {
            // a thread that panicked has nothing more to say
            let _ = thread.join();
        }
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        self.close();
    }
}

/// The thread's side.
#[derive(Debug)]
struct Worker {
    writer: RawWriter,
    shared: Arc<Shared>,
    /// When the disk failed.
    failed: Option<Time>,
}

impl Worker {
    fn run(mut self, receiver: &Receiver<Message>) {
        for message in receiver {
            self.handle(message);
        }
        let written = self.writer.flush();
        self.judge(written, Time::START);
        self.tell();
    }

    fn handle(&mut self, message: Message) {
        match message {
            Message::Arrival(dropped, arrival) => {
                self.shared.bytes.fetch_sub(payload(&arrival.input), Ordering::Relaxed);
                self.writer.drop_arrivals(dropped);
                let now = arrival.stamp.monotonic;
                if self.is_waiting(now) {
                    self.writer.drop_arrivals(1);
                } else {
                    let written = self.writer.record(&arrival);
                    self.judge(written, now);
                }
            }
            Message::Tick(now) if !self.is_waiting(now) => {
                let written = self.writer.tick(now);
                self.judge(written, now);
            }
            Message::Tick(_) => {}
            Message::Dropped(dropped) => self.writer.drop_arrivals(dropped),
        }
        self.tell();
    }

    fn tell(&self) {
        self.shared.state().written = self.writer.written();
    }

    /// Whether the disk is left alone after a failure.
    fn is_waiting(&self, now: Time) -> bool {
        self.failed.is_some_and(|failed| (Span::ZERO..RETRY_AFTER).contains(&(now - failed)))
    }

    fn judge(&mut self, result: Result<(), RawWriteError>, now: Time) {
        let records = self.writer.written().records;
        let mut state = self.shared.state();
        match result {
            Err(fault) => {
                if !matches!(fault, RawWriteError::TooLong { .. }) {
                    self.failed = Some(now);
                }
                state.fault = Some(Arc::new(fault));
            }
            Ok(()) if records > state.written.records => {
                self.failed = None;
                state.fault = self.writer.unremoved();
            }
            Ok(()) => {}
        }
    }
}
