//! What the monitor knows: the last snapshot, and how old it is. Whoever looks is shown it as it is then: what
//! has grown too old meanwhile is gone ([`Snapshot::after`]).

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use insd_web::snapshot::{Freshness, ShownAlignment, ShownMode, ShownMotion, Snapshot, TimeInfo};
use serde::Deserialize;

use crate::clock::Clock;

/// How the program at the other end is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// Nothing has come yet.
    Connecting,
    /// Data come.
    Live,
    /// The connection stands, and the navigator sends nothing new.
    Silent,
    /// There is no connection.
    Lost,
}

/// What the thread that reads hands to the one that shows.
#[derive(Debug)]
pub struct Board {
    clock: Clock,
    seen: Mutex<Seen>,
}

#[derive(Debug, Default)]
struct Seen {
    snapshot: Option<Box<Snapshot>>,
    at: Duration,
    connected: bool,
    fault: Option<String>,
}

/// What changes many times a second: the event `live` of the stream.
#[derive(Debug, Deserialize)]
struct Live {
    time: TimeInfo,
    mode: ShownMode,
    motion: Option<ShownMotion>,
    alignment: Option<ShownAlignment>,
}

impl Default for Board {
    fn default() -> Self {
        Board { clock: Clock::start(), seen: Mutex::default() }
    }
}

impl Board {
    /// Takes an event of the stream; one that cannot be read is left out.
    pub(super) fn take(&self, event: &str, data: &str) {
        let mut seen = self.lock();
        match event {
            "snapshot" => {
                let Ok(snapshot) = serde_json::from_str(data) else { return };
                seen.snapshot = Some(Box::new(snapshot));
            }
            "live" => {
                let Ok(live) = serde_json::from_str::<Live>(data) else { return };
                let Some(snapshot) = &mut seen.snapshot else { return };
                let Live { time, mode, motion, alignment } = live;
                (snapshot.time, snapshot.mode) = (time, mode);
                (snapshot.motion, snapshot.alignment) = (motion, alignment);
            }
            _ => return,
        }
        seen.at = self.clock.elapsed();
    }

    /// The connection was made.
    pub(super) fn connect(&self) {
        let mut seen = self.lock();
        (seen.connected, seen.fault) = (true, None);
    }

    /// The connection was lost, or could not be made.
    pub(super) fn disconnect(&self, fault: String) {
        let mut seen = self.lock();
        (seen.connected, seen.fault) = (false, Some(fault));
    }

    /// The last snapshot as it is now, if there is one.
    #[must_use]
    pub fn snapshot(&self) -> Option<Snapshot> {
        let seen = self.lock();
        let passed = self.clock.elapsed().saturating_sub(seen.at);
        seen.snapshot.as_deref().map(|snapshot| snapshot.after(passed.as_secs_f64()))
    }

    /// Why there is no connection.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        self.lock().fault.clone()
    }

    /// How the program is reached, and how long ago the navigator told what is shown.
    #[must_use]
    pub fn link(&self) -> (Link, Duration) {
        let seen = self.lock();
        let told = seen.snapshot.as_ref().map_or(0.0, |snapshot| snapshot.time.told_ago_s);
        let told = Duration::try_from_secs_f64(told).unwrap_or_default();
        let age = self.clock.elapsed().saturating_sub(seen.at) + told;
        let is_fresh = Freshness::of_age(age.as_secs_f64()) != Freshness::Gone;
        let link = match (&seen.snapshot, seen.connected) {
            (None, _) if seen.fault.is_none() => Link::Connecting,
            (_, false) => Link::Lost,
            (Some(_), true) if is_fresh => Link::Live,
            _ => Link::Silent,
        };
        (link, age)
    }

    fn lock(&self) -> MutexGuard<'_, Seen> {
        self.seen.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_changes_often_is_put_into_the_last_snapshot() {
        let board = Board::default();
        assert_eq!(board.link().0, Link::Connecting);
        board.take("live", r#"{"time":{},"mode":{"name":"aided"},"motion":null,"alignment":null}"#);
        assert_eq!(board.snapshot(), None);
        board.connect();
        board.take("snapshot", r#"{"version":1,"program":{"version":"9"}}"#);
        board.take(
            "live",
            r#"{"time":{"at_s":7.0},"mode":{"name":"aided"},"motion":null,"alignment":null}"#,
        );
        board.take("live", "nonsense");
        let snapshot = board.snapshot().unwrap();
        assert_eq!((snapshot.program.version.as_str(), snapshot.time.at_s.floor()), ("9", 7.0));
        assert!(snapshot.is_navigating());
        assert_eq!(board.link().0, Link::Live);
        board.disconnect("gone".to_owned());
        assert_eq!(board.link().0, Link::Lost);
    }
}
