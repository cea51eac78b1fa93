//! A verdict against the IMU: what the receiver may have been doing instead goes on to be heard beside it ([`appeal`](super::appeal)).

use insd_base::Time;
use nalgebra::UnitQuaternion;

use super::Judge;
use super::aid::Aid;
use super::appeal::{Appeal, DISMISSED};
use super::assessment::{WORST, unsure};
use super::charge::{Charge, Kind};
use super::onset::Onset;
use super::rows::{ALL, Direct};
use crate::error_state::{Errors, Weighed};

impl Judge {
    /// The estimate is mended for a fault of the IMU; what the receiver may have done instead goes on to be heard.
    pub(super) fn hear_both(&mut self, lie: Option<Charge>, mended: &Charge, now: Time) {
        let appeal = lie.and_then(|lie| self.appeal_of(&lie, mended, now));
        self.appeal = appeal.map(Box::new);
    }

    fn appeal_of(&self, lie: &Charge, mended: &Charge, now: Time) -> Option<Appeal> {
        let Kind::Shaped { group, since, sized } = lie.kind else { return None };
        let (_, chance) = self.docket.open_lie()?.left;
        let mut lacks = self.done_by(lie)?;
        lacks -= &self.done_by(mended)?;
        Some(Appeal::new((group, since), sized.value, (&lacks, chance), now))
    }

    /// What a fault has done to the estimate.
    fn done_by(&self, charge: &Charge) -> Option<Errors> {
        let Kind::Shaped { group, since, sized } = charge.kind else { return None };
        let group = &ALL[group];
        let of = |onset: &Onset| {
            onset.effects_of(group).total(&sized.value.as_slice()[..group.rows.len()])
        };
        self.begun(since).map(of)
    }

    /// The judge begins anew: after the verdict both go on to be heard, later the estimate is another.
    pub(super) fn keep_new_appeal(&mut self) {
        self.appeal = self.appeal.take().filter(|appeal| appeal.is_new());
        self.appeal.iter_mut().for_each(|appeal| appeal.begin());
    }

    /// Hears an innovation for both; `direct` is what faults add to it, `attitude` the navigator's.
    pub(super) fn hear_appeal(
        &mut self,
        (aid, now): (Aid, Time),
        weighed: &Weighed,
        attitude: &UnitQuaternion<f64>,
        direct: impl Fn(f64) -> Direct,
    ) {
        let Some(appeal) = self.appeal.as_mut().filter(|own| !own.is_new()) else { return };
        let direct = direct(appeal.age(now));
        let worth = unsure(appeal.heard_for(now), WORST);
        appeal.hear((weighed, aid.is_absorbed()), worth, attitude, &direct);
        let chance = appeal.chance_now();
        let is_dismissed = chance < DISMISSED;
        self.docket.weigh_open_lie((!is_dismissed).then_some(chance));
        if is_dismissed || appeal.is_beyond(attitude) {
            self.appeal = None;
        }
    }
}
