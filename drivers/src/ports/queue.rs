//! The queue between all ports and their one consumer.
//!
//! Overflow policy: each port may have so many bytes waiting. When more come, the **oldest** waiting
//! bytes of **that port** are dropped and counted; other ports are not touched, and a port never waits
//! for the consumer. An arrival costs its bytes and a fixed amount for itself, so that many small
//! reads are bounded too. States are dropped only when nothing else of their port is left to drop.
//!
//! Arrivals leave in the order in which they were put in. Two ports that hear at the same moment may
//! be in either order, so between ports the stamps can step back by the time a task takes to run.

use std::collections::{BTreeMap, VecDeque};
use std::sync::mpsc::RecvTimeoutError;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use insd_base::input::{Arrival, Input, PortId};
use tokio::sync::Notify;

/// Bytes that may wait for the consumer, for each port, unless another limit is wanted.
pub const WAITING_LIMIT: usize = 256 * 1024;

/// Bytes as which a frame of a CAN bus counts, and what the controller says of its bus: those of the
/// kernel's structure.
pub const FRAME: usize = 16;

/// What an arrival costs beside its bytes.
const COST: usize = size_of::<(u64, Arrival)>();

/// The end that ports put arrivals into. The receiver ends when the last copy is gone.
#[derive(Debug)]
pub struct Queue(Arc<Shared>);

/// The end of the consumer.
#[derive(Debug)]
pub struct Receiver(Arc<Shared>);

#[derive(Debug)]
struct Shared {
    waiting: Mutex<Waiting>,
    limit: usize,
    /// Something was put in, or the last queue went.
    ready: Notify,
    /// The same for a plain thread.
    ready_thread: Condvar,
    /// Something was taken out.
    room: Notify,
}

#[derive(Debug, Default)]
struct Waiting {
    ports: BTreeMap<PortId, Lane>,
    next: u64,
    queues: usize,
}

/// What waits of one port, with its place in the order of all.
#[derive(Debug, Default)]
struct Lane {
    arrivals: VecDeque<(u64, Arrival)>,
    cost: usize,
}

/// A queue in which so many bytes of each port may wait, see [`WAITING_LIMIT`].
#[must_use]
pub fn queue(limit: usize) -> (Queue, Receiver) {
    let shared = Arc::new(Shared {
        waiting: Mutex::new(Waiting { queues: 1, ..Waiting::default() }),
        limit,
        ready: Notify::new(),
        ready_thread: Condvar::new(),
        room: Notify::new(),
    });
    (Queue(Arc::clone(&shared)), Receiver(shared))
}

impl Queue {
    /// Puts an arrival in. Gives the number of bytes of that port that were dropped to make room.
    pub fn push(&self, arrival: Arrival) -> u64 {
        let dropped = self.0.lock().push(arrival, self.0.limit);
        self.0.wake();
        dropped
    }

    /// Waits until less than half of the limit of this port is taken. For those who can wait for the
    /// consumer, such as the reader of a file.
    pub async fn room(&self, port: PortId) {
        loop {
            let mut taken = std::pin::pin!(self.0.room.notified());
            taken.as_mut().enable();
            if self.0.lock().ports.get(&port).is_none_or(|lane| lane.cost < self.0.limit / 2) {
                return;
            }
            taken.await;
        }
    }
}

impl Clone for Queue {
    fn clone(&self) -> Self {
        self.0.lock().queues += 1;
        Queue(Arc::clone(&self.0))
    }
}

impl Drop for Queue {
    fn drop(&mut self) {
        self.0.lock().queues -= 1;
        self.0.wake();
    }
}

impl Receiver {
    /// The next arrival of any port; `None` when nothing waits and all queues are gone.
    pub async fn recv(&mut self) -> Option<Arrival> {
        let shared = Arc::clone(&self.0);
        loop {
            let ready = shared.ready.notified();
            match self.try_recv() {
                Err(RecvTimeoutError::Timeout) => ready.await,
                other => return other.ok(),
            }
        }
    }

    /// The same for a plain thread: it sleeps meanwhile. Not to be called from a task.
    pub fn recv_blocking(&mut self) -> Option<Arrival> {
        let mut waiting = self.0.lock();
        loop {
            match waiting.next() {
                Err(RecvTimeoutError::Timeout) => {
                    let woken = self.0.ready_thread.wait(waiting);
                    waiting = woken.unwrap_or_else(PoisonError::into_inner);
                }
                other => return self.taken(other).ok(),
            }
        }
    }

    /// The same, waiting no longer than this.
    ///
    /// # Errors
    /// `Timeout` when nothing came, `Disconnected` when nothing waits and all queues are gone.
    pub fn recv_timeout(&mut self, limit: Duration) -> Result<Arrival, RecvTimeoutError> {
        let waiting = self.0.lock();
        let woken = self.0.ready_thread.wait_timeout_while(waiting, limit, |waiting| {
            waiting.queues > 0 && waiting.ports.values().all(|lane| lane.arrivals.is_empty())
        });
        let (mut waiting, _) = woken.unwrap_or_else(PoisonError::into_inner);
        self.taken(waiting.next())
    }

