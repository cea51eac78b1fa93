//! Integers that are believed, and whether later epochs bear them out.

use std::collections::BTreeMap;

use insd_base::GpsTime;
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::arcs::Arcs;
use super::double::{DoubleDifferences, PairAmbiguity};
use super::float::Float;
use super::outcome::{RtkFix, RtkWithdrawal};
use super::pairing::{Group, SignalPair};

/// What is believed is contradicted when chance makes it as unlikely once in so many epochs.
const CONTRADICTED: f64 = 1e-7;

/// What is believed may bear others where the doubt of it was less.
const SURE: f64 = 1e-8;

/// Believed integers of signals, each up to a number that all of its group share.
#[derive(Clone, Debug, Default)]
pub(super) struct Belief {
    integers: BTreeMap<SignalPair, i64>,
    since: Option<GpsTime>,
    epochs: usize,
    /// The least doubt of a fix that rested on data alone.
    doubt: f64,
}

impl Belief {
    /// Forgets signals whose arcs have ended or begun anew.
    pub(super) fn keep(&mut self, arcs: &Arcs) {
        self.integers.retain(|pair, _| arcs.state_of(*pair).is_some() && !arcs.is_new(*pair));
        if self.integers.is_empty() {
            *self = Self::default();
        }
    }

    /// What is believed of an ambiguity.
    fn of(&self, ambiguity: &PairAmbiguity) -> Option<i64> {
        Some(self.integers.get(&ambiguity.pair)? - self.integers.get(&ambiguity.reference())?)
    }

    /// What is believed of the ambiguities of an epoch, by their place.
    fn among(&self, differences: &DoubleDifferences) -> Vec<(usize, i64)> {
        let all = differences.ambiguities().iter().enumerate();
        all.filter_map(|(place, ambiguity)| Some((place, self.of(ambiguity)?))).collect()
    }

    /// Believed integers that are so sure that others may rest on them, and their doubt.
    pub(super) fn sure(&self, differences: &DoubleDifferences) -> Option<(Vec<(usize, i64)>, f64)> {
        let among = self.among(differences);
        (self.epochs > 0 && self.doubt <= SURE && !among.is_empty()).then_some((among, self.doubt))
    }

    /// Whether real ambiguities have come to contradict what is believed.
    fn is_contradicted(&self, differences: &DoubleDifferences, float: &Float, level: f64) -> bool {
        let believed = self.among(differences);
        if believed.is_empty() {
            return false;
        }
        let count = believed.len();
        let off =
            DVector::from_fn(count, |i, _| float.ambiguities[believed[i].0] - believed[i].1 as f64);
        let covariance = DMatrix::from_fn(count, count, |i, j| {
            float.covariance[(3 + believed[i].0, 3 + believed[j].0)]
        });
        let Some(factor) = covariance.cholesky() else { return false };
        let distance = off.dot(&factor.solve(&off)) / level.max(1.0);
        ChiSquared::new(count as f64).is_ok_and(|law| law.sf(distance) < CONTRADICTED)
    }

    /// Whether integers do not contradict what is believed.
    pub(super) fn allows(&self, fix: &RtkFix) -> bool {
        self.offsets(fix).is_some()
    }

    /// Takes what an epoch has come to. Gives back what is withdrawn, if it contradicts what was believed.
    pub(super) fn take(
        &mut self,
        tag: GpsTime,
        (differences, float): (&DoubleDifferences, &Float),
        fix: Option<&RtkFix>,
    ) -> Option<RtkWithdrawal> {
        let level = float.misfit.0 / float.misfit.1.max(1) as f64;
        let is_wrong = match fix {
            Some(fix) => self.offsets(fix).is_none(),
            None => self.is_contradicted(differences, float, level),
        };
        let withdrawn = self.since.filter(|_| is_wrong);
        let withdrawn = withdrawn.map(|since| RtkWithdrawal { since, epochs: self.epochs });
        if is_wrong {
            *self = Self::default();
        }
        if let Some(fix) = fix {
            self.believe(tag, fix);
        }
        withdrawn
    }

    /// By what the integers of each group are counted from another origin than before; `None` where they are not the same integers.
    fn offsets(&self, fix: &RtkFix) -> Option<BTreeMap<Group, i64>> {
        let mut offsets = BTreeMap::new();
        for (ambiguity, integer) in &fix.integers {
            for (pair, integer) in [(ambiguity.pair, *integer), (ambiguity.reference(), 0)] {
                let Some(believed) = self.integers.get(&pair) else { continue };
                let offset = believed - integer;
                if *offsets.entry(pair.group()).or_insert(offset) != offset {
                    return None;
                }
            }
        }
        Some(offsets)
    }

    fn believe(&mut self, tag: GpsTime, fix: &RtkFix) {
        let offsets = self.offsets(fix).unwrap_or_default();
        self.doubt = if self.epochs == 0 { fix.doubt } else { self.doubt.min(fix.doubt) };
        self.since.get_or_insert(tag);
        self.epochs += 1;
        for (ambiguity, integer) in &fix.integers {
            let offset = offsets.get(&ambiguity.pair.group()).copied().unwrap_or(0);
            self.integers.insert(ambiguity.reference(), offset);
            self.integers.insert(ambiguity.pair, offset + integer);
        }
    }
}

#[cfg(test)]
mod tests {
    use insd_base::{SignalCode, Span};
    use nalgebra::{Matrix3, Vector3};

    use super::*;

    fn fix(reference: &str, integers: &[(&str, i64)]) -> RtkFix {
        let signal = SignalCode::new(1, b'C');
        let integer = |(satellite, integer): &(&str, i64)| {
            let satellite = satellite.parse().unwrap();
            let pair = SignalPair { satellite, rover: signal, base: signal };
            (PairAmbiguity { pair, reference: reference.parse().unwrap() }, *integer)
        };
        RtkFix {
            position: Vector3::zeros(),
            covariance: Matrix3::identity(),
            runner_up: Vector3::zeros(),
            doubt: 1e-9,
            ratio: 10.0,
            success: 1.0,
            integers: integers.iter().map(integer).collect(),
            attempts: 1,
            level: 1.0,
        }
    }

    #[test]
    fn other_integers_withdraw_what_was_believed_and_another_reference_does_not() {
        let nothing = DoubleDifferences::new(Vec::new());
        let float = Float {
            position: Vector3::zeros(),
            ambiguities: DVector::zeros(0),
            covariance: DMatrix::zeros(3, 3),
            misfit: (0.0, 0),
            known: (0.0, 0.0),
        };
        let start = GpsTime::from_week(2300, 0);
        let mut belief = Belief::default();
        let mut take = |second: f64, fix: &RtkFix| {
            let tag = start.plus(Span::from_seconds(second));
            belief.take(tag, (&nothing, &float), Some(fix))
        };
        assert_eq!(take(0.0, &fix("G01", &[("G02", 5), ("G03", -7)])), None);
        // the same against G02, and a satellite more
        assert_eq!(take(1.0, &fix("G02", &[("G01", -5), ("G03", -12), ("G04", 2)])), None);
        assert_eq!(take(2.0, &fix("G04", &[("G03", -14)])), None);
        let withdrawn = take(3.0, &fix("G01", &[("G02", 5), ("G03", -8)])).unwrap();
        assert_eq!(withdrawn, RtkWithdrawal { since: start, epochs: 3 });
        // what has taken its place is believed
        assert_eq!(take(4.0, &fix("G01", &[("G02", 5), ("G03", -8)])), None);
    }
}
