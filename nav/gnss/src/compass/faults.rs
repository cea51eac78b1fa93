//! What is wrong with antennas, cables, clocks and the configuration, by what epochs show in a row.

use std::collections::BTreeMap;

use insd_base::GpsTime;

use super::fit::{Freed, with_own_clock, without};
use super::observe::Observed;
use super::settings::CompassArray;
use super::signal::Common;
use insd_base::satellites::CompassFault;

/// So many epochs more that show a fault than do not, and it is one.
const BORNE_OUT: usize = 4;
/// At most so many are counted, so that a fault that has gone is forgotten.
const MOST: usize = 8;
/// An antenna that hears less than this share of what the others do hears next to nothing.
const FEW: f64 = 0.35;
/// An antenna whose signals are this much weaker than those of the others is broken, dB: ten to one is more than antennas of one make differ by.
const WEAK: f64 = 10.0;
/// An antenna whose phases fitted to nothing is tried again after so many epochs.
const TRIED_AGAIN: usize = 120;

/// Counts of what epochs show, by antenna.
#[derive(Clone, Debug, Default)]
pub(super) struct Monitor {
    broken: Vec<usize>,
    clock: Vec<usize>,
    own_clock: Vec<bool>,
    incoherent: Vec<usize>,
    left_out: Vec<usize>,
    swapped: BTreeMap<(usize, usize), usize>,
    began: Option<(GpsTime, Vec<Option<f64>>)>,
    rates: Vec<f64>,
}

impl Monitor {
    pub(super) fn new(antennas: usize) -> Self {
        Self {
            broken: vec![0; antennas],
            clock: vec![0; antennas],
            own_clock: vec![false; antennas],
            incoherent: vec![0; antennas],
            left_out: vec![0; antennas],
            rates: vec![0.0; antennas],
            ..Self::default()
        }
    }

    /// Looks at what antennas hear, and at their clocks.
    pub(super) fn hear(&mut self, observed: &Observed) {
        let count = |antenna: usize| {
            let has = observed
                .commons
                .iter()
                .filter(|common| common.heard.iter().any(|own| own.antenna == antenna));
            has.count() as f64
        };
        let counts: Vec<f64> = (0..self.broken.len()).map(count).collect();
        let most = counts.iter().copied().fold(0.0, f64::max);
        let strength = observed.strengths.iter().flatten().copied().fold(0.0, f64::max);
        for (antenna, broken) in self.broken.iter_mut().enumerate() {
            let is_deaf = most >= 4.0 && counts[antenna] < FEW * most;
            let is_weak = observed.strengths[antenna].is_some_and(|own| own < strength - WEAK);
            note(broken, is_deaf || is_weak);
        }
        for left_out in &mut self.left_out {
            *left_out = left_out.saturating_sub(1);
        }
        self.watch_clocks(observed);
    }

    /// By how much each clock gains on the middle of the others, m/s, since they were heard first.
    fn watch_clocks(&mut self, observed: &Observed) {
        let Some((since, first)) = &self.began else {
            self.began = Some((observed.tag, observed.clocks.clone()));
            return;
        };
        let elapsed = observed.tag.since(*since).as_seconds();
        if elapsed <= 0.0 {
            return;
        }
        let gains: Vec<Option<f64>> = observed
            .clocks
            .iter()
            .zip(first)
            .map(|(now, then)| Some(((*now)? - (*then)?) / elapsed))
            .collect();
        for (antenna, rate) in self.rates.iter_mut().enumerate() {
            let others = gains.iter().enumerate().filter(|(other, _)| *other != antenna);
            let mut others: Vec<f64> = others.filter_map(|(_, gain)| *gain).collect();
            others.sort_by(f64::total_cmp);
            let middle = others.get(others.len() / 2);
            *rate = gains[antenna].zip(middle).map_or(*rate, |(own, middle)| own - middle);
        }
    }

    /// What an epoch that fits had to have done to it.
    pub(super) fn fitted(&mut self, freed: Freed) {
        for antenna in 0..self.clock.len() {
            note(&mut self.clock[antenna], freed == Freed::Clock(antenna));
            if self.clock[antenna] >= BORNE_OUT {
                self.own_clock[antenna] = true;
            }
            note(&mut self.incoherent[antenna], freed == Freed::Antenna(antenna));
            if self.incoherent[antenna] >= BORNE_OUT {
                self.left_out[antenna] = TRIED_AGAIN;
                self.incoherent[antenna] = 0;
            }
        }
        self.swapped.clear();
    }

    /// Pairs of antennas that fit in each other's place where nothing does as configured.
    pub(super) fn fits_swapped(&mut self, pairs: &[(usize, usize)]) {
        for pair in pairs {
            self.swapped.entry(*pair).or_default();
        }
        for (pair, count) in &mut self.swapped {
            note(count, pairs.contains(pair));
        }
    }

    /// The array with the clocks that have been found.
    pub(super) fn effective(&self, array: &CompassArray) -> CompassArray {
        let own = (0..array.antennas()).filter(|antenna| self.own_clock[*antenna]);
        own.fold(array.clone(), |array, antenna| with_own_clock(&array, antenna))
    }

    /// Signals without the antennas that are not to be used.
    pub(super) fn of_use(&self, commons: &[Common]) -> Vec<Common> {
        // what is deaf or weak is of no use, whether that has been so for long or not
        let is_out = |antenna: usize| self.broken[antenna] > 0 || self.left_out[antenna] > 0;
        commons.iter().filter_map(|common| without(common, &is_out)).collect()
    }

    pub(super) fn faults(&self) -> Vec<CompassFault> {
        let mut faults = Vec::new();
        for antenna in 0..self.broken.len() {
            if self.broken[antenna] >= BORNE_OUT {
                faults.push(CompassFault::Broken { antenna });
            }
            if self.own_clock[antenna] {
                faults.push(CompassFault::OwnClock { antenna, rate: self.rates[antenna] });
            }
            if self.left_out[antenna] > 0 {
                faults.push(CompassFault::Incoherent { antenna });
            }
        }
        let swapped = self.swapped.iter().filter(|(_, count)| **count >= BORNE_OUT);
        faults.extend(swapped.map(|((one, other), _)| {
            let (one, other) = (*one, *other);
            CompassFault::Swapped { one, other }
        }));
        faults
    }
}

fn note(count: &mut usize, is_shown: bool) {
    *count = if is_shown { (*count + 1).min(MOST) } else { count.saturating_sub(1) };
}
