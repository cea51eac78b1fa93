//! From the engine's thread to the thread of the page: the newest snapshot, and never a wait.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use arc_swap::ArcSwapOption;

use crate::snapshot::Snapshot;

/// A snapshot and its number.
#[derive(Debug)]
pub(crate) struct Numbered {
    /// Counts from 1.
    pub(crate) number: u64,
    pub(crate) snapshot: Snapshot,
}

#[derive(Debug, Default)]
struct Slot {
    latest: ArcSwapOption<Numbered>,
    published: AtomicU64,
}

/// The engine's end.
#[derive(Debug)]
pub struct Publisher(Arc<Slot>);

/// The page's end. Its clones see the same.
#[derive(Clone, Debug)]
pub struct Viewer(Arc<Slot>);

/// A channel that holds the newest snapshot and nothing else.
#[must_use]
pub fn channel() -> (Publisher, Viewer) {
    let slot = Arc::new(Slot::default());
    (Publisher(Arc::clone(&slot)), Viewer(slot))
}

impl Publisher {
    /// Puts a snapshot in the place of the one before. It swaps a pointer: it takes no lock, wakes
    /// nobody, and does not depend on how many look on or how slow they are. `time.at_s` must go on from
    /// one to the next: rates, track and history are reckoned by it.
    pub fn publish(&self, snapshot: Snapshot) {
        let number = self.0.published.fetch_add(1, Ordering::Relaxed) + 1;
        self.0.latest.store(Some(Arc::new(Numbered { number, snapshot })));
    }
}

impl Viewer {
    /// The newest snapshot; `None` before the first.
    pub(crate) fn latest(&self) -> Option<Arc<Numbered>> {
        self.0.latest.load_full()
    }

    /// Looks at the newest snapshot and its number, which counts from 1; `None` before the first. It is as it was
    /// published: who shows it lets time go on ([`Snapshot::after`]).
    pub fn look<R>(&self, look: impl FnOnce(u64, &Snapshot) -> R) -> Option<R> {
        self.latest().map(|latest| look(latest.number, &latest.snapshot))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whoever_looks_sees_the_newest_and_its_number() {
        let (publisher, viewer) = channel();
        assert!(viewer.latest().is_none());
        for uptime_s in [1.0, 2.0, 3.0] {
            let mut snapshot = Snapshot::default();
            snapshot.program.uptime_s = uptime_s;
            publisher.publish(snapshot);
        }
        let latest = viewer.clone().latest().unwrap();
        assert_eq!((latest.number, latest.snapshot.program.uptime_s), (3, 3.0));
    }
}
