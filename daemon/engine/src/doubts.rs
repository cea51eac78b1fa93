//! What is found to be otherwise than configured, and what follows from it.

use insd_base::{Event, Finding, ModeReason, Time};

use crate::{Engine, Stage};

/// A lever arm of which nothing is known, 1-sigma of each component, m.
const ANYWHERE: f64 = 50.0;

impl Engine {
    /// What an alignment that GNSS refutes was misled by is most likely the lever arm of the antenna: the
    /// next one takes it as unknown. There is no third.
    pub(crate) fn consider_another(&mut self) {
        let Stage::Running(line) = &self.stage else { return };
        if line.estimator().is_refuted() && self.nav.gnss.lever_std < ANYWHERE {
            let time = line.now();
            self.nav.gnss.lever_std = ANYWHERE;
            self.start_over(time, ModeReason::HeadingRefuted);
        }
    }

    pub(crate) fn tell_installation(&mut self, time: Time) {
        let ship = match &self.stage {
            Stage::Running(line) => Some(line.estimator()),
            Stage::Levelling(_) => None,
        };
        for finding in self.surveyor.look(ship, time) {
            self.tell(Event::InstallationFound { time, finding });
        }
    }

    /// What of the installation is found to be otherwise than configured, as it is known now.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        self.surveyor.findings()
    }
}
