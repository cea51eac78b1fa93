//! An epoch that does not fit as the array is configured: what would make it fit.

use super::level::is_possible;
use super::lines::LineBiases;
use super::model::Model;
use super::prior::CompassPrior;
use super::search::{Candidates, Region, candidates};
use super::settings::{CompassArray, CompassShape};
use super::signal::Common;
use super::solve::{Outcome, Start, solve};

/// By how much better an epoch has to fit before something is taken for wrong.
const BETTER: f64 = 2.0;

/// The same where many epochs say so.
const BETTER_BY_TIME: f64 = 1.25;
/// Of an array with two antennas exchanged so many poses are looked at.
const FIRST: usize = 12;

/// What was done to an epoch to make it fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Freed {
    /// Nothing.
    Nothing,
    /// The clock of one receiver.
    Clock(usize),
    /// One antenna was left out.
    Antenna(usize),
}

impl Freed {
    /// The signals that were used.
    pub(super) fn commons(self, commons: &[Common]) -> Vec<Common> {
        let is_out = |antenna: usize| self == Self::Antenna(antenna);
        commons.iter().filter_map(|common| without(common, &is_out)).collect()
    }
}

/// Solves an epoch as it is.
pub(super) fn plain(model: &Model<'_>, start: &Start) -> Option<(Outcome, Freed)> {
    solve(model, start).map(|outcome| (outcome, Freed::Nothing))
}

/// Solves an epoch, and where it does not fit, with the clock of each receiver free in turn, and without each antenna.
///
/// `is_suspicious`: epochs have fitted worse than they should for a while, though none so badly that it alone says so.
pub(super) fn fitted(
    model: &Model<'_>,
    start: &Start,
    is_suspicious: bool,
) -> Option<(Outcome, Freed)> {
    let own = solve(model, start)?;
    if own.times() <= 1.0 && !is_suspicious {
        return Some((own, Freed::Nothing));
    }
    let clocks = clocks(model).into_iter().filter_map(|antenna| {
        let array = with_own_clock(model.array, antenna);
        Some((solve(&Model { array: &array, ..*model }, start)?, Freed::Clock(antenna)))
    });
    let antennas = spare(model).filter_map(|antenna| {
        let freed = Freed::Antenna(antenna);
        let commons = freed.commons(model.commons);
        Some((solve(&Model { commons: &commons, ..*model }, start)?, freed))
    });
    let is_better = |(other, _): &(Outcome, Freed)| {
        let better = if own.times() > 1.0 { BETTER } else { BETTER_BY_TIME };
        other.times() <= 1.0 && other.times() * better < own.times()
    };
    let best = |all: Vec<(Outcome, Freed)>| {
        let best = all.into_iter().min_by(|(a, _), (b, _)| a.times().total_cmp(&b.times()));
        best.filter(is_better)
    };
    // without an antenna all fits that fits with its clock free
    let found = best(clocks.collect()).or_else(|| best(antennas.collect()));
    Some(found.unwrap_or((own, Freed::Nothing)))
}

/// Receivers that share their clock with others; of two alone it is the second.
fn clocks(model: &Model<'_>) -> Vec<usize> {
    let clocks = &model.array.clocks;
    let sharing = |antenna: &usize| {
        let others = clocks.iter().filter(|own| **own == clocks[*antenna]).count() - 1;
        others > 1 || (others == 1 && clocks[..*antenna].contains(&clocks[*antenna]))
    };
    (0..clocks.len()).filter(sharing).collect()
}

/// Antennas without which there are still three.
fn spare(model: &Model<'_>) -> std::ops::Range<usize> {
    let count = model.array.antennas();
    0..if count > 3 { count } else { 0 }
}

/// The array with a receiver on a clock that no other has.
pub(super) fn with_own_clock(array: &CompassArray, antenna: usize) -> CompassArray {
    let mut array = array.clone();
    let unused = array.clocks.iter().max().map_or(0, |most| most.saturating_add(1));
    array.clocks[antenna] = unused;
    array
}

/// A signal without some of the antennas; `None` where fewer than two are left.
pub(super) fn without(common: &Common, is_out: &dyn Fn(usize) -> bool) -> Option<Common> {
    let mut common = common.clone();
    common.heard.retain(|own| !is_out(own.antenna));
    (common.heard.len() >= 2).then_some(common)
}

/// Pairs of antennas that make an epoch fit when they change places: of a square both that stand across a corner, as one exchange is the other one turned about.
pub(super) fn swapped(
    model: &Model<'_>,
    lines: &LineBiases,
    (region, prior): (&Region, &CompassPrior),
    times: f64,
) -> Vec<(usize, usize)> {
    let CompassShape::Body(levers) = model.shape() else { return Vec::new() };
    let pairs = (0..levers.len()).flat_map(|a| (a + 1..levers.len()).map(move |b| (a, b)));
    let fits = |pair: &(usize, usize)| {
        let array = model.array.swapped(*pair);
        let model = Model { array: &array, ..*model };
        let Ok(Candidates { poses, .. }) = candidates(&model, lines, region, FIRST) else {
            return false;
        };
        let mut solved = poses.into_iter().filter_map(|pose| {
            let start = Start { pose, covariance: region.covariance(), lines: lines.clone() };
            solve(&model, &start).filter(|outcome| is_possible(outcome, prior))
        });
        solved.any(|outcome| outcome.times() <= 1.0 && outcome.times() * BETTER < times)
    };
    pairs.filter(fits).collect()
}
