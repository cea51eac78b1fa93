//! Ports at work, as whoever started them holds them.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, PoisonError};

use insd_base::Span;
use tokio::task::AbortHandle;

use super::outbox::Outlet;
use super::outgoing::{Outgoing, OutputStatus};
use super::teller::Shown;

/// A port at work. It stops when this is dropped.
#[must_use = "the port stops when its handle is dropped"]
#[derive(Debug)]
pub struct PortHandle {
    work: Work,
    outlet: Option<Outlet>,
    attempts: Arc<AtomicU64>,
}

/// A port that is only written to, at work. It stops when this is dropped.
#[must_use = "the port stops when its handle is dropped"]
#[derive(Debug)]
pub struct OutputPort {
    handle: PortHandle,
    outlet: Outlet,
    shown: Shown,
}

/// What works for a port.
#[derive(Debug)]
pub(super) enum Work {
    Task(AbortHandle),
    Thread(Arc<AtomicBool>),
}

impl PortHandle {
    pub(super) fn new(work: Work, outlet: Option<Outlet>, attempts: Arc<AtomicU64>) -> Self {
        PortHandle { work, outlet, attempts }
    }

    /// A port that a task of its own listens to.
    pub(crate) fn of_task(task: AbortHandle, attempts: Arc<AtomicU64>) -> Self {
        PortHandle::new(Work::Task(task), None, attempts)
    }

    /// Hands over what grows old: where the ship is, for a caster. Gives whether the port takes it.
    pub fn offer(&self, message: Outgoing) -> bool {
        let Some(outlet) = &self.outlet else { return false };
        outlet.send(message);
        true
    }

    /// Puts a whole message behind what is still to be written, and never waits: a command, for example.
    /// Gives whether the port is one that is written to. When too many bytes wait the oldest go.
    pub fn send(&self, message: Vec<u8>) -> bool {
        let Some(outlet) = &self.outlet else { return false };
        let (valid, period) = (outlet.now(), Span::ZERO);
        outlet.send(Outgoing { slot: 0, bytes: message, valid, period });
        true
    }

    /// Whole messages that were dropped since the start, the oldest first, because they could not be
    /// written soon enough. Of a TCP server: counted for each client.
    #[must_use]
    pub fn dropped(&self) -> u64 {
        self.outlet.as_ref().map_or(0, |outlet| outlet.tally().all_dropped())
    }

    /// How often it was tried to open the port.
    #[must_use]
    pub fn attempts(&self) -> u64 {
        self.attempts.load(Ordering::Relaxed)
    }
}

impl Drop for PortHandle {
    fn drop(&mut self) {
        match &self.work {
            Work::Task(task) => task.abort(),
            Work::Thread(stop) => stop.store(true, Ordering::Relaxed),
        }
    }
}

impl OutputPort {
    pub(super) fn new(handle: PortHandle, outlet: Outlet, shown: Shown) -> Self {
        OutputPort { handle, outlet, shown }
    }

    /// Hands a message over, and never waits.
    pub fn send(&self, message: Outgoing) {
        self.outlet.send(message);
    }

    /// What it has done since its start.
    #[must_use]
    pub fn status(&self) -> OutputStatus {
        let slots = self.outlet.tally().status();
        OutputStatus {
            state: self.shown.lock().unwrap_or_else(PoisonError::into_inner).clone(),
            attempts: self.handle.attempts(),
            sent: slots.iter().map(|slot| slot.sent).sum(),
            dropped: slots.iter().map(|slot| slot.dropped).sum(),
            waiting: slots.iter().map(|slot| slot.waiting).sum(),
            bytes: slots.iter().map(|slot| slot.bytes).sum(),
            slots,
        }
    }

    /// Messages of all slots that will never leave, see [`OutputStatus::dropped`].
    #[must_use]
    pub fn dropped(&self) -> u64 {
        self.outlet.tally().all_dropped()
    }

    /// See [`PortHandle::attempts`].
    #[must_use]
    pub fn attempts(&self) -> u64 {
        self.handle.attempts()
    }
}
