//! Who speaks on a bus: frames in, frames and wake-up out. It does no I/O and reads no clock.

use std::sync::{Arc, Mutex, PoisonError};

use insd_base::{BusEvent, CanFrame, Time};
use tokio::sync::Notify;

/// A node of the bus, as the port drives it.
///
/// A frame that [`Speaker::next_frame`] gives is followed by [`Speaker::sent`] or [`Speaker::refused`], or
/// by [`Speaker::down`] if the bus was lost meanwhile; only one that was sent is gone.
pub trait Speaker: Send {
    /// The bus is open: nobody on it knows us yet.
    fn up(&mut self, now: Time);
    /// The bus is lost.
    fn down(&mut self, now: Time);
    /// The controller says something. [`BusEvent::Restarted`] also comes when the controller was off and
    /// frames are heard again, or half a second has passed.
    fn bus_event(&mut self, event: BusEvent, now: Time);
    /// A frame of another node was heard.
    fn hear(&mut self, frame: &CanFrame, now: Time);
    /// The time of [`Speaker::wake_at`] has come.
    fn wake(&mut self, now: Time);
    /// When it wants to be woken next.
    fn wake_at(&self) -> Option<Time>;
    /// The frame to be sent next, if there is one now.
    fn next_frame(&mut self, now: Time) -> Option<CanFrame>;
    /// The frame was handed over to the controller.
    fn sent(&mut self, now: Time);
    /// There was no room for the frame. It is asked for again when the bus has room, if it can tell, and at
    /// the time of [`Speaker::wake_at`].
    fn refused(&mut self, now: Time);
}

/// A speaker that the port's task and others share: they hand in what is to be said.
#[derive(Debug)]
pub struct SharedSpeaker<S: ?Sized = dyn Speaker>(Arc<Shared<S>>);

#[derive(Debug)]
struct Shared<S: ?Sized> {
    ready: Notify,
    speaker: Mutex<S>,
}

impl<S: Speaker + 'static> SharedSpeaker<S> {
    /// Shares a speaker.
    #[must_use]
    pub fn new(speaker: S) -> Self {
        SharedSpeaker(Arc::new(Shared { ready: Notify::new(), speaker: Mutex::new(speaker) }))
    }

    /// The same speaker, as a port takes it.
    #[must_use]
    pub fn for_port(&self) -> SharedSpeaker {
        SharedSpeaker(self.0.clone())
    }
}

impl<S: Speaker + ?Sized> SharedSpeaker<S> {
    /// Does something with the speaker, for which others wait, and lets the port look at once whether
    /// there is something to be sent.
    pub fn with<T>(&self, act: impl FnOnce(&mut S) -> T) -> T {
        let result = self.quietly(act);
        self.0.ready.notify_one();
        result
    }

    /// Does something with the speaker without waking the port.
    pub(super) fn quietly<T>(&self, act: impl FnOnce(&mut S) -> T) -> T {
        act(&mut self.0.speaker.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Waits until somebody has handed in something.
    pub(super) async fn ready(&self) {
        self.0.ready.notified().await;
    }
}

impl<S: ?Sized> Clone for SharedSpeaker<S> {
    fn clone(&self) -> Self {
        SharedSpeaker(Arc::clone(&self.0))
    }
}
