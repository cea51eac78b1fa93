//! Lines that repeat: after a number of them in a minute they are counted instead of written.

use std::collections::BTreeMap;
use std::fmt::{self, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tracing::field::{Field, Visit};
use tracing::{Event, Subscriber};
use tracing_subscriber::Layer;
use tracing_subscriber::layer::Context;

use crate::clock::Clock;

/// Lines of one kind that are written in a window.
const ALLOWED: u64 = 30;
/// The window.
const WINDOW: Duration = Duration::from_secs(60);
/// Kinds that are counted; beyond this the oldest are forgotten.
const KINDS: usize = 1024;

/// Leaves out what repeats, by the place in the program it comes from and who it is about.
#[derive(Clone, Debug)]
pub struct Repeats {
    shared: Arc<Mutex<Shared>>,
    clock: Clock,
}

#[derive(Debug, Default)]
struct Shared {
    kinds: BTreeMap<Kind, Count>,
    total: u64,
}

/// Place in the program, and who it is about.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Kind {
    place: &'static str,
    about: String,
}

#[derive(Clone, Copy, Debug)]
struct Count {
    since: Duration,
    seen: u64,
}

impl Default for Repeats {
    fn default() -> Self {
        Repeats { shared: Arc::default(), clock: Clock::start() }
    }
}

impl Repeats {
    /// Lines left out since the start.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.shared().total
    }

    /// Tells how many lines were left out in windows that are over; to be called now and then.
    pub fn tell(&self) {
        for (kind, left_out) in self.over(self.clock.elapsed()) {
            let Kind { place, about } = kind;
            tracing::info!(place, about, left_out, "lines that repeat were left out");
        }
    }

    fn shared(&self) -> MutexGuard<'_, Shared> {
        self.shared.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn over(&self, now: Duration) -> Vec<(Kind, u64)> {
        let mut told = Vec::new();
        self.shared().kinds.retain(|kind, count| {
            let is_over = now.saturating_sub(count.since) >= WINDOW;
            if is_over && count.seen > ALLOWED {
                told.push((kind.clone(), count.seen - ALLOWED));
            }
            !is_over
        });
        told
    }

    /// Whether another line of a kind is written.
    fn admit(&self, kind: Kind, now: Duration) -> bool {
        let mut shared = self.shared();
        if shared.kinds.len() >= KINDS && !shared.kinds.contains_key(&kind) {
            shared.kinds.pop_first();
        }
        let count = shared.kinds.entry(kind).or_insert(Count { since: now, seen: 0 });
        count.seen += 1;
        let admitted = count.seen <= ALLOWED;
        shared.total += u64::from(!admitted);
        admitted
    }
}

impl<S: Subscriber> Layer<S> for Repeats {
    fn event_enabled(&self, event: &Event<'_>, _: Context<'_, S>) -> bool {
        let mut about = About::default();
        event.record(&mut about);
        let kind = Kind { place: event.metadata().name(), about: about.0 };
        self.admit(kind, self.clock.elapsed())
    }
}

/// The fields that say who a line is about.
#[derive(Debug, Default)]
struct About(String);

impl Visit for About {
    fn record_debug(&mut self, field: &Field, value: &dyn fmt::Debug) {
        if matches!(field.name(), "port" | "sensor" | "output" | "message_kind" | "host") {
            // a text takes all that is written to it
            let _ = write!(self.0, "{value:?} ");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(about: &str) -> Kind {
        Kind { place: "here", about: about.to_owned() }
    }

    #[test]
    fn what_repeats_is_counted_and_what_is_about_another_is_not_hindered() {
        let repeats = Repeats::default();
        let at = Duration::from_secs;
        let admitted = (0..100).filter(|_| repeats.admit(kind("gnss"), at(1))).count();
        assert_eq!((admitted, repeats.total()), (30, 70));
        assert!(repeats.admit(kind("log"), at(1)));
        assert_eq!(repeats.over(at(60)), []);
        assert_eq!(repeats.over(at(61)), [(kind("gnss"), 70)]);
        assert!(repeats.admit(kind("gnss"), at(62)));
    }

    #[test]
    fn the_kinds_that_are_remembered_are_bounded() {
        let repeats = Repeats::default();
        for number in 0..5000 {
            repeats.admit(kind(&number.to_string()), Duration::ZERO);
        }
        assert!(repeats.shared().kinds.len() <= KINDS);
    }
}
