//! A receiver on board and its base: which epochs belong together, and what comes of them.

use std::sync::Arc;

use insd_base::satellites::{RtkEpoch, RtkPlace, RtkSilence};
use insd_base::{BaseEpoch, GpsTime, SatelliteEpoch, Time};
use nalgebra::Vector3;

use super::difference::PlacedEpoch;
use super::outcome::{RtkFix, RtkRefusal, RtkSolution};
use super::settings::RtkSettings;
use super::tracker::RtkTracker;
use crate::context::Context;

/// Tags of epochs that belong together differ by no more than clocks do, s.
const SAME: f64 = 0.02;
/// An epoch waits for the base's of the same instant until the next one comes, if that is within this, s: what is later is too late for the filter.
const PATIENCE: f64 = 1.2;
/// After a pause as long as this, s, integers have to be believed
const PAUSE: f64 = 10.0;
/// for so many epochs in a row before they are told.
const SURE: usize = 5;
/// A base that has said nothing for so long, s, is silent.
const SILENT: f64 = 30.0;
/// A base whose place is told otherwise by more, m, is another one.
const SAME_PLACE: f64 = 1e-3;

/// Follows one receiver against one base. An epoch is solved with that of the base of the same instant; with the newest there is if that has not come when
/// the next epoch does. Until a base has been heard it does nothing.
#[derive(Clone, Debug)]
pub struct RtkLink {
    tracker: RtkTracker,
    base: Option<Arc<BaseEpoch>>,
    waiting: Option<(SatelliteEpoch, Time)>,
    /// Tag of the newest epoch of the receiver.
    newest: Option<GpsTime>,
    /// When integers were believed last, and for how many epochs in a row.
    fixed: Option<(GpsTime, usize)>,
    is_sure: bool,
}

impl Default for RtkLink {
    fn default() -> Self {
        Self {
            tracker: RtkTracker::continuous(RtkSettings::default()),
            base: None,
            waiting: None,
            newest: None,
            fixed: None,
            is_sure: false,
        }
    }
}

impl RtkLink {
    /// Hears the base; gives the epoch that waited for it, if one did.
    pub fn hear_base(&mut self, context: &Context, told: &Arc<BaseEpoch>) -> Option<RtkEpoch> {
        let before = self.base.replace(Arc::clone(told));
        if before.is_some_and(|before| !told.is_moving && is_other(&before, told)) {
            self.begin_anew();
        }
        let is_awaited = |(epoch, _): &mut (SatelliteEpoch, Time)| belong(epoch, told);
        let (epoch, time) = self.waiting.take_if(is_awaited)?;
        self.solve(context, &epoch, time)
    }

    /// Hears the receiver's next epoch, sampled at an instant of the ship's time line; gives what need not, or must not, wait any longer.
    pub fn hear_rover(
        &mut self,
        context: &Context,
        epoch: &SatelliteEpoch,
        time: Time,
    ) -> Vec<RtkEpoch> {
        let apart = self.newest.replace(epoch.tag).map(|last| epoch.tag.since(last).as_seconds());
        let Some(base) = self.base.clone() else { return Vec::new() };
        let late = self.waiting.take().and_then(|(late, at)| self.solve(context, &late, at));
        let may_wait = apart.is_some_and(|apart| apart < PATIENCE) && !belong(epoch, &base);
        let own = if may_wait {
            self.waiting = Some((epoch.clone(), time));
            None
        } else {
            self.solve(context, epoch, time)
        };
        late.into_iter().chain(own).collect()
    }

    /// How often a fix had to be withdrawn.
    #[must_use]
    pub fn withdrawals(&self) -> usize {
        self.tracker.withdrawals()
    }

    /// Another base: what was carried on is not its.
    fn begin_anew(&mut self) {
        let waiting = self.waiting.take();
        let (base, newest) = (self.base.take(), self.newest);
        *self = Self { base, waiting, newest, ..Self::default() };
    }

    fn solve(&mut self, context: &Context, epoch: &SatelliteEpoch, time: Time) -> Option<RtkEpoch> {
        let base = self.base.clone()?;
        let silent = |why| Some(RtkEpoch { time, place: Err(why), is_withdrawal: false });
        let Some(position) = base.position.map(|place| place.0) else {
            return silent(RtkSilence::BaseUnplaced);
        };
        if base.is_moving {
            return silent(RtkSilence::BaseMoves);
        }
        let age = epoch.tag.since(base.epoch.tag).as_seconds();
        if age.abs() > SILENT {
            return silent(RtkSilence::BaseSilent);
        }
        let placed = PlacedEpoch { epoch: &base.epoch, position };
        let told = self.tracker.take(context, epoch, &placed, None);
        let is_withdrawal = told.as_ref().is_ok_and(|told| told.withdrawn.is_some());
        if is_withdrawal {
            (self.fixed, self.is_sure) = (None, false);
        }
        let place = told.map_err(silence).and_then(|told| self.place(&told, &base, &position));
        Some(RtkEpoch { time, place, is_withdrawal })
    }

    fn place(
        &mut self,
        told: &RtkSolution,
        base: &BaseEpoch,
        at: &Vector3<f64>,
    ) -> Result<RtkPlace, RtkSilence> {
        let fix = told.fixed.as_ref().map_err(|why| silence(*why));
        let fix = match fix {
            Ok(fix) => fix,
            Err(why) => {
                self.fixed = self.fixed.map(|(last, _)| (last, 0));
                return Err(why);
            }
        };
        if !self.is_settled(told.tag) {
            return Err(RtkSilence::Settling);
        }
        let RtkFix { position, covariance, doubt, level, .. } = *fix;
        Ok(RtkPlace {
            antenna: position,
            covariance: covariance * level.max(1.0),
            baseline: (position - at).norm(),
            is_surveyed: base.is_surveyed,
            age: told.age,
            doubt,
        })
    }

    /// Whether integers have been believed for long enough, now that they are.
    fn is_settled(&mut self, tag: GpsTime) -> bool {
        let before = self.fixed.filter(|(last, _)| tag.since(*last).as_seconds() < PAUSE);
        let row = before.map_or(1, |(_, row)| row + 1);
        self.is_sure &= before.is_some();
        self.is_sure |= row >= SURE;
        self.fixed = Some((tag, row));
        self.is_sure
    }
}

fn belong(epoch: &SatelliteEpoch, base: &BaseEpoch) -> bool {
    epoch.tag.since(base.epoch.tag).as_seconds().abs() < SAME
}

fn is_other(before: &BaseEpoch, now: &BaseEpoch) -> bool {
    let moved = before.position.zip(now.position).map(|(a, b)| (a.0 - b.0).norm());
    before.station != now.station || moved.is_some_and(|moved| moved > SAME_PLACE)
}

fn silence(why: RtkRefusal) -> RtkSilence {
    match why {
        RtkRefusal::Age { .. } => RtkSilence::BaseSilent,
        RtkRefusal::BasePlace { .. } => RtkSilence::BaseElsewhere,
        RtkRefusal::Rover(_)
        | RtkRefusal::TooFew { .. }
        | RtkRefusal::Geometry
        | RtkRefusal::TooFewPhases { .. } => RtkSilence::TooFew,
        RtkRefusal::Search(_) | RtkRefusal::Ratio { .. } | RtkRefusal::Prior { .. } => {
            RtkSilence::Unclear
        }
        RtkRefusal::Residuals { .. } => RtkSilence::Residuals,
    }
}
