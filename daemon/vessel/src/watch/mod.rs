//! References that are watched and not used: compasses, positions and inclinometers that others have brought on board. Each
//! is held against what the ship says of herself, and against each other one of its kind, as a heading monitor does.
//!
//! Who is wrong is told where there is evidence: the ship is aligned, does not doubt herself, and claims by far less than the
//! difference; and no second reference says the same as the first. Otherwise two contradict each other, and nobody is named.

mod average;
mod history;
mod plan;
mod report;
#[cfg(test)]
mod tests;

pub use plan::{MOST_WATCHED, WatchLimits, WatchPlan, WatchQuantity};
pub use report::{WatchChange, WatchComparison};

use insd_base::{Geodetic, Integrity, Motion, Span, Time};
use insd_intake::watched::{Watched, WatchedValue};
use insd_output::Contradicted;

use average::{Average, Found};
use history::{History, Reading};

/// Time between two looks.
const LOOK: Span = Span::from_nanos(200_000_000);
/// Our own motion is carried on to a reading over no more than this.
const CARRIED: Span = Span::from_nanos(500_000_000);
/// By how much a reading may be older than it seems, 1-sigma, s: hardly a compass states the delay of its filter.
const DELAY_STD: f64 = 0.2;
/// A difference speaks against somebody where it is beyond so many sigmas of what we claim.
const CERTAIN: f64 = 3.0;

/// All that are watched.
#[derive(Clone, Debug, Default)]
pub(crate) struct ReferenceWatch {
    watched: Vec<WatchedReference>,
    pairs: Vec<Pair>,
    looked: Option<Time>,
    /// Whether our own word counts as evidence.
    is_sure: bool,
}

#[derive(Clone, Debug)]
struct WatchedReference {
    plan: WatchPlan,
    histories: [History; WatchQuantity::ALL.len()],
}

/// Two of a quantity that are compared: a watched one, and another or ourselves.
#[derive(Clone, Debug)]
struct Pair {
    quantity: WatchQuantity,
    one: usize,
    other: Option<usize>,
    average: Average,
    /// How it stood at the last look.
    told: Verdict,
}

/// How a comparison stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
struct Verdict {
    differ: bool,
    /// Who is wrong, if that is known.
    wrong: Option<usize>,
}

impl ReferenceWatch {
    /// Nothing has been heard yet.
    pub(crate) fn new(plans: Vec<WatchPlan>) -> Self {
        let pair = |quantity, one, other| Pair {
            quantity,
            one,
            other,
            average: Average::default(),
            told: Verdict::default(),
        };
        let mut pairs = Vec::new();
        for quantity in WatchQuantity::ALL {
            for one in 0..plans.len() {
                pairs.push(pair(quantity, one, None));
                pairs.extend((one + 1..plans.len()).map(|other| pair(quantity, one, Some(other))));
            }
        }
        let watched =
            plans.into_iter().map(|plan| WatchedReference { plan, histories: Default::default() });
        ReferenceWatch { watched: watched.collect(), pairs, looked: None, is_sure: false }
    }

    /// Takes in what a watched sensor says, beside how the IMU moves.
    pub(crate) fn hear(&mut self, told: &Watched, motion: Option<&Motion>) {
        let found = self.watched.iter().position(|own| own.plan.sensor == told.sensor);
        let Some(index) = found else { return };
        let near =
            |own: &&Motion| (told.time - own.solution.time).as_nanos().abs() <= CARRIED.as_nanos();
        let motion = motion.filter(near).map(|own| own.at(told.time));
        let plan = &self.watched[index].plan;
        let value = at_imu(told.value, plan, motion.as_ref());
        let std = told.std.unwrap_or(plan.attitude_std);
        let reading = Reading { time: told.time, value, std };
        let quantity = WatchQuantity::of(&value);
        if !self.watched[index].histories[quantity as usize].add(reading) {
            return;
        }
        if let Some(motion) = &motion {
            self.against_own(index, &reading, motion);
        }
        self.against_others(index, quantity, std, motion.as_ref());
    }

    fn against_own(&mut self, index: usize, reading: &Reading, motion: &Motion) {
        let quantity = WatchQuantity::of(&reading.value);
        let (own, sigma) = said(quantity, motion);
        let Some(difference) = reading.value.less(&own) else { return };
        let own_sigma = sigma.hypot(moves(quantity, motion) * DELAY_STD);
        let sigma = own_sigma.hypot(reading.std);
        let found = Found { time: reading.time, difference, sigma, own_sigma };
        let smooth = self.watched[index].plan.smooth;
        let mut pairs = self.pairs.iter_mut();
        let own = pairs.find(|pair| pair.is_of(quantity, index) && pair.other.is_none());
        own.into_iter().for_each(|pair| pair.average.note(found, smooth));
    }

