//! Messages that wait to be written to one device or one client.
//!
//! Overflow policy: only whole messages wait; when there are more bytes than may wait, the **oldest
//! messages** are dropped and counted. Putting one in never waits.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::Notify;

/// A bounded queue of whole messages.
#[derive(Clone, Debug)]
pub(super) struct Outbox {
    shared: Arc<Shared>,
    dropped: Arc<AtomicU64>,
}

#[derive(Debug)]
struct Shared {
    messages: Mutex<Messages>,
    limit: usize,
    ready: Notify,
}

#[derive(Debug, Default)]
struct Messages {
    queue: VecDeque<Vec<u8>>,
    bytes: usize,
}

/// A message that is being written. It counts as dropped unless it is marked as written.
#[derive(Debug)]
pub(super) struct Leaving {
    /// The message.
    pub(super) bytes: Vec<u8>,
    dropped: Arc<AtomicU64>,
    written: bool,
}

impl Outbox {
    /// An outbox in which so many bytes may wait.
    pub(super) fn new(limit: usize) -> Self {
        Outbox::counting(limit, Arc::default())
    }

    /// One for a client of this one: what it drops counts here.
    pub(super) fn for_client(&self) -> Self {
        Outbox::counting(self.shared.limit, Arc::clone(&self.dropped))
    }

    fn counting(limit: usize, dropped: Arc<AtomicU64>) -> Self {
        let (messages, ready) = (Mutex::default(), Notify::new());
        Outbox { shared: Arc::new(Shared { messages, limit, ready }), dropped }
    }

    /// Puts a message in.
    pub(super) fn send(&self, message: Vec<u8>) {
        if message.is_empty() {
            return;
        }
        if message.len() > self.shared.limit {
            self.count(1);
            return;
        }
        let mut messages = self.lock();
        messages.bytes += message.len();
        messages.queue.push_back(message);
        while messages.bytes > self.shared.limit {
            let Some(oldest) = messages.queue.pop_front() else { break };
            messages.bytes -= oldest.len();
            self.count(1);
        }
        drop(messages);
        self.shared.ready.notify_one();
    }

    /// Takes the oldest message, waiting for one. Nothing is lost if the future is dropped.
    pub(super) async fn next(&self) -> Leaving {
        loop {
            let ready = self.shared.ready.notified();
            if let Some(bytes) = self.take() {
                return Leaving { bytes, dropped: Arc::clone(&self.dropped), written: false };
            }
            ready.await;
        }
    }

    /// Drops what waits: after an absence it is old.
    pub(super) fn clear(&self) {
        let mut messages = self.lock();
        self.count(messages.queue.len() as u64);
        *messages = Messages::default();
    }

    /// Counts messages that were lost outside.
    pub(super) fn count(&self, messages: u64) {
        self.dropped.fetch_add(messages, Ordering::Relaxed);
    }

    /// Messages dropped since the start.
    pub(super) fn dropped(&self) -> u64 {
        self.dropped.load(Ordering::Relaxed)
    }

    fn take(&self) -> Option<Vec<u8>> {
        let mut messages = self.lock();
        let message = messages.queue.pop_front()?;
        messages.bytes -= message.len();
        Some(message)
    }

    fn lock(&self) -> MutexGuard<'_, Messages> {
        self.shared.messages.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Leaving {
    /// It has been handed over whole.
    pub(super) fn written(mut self) {
        self.written = true;
    }
}

impl Drop for Leaving {
    fn drop(&mut self) {
        if !self.written {
            self.dropped.fetch_add(1, Ordering::Relaxed);
        }
    }
}

/// The next message if there is an outbox; otherwise never.
pub(super) async fn next_of(outbox: Option<&Outbox>) -> Leaving {
    match outbox {
        Some(outbox) => outbox.next().await,
        None => std::future::pending().await,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn the_oldest_whole_messages_make_room() {
        let outbox = Outbox::new(10);
        for message in ["aaaa", "bbbb", "cccc", "longer than all that may wait"] {
            outbox.send(message.as_bytes().to_vec());
        }
        for expected in ["bbbb", "cccc"] {
            let leaving = outbox.next().await;
            assert_eq!(leaving.bytes, expected.as_bytes());
            leaving.written();
        }
        assert_eq!(outbox.dropped(), 2);
    }

    #[tokio::test]
    async fn what_was_taken_and_not_written_counts_as_dropped() {
        let outbox = Outbox::new(10);
        outbox.send(vec![1]);
        drop(outbox.next().await);
        outbox.send(vec![2]);
        outbox.clear();
        assert_eq!(outbox.dropped(), 2);
    }
}
