//! What the compass takes its antennas and receivers for, and what it asks before it believes integers.

use nalgebra::Vector3;

/// How the antennas stand to each other.
#[derive(Clone, Debug, PartialEq)]
pub enum CompassShape {
    /// Fixed to a hull: where each stands, forward, starboard, down from any common point, m. What is found is the attitude of the hull.
    Body(Vec<Vector3<f64>>),
    /// Two antennas on whatever they stand: what is found is the vector from the first to the second. `length`: what it is known to be, m, and its
    /// 1-sigma; without it integers are looked for by codes, as against a base.
    Baseline {
        /// Distance of the two antennas and its 1-sigma, m.
        length: Option<(f64, f64)>,
    },
}

/// Antennas with a receiver each.
#[derive(Clone, Debug, PartialEq)]
pub struct CompassArray {
    /// Where they stand.
    pub shape: CompassShape,
    /// The clock of each receiver: those of the same number run on one oscillator.
    pub clocks: Vec<usize>,
}

impl CompassArray {
    /// Antennas on a hull whose receivers all run on one oscillator.
    #[must_use]
    pub fn on_one_clock(levers: Vec<Vector3<f64>>) -> Self {
        let clocks = vec![0; levers.len()];
        Self { shape: CompassShape::Body(levers), clocks }
    }

    /// The same with a clock for each receiver.
    #[must_use]
    pub fn on_own_clocks(levers: Vec<Vector3<f64>>) -> Self {
        let clocks = (0..levers.len()).collect();
        Self { shape: CompassShape::Body(levers), clocks }
    }

    /// How many antennas there are.
    #[must_use]
    pub fn antennas(&self) -> usize {
        self.clocks.len()
    }

    /// The greatest distance between two antennas, m; `None` where it is not known.
    pub(super) fn span(&self) -> Option<f64> {
        match &self.shape {
            CompassShape::Baseline { length } => length.map(|(length, _)| length),
            CompassShape::Body(levers) => {
                let pairs = levers.iter().flat_map(|a| levers.iter().map(move |b| (a - b).norm()));
                pairs.max_by(f64::total_cmp)
            }
        }
    }

    /// Two antennas at the least, finite, not all in one place, a clock for each.
    pub(super) fn is_usable(&self) -> bool {
        let count = self.clocks.len();
        let shaped = match &self.shape {
            CompassShape::Body(levers) => {
                levers.len() == count && levers.iter().flatten().all(|x| x.is_finite())
            }
            CompassShape::Baseline { length } => {
                let sound = |(length, std): (f64, f64)| length.is_finite() && std > 0.0;
                count == 2 && length.is_none_or(sound)
            }
        };
        shaped && count >= 2 && self.span().is_none_or(|span| span > 0.01)
    }

    /// The same with two antennas in each other's place.
    pub(super) fn swapped(&self, (a, b): (usize, usize)) -> Self {
        let mut other = self.clone();
        if let CompassShape::Body(levers) = &mut other.shape {
            levers.swap(a, b);
        }
        other
    }
}

/// Noise, limits and demands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompassSettings {
    /// 1-sigma of a receiver's phase, m: `sigma^2 (1 + 1/sin^2 E)`, tenfold for each 10 dB below [`Self::weak`].
    pub phase: f64,
    /// C/N0 below which phases are worse than their elevation says, dB Hz.
    pub weak: f64,
    /// Satellites below this elevation are not used, rad.
    pub lowest: f64,
    /// By how much a line bias wanders, m per root of a second.
    pub line_walk: f64,
    /// By how much the array may have turned in a root of a second where nobody tells its turns, rad; 1-sigma.
    pub turning: f64,
    /// The chance of wrong integers that is allowed.
    pub risk: f64,
    /// What the residuals' variance over that assumed may be.
    pub level: f64,
}

impl Default for CompassSettings {
    fn default() -> Self {
        Self {
            phase: 0.002,
            weak: 34.0,
            lowest: 10_f64.to_radians(),
            line_walk: 5e-5,
            turning: 0.02,
            risk: 1e-4,
            level: 4.0,
        }
    }
}
