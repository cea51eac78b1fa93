//! What faults that nobody has found add to the protection levels, between one time that it is worked out and the next.

use insd_base::{Protection, Time};

/// Levels are worked out so far ahead, s: until then the next ones are.
pub(super) const AHEAD: f64 = 1.0;

/// What is hidden, as of an instant.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Hidden {
    as_of: Option<Time>,
    /// What it adds to the levels until [`AHEAD`], m.
    adds: Protection,
    /// How fast that grows from then on, m/s.
    grows: Protection,
}

/// By how much levels are beyond others, m.
pub(super) fn beyond(levels: &Protection, others: &Protection) -> Protection {
    Protection {
        horizontal: (levels.horizontal - others.horizontal).max(0.0),
        vertical: (levels.vertical - others.vertical).max(0.0),
    }
}

impl Hidden {
    /// As of now, by what it adds so far ahead, and twice as far.
    pub(super) fn new(now: Time, [adds, later]: [Protection; 2]) -> Self {
        let Protection { horizontal, vertical } = beyond(&later, &adds);
        let grows = Protection { horizontal: horizontal / AHEAD, vertical: vertical / AHEAD };
        Hidden { as_of: Some(now), adds, grows }
    }

    pub(super) fn is_due(&self, now: Time) -> bool {
        self.as_of.is_none_or(|as_of| (now - as_of).as_seconds() > 0.95 * AHEAD)
    }

    /// What it adds to the levels at an instant, m.
    pub(super) fn at(&self, now: Time) -> Protection {
        let age = self.as_of.map_or(0.0, |as_of| (now - as_of).as_seconds() - AHEAD).max(0.0);
        let Hidden { adds, grows, .. } = self;
        Protection {
            horizontal: adds.horizontal + age * grows.horizontal,
            vertical: adds.vertical + age * grows.vertical,
        }
    }
}
