//! Messages on their way from whoever makes them to the tasks that write them.
//!
//! An [`Outlet`] is the hand-over of a port: it gives each message to all [`Outbox`]es, of which a device
//! has one and a TCP server one for each client. Handing over never waits for anybody. What waits in an
//! outbox, and what leaves it next, is the matter of [`Waiting`].

use std::fmt;
use std::future::poll_fn;
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::task::{Context, Poll};

use insd_base::{Span, Time};
use tokio::sync::Notify;

use super::clock::Clock;
use super::outgoing::Outgoing;
use super::pace::Pace;
use super::tally::Tally;
use super::waiting::{All, Item, Newest, Start, Waiting};

/// What may wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keeping {
    /// The newest message of each slot.
    Newest,
    /// All messages, in order.
    All,
}

/// The hand-over of a port.
#[derive(Clone)]
pub(super) struct Outlet {
    keeping: Keeping,
    limit: usize,
    clock: Arc<dyn Clock>,
    tally: Arc<Tally>,
    boxes: Arc<Mutex<Vec<Weak<Shared>>>>,
}

/// Messages that wait to be written to one device or client. When it is dropped so is what waits.
pub(super) struct Outbox(Arc<Shared>);

struct Shared {
    waiting: Mutex<Waiting>,
    limit: usize,
    ready: Notify,
    clock: Arc<dyn Clock>,
    tally: Arc<Tally>,
}

/// A message that is being written. It counts as dropped unless it is marked as written.
pub(super) struct Leaving {
    message: Arc<Outgoing>,
    tally: Arc<Tally>,
    written: bool,
}

impl Outlet {
    /// An outlet to outboxes, in each of which so many bytes may wait.
    pub(super) fn new(keeping: Keeping, limit: usize, clock: Arc<dyn Clock>) -> Self {
        Outlet { keeping, limit, clock, tally: Arc::default(), boxes: Arc::default() }
    }

    /// One outbox more: it gets what is handed over from now on.
    pub(super) fn outbox(&self) -> Outbox {
        let waiting = match self.keeping {
            Keeping::Newest => Waiting::Newest(Newest::default()),
            Keeping::All => Waiting::All(All::default()),
        };
        let shared = Arc::new(Shared {
            waiting: Mutex::new(waiting),
            limit: self.limit,
            ready: Notify::new(),
            clock: Arc::clone(&self.clock),
            tally: Arc::clone(&self.tally),
        });
        self.boxes().push(Arc::downgrade(&shared));
        Outbox(shared)
    }

    /// Hands a message over, and never waits.
    pub(super) fn send(&self, message: Outgoing) {
        if message.bytes.is_empty() {
            return;
        }
        let message = Arc::new(message);
        self.boxes().retain(|outbox| {
            let outbox = outbox.upgrade();
            outbox.inspect(|outbox| outbox.put(Arc::clone(&message))).is_some()
        });
    }

    /// What became of the messages.
    pub(super) fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Tells the time.
    pub(super) fn now(&self) -> Time {
        self.clock.now().monotonic
    }

    fn boxes(&self) -> MutexGuard<'_, Vec<Weak<Shared>>> {
        self.boxes.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl fmt::Debug for Outlet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Outlet").field("keeping", &self.keeping).finish_non_exhaustive()
    }
}

impl Outbox {
    /// Waits until something waits.
    pub(super) async fn something(&self) {
        loop {
            let ready = self.0.ready.notified();
            if !self.0.lock().is_empty() {
                return;
            }
            ready.await;
        }
    }

    /// The message that leaves next, unless nothing waits that is not too old.
    pub(super) fn take(&self, pace: Option<&Pace<'_>>) -> Option<Leaving> {
        self.0.take(self.0.start(pace)).map(|item| self.0.leaving(item))
    }

    /// The message that leaves next, waiting for one. Nothing is lost if the future is dropped.
    pub(super) async fn next(&self) -> Leaving {
        loop {
            self.something().await;
            if let Some(leaving) = self.take(None) {
                return leaving;
            }
        }
    }

    /// Waits for a message, and offers the one that leaves next to a writer until it takes some of it or
    /// fails. As long as the writer is not ready nothing is committed: what waits can still be replaced.
    pub(super) async fn offer(
        &self,
        pace: Option<&Pace<'_>>,
        mut write: impl FnMut(&mut Context<'_>, &[u8]) -> Poll<io::Result<usize>>,
    ) -> (Leaving, io::Result<usize>) {
        loop {
            self.something().await;
            let offered = poll_fn(|cx| {
                let Some(item) = self.0.take(self.0.start(pace)) else {
                    return Poll::Ready(None);
                };
                match write(cx, &item.message.bytes) {
                    Poll::Ready(result) => Poll::Ready(Some((self.0.leaving(item), result))),
                    Poll::Pending => {
                        self.0.put_back(item);
                        Poll::Pending
                    }
                }
            });
            if let Some(offered) = offered.await {
                return offered;
            }
        }
    }

    /// Drops what waits: after an absence it is old.
    pub(super) fn clear(&self) {
        self.0.clear();
    }

    /// A message of this slot was sent and will never be read.
    pub(super) fn unread(&self, slot: u16) {
        self.0.tally.unread(slot);
    }

    /// Tells the time.
    pub(super) fn now(&self) -> Time {
        self.0.clock.now().monotonic
    }
}

impl Shared {
    fn put(&self, message: Arc<Outgoing>) {
        self.tally.handed(message.slot);
        let now = self.clock.now().monotonic;
        self.lock().put(message, now, self.limit, |lost| self.tally.dropped(lost.slot));
        self.ready.notify_one();
    }

