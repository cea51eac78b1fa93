//! What the aids measured against what was expected.

use std::collections::BTreeMap;

use insd_base::{AidInnovation, SatelliteInnovation, Time};

use super::lane::Lane;
use crate::report::statistics::Statistics;

/// Bits in the lane of an aid.
pub(crate) const USED: u16 = 1;
/// See [`USED`].
pub(crate) const REJECTED: u16 = 2;
/// Aids at most: names are constants of the program.
const LIMIT: usize = 64;
/// Sigmas within which 95.4 % of a Gaussian lie.
const TWO: f64 = 2.0;

/// Innovations over their expected sigma.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Normalised {
    pub(crate) all: Statistics,
    within: u64,
}

/// One aid.
#[derive(Clone, Debug)]
pub(crate) struct Aid {
    pub(crate) lane: Lane,
    /// By component, of what was used.
    pub(crate) used: [Normalised; 3],
    /// By component, of everything that was weighed.
    pub(crate) weighed: [Normalised; 3],
}

/// All aids by name.
#[derive(Clone, Debug)]
pub(crate) struct Aids {
    start: Time,
    pub(crate) by_name: BTreeMap<&'static str, Aid>,
}

impl Normalised {
    fn add(&mut self, ratio: f64) {
        self.all.add(ratio);
        self.within += u64::from(ratio.abs() <= TWO);
    }

    /// Share within two sigmas; `None` of nothing.
    pub(crate) fn coverage(&self) -> Option<f64> {
        let count = self.all.count();
        (count > 0).then(|| self.within as f64 / count as f64)
    }
}

impl Aids {
    pub(crate) fn new(start: Time) -> Self {
        Aids { start, by_name: BTreeMap::new() }
    }

    /// Takes an innovation that came at this moment.
    pub(crate) fn innovation(&mut self, now: Time, innovation: &AidInnovation) {
        let ratio = innovation.innovation / innovation.sigma;
        let component = usize::from(innovation.component);
        let Some(aid) = self.aid(innovation.aid) else { return };
        let count = |list: &mut [Normalised; 3]| {
            if let Some(own) = list.get_mut(component).filter(|_| ratio.is_finite()) {
                own.add(ratio);
            }
        };
        count(&mut aid.weighed);
        if innovation.accepted {
            count(&mut aid.used);
            aid.lane.mark(now, USED);
        }
    }

    /// Takes what a satellite told at this moment: of one component, and refused without an event of its own.
    pub(crate) fn satellite(&mut self, now: Time, told: &SatelliteInnovation) {
        self.innovation(now, &told.of_aid());
        if !told.accepted {
            self.rejected(now, told.aid);
        }
    }

    /// Takes a rejection that came at this moment.
    pub(crate) fn rejected(&mut self, now: Time, aid: &'static str) {
        if let Some(aid) = self.aid(aid) {
            aid.lane.mark(now, REJECTED);
        }
    }

    fn aid(&mut self, name: &'static str) -> Option<&mut Aid> {
        let is_room = self.by_name.len() < LIMIT || self.by_name.contains_key(name);
        let none = || Aid {
            lane: Lane::new(self.start),
            used: Default::default(),
            weighed: Default::default(),
        };
        is_room.then(|| self.by_name.entry(name).or_insert_with(none))
    }
}
