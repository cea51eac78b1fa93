//! States that join and leave: a ship does not pay for those of sensors that she has not.

use super::Filter;
use crate::declaration::Carried;
use crate::error_state::carried;

impl Filter {
    /// The states of a sensor that speaks for the first time are carried from now on, and by the judge, too.
    pub(super) fn begin_to_carry(&mut self, when: Carried) {
        let is_missing = |filter: &Filter| {
            let layout = filter.state.covariance.layout();
            carried(when).any(|declared| layout.start(declared.key).is_none())
        };
        if !is_missing(self) {
            return;
        }
        let config = self.config;
        carried(when).for_each(|declared| declared.join(&mut self.state.covariance, &config));
        if let Some(judge) = self.judge_now() {
            carried(when).for_each(|declared| judge.join(declared, &config));
        }
    }

    /// The states of what is no more are not carried any longer.
    pub(super) fn end_to_carry(&mut self, when: Carried) {
        for declared in carried(when) {
            self.state.covariance.leave(declared.key);
            declared.value(&mut self.state.nominal).fill(0.0);
        }
    }
}
