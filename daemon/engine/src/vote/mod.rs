//! Several engines at work: which of them is believed, and who differs from whom.
//!
//! [`Voter::look`] is handed what each engine says at one instant, some ten times a second. It is a
//! function of what it is handed: recordings replay to the same choice.
//!
//! - *Two that are apart* by more than they claim, for 2 s, disagree, and at once two whose IMUs of a sudden turn apart. That says nothing of who is wrong. What
//!   may: see [`Doubt`], the strongest reason first. Where there is none, the engine in use stays in use.
//! - *Three*: one that disagrees with two who agree with each other is outvoted. Engines that share an IMU
//!   have one voice, as what is wrong with it is wrong in both.
//! - *The engine in use* is left at once when it falls silent, gives itself up or is found to be wrong, and after 2 s when
//!   another has more behind it (its mode, its sigmas). An engine that stands before it in the order of the
//!   configuration is taken back after 30 s in which nothing spoke against it.

mod compare;
mod evidence;
mod gyros;
mod pair;
mod record;
mod turning;

use insd_base::{Body, Mode, Motion, Solution, SolutionSigma, Time};

pub use compare::{Apart, ComparedQuantity, Difference, differences};
pub use evidence::{Doubt, Testimony};
pub use gyros::Gyros;
pub use record::Record;

use evidence::{is_imu_doubted, is_vaguer, rank};
use pair::Pair;

/// Another engine must have more behind it for so long to be used instead, s.
const BETTER: f64 = 2.0;
/// An engine that stands first must have been sound for so long to be taken back, s.
const TRIAL: f64 = 30.0;
/// Longest time between two looks that counts, s.
const STEP: f64 = 0.5;

/// What the voter knows of an engine beforehand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Voice {
    /// Which IMU it has: engines of the same number share one.
    pub imu: usize,
    /// How well its IMU's axes are known to be those of the first IMU, 1-sigma, rad.
    pub mounting_std: f64,
    /// How far its IMU is from the first, m.
    pub distance: f64,
}

/// Two engines that are apart by more than they claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disagreement {
    /// Their indices.
    pub between: (usize, usize),
    /// Where they are farthest apart, beside what they claim; at the last look at both.
    pub difference: Difference,
    /// Which of them is taken as wrong, and why; `None` where nothing tells.
    pub wrong: Option<(usize, Doubt)>,
}

/// Something that the voter found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VoteEvent {
    /// Two engines disagree from now on.
    Differ {
        /// When.
        time: Time,
        /// Who, in what, by how much, and who of them is wrong as far as that is known yet.
        disagreement: Disagreement,
    },
    /// It is found who of two is wrong.
    Wrong {
        /// When.
        time: Time,
        /// Which two.
        between: (usize, usize),
        /// Which of them.
        engine: usize,
        /// Why.
        why: Doubt,
    },
    /// Two engines agree again.
    Agree {
        /// When.
        time: Time,
        /// Which.
        between: (usize, usize),
    },
    /// Another engine is used.
    Switched {
        /// When.
        time: Time,
        /// The one before.
        from: usize,
        /// The one from now on.
        to: usize,
        /// What speaks against the one before; `None` if one that stands first is taken back.
        why: Option<Doubt>,
    },
}

/// Compares engines and chooses among them.
#[derive(Clone, Debug)]
pub struct Voter {
    voices: Vec<Voice>,
    pairs: Vec<Pair>,
    chosen: usize,
    looked: Option<Time>,
    /// Since when another has more behind it than the engine in use.
    better: Option<Time>,
    /// Since when each could be taken back.
    sound: Vec<Option<Time>>,
    /// What the engine in use may be off by beside its claims.
    cover: Option<SolutionSigma>,
}

/// What each engine says, with its motion where it can be used, all at one time.
struct Round<'a> {
    now: Time,
    said: Vec<(&'a Testimony, Option<Motion>)>,
}

impl Voter {
    /// A voter on engines in their order of preference; the first is used to begin with.
    #[must_use]
    pub fn new(voices: Vec<Voice>) -> Self {
        let count = voices.len();
        let pairs = (0..count).flat_map(|one| (one + 1..count).map(move |two| Pair::new(one, two)));
        Voter {
            pairs: pairs.collect(),
            chosen: 0,
            looked: None,
            better: None,
            sound: vec![None; count],
            cover: None,
            voices,
        }
    }

    /// The engine in use, by its index.
    #[must_use]
    pub fn chosen(&self) -> usize {
        self.chosen
    }

    /// The disagreements there are.
    pub fn disagreements(&self) -> impl Iterator<Item = Disagreement> {
        self.pairs.iter().filter(|pair| pair.differs).filter_map(Pair::disagreement)
    }

