//! One signal of one satellite as all antennas track it, with all that is known of its way taken out.

use insd_base::{SatelliteId, SignalCode};
use nalgebra::Vector3;

use insd_base::satellites::LineBias;

/// What one antenna has of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heard {
    pub(super) antenna: usize,
    /// Phase less the way to the place that all antennas share, m.
    pub(super) phase: f64,
    pub(super) variance: f64,
    pub(super) line: LineBias,
}

/// A signal that two antennas have at the least.
#[derive(Clone, Debug)]
pub(super) struct Common {
    pub(super) satellite: SatelliteId,
    /// As the first of the antennas tracks it.
    pub(super) signal: SignalCode,
    pub(super) wavelength: f64,
    /// From the antennas to the satellite: north, east, down.
    pub(super) line_of_sight: Vector3<f64>,
    /// In order of the antennas; the first is what the others are held against.
    pub(super) heard: Vec<Heard>,
}
