//! What a port needs of those around it.

use std::sync::Arc;

use super::clock::Clock;
use super::judge::BaudJudge;
use super::queue::Queue;

/// What every port is given.
#[derive(Clone)]
pub struct Surroundings {
    /// Tells the time of receipt.
    pub clock: Arc<dyn Clock>,
    /// Takes what arrives, and each change of state.
    pub queue: Queue,
    /// Judges the bytes of a serial line whose baud rate is searched. Without a judge the rate is the
    /// configured one.
    pub judge: Option<BaudJudge>,
}
