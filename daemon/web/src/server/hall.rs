//! What all connections share, and the task that keeps it new.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use axum::body::Bytes;
use insd_languages::Language;
use tokio::sync::watch;
use tokio::time::{Instant, MissedTickBehavior, interval};

use crate::channel::{Numbered, Viewer};
use crate::orders::OrderSender;
use crate::snapshot::Snapshot;

use super::access::Access;
use super::archive::Recordings;
use super::frame::Frame;
use super::history::History;
use super::reporter::Reports;
use super::track::Track;

/// How often it is looked whether there is a new snapshot.
const LOOK: Duration = Duration::from_millis(50);
/// Time without anything new after which the engine is taken as dead.
const PATIENCE: Duration = Duration::from_secs(2);
/// Time without anything new after which what is there is shown again, older, and then again and again.
const SOON: Duration = Duration::from_millis(250);
const AGAIN: Duration = Duration::from_millis(100);
/// Looks after which one wrong token of each client is forgotten: 6 s.
const FORGET: u32 = 120;

/// What all connections share.
#[derive(Debug)]
pub(super) struct Hall {
    frames: watch::Sender<Option<Arc<Frame>>>,
    alive: AtomicBool,
    past: Mutex<Past>,
    pub(super) clients: AtomicUsize,
    pub(super) access: Access,
    pub(super) orders: OrderSender,
    /// The language of who has not chosen one.
    pub(super) language: Language,
    /// A picture of what the camera sees.
    pub(super) picture: Option<PathBuf>,
    /// Raw recordings of this ship.
    pub(super) recordings: Option<Recordings>,
    /// Who makes reports of them.
    pub(super) reports: Option<Reports>,
}

#[derive(Debug)]
struct Past {
    track: Track,
    histories: [History; 2],
}

impl Hall {
    pub(super) fn new(
        token: Option<String>,
        hosts: &[String],
        language: Language,
        orders: OrderSender,
    ) -> Self {
        Hall {
            frames: watch::Sender::new(None),
            alive: AtomicBool::new(false),
            past: Mutex::new(Past { track: Track::default(), histories: History::both() }),
            clients: AtomicUsize::new(0),
            access: Access::new(token, hosts),
            orders,
            language,
            picture: None,
            recordings: None,
            reports: None,
        }
    }

    /// The newest frame; `None` before the first.
    pub(super) fn latest(&self) -> Option<Arc<Frame>> {
        self.frames.borrow().clone()
    }

    /// Each frame from now on, or the newest where one is slow.
    pub(super) fn follow(&self) -> watch::Receiver<Option<Arc<Frame>>> {
        self.frames.subscribe()
    }

    /// Whether the engine has published something within the last 2 s.
    pub(super) fn is_alive(&self) -> bool {
        self.alive.load(Ordering::Relaxed)
    }

    pub(super) fn track(&self) -> Bytes {
        self.past().track.json()
    }

    /// The finer history, or the coarser one.
    pub(super) fn history(&self, is_coarse: bool) -> Bytes {
        let [fine, coarse] = &mut self.past().histories;
        if is_coarse { coarse.json() } else { fine.json() }
    }

    /// Shows what was seen as it is now.
    fn show(&self, seen: &Seen, now: Instant) {
        let snapshot = seen.source.snapshot.after((now - seen.at).as_secs_f64());
        self.note(&snapshot);
        self.frames.send_replace(Some(Arc::new(Frame::new(seen.source.number, snapshot))));
    }

    fn note(&self, snapshot: &Snapshot) {
        let mut past = self.past();
        past.track.note(snapshot);
        past.histories.iter_mut().for_each(|history| history.note(snapshot));
    }

    /// Only this thread ever takes it, and never across a wait.
    fn past(&self) -> MutexGuard<'_, Past> {
        self.past.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The newest snapshot, when it was seen first, and when it was shown last.
struct Seen {
    source: Arc<Numbered>,
    at: Instant,
    shown: Instant,
}

/// Looks for new snapshots for ever. It looks rather than being woken, so that the engine need not wake
/// anybody. When none comes the last one is shown again and again, each time older.
pub(super) async fn pump(viewer: &Viewer, hall: &Hall) {
    let mut ticks = interval(LOOK);
    ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let (mut seen, mut looks): (Option<Seen>, u32) = (None, 0);
    loop {
        let now = ticks.tick().await;
        looks = (looks + 1) % FORGET;
        if looks == 0 {
            hall.access.forget();
        }
        let number = seen.as_ref().map(|seen| seen.source.number);
        let latest = viewer.latest().filter(|latest| Some(latest.number) != number);
        if let Some(source) = latest {
            hall.show(seen.insert(Seen { source, at: now, shown: now }), now);
        }
        if let Some(own) =
            seen.as_mut().filter(|own| now - own.at >= SOON && now - own.shown >= AGAIN)
        {
            own.shown = now;
            hall.show(own, now);
        }
        let is_alive = seen.as_ref().is_some_and(|seen| now - seen.at < PATIENCE);
        hall.alive.store(is_alive, Ordering::Relaxed);
    }
}
