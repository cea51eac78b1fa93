//! What was told of the integrity: each state for how long, and who was left out when.

use std::collections::BTreeMap;

use insd_base::{Availability, Span, Time};
use serde::Serialize;

use super::pieces::Pieces;

/// How long a state was told.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Share {
    /// In all, s.
    pub total_s: f64,
    /// Of the time in which anything was told, 0 to 1.
    pub share: f64,
}

/// When a source was left out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Exclusion {
    /// Its word: `gnss`, `log`, ...
    pub source: String,
    /// First time, s.
    pub first_s: f64,
    /// Last time, s.
    pub last_s: f64,
    /// In all, s.
    pub total_s: f64,
    /// In so many pieces.
    pub pieces: u64,
}

/// What was told, entered in order of time.
#[derive(Clone, Debug, Default)]
pub struct FaultsTold {
    all: Pieces,
    states: [Pieces; Availability::ALL.len()],
    excluded: BTreeMap<String, Pieces>,
}

impl FaultsTold {
    /// What was told from an instant on for so long.
    pub fn enter(
        &mut self,
        time: Time,
        held: Span,
        integrity: Option<Availability>,
        excluded: &[impl AsRef<str>],
    ) {
        self.all.enter(time, held, true);
        for (pieces, own) in self.states.iter_mut().zip(Availability::ALL) {
            pieces.enter(time, held, integrity == Some(own));
        }
        for source in excluded {
            if !self.excluded.contains_key(source.as_ref()) {
                self.excluded.insert(source.as_ref().to_owned(), Pieces::default());
            }
        }
        for (source, pieces) in &mut self.excluded {
            let holds = excluded.iter().any(|own| own.as_ref() == source);
            pieces.enter(time, held, holds);
        }
    }

    /// Nothing was told for a while.
    pub fn cut(&mut self) {
        self.excluded.values_mut().for_each(Pieces::cut);
    }

    /// How long anything was told, s.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.all.total()
    }

    /// How long each state was told, of those that ever were.
    #[must_use]
    pub fn states(&self) -> Vec<(Availability, Share)> {
        let states = Availability::ALL.into_iter().zip(&self.states);
        let share = |total_s: f64| Share { total_s, share: total_s / self.total() };
        let told = states.filter(|(_, pieces)| pieces.count() > 0);
        told.map(|(state, pieces)| (state, share(pieces.total()))).collect()
    }

    /// When each source was left out, of those that ever were.
    #[must_use]
    pub fn exclusions(&self) -> Vec<Exclusion> {
        let one = |(source, pieces): (&String, &Pieces)| {
            let (first, last) = pieces.extent()?;
            Some(Exclusion {
                source: source.clone(),
                first_s: first.as_seconds(),
                last_s: last.as_seconds(),
                total_s: pieces.total(),
                pieces: pieces.count(),
            })
        };
        self.excluded.iter().filter_map(one).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_state_and_each_source_has_its_own_time() {
        let mut told = FaultsTold::default();
        let second = Span::from_seconds(1.0);
        for at in 0..100 {
            let integrity = match at {
                0..10 => None,
                10..90 => Some(Availability::Available),
                _ => Some(Availability::Fault),
            };
            let excluded: &[&str] = match at {
                20..30 | 50..60 => &["gnss"],
                30..40 => &["gnss", "log"],
                _ => &[],
            };
            told.enter(Time::from_seconds(f64::from(at)), second, integrity, excluded);
        }
        let of = |total_s| Share { total_s, share: total_s / 100.0 };
        let states = [(Availability::Available, of(80.0)), (Availability::Fault, of(10.0))];
        assert_eq!(told.states(), states);
        let gnss = Exclusion {
            source: "gnss".to_owned(),
            first_s: 20.0,
            last_s: 59.0,
            total_s: 30.0,
            pieces: 2,
        };
        let log = Exclusion {
            source: "log".to_owned(),
            first_s: 30.0,
            last_s: 39.0,
            total_s: 10.0,
            pieces: 1,
        };
        assert_eq!(told.exclusions(), [gnss, log]);
    }
}