    /// Why an engine is taken as wrong, if it is.
    #[must_use]
    pub fn doubt(&self, engine: usize) -> Option<Doubt> {
        let told = self.pairs.iter().filter(|pair| pair.differs).filter_map(|pair| pair.blamed);
        told.filter(|(blamed, _)| *blamed == engine).map(|(_, doubt)| doubt).min()
    }

    /// Looks at what all engines say, in their order; gives what that changes.
    pub fn look(&mut self, now: Time, said: &[Testimony]) -> Vec<VoteEvent> {
        let passed = self.looked.map_or(0.0, |last| (now - last).as_seconds().clamp(0.0, STEP));
        self.looked = Some(now);
        let round = Round::new(now, said);
        let mut events = self.compare(&round, passed);
        events.extend(self.choose(&round));
        self.cover = self.cover_of(&round);
        events
    }

    /// Since when and by how much the gyros of an engine may turn too fast, rad/s, body axes, where they have begun to turn apart from
    /// another's and it is not known whose are wrong.
    #[must_use]
    pub fn suspicion(&self, engine: usize) -> Option<(Time, Body)> {
        self.pairs.iter().find_map(|pair| pair.excess(engine))
    }

    /// What the engine in use claims, and if it differs from another, and it is not known who is wrong, what covers
    /// that one, too.
    #[must_use]
    pub fn covered(&self, sigma: &SolutionSigma) -> SolutionSigma {
        self.cover.map_or(*sigma, |cover| cover.greatest(sigma))
    }

    fn cover_of(&self, round: &Round<'_>) -> Option<SolutionSigma> {
        let own = round.motion(self.chosen)?;
        let of_pair = |pair: &Pair| {
            let (one, two) = pair.between;
            let other = round.motion(if one == self.chosen { two } else { one })?;
            let apart = apart(self.voices.get(one), self.voices.get(two));
            pair.cover(self.chosen, own, other, &apart)
        };
        self.pairs.iter().filter_map(of_pair).reduce(|a, b| a.greatest(&b))
    }

    fn compare(&mut self, round: &Round<'_>, passed: f64) -> Vec<VoteEvent> {
        let before: Vec<_> = self.pairs.iter().map(|pair| (pair.differs, pair.blamed)).collect();
        for pair in &mut self.pairs {
            let (one, other) = pair.between;
            let both = round.motion(one).zip(round.motion(other));
            let apart = apart(self.voices.get(one), self.voices.get(other));
            let testimonies = round.testimony(one).zip(round.testimony(other));
            let turned = [one, other].map(|own| round.testimony(own)?.turned.map(|own| own.0));
            pair.look((round.now, passed), both, turned, &apart);
            if let (Some((a, b)), Some((first, second))) = (both, testimonies) {
                pair.blame(round.now, (first, a), (second, b));
            }
        }
        self.count_voices(round);
        let changes = self.pairs.iter().zip(before);
        changes.filter_map(|(pair, before)| pair.news(round.now, before)).collect()
    }

    /// Outvotes who disagrees with two that agree with each other and have an IMU each.
    fn count_voices(&mut self, round: &Round<'_>) {
        let count = self.voices.len();
        let out: Vec<usize> = (0..count).filter(|own| self.is_outvoted(*own, round)).collect();
        for pair in self.pairs.iter_mut().filter(|pair| pair.differs) {
            // of two that are both outvoted neither is right
            let (one, other) = (out.contains(&pair.between.0), out.contains(&pair.between.1));
            if one != other {
                let engine = if one { pair.between.0 } else { pair.between.1 };
                pair.accuse((engine, Doubt::Outvoted));
            }
        }
    }

    fn is_outvoted(&self, own: usize, round: &Round<'_>) -> bool {
        let against: Vec<usize> = (0..self.voices.len())
            .filter(|other| round.motion(*other).is_some() && self.differ(own, *other))
            .collect();
        let agree = |one: usize, other: usize| {
            let imus = self.voices.get(one).zip(self.voices.get(other));
            one < other
                && imus.is_some_and(|(one, other)| one.imu != other.imu)
                && !self.differ(one, other)
        };
        against.iter().any(|one| against.iter().any(|other| agree(*one, *other)))
    }

    fn differ(&self, one: usize, other: usize) -> bool {
        let of_both = |pair: &&Pair| one != other && pair.is_of(one) && pair.is_of(other);
        self.pairs.iter().find(of_both).is_some_and(|pair| pair.differs)
    }

    fn choose(&mut self, round: &Round<'_>) -> Option<VoteEvent> {
        let (from, time) = (self.chosen, round.now);
        let (to, why) = self.leave(round).or_else(|| self.take_back(round))?;
        self.chosen = to;
        self.better = None;
        self.sound.fill(None);
        Some(VoteEvent::Switched { time, from, to, why })
    }

