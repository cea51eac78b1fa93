//! What is wrong with a scenario: every fault with its key and what was expected there.

use std::fmt;

/// One value that cannot be simulated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenarioFault {
    /// The key, from the root of the file: `gnss.outages[1].duration_s`.
    pub key: String,
    /// What was expected, and what was found.
    pub problem: String,
}

impl fmt::Display for ScenarioFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.key, self.problem)
    }
}

/// Why a text is not a scenario.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ScenarioError {
    /// Not TOML, an unknown or missing key, or a value of the wrong type; the parser's own message,
    /// with the line and a caret under the place.
    #[error("{0}")]
    Syntax(String),
    /// Values outside their range, or that contradict each other; all of them.
    #[error("{}", list(.0))]
    Values(Vec<ScenarioFault>),
}

fn list(faults: &[ScenarioFault]) -> String {
    faults.iter().map(ScenarioFault::to_string).collect::<Vec<_>>().join("\n")
}

/// Collects faults while the sections of a scenario check themselves.
#[derive(Debug, Default)]
pub(crate) struct Faults(Vec<ScenarioFault>);

impl Faults {
    /// `Ok` if nothing was found.
    pub(crate) fn into_result(self) -> Result<(), ScenarioError> {
        if self.0.is_empty() { Ok(()) } else { Err(ScenarioError::Values(self.0)) }
    }

    /// Adds a fault.
    pub(crate) fn add(&mut self, key: impl Into<String>, problem: impl Into<String>) {
        self.0.push(ScenarioFault { key: key.into(), problem: problem.into() });
    }

    /// Expects a finite number in [low, high].
    pub(crate) fn range(&mut self, key: impl Into<String>, value: f64, low: f64, high: f64) {
        if !(low..=high).contains(&value) {
            self.add(key, format!("expected a number from {low} to {high}, found {value}"));
        }
    }

    /// Expects a finite number of zero or more.
    pub(crate) fn not_negative(&mut self, key: impl Into<String>, value: f64) {
        if !(value.is_finite() && value >= 0.0) {
            self.add(key, format!("expected zero or a positive number, found {value}"));
        }
    }

    /// Expects a finite number above zero.
    pub(crate) fn positive(&mut self, key: impl Into<String>, value: f64) {
        if !(value.is_finite() && value > 0.0) {
            self.add(key, format!("expected a positive number, found {value}"));
        }
    }

    /// Expects a finite number.
    pub(crate) fn finite(&mut self, key: impl Into<String>, value: f64) {
        if !value.is_finite() {
            self.add(key, format!("expected a finite number, found {value}"));
        }
    }

    /// Expects three finite numbers of zero or more.
    pub(crate) fn std3(&mut self, key: &str, values: [f64; 3]) {
        for (axis, value) in values.into_iter().enumerate() {
            self.not_negative(format!("{key}[{axis}]"), value);
        }
    }

    /// Expects a lever arm: three numbers within 1000 m.
    pub(crate) fn lever_arm(&mut self, key: &str, values: [f64; 3]) {
        for (axis, value) in values.into_iter().enumerate() {
            self.range(format!("{key}[{axis}]"), value, -1000.0, 1000.0);
        }
    }
}