    fn against_others(
        &mut self,
        index: usize,
        quantity: WatchQuantity,
        std: f64,
        motion: Option<&Motion>,
    ) {
        let own_sigma = motion.map_or(0.0, |motion| moves(quantity, motion) * DELAY_STD);
        for pair in self.pairs.iter_mut().filter(|pair| pair.quantity == quantity) {
            // it is the second of a pair whose readings lie between two of the first
            let Some(other) = pair.other.filter(|_| pair.one == index) else { continue };
            let [own, other] = [index, other].map(|each| &self.watched[each]);
            let smooth = own.plan.smooth.max(other.plan.smooth);
            let histories = [own, other].map(|each| &each.histories[quantity as usize]);
            for (time, difference, their_std) in histories[0].against(histories[1]) {
                let sigma = std.hypot(their_std).hypot(own_sigma);
                pair.average.note(Found { time, difference, sigma, own_sigma }, smooth);
            }
        }
    }

    /// Judges the differences if it is time to, and tells what has changed; `motion` is how the IMU moves by our own account.
    pub(crate) fn look(
        &mut self,
        now: Time,
        motion: impl FnOnce() -> Option<Motion>,
        mut tell: impl FnMut(WatchChange),
    ) {
        if self.watched.is_empty() || self.looked.is_some_and(|last| now - last < LOOK) {
            return;
        }
        self.looked = Some(now);
        self.is_sure = motion().is_some_and(|motion| is_sure(&motion));
        let differ: Vec<bool> = (0..self.pairs.len()).map(|pair| self.differs(pair, now)).collect();
        for (index, differ) in differ.iter().enumerate() {
            let wrong = self.wrong(index, now).or_else(|| self.still_wrong(index, now));
            let wrong = wrong.filter(|_| *differ);
            let verdict = Verdict { differ: *differ, wrong };
            if verdict != self.pairs[index].told {
                self.pairs[index].told = verdict;
                let comparison = self.comparison(&self.pairs[index], now);
                comparison.into_iter().for_each(|comparison| tell(WatchChange { comparison }));
            }
        }
    }

    /// Whether two have been too far apart for long enough.
    fn differs(&mut self, index: usize, now: Time) -> bool {
        let (limit, hold) = self.limits(&self.pairs[index]);
        let is_sure = self.is_sure;
        let pair = &mut self.pairs[index];
        let is_beyond = pair.average.mean(now).map(|mean| {
            let counts = pair.other.is_some() || is_sure;
            counts && mean.size() > limit.max(CERTAIN * mean.own_sigma)
        });
        match is_beyond {
            Some(is_beyond) => pair.average.look(is_beyond, hold, now),
            None => {
                pair.average.lapse();
                false
            }
        }
    }

    /// Who of two that differ is wrong, if that is known. Judged by what has been compared up to this look.
    fn wrong(&self, index: usize, now: Time) -> Option<usize> {
        let Pair { quantity, one, other, .. } = self.pairs[index];
        let stands_out = |sensor: usize| self.is_refuted(quantity, sensor, now);
        match other {
            None => Some(one).filter(|one| stands_out(*one)),
            Some(other) => match (stands_out(one), stands_out(other)) {
                (true, false) => Some(one),
                (false, true) => Some(other),
                _ => None,
            },
        }
    }

    /// Who was named at the last look is not cleared by a difference that is about to end.
    fn still_wrong(&self, index: usize, now: Time) -> Option<usize> {
        let Pair { quantity, told, .. } = &self.pairs[index];
        told.wrong.filter(|wrong| self.is_sure && self.is_alone(*quantity, *wrong, now))
    }

    /// Whether a sensor is beyond what we claim and nobody says the same as it.
    fn is_refuted(&self, quantity: WatchQuantity, sensor: usize, now: Time) -> bool {
        self.is_alone(quantity, sensor, now) && self.is_beyond_own(quantity, sensor, now)
    }

    /// Whether no other sensor agrees with this one against us: two that do are evidence that cannot be weighed, as they may be
    /// two ends of one compass.
    fn is_alone(&self, quantity: WatchQuantity, sensor: usize, now: Time) -> bool {
        !self.pairs.iter().any(|pair| {
            let partner = match (pair.one, pair.other) {
                (one, Some(other)) if one == sensor => other,
                (one, Some(other)) if other == sensor => one,
                _ => return false,
            };
            let agrees = |mean: &Found| mean.size() <= self.limits(pair).0;
            pair.quantity == quantity
                && pair.average.mean(now).is_some_and(agrees)
                && self.is_beyond_own(quantity, partner, now)
        })
    }

