//! A difference that is averaged, and whether it has been too large for long enough.

use insd_base::{Span, Time};

/// A reference that says nothing for so long is compared no more.
pub(super) const PATIENCE: Span = Span::from_nanos(5_000_000_000);
/// A difference must have been small for so long before it counts as such again.
const RECOVERY: Span = Span::from_nanos(5_000_000_000);

/// One difference of two components, in rad or m, as they were found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Found {
    pub(super) time: Time,
    pub(super) difference: [f64; 2],
    /// 1-sigma of what both claim of it.
    pub(super) sigma: f64,
    /// 1-sigma of what may be said without their sensor's being wrong: what we claim ourselves, and what a delay that nobody
    /// told makes of it.
    pub(super) own_sigma: f64,
}

/// A running mean: of all at first, and of the last seconds from then on.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(super) struct Average {
    mean: Option<Found>,
    count: u32,
    latch: Exceeded,
}

/// Whether a limit counts as exceeded, and since when it is otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
struct Exceeded {
    holds: bool,
    otherwise: Option<Time>,
}

impl Average {
    /// Takes a difference in, `over` which time the mean is taken.
    pub(super) fn note(&mut self, found: Found, over: Span) {
        let Some(mean) = self.mean.filter(|mean| found.time - mean.time <= PATIENCE) else {
            (self.mean, self.count) = (Some(found), 1);
            return;
        };
        let passed = (found.time - mean.time).as_seconds();
        if passed <= 0.0 {
            return;
        }
        self.count = self.count.saturating_add(1);
        let of_all = 1.0 / f64::from(self.count);
        let gain = of_all.max(1.0 - (-passed / over.as_seconds().max(1e-3)).exp());
        let towards = |from: f64, to: f64| from + gain * (to - from);
        let both = |from: f64, to: f64| towards(from * from, to * to).max(0.0).sqrt();
        let [first, second] = found.difference;
        self.mean = Some(Found {
            time: found.time,
            difference: [towards(mean.difference[0], first), towards(mean.difference[1], second)],
            sigma: both(mean.sigma, found.sigma),
            own_sigma: both(mean.own_sigma, found.own_sigma),
        });
    }

    /// The mean, while it is not too old.
    pub(super) fn mean(&self, now: Time) -> Option<&Found> {
        self.mean.as_ref().filter(|mean| now - mean.time <= PATIENCE)
    }

    /// Time passes, and the mean is beyond its limit or not; whether that has been so for long enough.
    pub(super) fn look(&mut self, is_beyond: bool, hold: Span, now: Time) -> bool {
        let latch = &mut self.latch;
        let delay = if latch.holds { RECOVERY } else { hold };
        if is_beyond == latch.holds {
            latch.otherwise = None;
        } else if now - *latch.otherwise.get_or_insert(now) >= delay {
            *latch = Exceeded { holds: is_beyond, otherwise: None };
        }
        latch.holds
    }

    /// Forgets whether it was too large: there is nothing to compare any more.
    pub(super) fn lapse(&mut self) {
        *self = Average::default();
    }
}

impl Found {
    /// How large it is.
    pub(super) fn size(&self) -> f64 {
        self.difference[0].hypot(self.difference[1])
    }
}
