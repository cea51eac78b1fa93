//! What a base station measures, and where it is.

use super::epoch::SatelliteEpoch;
use crate::frames::Ecef;
use crate::time::Time;

/// What a base measured at one instant: the other half of differences, and never ranges of the ship.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseEpoch {
    /// Its tag on the ship's time line. The base's clock may be off by a millisecond.
    pub time: Time,
    /// Number of the station, where it tells one.
    pub station: Option<u16>,
    /// Reference point of its antenna, in the frame of its network, m; `None` while nobody has told it.
    pub position: Option<Ecef>,
    /// That position is by a survey that somebody on board answers for, and not the base's own word alone.
    pub is_surveyed: bool,
    /// It moves: the position is that of about this epoch, and known no better than a single point may be.
    pub is_moving: bool,
    /// What it measured, with its own tag.
    pub epoch: SatelliteEpoch,
}
