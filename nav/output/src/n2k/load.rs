//! What a table of transmissions costs the bus.
//!
//! A frame with a 29-bit identifier and eight bytes has 131 bits with the three of the gap after it (ISO
//! 11898-1): start 1, arbitration and control 38, data 64, checksum 15, its delimiter 1, acknowledge 2,
//! end 7, gap 3. The 118 from the start to the checksum are stuffed: after five equal bits one of the
//! other kind goes in, and counts for the next five. So at worst there are floor(117 / 4) = 29 more, 160
//! in all (R. Davis, A. Burns, R. Bril, J. Lukkien, Controller Area Network (CAN) schedulability analysis:
//! refuted, revisited and revised, Real-Time Systems 35, 2007, eq. 1).

use insd_n2k::node::Transmit;

use super::table::Entry;

/// The speed of an NMEA 2000 bus.
pub const BITS_PER_SECOND: f64 = 250_000.0;

/// Bits of a frame of eight bytes and the gap after it, without stuffing.
const FRAME_BITS: f64 = 131.0;
/// Most bits that are stuffed into it.
const WORST_STUFFING: f64 = 29.0;
/// Bits that are stuffed into it on average, as counted over the frames of the default table while a ship
/// sails (`tests/n2k/load.rs`). Bits that fall like a coin would have 3.9; fields that are not available
/// and reserved bits are rows of ones.
const MEAN_STUFFING: f64 = 9.0;

/// What a table of transmissions costs the bus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BusLoad {
    /// Frames per second.
    pub frames: f64,
}

impl BusLoad {
    /// The load of the groups of a table that are enabled and that a [`super::PgnSchedule`] sends, if epochs
    /// come at least as often as they do.
    #[must_use]
    pub fn of(transmit: &[Transmit]) -> Self {
        let enabled = transmit.iter().filter(|line| line.enabled);
        let frames = enabled.filter_map(|line| {
            let frames = Entry::of(line.pgn)?.frames() as f64;
            (line.interval.as_nanos() > 0).then(|| frames / line.interval.as_seconds())
        });
        BusLoad { frames: frames.sum() }
    }

    /// Bits per second with the stuffing of the default table.
    #[must_use]
    pub fn mean_bits(&self) -> f64 {
        self.frames * (FRAME_BITS + MEAN_STUFFING)
    }

    /// Bits per second with as much stuffing as there can be.
    #[must_use]
    pub fn worst_bits(&self) -> f64 {
        self.frames * (FRAME_BITS + WORST_STUFFING)
    }
}
