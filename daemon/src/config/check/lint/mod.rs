//! What is allowed, and yet wrong on nearly every ship: what installers get wrong.

mod imu;
mod outputs;
mod ports;
mod sensors;
mod ship;
mod sockets;

use super::finding::{Finding, Place, Severity};
use crate::config::Config;

/// Everything that is found in a configuration.
pub(super) fn all(config: &Config) -> Vec<Finding> {
    let mut found = Found::default();
    ship::look(config, &mut found);
    imu::look(config, &mut found);
    ports::look(config, &mut found);
    sockets::look(config, &mut found);
    sensors::look(config, &mut found);
    outputs::look(config, &mut found);
    found.0
}

/// What was found so far.
#[derive(Default)]
struct Found(Vec<Finding>);

impl Found {
    /// One more; `advice` may be empty.
    fn tell(
        &mut self,
        severity: Severity,
        cause: &'static str,
        place: Place,
        text: &str,
        advice: &str,
    ) {
        let finding = Finding::new(severity, cause, place, text);
        self.0.push(if advice.is_empty() { finding } else { finding.advise(advice) });
    }

    fn error(&mut self, cause: &'static str, place: Place, text: &str, advice: &str) {
        self.tell(Severity::Error, cause, place, text, advice);
    }

    fn warn(&mut self, cause: &'static str, place: Place, text: &str, advice: &str) {
        self.tell(Severity::Warning, cause, place, text, advice);
    }

    fn note(&mut self, cause: &'static str, place: Place, text: &str, advice: &str) {
        self.tell(Severity::Note, cause, place, text, advice);
    }
}
