//! Words of a navigation message as receivers hand them on.

use insd_base::satellites::{SatelliteId, SignalCode};

/// One subframe, page or string of a satellite's message, in the form of RXM-SFRBX, to which other receivers' forms are brought:
///
/// - GPS and QZSS L1 C/A, BeiDou: ten words of 30 bits in the low bits, parity last, data bits as they were before the
///   encoder turned them round (`d` of IS-GPS-200N, table 20-XIV), BeiDou without interleaving;
/// - Galileo I/NAV: eight words, the even half of a page in the first four and the odd half in the others, each from the top bit on;
/// - Galileo F/NAV: 244 bits from the top bit of the first word on;
/// - GLONASS: the 85 bits of a string from the top bit of the first word on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NavigationWords {
    /// Who sent them.
    pub satellite: SatelliteId,
    /// On which signal.
    pub signal: SignalCode,
    /// GLONASS: its frequency channel, -7 to 6, where the receiver tells it.
    pub channel: Option<i8>,
    /// The words.
    pub words: Vec<u32>,
}