    fn is_beyond_own(&self, quantity: WatchQuantity, sensor: usize, now: Time) -> bool {
        let own =
            self.pairs.iter().find(|pair| pair.is_of(quantity, sensor) && pair.other.is_none());
        let beyond = |pair: &Pair| {
            let (limit, _) = self.limits(pair);
            let mean = pair.average.mean(now)?;
            Some(mean.size() > limit.max(CERTAIN * mean.own_sigma))
        };
        self.is_sure && own.and_then(beyond).unwrap_or(false)
    }

    /// Limit and patience of a pair: the wider of both.
    fn limits(&self, pair: &Pair) -> (f64, Span) {
        let plans = std::iter::once(pair.one).chain(pair.other);
        let each = plans.filter_map(|index| self.watched.get(index)).map(|own| &own.plan);
        each.fold((0.0, Span::ZERO), |(limit, hold), plan| {
            (limit.max(plan.limits.of(pair.quantity)), hold.max(plan.hold))
        })
    }

    /// All comparisons of which something is known, as they stand.
    pub(crate) fn comparisons(&self, now: Time) -> Vec<WatchComparison> {
        self.pairs.iter().filter_map(|pair| self.comparison(pair, now)).collect()
    }

    fn comparison(&self, pair: &Pair, now: Time) -> Option<WatchComparison> {
        let mean = pair.average.mean(now)?;
        let name = |index: usize| self.watched.get(index).map(|own| own.plan.name.clone());
        let difference = match pair.quantity {
            WatchQuantity::Heading => mean.difference[0],
            _ => mean.size(),
        };
        Some(WatchComparison {
            quantity: pair.quantity,
            sensor: name(pair.one)?,
            against: pair.other.and_then(name),
            time: mean.time,
            difference,
            sigma: mean.sigma,
            limit: self.limits(pair).0,
            differ: pair.told.differ,
            wrong: pair.told.wrong.and_then(name),
        })
    }

    /// What is to be told of each quantity as an alert.
    pub(crate) fn contradicted(&self, now: Time) -> Contradicted {
        let all: Vec<WatchComparison> =
            self.comparisons(now).into_iter().filter(|own| own.differ).collect();
        let about = |quantity| report::alert(all.iter().filter(|own| own.quantity == quantity));
        Contradicted {
            heading: about(WatchQuantity::Heading),
            position: about(WatchQuantity::Position),
            attitude: about(WatchQuantity::Attitude),
        }
    }
}

impl Pair {
    fn is_of(&self, quantity: WatchQuantity, one: usize) -> bool {
        self.quantity == quantity && self.one == one
    }
}

/// Whether our own word is evidence: she is aligned, and does not doubt herself.
fn is_sure(motion: &Motion) -> bool {
    let solution = &motion.solution;
    let doubts = solution.judgement.integrity == Integrity::Contradiction;
    solution.mode.is_navigating() && !doubts
}

/// A position is told as that of the IMU, where it is known how the ship lies.
fn at_imu(value: WatchedValue, plan: &WatchPlan, motion: Option<&Motion>) -> WatchedValue {
    match (value, motion) {
        (WatchedValue::Position(at), Some(motion)) => {
            let there = motion.at_point(&plan.lever).solution.position;
            let here = &motion.solution.position;
            WatchedValue::Position(Geodetic {
                latitude: at.latitude - there.latitude + here.latitude,
                longitude: at.longitude - there.longitude + here.longitude,
                height: at.height,
            })
        }
        _ => value,
    }
}

/// What we say of a quantity ourselves, and the greater 1-sigma of its components.
fn said(quantity: WatchQuantity, motion: &Motion) -> (WatchedValue, f64) {
    let (solution, sigma) = (&motion.solution, &motion.solution.sigma);
    let attitude = &solution.attitude;
    match quantity {
        WatchQuantity::Heading => (WatchedValue::Heading(attitude.heading), sigma.heading),
        WatchQuantity::Position => {
            let sigma = sigma.position.0.x.max(sigma.position.0.y);
            (WatchedValue::Position(solution.position), sigma)
        }
        WatchQuantity::Attitude => {
            let (roll, pitch) = (attitude.roll, attitude.pitch);
            (WatchedValue::Tilt { roll, pitch }, sigma.roll.max(sigma.pitch))
        }
    }
}

/// How fast a quantity changes, rad/s or m/s.
fn moves(quantity: WatchQuantity, motion: &Motion) -> f64 {
    let solution = &motion.solution;
    match quantity {
        WatchQuantity::Heading => solution.rate_of_turn().abs(),
        WatchQuantity::Position => solution.velocity.0.xy().norm(),
        WatchQuantity::Attitude => solution.rate.0.xy().norm(),
    }
}
