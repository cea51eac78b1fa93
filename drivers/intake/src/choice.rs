//! Which of several sources of a quantity is used.
//!
//! The best that is valid; a source that is silent or says that it is invalid is left after its
//! patience, and a better one is taken back only after it has been valid for a while, so that the
//! navigator does not flip between two.

use insd_base::{Span, Time};

/// A quantity that several sources may give.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Quantity {
    /// Increments of angle and velocity.
    Inertial,
    /// Position and velocity from satellites.
    Gnss,
    /// Velocity over the sea bed.
    BottomVelocity,
    /// Velocity through the water.
    WaterVelocity,
    /// True heading.
    Heading,
    /// Position from elsewhere than satellites.
    Position,
}

/// Why another source is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Why {
    /// It is the first that is valid.
    First,
    /// The one before fell silent.
    Silent,
    /// The one before says that it is not valid.
    Invalid,
    /// It is better than the one before, and has been valid for a while.
    Better,
    /// There is none.
    NoneLeft,
}

impl Quantity {
    /// Its word: `inertial`, `bottom_velocity`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Quantity::Inertial => "inertial",
            Quantity::Gnss => "gnss",
            Quantity::BottomVelocity => "bottom_velocity",
            Quantity::WaterVelocity => "water_velocity",
            Quantity::Heading => "heading",
            Quantity::Position => "position",
        }
    }
}

impl Why {
    /// Its word: `first`, `none_left`, ...
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Why::First => "first",
            Why::Silent => "silent",
            Why::Invalid => "invalid",
            Why::Better => "better",
            Why::NoneLeft => "none_left",
        }
    }
}

/// Another source is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Chosen {
    /// Of what.
    pub quantity: Quantity,
    /// Index of the sensor used before.
    pub from: Option<usize>,
    /// Index of the sensor used now.
    pub to: Option<usize>,
    /// Why.
    pub why: Why,
}

/// The sources of one quantity.
#[derive(Clone, Debug)]
pub struct Choice {
    quantity: Quantity,
    hold: Span,
    candidates: Vec<Candidate>,
    current: Option<usize>,
    why: Option<Why>,
}

#[derive(Clone, Copy, Debug)]
struct Candidate {
    sensor: usize,
    priority: u8,
    patience: Span,
    heard: Option<Time>,
    valid: Option<Time>,
    valid_since: Option<Time>,
}

impl Choice {
    /// A choice without candidates. A better source must have been valid for `hold` to be taken back.
    #[must_use]
    pub fn new(quantity: Quantity, hold: Span) -> Self {
        Choice { quantity, hold, candidates: Vec::new(), current: None, why: None }
    }

    /// Adds a source; a lower priority is better, and of equals the first. It is left after it has
    /// been silent or invalid for its `patience`.
    pub fn add(&mut self, sensor: usize, priority: u8, patience: Span) {
        let none = None;
        self.candidates.push(Candidate {
            sensor,
            priority,
            patience,
            heard: none,
            valid: none,
            valid_since: none,
        });
        self.candidates.sort_by_key(|candidate| (candidate.priority, candidate.sensor));
    }

    /// A source spoke. Tells whether another one is used from now on; then ask [`Choice::is_used`].
    pub fn hear(&mut self, sensor: usize, valid: bool, now: Time) -> Option<Chosen> {
        if let Some(own) = self.candidates.iter_mut().find(|own| own.sensor == sensor) {
            own.heard = Some(now);
            if valid {
                let lapsed = own.valid.is_none_or(|last| now - last > own.patience);
                own.valid_since = own.valid_since.filter(|_| !lapsed).or(Some(now));
                own.valid = Some(now);
            } else {
                own.valid_since = None;
            }
        }
        self.look(now)
    }

    /// Time passes: a silent source is left.
    pub fn look(&mut self, now: Time) -> Option<Chosen> {
        let before = self.current;
        let best = self.candidates.iter().find(|own| own.is_valid(now)).copied();
        let current = before.and_then(|sensor| self.candidate(sensor)).copied();
        let (to, why) = match (current, best) {
            (None, None) => return None,
            (None, Some(best)) => (Some(best.sensor), Why::First),
            (Some(own), best) if !own.is_valid(now) => {
                let why = if own.is_heard(now) { Why::Invalid } else { Why::Silent };
                (best.map(|best| best.sensor), best.map_or(Why::NoneLeft, |_| why))
            }
            (Some(own), Some(best)) if best.priority < own.priority => {
                if best.valid_since.is_none_or(|since| now - since < self.hold) {
                    return None;
                }
                (Some(best.sensor), Why::Better)
            }
            _ => return None,
        };
        self.current = to;
        self.why = Some(why);
        Some(Chosen { quantity: self.quantity, from: before, to, why })
    }

