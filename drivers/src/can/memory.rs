//! A bus in memory, for tests: what one end sends all others hear, in order.
//!
//! It can be taken down and up again, be short of room, and say what a controller would say.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use insd_base::{BusEvent, CanFrame, Stamp};
use tokio::sync::Notify;

use super::{CanBus, Heard, Opener, Sending};
use crate::ports::Clock;

/// A bus.
#[derive(Clone)]
pub struct MemoryBus {
    shared: Arc<Shared>,
}

struct Shared {
    clock: Arc<dyn Clock>,
    state: Mutex<State>,
    changed: Notify,
}

#[derive(Default)]
struct State {
    down: bool,
    /// Frames for which there is room; any number if nothing is said.
    room: Option<usize>,
    /// What waits at each end.
    ends: BTreeMap<u64, VecDeque<Heard>>,
    opened: u64,
}

/// An open end of a bus. Closing it takes it off.
pub struct MemoryEnd {
    bus: MemoryBus,
    number: u64,
}

impl MemoryBus {
    /// A bus that is up, with room for everything. Frames are stamped with this clock.
    #[must_use]
    pub fn new(clock: Arc<dyn Clock>) -> Self {
        let (state, changed) = (Mutex::default(), Notify::new());
        MemoryBus { shared: Arc::new(Shared { clock, state, changed }) }
    }

    /// A new end of the bus, if it is up.
    #[must_use]
    pub fn end(&self) -> Option<MemoryEnd> {
        let mut state = self.state();
        if state.down {
            return None;
        }
        state.opened += 1;
        let number = state.opened;
        state.ends.insert(number, VecDeque::new());
        Some(MemoryEnd { bus: self.clone(), number })
    }

    /// Takes the bus down: all ends are lost, and no new ones can be had.
    pub fn down(&self) {
        let mut state = self.state();
        state.down = true;
        state.ends.clear();
        self.shared.changed.notify_waiters();
    }

    /// Takes it up again.
    pub fn up(&self) {
        self.state().down = false;
    }

    /// Makes room for so many frames more and then none, or for any number.
    pub fn room(&self, frames: Option<usize>) {
        self.state().room = frames;
        self.shared.changed.notify_waiters();
    }

    /// Lets the controllers of all ends say this.
    pub fn say(&self, event: BusEvent) {
        let stamp = self.shared.clock.now();
        for waiting in self.state().ends.values_mut() {
            waiting.push_back(Heard::Event(stamp, event));
        }
        self.shared.changed.notify_waiters();
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.shared.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    fn send(&mut self, from: u64, stamp: Stamp, frame: CanFrame) -> Result<Sending, String> {
        if !self.ends.contains_key(&from) {
            return Err(DOWN.to_owned());
        }
        match &mut self.room {
            Some(0) => return Ok(Sending::Full),
            Some(room) => *room -= 1,
            None => {}
        }
        for (_, waiting) in self.ends.iter_mut().filter(|(end, _)| **end != from) {
            waiting.push_back(Heard::Frame(stamp, frame));
        }
        Ok(Sending::Sent)
    }

    /// What waits at an end, if something does.
    fn next(&mut self, end: u64, refused: bool) -> Option<Result<Heard, String>> {
        match self.ends.get_mut(&end).map(VecDeque::pop_front) {
            None => Some(Err(DOWN.to_owned())),
            Some(Some(heard)) => Some(Ok(heard)),
            Some(None) => (refused && self.room != Some(0)).then_some(Ok(Heard::Room)),
        }
    }
}

const DOWN: &str = "the bus is down";

impl CanBus for MemoryEnd {
    async fn next(&mut self, refused: bool) -> Result<Heard, String> {
        loop {
            let mut changed = std::pin::pin!(self.bus.shared.changed.notified());
            changed.as_mut().enable();
            if let Some(heard) = self.bus.state().next(self.number, refused) {
                return heard;
            }
            changed.await;
        }
    }

    fn try_send(&mut self, frame: &CanFrame) -> Result<Sending, String> {
        let stamp = self.bus.shared.clock.now();
        let sending = self.bus.state().send(self.number, stamp, *frame);
        self.bus.shared.changed.notify_waiters();
        sending
    }
}

impl Drop for MemoryEnd {
    fn drop(&mut self) {
        self.bus.state().ends.remove(&self.number);
    }
}

impl Opener for MemoryBus {
    type Bus = MemoryEnd;

    async fn open(&mut self) -> Result<(Self::Bus, String), String> {
        self.end().map(|end| (end, "a bus in memory".to_owned())).ok_or_else(|| DOWN.to_owned())
    }
}