    /// The next arrival if one waits.
    ///
    /// # Errors
    /// `Timeout` when nothing waits, `Disconnected` when all queues are gone too.
    pub fn try_recv(&mut self) -> Result<Arrival, RecvTimeoutError> {
        let next = self.0.lock().next();
        self.taken(next)
    }

    fn taken(&self, next: Result<Arrival, RecvTimeoutError>) -> Result<Arrival, RecvTimeoutError> {
        if next.is_ok() {
            self.0.room.notify_waiters();
        }
        next
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wake(&self) {
        self.ready.notify_one();
        self.ready_thread.notify_one();
    }
}

impl Waiting {
    fn push(&mut self, arrival: Arrival, limit: usize) -> u64 {
        let lane = self.ports.entry(arrival.port).or_default();
        lane.cost += cost(&arrival);
        lane.arrivals.push_back((self.next, arrival));
        self.next += 1;
        let mut dropped = 0;
        while lane.cost > limit {
            let Some(oldest) = lane.drop_oldest() else { break };
            lane.cost -= cost(&oldest);
            dropped += length(&oldest) as u64;
        }
        dropped
    }

    fn next(&mut self) -> Result<Arrival, RecvTimeoutError> {
        let fronts = self.ports.values_mut().filter(|lane| !lane.arrivals.is_empty());
        let first = fronts.min_by_key(|lane| lane.arrivals.front().map(|(place, _)| *place));
        let arrival = first.and_then(|lane| {
            let (_, arrival) = lane.arrivals.pop_front()?;
            lane.cost -= cost(&arrival);
            Some(arrival)
        });
        arrival.ok_or(if self.queues == 0 {
            RecvTimeoutError::Disconnected
        } else {
            RecvTimeoutError::Timeout
        })
    }
}

impl Lane {
    fn drop_oldest(&mut self) -> Option<Arrival> {
        let is_state = |(_, arrival): &(u64, Arrival)| matches!(arrival.input, Input::State(_));
        let oldest = self.arrivals.iter().position(|waiting| !is_state(waiting)).unwrap_or(0);
        self.arrivals.remove(oldest).map(|(_, arrival)| arrival)
    }
}

fn length(arrival: &Arrival) -> usize {
    match &arrival.input {
        Input::Bytes(bytes) => bytes.len(),
        Input::Sent(sent) => sent.bytes.len(),
        Input::Can(_) | Input::Bus(_) => FRAME,
        Input::Order(order) => order.length(),
        Input::Pulse(_) | Input::State(_) | Input::Storage(_) | Input::Tick => 0,
    }
}

fn cost(arrival: &Arrival) -> usize {
    COST + length(arrival)
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Time;
    use insd_base::input::{PortState, Stamp};
    use insd_base::utc::UtcTime;

    fn arrival(port: u16, input: Input) -> Arrival {
        let stamp = Stamp { monotonic: Time::START, system: UtcTime::from_nanos(0) };
        Arrival { stamp, port: PortId(port), input }
    }

    fn bytes(port: u16, length: usize) -> Arrival {
        arrival(port, Input::Bytes(vec![port as u8; length]))
    }

    #[test]
    fn arrivals_leave_in_the_order_of_all_ports() {
        let (queue, mut receiver) = queue(WAITING_LIMIT);
        for port in [3, 1, 2, 1, 3] {
            queue.push(bytes(port, 1));
        }
        drop(queue);
        let ports: Vec<u16> =
            std::iter::from_fn(|| receiver.recv_blocking()).map(|arrival| arrival.port.0).collect();
        assert_eq!(ports, [3, 1, 2, 1, 3]);
    }

    #[test]
    fn a_flood_costs_its_own_port_the_oldest_bytes_and_no_state() {
        let (queue, mut receiver) = queue(4 * (100 + COST));
        queue.push(arrival(1, Input::State(PortState::Speaking)));
        queue.push(bytes(2, 7));
        let dropped: u64 = (0..1000).map(|_| queue.push(bytes(1, 100))).sum();
        drop(queue);
        let all: Vec<Arrival> = std::iter::from_fn(|| receiver.recv_blocking()).collect();
        let received: usize = all.iter().filter(|a| a.port.0 == 1).map(length).sum();
        assert_eq!(dropped + received as u64, 100_000);
        assert_eq!(all[0].input, Input::State(PortState::Speaking));
        assert_eq!(all[1], bytes(2, 7));
    }

    #[test]
    fn states_alone_are_bounded_too() {
        let (queue, mut receiver) = queue(10 * COST);
        for _ in 0..1000 {
            queue.push(arrival(1, Input::State(PortState::Speaking)));
        }
        drop(queue);
        assert_eq!(std::iter::from_fn(|| receiver.recv_blocking()).count(), 10);
    }

    #[test]
    fn the_receiver_tells_nothing_yet_from_never_again() {
        let (queue, mut receiver) = queue(WAITING_LIMIT);
        let soon = Duration::from_millis(1);
        assert_eq!(receiver.recv_timeout(soon), Err(RecvTimeoutError::Timeout));
        queue.push(bytes(1, 1));
        assert_eq!(receiver.recv_timeout(soon), Ok(bytes(1, 1)));
        drop(queue);
        assert_eq!(receiver.recv_timeout(soon), Err(RecvTimeoutError::Disconnected));
    }
}
