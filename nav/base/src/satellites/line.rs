//! Line biases: what cables and receivers add to a phase, one for each antenna, constellation and signal.

use super::signal::{Constellation, SatelliteId, SignalCode};

/// Which line: a signal of a constellation on its way from one antenna through its receiver, against the first antenna's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LineBias {
    /// The antenna, counted from 0.
    pub antenna: usize,
    /// The constellation: makes of receivers differ by half a cycle from one to another.
    pub constellation: Constellation,
    /// Geostationary satellites of BeiDou have lines of their own.
    pub is_geostationary: bool,
    /// The signal as this receiver tracks it.
    pub signal: SignalCode,
    /// As the receiver does that it is held against.
    pub against: SignalCode,
}

impl LineBias {
    /// Of an antenna whose receiver tracks a satellite by one signal, held against one that tracks it by another or the same.
    #[must_use]
    pub fn new(
        antenna: usize,
        satellite: SatelliteId,
        signal: SignalCode,
        against: SignalCode,
    ) -> Self {
        Self {
            antenna,
            constellation: satellite.constellation,
            is_geostationary: satellite.is_geostationary(),
            signal,
            against,
        }
    }

    /// Nought by definition: what the others are counted from.
    #[must_use]
    pub fn is_origin(&self) -> bool {
        self.antenna == 0 && self.signal == self.against
    }
}
