//! What is found to be otherwise than configured, and what follows from it.

use insd_base::{Event, Finding, ModeReason, Time};
use insd_nav::config::LeverFound;

use crate::{Engine, Stage};

impl Engine {
    /// What an alignment that GNSS refutes was misled by is most likely the lever arm of the antenna: the
    /// next one takes it as it was found, or as unknown. After that there is no other.
    pub(crate) fn consider_another(&mut self) {
        let Stage::Running(line) = &self.stage else { return };
        let Some(found) = line.estimator().refuted_by() else { return };
        let known = self.nav.gnss.lever_found;
        if known.is_none() || (known != Some(LeverFound::UNKNOWN) && found == LeverFound::UNKNOWN) {
            let time = line.now();
            self.nav.gnss.lever_found = Some(found);
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
