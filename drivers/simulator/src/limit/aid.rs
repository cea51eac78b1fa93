//! What is measured: the berth, from which the ship is displaced, and fixes of the GNSS.

use nalgebra::{DMatrix, DVector};

use super::covariance::{Covariance, Measurement, Shaping};
use super::model::{ATTITUDE, POSITION, VELOCITY, cross};
use super::way::Place;
use super::way::level_turn;
use crate::motion::Swing;
use crate::scenario::{Gnss, GnssNoise};

/// White noise of the berth's position, 1-sigma of one axis, m, when it is used twice a second.
const BERTH_NOISE: (f64, f64) = (0.01, 0.5);
/// Damping of the shaping filters of the motion in the moorings and in the waves, and by how much
/// that in the moorings has a shorter period than its spectrum's mean. The first two stand for the
/// width of the spectra; all three are fitted to the limits of the moored voyages that come with the
/// project's bars.
const MOORING_DAMPING: f64 = 0.4;
const WAVE_DAMPING: f64 = 0.15;
const MOORING_TUNING: f64 = 1.05;

/// The berth: it is where the ship would be but for her displacement by moorings and waves.
#[derive(Clone, Debug)]
pub(super) struct Berth {
    /// Places of the displacements, m: forward (moorings, waves), starboard (moorings, waves).
    displacements: [[usize; 2]; 2],
    variance: f64,
}

impl Berth {
    /// A berth at which the ship swings as given (moorings, waves) and that is used every `step`, s.
    pub(super) fn new(swings: &[[Swing; 2]; 2], step: f64, covariance: &mut Covariance) -> Self {
        let [moorings, waves] = swings;
        let displacements = [0, 1].map(|axis| {
            let (slow, fast) = (moorings[axis], waves[axis]);
            let slow = Shaping::oscillator(slow.std, slow.omega * MOORING_TUNING, MOORING_DAMPING);
            let fast = Shaping::oscillator(fast.std, fast.omega, WAVE_DAMPING);
            [covariance.append(&slow), covariance.append(&fast)]
        });
        let (std, interval) = BERTH_NOISE;
        Berth { displacements, variance: std * std * interval / step }
    }

    /// Inertial position less berth: error of position plus displacement.
    pub(super) fn measurement(&self, place: &Place, size: usize) -> Measurement {
        let mut rows = DMatrix::zeros(2, size);
        let turn = level_turn(place.heading);
        for row in 0..2 {
            rows[(row, POSITION.at(row))] = 1.0;
            for (axis, parts) in self.displacements.iter().enumerate() {
                parts.iter().for_each(|part| rows[(row, *part)] = turn[(row, axis)]);
            }
        }
        Measurement { rows, variances: DVector::from_element(2, self.variance) }
    }
}

/// Fixes of the GNSS.
#[derive(Clone, Debug)]
pub(super) struct Fixes {
    position: Part,
    velocity: Option<Part>,
}

/// Position or velocity: white noise and the places of the correlated one.
#[derive(Clone, Debug)]
struct Part {
    variances: [f64; 2],
    correlated: [usize; 2],
}

impl Part {
    fn new(noise: &GnssNoise, together: f64, covariance: &mut Covariance) -> Self {
        let append = |axis: usize| {
            let std = noise.correlated[axis];
            covariance.append(&Shaping::markov(std, noise.correlation_time_s))
        };
        let correlated = [0, 1].map(append);
        Part { variances: [0, 1].map(|axis| noise.white[axis].powi(2) / together), correlated }
    }
}

impl Fixes {
    /// Fixes with the receiver's own error model, `together` of them as one.
    pub(super) fn new(gnss: &Gnss, together: f64, covariance: &mut Covariance) -> Self {
        let position = Part::new(&gnss.position_noise(), together, covariance);
        let velocity =
            gnss.with_velocity.then(|| Part::new(&gnss.velocity_noise(), together, covariance));
        Fixes { position, velocity }
    }

    /// Inertial position and velocity at the antenna less those of the fix. The lever arm turns with
    /// the error of attitude: C l is off by l x phi, and its velocity likewise.
    pub(super) fn measurement(&self, place: &Place, size: usize) -> Measurement {
        let parts = [
            Some((&self.position, POSITION, place.lever)),
            self.velocity.as_ref().map(|velocity| (velocity, VELOCITY, place.lever_velocity)),
        ];
        let parts: Vec<_> = parts.into_iter().flatten().collect();
        let mut rows = DMatrix::zeros(2 * parts.len(), size);
        let mut variances = DVector::zeros(2 * parts.len());
        for (index, (part, block, lever)) in parts.into_iter().enumerate() {
            let turned = cross(&lever);
            for axis in 0..2 {
                let row = 2 * index + axis;
                rows[(row, block.at(axis))] = 1.0;
                rows[(row, part.correlated[axis])] = 1.0;
                (0..3).for_each(|turn| rows[(row, ATTITUDE.at(turn))] = turned[(axis, turn)]);
                variances[row] = part.variances[axis];
            }
        }
        Measurement { rows, variances }
    }
}
