//! The budget of a range's error: what is not noise.

use insd_base::satellites::time_keeper;
use insd_base::{Constellation, SatelliteId, SignalCode};

/// Satellites below this elevation are not used, rad: 10 degrees.
pub(crate) const LOWEST: f64 = 0.1745;
/// 1-sigma of a receiver's delay on a further band against its first, m.
pub(crate) const BAND_DELAY: f64 = 10.0;
/// By what share the ionosphere as a whole may be other than its model; 1-sigma (IS-GPS-200N, 20.3.3.5.2.5: half of it is left).
pub(crate) const IONOSPHERE_SCALE: f64 = 0.5;
/// By what share it may be so on one ray alone.
pub(crate) const IONOSPHERE_RAY: f64 = 0.2;

/// 1-sigma of what a broadcast orbit and clock add to a range, m: in space they are off by 0.98 (Galileo), 1.4 (GPS), 2.6 (BeiDou) and
/// 2.9 m (GLONASS, whose receivers' delays differ from channel to channel besides) against precise orbits, of which more than half is along the line.
pub(crate) fn orbit_std(constellation: Constellation) -> f64 {
    match constellation {
        Constellation::Galileo => 0.6,
        Constellation::BeiDou => 1.5,
        Constellation::Glonass => 2.5,
        _ => 0.9,
    }
}

/// 1-sigma of a delay between codes of one satellite that nobody tells, m.
pub(crate) fn untold_std(satellite: SatelliteId, signal: SignalCode) -> f64 {
    let by_band: f64 = match (time_keeper(satellite.constellation), signal.band) {
        // the old messages say nothing of L5
        (Constellation::Gps, 5) => 1.5,
        // their clock refers to codes that are not those of civil receivers
        (Constellation::Gps, 2) => 0.5,
        // a receiver has another delay on each channel
        (Constellation::Glonass, 2) => 3.0,
        _ => 0.0,
    };
    // tracked without being known, by what is alike on two bands: with the noise of both
    let codeless = if signal.attribute == b'W' { 1.6 } else { 0.0 };
    by_band.hypot(codeless)
}