    /// Whether a sensor is the one in use.
    #[must_use]
    pub fn is_used(&self, sensor: usize) -> bool {
        self.current == Some(sensor)
    }

    /// The place of a sensor among all: 0 for the one in use, then by priority.
    #[must_use]
    pub fn rank(&self, sensor: usize) -> u8 {
        if self.is_used(sensor) {
            return 0;
        }
        let others = self.candidates.iter().filter(|own| !self.is_used(own.sensor));
        let before = others.take_while(|own| own.sensor != sensor).count();
        u8::try_from(before + 1).unwrap_or(u8::MAX)
    }

    /// The sensor in use.
    #[must_use]
    pub fn current(&self) -> Option<usize> {
        self.current
    }

    /// Why that one; `None` before any has been valid.
    #[must_use]
    pub fn why(&self) -> Option<Why> {
        self.why
    }

    /// Of what.
    #[must_use]
    pub fn quantity(&self) -> Quantity {
        self.quantity
    }

    fn candidate(&self, sensor: usize) -> Option<&Candidate> {
        self.candidates.iter().find(|own| own.sensor == sensor)
    }
}

impl Candidate {
    fn is_valid(&self, now: Time) -> bool {
        self.valid.is_some_and(|last| now - last <= self.patience)
    }

    fn is_heard(&self, now: Time) -> bool {
        self.heard.is_some_and(|last| now - last <= self.patience)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choice() -> Choice {
        let mut choice = Choice::new(Quantity::Heading, Span::from_seconds(10.0));
        choice.add(4, 2, Span::from_seconds(2.0));
        choice.add(7, 1, Span::from_seconds(2.0));
        choice
    }

    /// Lets sources speak each 0.5 s, as `(sensor, valid)`, from one time to another; gives changes.
    fn spoken(
        choice: &mut Choice,
        from: f64,
        to: f64,
        sources: &[(usize, bool)],
    ) -> Vec<(f64, Option<usize>, Why)> {
        let mut changes = Vec::new();
        let steps = ((to - from) * 2.0) as i32;
        for step in 0..steps {
            let seconds = from + f64::from(step) * 0.5;
            let now = Time::from_seconds(seconds);
            let told =
                sources.iter().filter_map(|(sensor, valid)| choice.hear(*sensor, *valid, now));
            changes.extend(told.map(|told| (seconds, told.to, told.why)));
        }
        changes
    }

    #[test]
    fn the_first_valid_source_is_used_and_a_better_one_after_its_trial() {
        let mut choice = choice();
        assert_eq!(spoken(&mut choice, 0.0, 3.0, &[(4, true)]), [(0.0, Some(4), Why::First)]);
        let both = spoken(&mut choice, 3.0, 20.0, &[(4, true), (7, true)]);
        assert_eq!(both, [(13.0, Some(7), Why::Better)]);
        assert!(choice.is_used(7) && !choice.is_used(4));
        assert_eq!((choice.rank(7), choice.rank(4)), (0, 1));
    }

    #[test]
    fn a_source_is_left_when_silent_and_when_it_says_it_is_invalid() {
        for (best, why) in [(None, Why::Silent), (Some((7, false)), Why::Invalid)] {
            let mut choice = choice();
            spoken(&mut choice, 0.0, 20.0, &[(4, true), (7, true)]);
            let mut sources = vec![(4, true)];
            sources.extend(best);
            let changes = spoken(&mut choice, 20.0, 30.0, &sources);
            assert_eq!(changes, [(22.0, Some(4), why)], "{why:?}");
        }
    }

    #[test]
    fn a_source_that_comes_and_goes_is_not_taken_back() {
        let mut choice = choice();
        spoken(&mut choice, 0.0, 1.0, &[(4, true)]);
        for k in 0..20 {
            let at = 1.0 + f64::from(k) * 8.0;
            assert_eq!(spoken(&mut choice, at, at + 5.0, &[(4, true), (7, true)]), []);
            assert_eq!(spoken(&mut choice, at + 5.0, at + 8.0, &[(4, true)]), []);
        }
    }

    #[test]
    fn when_all_are_silent_there_is_none() {
        let mut choice = choice();
        spoken(&mut choice, 0.0, 1.0, &[(4, true)]);
        let told = choice.look(Time::from_seconds(5.0)).unwrap();
        assert_eq!((told.to, told.why), (None, Why::NoneLeft));
        assert_eq!(choice.look(Time::from_seconds(6.0)), None);
    }
}
