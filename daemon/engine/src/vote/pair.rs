//! Two engines side by side: since when they disagree, and who of them is taken as wrong.

use insd_base::{Motion, Time};

use super::compare::{Apart, Difference, differences};
use super::evidence::{Doubt, Testimony, suspect};

/// For so long they must be apart, s.
const LASTS: f64 = 2.0;
/// Time apart is forgotten at this share of the rate at which it adds up: what comes and goes with the
/// waves counts too.
const FORGETS: f64 = 0.25;
/// They agree again when they have been within this share of the limits for so long, s.
const CLOSE: f64 = 0.7;
const QUIET: f64 = 20.0;

/// How two engines have got on so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    /// Their indices; the first is the lower.
    pub(super) between: (usize, usize),
    /// Time apart, s.
    apart: f64,
    /// The last time at which they were not close.
    loud: Option<Time>,
    /// The greatest difference of the last look at both.
    pub(super) worst: Option<Difference>,
    /// Whether they disagree.
    pub(super) differs: bool,
    /// Who is wrong, by its index, if anything tells.
    pub(super) blamed: Option<(usize, Doubt)>,
    /// What would tell otherwise, and since when.
    told: Option<((usize, Doubt), Time)>,
}

impl Pair {
    pub(super) fn new(first: usize, second: usize) -> Self {
        Pair {
            between: (first, second),
            apart: 0.0,
            loud: None,
            worst: None,
            differs: false,
            blamed: None,
            told: None,
        }
    }

    /// Whether it is about an engine.
    pub(super) fn is_of(&self, engine: usize) -> bool {
        self.between.0 == engine || self.between.1 == engine
    }

    /// Compares them, `passed` s after the last look; not at all while one of them has no motion.
    pub(super) fn look(
        &mut self,
        now: Time,
        passed: f64,
        motions: Option<(&Motion, &Motion)>,
        apart: &Apart,
    ) {
        let worst = motions.and_then(|(one, other)| {
            let all = differences(one, other, apart);
            all.into_iter().max_by(|a, b| a.share().total_cmp(&b.share()))
        });
        let share = worst.map_or(0.0, |worst| worst.share());
        self.worst = worst.or(self.worst);
        let change = if share > 1.0 { passed } else { -FORGETS * passed };
        self.apart = (self.apart + change).clamp(0.0, LASTS);
        if share > CLOSE {
            self.loud = Some(now);
        }
        if self.apart >= LASTS {
            self.differs = true;
        } else if self.loud.is_none_or(|loud| (now - loud).as_seconds() >= QUIET) {
            *self = Pair { apart: 0.0, differs: false, blamed: None, ..*self };
        }
    }

    /// Looks who of the two is wrong, where they disagree. It takes 2 s to find, and only what is stronger
    /// takes it back.
    pub(super) fn blame(
        &mut self,
        now: Time,
        one: (&Testimony, &Motion),
        other: (&Testimony, &Motion),
    ) {
        let found = suspect(one, other)
            .map(|(second, doubt)| (if second { self.between.1 } else { self.between.0 }, doubt));
        self.told = found.map(|found| match self.told {
            Some((before, since)) if before == found => (found, since),
            _ => (found, now),
        });
        let lasting = self.told.filter(|(_, since)| (now - *since).as_seconds() >= LASTS);
        if let Some((found, _)) = lasting.filter(|_| self.differs) {
            self.accuse(found);
        }
    }

    /// Takes one of them as wrong, unless something stronger told otherwise.
    pub(super) fn accuse(&mut self, (engine, doubt): (usize, Doubt)) {
        if self.blamed.is_none_or(|(_, before)| doubt < before) {
            self.blamed = Some((engine, doubt));
        }
    }
}
