//! How long the bridge may leave a warning alone.

use insd_base::Span;

/// What becomes of a warning that nobody has acknowledged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Escalation {
    /// It is raised again as a warning, and again.
    #[default]
    Repeat,
    /// It becomes an alarm.
    Alarm,
}

/// How the bridge's patience is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlertConfig {
    /// Time after which a warning that nobody has acknowledged is raised again. Default 5 min.
    pub patience: Span,
    /// As what.
    pub escalation: Escalation,
}

impl Default for AlertConfig {
    fn default() -> Self {
        let patience = Span::from_nanos(300_000_000_000);
        AlertConfig { patience, escalation: Escalation::default() }
    }
}
