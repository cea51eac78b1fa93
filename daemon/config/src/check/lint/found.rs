//! What was found so far.

use crate::check::finding::{ConfigFinding, ConfigPlace, Severity};

/// What was found so far.
#[derive(Default)]
pub(super) struct Found(pub(super) Vec<ConfigFinding>);

impl Found {
    /// One more; `advice` may be empty.
    fn tell(
        &mut self,
        severity: Severity,
        cause: &'static str,
        place: ConfigPlace,
        text: &str,
        advice: &str,
    ) {
        let finding = ConfigFinding::new(severity, cause, place, text);
        self.0.push(if advice.is_empty() { finding } else { finding.advise(advice) });
    }

    pub(super) fn error(
        &mut self,
        cause: &'static str,
        place: ConfigPlace,
        text: &str,
        advice: &str,
    ) {
        self.tell(Severity::Error, cause, place, text, advice);
    }

    pub(super) fn warn(
        &mut self,
        cause: &'static str,
        place: ConfigPlace,
        text: &str,
        advice: &str,
    ) {
        self.tell(Severity::Warning, cause, place, text, advice);
    }

    pub(super) fn note(
        &mut self,
        cause: &'static str,
        place: ConfigPlace,
        text: &str,
        advice: &str,
    ) {
        self.tell(Severity::Note, cause, place, text, advice);
    }
}
