//! A camera on a thread of its own.

use std::process::Child;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::thread;
use std::time::Duration;

use crate::fault::CaptureFault;
use crate::folder::TimedImage;

/// Images that wait for somebody to look at them; a newer one beyond is dropped.
const WAITING: usize = 2;

/// The near end of a camera's thread. Dropping it ends the child process, and the thread as soon as the camera gives a sign of life.
#[derive(Debug)]
pub struct LiveCamera {
    images: Receiver<TimedImage>,
    shared: Arc<Shared>,
    child: Option<Child>,
}

#[derive(Debug, Default)]
struct Shared {
    dropped: AtomicU64,
    is_over: AtomicBool,
}

/// What the thread hands images to.
pub(crate) struct Hand {
    images: SyncSender<TimedImage>,
    shared: Arc<Shared>,
}

impl Hand {
    /// Hands an image over, or drops it if nobody keeps up; `false` if nobody wants any more.
    pub(crate) fn over(&self, image: TimedImage) -> bool {
        match self.images.try_send(image) {
            Ok(()) => {}
            Err(TrySendError::Full(_)) => {
                self.shared.dropped.fetch_add(1, Ordering::Relaxed);
            }
            Err(TrySendError::Disconnected(_)) => return false,
        }
        !self.shared.is_over.load(Ordering::Relaxed)
    }
}

impl LiveCamera {
    /// Starts the thread that does `work`.
    pub(crate) fn start(
        name: &str,
        work: impl FnOnce(&Hand) + Send + 'static,
    ) -> Result<Self, CaptureFault> {
        let (sender, images) = sync_channel(WAITING);
        let shared = Arc::new(Shared::default());
        let hand = Hand { images: sender, shared: Arc::clone(&shared) };
        let thread = thread::Builder::new().name("camera".to_owned()).spawn(move || work(&hand));
        thread.map_err(|fault| CaptureFault::io(&name, fault))?;
        Ok(LiveCamera { images, shared, child: None })
    }

    /// The same with the child process that it reads from.
    pub(crate) fn with_child(mut self, child: Child) -> Self {
        self.child = Some(child);
        self
    }

    /// The next image; `None` if none came in `patience`.
    ///
    /// # Errors
    /// The source has ended, and none will come any more.
    pub fn next(&self, patience: Duration) -> Result<Option<TimedImage>, CaptureFault> {
        match self.images.recv_timeout(patience) {
            Ok(image) => Ok(Some(image)),
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => {
                let reason = "the source has ended".to_owned();
                Err(CaptureFault::Source { place: "camera".to_owned(), reason })
            }
        }
    }

    /// Images that nobody had time for.
    #[must_use]
    pub fn dropped(&self) -> u64 {
        self.shared.dropped.load(Ordering::Relaxed)
    }
}

impl Drop for LiveCamera {
    fn drop(&mut self) {
        self.shared.is_over.store(true, Ordering::Relaxed);
        if let Some(child) = &mut self.child {
            // one that has ended by itself cannot be killed, which is as well
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}
