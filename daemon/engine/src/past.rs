//! The voyage as it is known afterwards, where enough of it was kept.

use insd_nav::smoothing::{SmoothedVoyage, smoothed};

use super::{Engine, Stage};

impl Engine {
    /// All of the voyage so far, each instant with what was measured after it: rows where she navigated, none where the heading was being sought.
    #[must_use]
    pub fn smoothed(&self) -> SmoothedVoyage {
        let mut now = self.clone();
        now.keep_past();
        now.past.iter().map(smoothed).reduce(SmoothedVoyage::followed_by).unwrap_or_default()
    }

    /// Puts away what has been kept, before all is begun anew.
    pub(super) fn keep_past(&mut self) {
        let Stage::Running(line) = &self.stage else { return };
        let navigator = line.estimator().likeliest();
        self.past.extend(navigator.and_then(|own| own.filter().past()));
    }
}
