//! What a node sends by itself, and how often.

use insd_base::Span;

/// One parameter group that is sent again and again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transmit {
    /// Its number.
    pub pgn: u32,
    /// Its priority, 0 to 7.
    pub priority: u8,
    /// Time from one message to the next.
    pub interval: Span,
    /// Whether it is sent.
    pub enabled: bool,
}