    fn take(&self, start: Start) -> Option<Item> {
        self.lock().take(start, |lost| self.tally.dropped(lost.slot))
    }

    fn put_back(&self, item: Item) {
        self.lock().put_back(item, |lost| self.tally.dropped(lost.slot));
    }

    fn clear(&self) {
        self.lock().clear(|lost| self.tally.dropped(lost.slot));
    }

    fn start(&self, pace: Option<&Pace<'_>>) -> Start {
        let now = self.clock.now().monotonic;
        pace.map_or(Start { at: now, per_byte: Span::ZERO }, |pace| pace.start(now))
    }

    fn leaving(&self, item: Item) -> Leaving {
        Leaving { message: item.message, tally: Arc::clone(&self.tally), written: false }
    }

    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Shared {
    fn drop(&mut self) {
        self.clear();
    }
}

impl Leaving {
    /// The message.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.message.bytes
    }

    /// Its slot.
    pub(super) fn slot(&self) -> u16 {
        self.message.slot
    }

    /// It has been handed over whole, and its last byte leaves at this time.
    pub(super) fn written(mut self, out: Time) {
        self.written = true;
        let age = out - self.message.valid;
        self.tally.sent(self.message.slot, self.message.bytes.len(), age);
    }
}

impl Drop for Leaving {
    fn drop(&mut self) {
        if !self.written {
            self.tally.dropped(self.message.slot);
        }
    }
}

#[cfg(test)]
mod tests {
    use insd_base::{Stamp, UtcTime};

    use super::*;

    /// A clock that stands at a second.
    struct Still;

    impl Clock for Still {
        fn now(&self) -> Stamp {
            Stamp { monotonic: Time::from_seconds(1.0), system: UtcTime::from_nanos(0) }
        }
    }

    fn outlet(keeping: Keeping) -> Outlet {
        Outlet::new(keeping, 100, Arc::new(Still))
    }

    fn message(slot: u16, byte: u8) -> Outgoing {
        let (valid, period) = (Time::from_seconds(0.9), Span::from_seconds(1.0));
        Outgoing { slot, bytes: vec![byte; 3], valid, period }
    }

    /// Sent, dropped and waiting messages of all slots.
    fn sums(outlet: &Outlet) -> (u64, u64, u64) {
        outlet.tally().status().iter().fold((0, 0, 0), |sums, slot| {
            (sums.0 + slot.sent, sums.1 + slot.dropped, sums.2 + slot.waiting)
        })
    }

    #[tokio::test]
    async fn what_was_taken_and_not_written_counts_as_dropped() {
        let outlet = outlet(Keeping::Newest);
        let outbox = outlet.outbox();
        outlet.send(message(1, 1));
        drop(outbox.next().await);
        outlet.send(message(2, 2));
        outbox.clear();
        outlet.send(message(3, 3));
        outlet.send(message(4, 4));
        outbox.next().await.written(outbox.now());
        assert_eq!(sums(&outlet), (1, 2, 1));
        drop(outbox);
        assert_eq!(sums(&outlet), (1, 3, 0));
        let age = outlet.tally().status()[2].age.unwrap();
        assert_eq!(age.last, Span::from_nanos(100_000_000));
    }

    #[tokio::test]
    async fn each_client_gets_what_is_handed_over_from_its_coming_to_its_going() {
        let outlet = outlet(Keeping::Newest);
        outlet.send(message(1, 1));
        let early = outlet.outbox();
        outlet.send(message(1, 2));
        let late = outlet.outbox();
        outlet.send(message(2, 3));
        let mut left = Vec::new();
        for outbox in [&early, &early, &late] {
            let leaving = outbox.next().await;
            left.push(leaving.bytes()[0]);
            leaving.written(outbox.now());
        }
        assert_eq!((left, sums(&outlet)), (vec![2, 3, 3], (3, 0, 0)));
        drop((early, late));
        outlet.send(message(1, 4));
        assert_eq!(sums(&outlet), (3, 0, 0));
    }

    #[tokio::test]
    async fn a_writer_that_is_not_ready_gets_the_newest_when_it_is() {
        let outlet = outlet(Keeping::Newest);
        let outbox = outlet.outbox();
        outlet.send(message(1, 1));
        let mut offered = Vec::new();
        let offer = outbox.offer(None, |cx, bytes| {
            offered.push(bytes[0]);
            if offered.len() == 1 {
                // something newer comes while the writer is not ready
                outlet.send(message(1, 2));
                cx.waker().wake_by_ref();
                return Poll::Pending;
            }
            Poll::Ready(Ok(bytes.len()))
        });
        let (leaving, taken) = offer.await;
        assert_eq!((leaving.bytes()[0], taken.unwrap()), (2, 3));
        leaving.written(outbox.now());
        assert_eq!((offered, sums(&outlet)), (vec![1, 2], (1, 1, 0)));
    }
}
