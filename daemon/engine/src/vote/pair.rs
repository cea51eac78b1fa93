//! Two engines side by side: since when they disagree, and who of them is taken as wrong.

use insd_base::{Body, Motion, SolutionSigma, Time};
use nalgebra::Vector3;

use super::compare::{Apart, Difference, differences, distance};
use super::evidence::{Doubt, Testimony, suspect};
use super::turning::Turning;

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
    turning: Turning,
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
            turning: Turning::default(),
        }
    }

    /// Whether it is about an engine.
    pub(super) fn is_of(&self, engine: usize) -> bool {
        self.between.0 == engine || self.between.1 == engine
    }

    /// The index of one of them.
    fn engine(&self, second: bool) -> usize {
        if second { self.between.1 } else { self.between.0 }
    }

    /// Whether they disagree, and it is not known who is wrong.
    fn is_open(&self) -> bool {
        self.differs && self.blamed.is_none()
    }

    /// Compares them, `passed` s after the last look: their motions not at all while one of them has none, how their IMUs
    /// turned, rad/s, while both say so.
    pub(super) fn look(
        &mut self,
        (now, passed): (Time, f64),
        motions: Option<(&Motion, &Motion)>,
        turned: [Option<Vector3<f64>>; 2],
        apart: &Apart,
    ) {
        let found = self.turning.look(now, turned, apart.mounting_std);
        let of_motions = motions.map(|(one, other)| differences(one, other, apart));
        let all = of_motions.into_iter().flatten().chain(found.apart);
        let worst = all.max_by(|a, b| a.share().total_cmp(&b.share()));
        let share = worst.map_or(0.0, |worst| worst.share());
        self.worst = worst.or(self.worst);
        let change = if share > 1.0 { passed } else { -FORGETS * passed };
        self.apart = (self.apart + change).clamp(0.0, LASTS);
        if found.is_sudden {
            self.apart = LASTS;
        }
        if share > CLOSE {
            self.loud = Some(now);
        }
        if self.apart >= LASTS {
            self.differs = true;
        } else if self.loud.is_none_or(|loud| (now - loud).as_seconds() >= QUIET) {
            *self = Pair { apart: 0.0, differs: false, blamed: None, ..*self };
            self.turning.agree();
        }
        if let Some(own) = found.jumped {
            self.accuse((self.engine(own == 1), Doubt::Jumped));
        }
    }

    /// Looks who of the two is wrong, where they disagree. It takes 2 s to find, but for evidence that was gathered for
    /// long enough itself, and only what is stronger takes it back.
    pub(super) fn blame(
        &mut self,
        now: Time,
        one: (&Testimony, &Motion),
        other: (&Testimony, &Motion),
    ) {
        let found = suspect(one, other).map(|(second, doubt)| (self.engine(second), doubt));
        self.told = found.map(|found| match self.told {
            Some((before, since)) if before == found => (found, since),
            _ => (found, now),
        });
        let lasts = |(found, since): &((usize, Doubt), Time)| {
            found.1 == Doubt::Unlikely || (now - *since).as_seconds() >= LASTS
        };
        let lasting = self.told.filter(lasts);
        if let Some((found, _)) = lasting.filter(|_| self.differs) {
            self.accuse(found);
        }
    }

    /// Since when and by how much an engine's IMU turns faster than the other's, rad/s, body axes, where it is not known who is wrong.
    pub(super) fn excess(&self, engine: usize) -> Option<(Time, Body)> {
        let (since, excess) = self.turning.excess().filter(|_| self.is_open())?;
        match engine {
            one if one == self.between.0 => Some((since, Body(-excess))),
            other if other == self.between.1 => Some((since, Body(excess))),
            _ => None,
        }
    }

    /// What one that is used may be beside its claims while it is not known whether it is wrong: half of the way to the
    /// other, and what that claims.
    pub(super) fn cover(
        &self,
        engine: usize,
        motion: &Motion,
        other: &Motion,
        apart: &Apart,
    ) -> Option<SolutionSigma> {
        let is_open = self.is_of(engine) && self.is_open();
        is_open.then(|| distance(motion, other, apart).scaled(0.5).plus(&other.solution.sigma))
    }

    /// Takes one of them as wrong, unless something stronger told otherwise.
    pub(super) fn accuse(&mut self, (engine, doubt): (usize, Doubt)) {
        if self.blamed.is_none_or(|(_, before)| doubt < before) {
            self.blamed = Some((engine, doubt));
        }
    }
}