    /// Whom to use instead of the engine in use, and why, if something speaks against it.
    fn leave(&mut self, round: &Round<'_>) -> Option<(usize, Option<Doubt>)> {
        let best = self.best(round)?;
        let own = self.chosen;
        if round.motion(own).is_none() {
            return Some((best, Some(Doubt::Silent)));
        }
        let wrong = self.doubt(own);
        if best == own || (wrong.is_none() && self.doubt(best).is_some()) {
            self.better = None;
            return None;
        }
        if wrong.is_some() && self.doubt(best).is_none() {
            return Some((best, wrong));
        }
        let lesser = round.lesser(own, best);
        let since = *lesser.map(|_| self.better.get_or_insert(round.now))?;
        let is_idle = round.motion(own).is_some_and(|own| own.solution.mode == Mode::Standby);
        let waits = !is_idle && (round.now - since).as_seconds() < BETTER;
        (!waits).then_some((best, lesser))
    }

    /// The engine with the most behind it: usable, not wrong, of the highest mode, the most certain; the
    /// engine in use where another is not clearly better, and then the order of preference.
    fn best(&self, round: &Round<'_>) -> Option<usize> {
        let usable = |own: &usize| round.motion(*own).is_some();
        let in_order = std::iter::once(self.chosen).chain(0..self.voices.len()).filter(usable);
        in_order.reduce(|best, own| {
            let (wrong, sound) = (self.doubt(best).is_some(), self.doubt(own).is_none());
            let is_better = if wrong == sound { sound } else { round.lesser(best, own).is_some() };
            if is_better { own } else { best }
        })
    }

    /// An engine that stands before the one in use and has been as good for a while.
    fn take_back(&mut self, round: &Round<'_>) -> Option<(usize, Option<Doubt>)> {
        for own in 0..self.chosen {
            let sound = round.motion(own).is_some()
                && round.lesser(own, self.chosen).is_none()
                && !self.pairs.iter().any(|pair| pair.differs && pair.is_of(own));
            let since = self.sound.get_mut(own)?;
            *since = sound.then(|| since.unwrap_or(round.now));
            if since.is_some_and(|since| (round.now - since).as_seconds() >= TRIAL) {
                return Some((own, None));
            }
        }
        None
    }
}

/// What may be between two IMUs; nothing if they are one.
fn apart(one: Option<&Voice>, other: Option<&Voice>) -> Apart {
    let two = one.zip(other).filter(|(one, other)| one.imu != other.imu);
    two.map_or_else(Apart::default, |(one, other)| Apart {
        mounting_std: one.mounting_std.hypot(other.mounting_std),
        distance: one.distance + other.distance,
    })
}

impl Pair {
    fn disagreement(&self) -> Option<Disagreement> {
        let difference = self.worst?;
        Some(Disagreement { between: self.between, difference, wrong: self.blamed })
    }

    fn news(&self, time: Time, before: (bool, Option<(usize, Doubt)>)) -> Option<VoteEvent> {
        let between = self.between;
        match (before.0, self.differs) {
            (false, true) => {
                self.disagreement().map(|disagreement| VoteEvent::Differ { time, disagreement })
            }
            (true, false) => Some(VoteEvent::Agree { time, between }),
            _ if before.1 == self.blamed => None,
            _ => self.blamed.map(|(engine, why)| VoteEvent::Wrong { time, between, engine, why }),
        }
    }
}

impl<'a> Round<'a> {
    /// Motions that can be used, carried on to the newest of them.
    fn new(now: Time, said: &'a [Testimony]) -> Self {
        let newest = said.iter().filter_map(|own| Some(own.usable(now)?.solution.time)).max();
        let carried = |motion: &Motion| match newest {
            Some(time) if time > motion.solution.time => motion.at(time),
            _ => *motion,
        };
        let said = said.iter().map(|own| (own, own.usable(now).map(carried)));
        Round { now, said: said.collect() }
    }

    fn motion(&self, engine: usize) -> Option<&Motion> {
        self.said.get(engine)?.1.as_ref()
    }

    fn testimony(&self, engine: usize) -> Option<&'a Testimony> {
        self.said.get(engine).map(|(said, _)| *said)
    }

    /// Why there is less behind one engine than behind another, if there is.
    fn lesser(&self, own: usize, other: usize) -> Option<Doubt> {
        let (a, b) = (&self.motion(own)?.solution, &self.motion(other)?.solution);
        let doubted = |engine: usize, solution: &Solution| {
            self.testimony(engine).is_some_and(|said| is_imu_doubted(said, solution))
        };
        let (rank, best) = (rank(a.mode), rank(b.mode));
        let reasons = [
            (doubted(own, a) && !doubted(other, b), Doubt::ImuInvalid),
            (!a.mode.is_navigating() && b.mode.is_navigating(), Doubt::Aligning),
            (rank < best, Doubt::LesserMode),
            (rank == best && is_vaguer(a, b), Doubt::LessCertain),
        ];
        reasons.into_iter().find(|(holds, _)| *holds).map(|(_, doubt)| doubt)
    }
}

#[cfg(test)]
mod tests;
