//! Whoever looks at the ship of the demo besides the terminal.

use insd_base::{Time, UtcTime};
use insd_engine::{Engine, Output};
use insd_vessel::Outputs;

/// All that there is to see of the ship now.
#[derive(Clone, Copy, Debug)]
pub struct DemoSight<'a> {
    /// Voyage time.
    pub now: Time,
    /// The same in UTC.
    pub utc: Option<UtcTime>,
    /// Who navigates her.
    pub engine: &'a Engine,
    /// What leaves her, with berth and alerts.
    pub outputs: &'a Outputs,
}

/// Is told what the engine tells, and shown the ship whenever she has gone on.
pub trait Onlooker: Send {
    /// The engine told something.
    fn hear(&mut self, output: &Output);
    /// She has gone on.
    fn see(&mut self, sight: &DemoSight<'_>);
}
