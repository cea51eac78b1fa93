//! The noise that an IMU really has: a data sheet is written on a granite table, a ship vibrates.
//!
//! What the filter must be told is the part that adds up: white noise of rate or force, which makes a
//! random walk of angle or velocity. Its density is the same at every averaging time. What else is in the
//! samples is not:
//!
//! * steps in which angle and velocity are counted: white noise of their sum, which never grows; its
//!   density falls with the square of the averaging time. What it leaves in an attitude or a velocity is a
//!   fraction of a step, far below what either is known to;
//! * an engine: narrow lines, which the IMU measures as it does any motion, and which fill few octaves;
//! * the motion of the hull, at the long averaging times.
//!
//! So the density is measured at more than one averaging time. Fourth differences of successive samples
//! leave next to nothing of a hull's motion and seventy times the variance of white noise (binomial
//! coefficients 1, 4, 6, 4, 1), and they hold all there is of steps and lines. Octave by octave it is the
//! wavelet variance (Percival, On estimation of the wavelet variance, Biometrika 82 (1995)): an Allan
//! variance with filters so steep that each octave holds its own frequencies only. All that is not white
//! adds to an octave, nothing takes away: the white noise is no more than the quietest one shows, its
//! floor, and what of that is steps is told from the octaves above. Where the floor is what the data sheet
//! states, so is the noise, whatever the samples look like. Where it is higher, the vibration reaches the
//! noise, and a floor is the least that there is: then the samples count, up to [`COVERED`] floors.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Running density of the white noise of three axes, by octaves of frequency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NoiseMonitor {
    /// Random walk that is stated: unit per square root of a second.
    stated: f64,
    samples: Samples,
    /// From the highest frequencies down.
    octaves: Vec<Octave>,
    excess: Vector3<f64>,
}

/// The density that single samples show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Samples {
    last: [Vector3<f64>; 4],
    count: u32,
    density: Vector3<f64>,
}

/// One octave of the frequencies, and what is handed to the next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Octave {
    /// The newest inputs, in a ring: a gap, as there is before a next start, makes them worthless.
    #[serde(skip)]
    inputs: [Vector3<f64>; TAPS],
    #[serde(skip)]
    taken: usize,
    density: Vector3<f64>,
    /// Coefficients in the mean, and how many it holds at most.
    count: f64,
    memory: f64,
}

/// Squared sum of the binomial coefficients of a fourth difference.
const GAIN: f64 = 70.0;
/// Number of coefficients of the filters.
const TAPS: usize = 16;
/// Daubechies' scaling filter with eight vanishing moments: Ten Lectures on Wavelets (1992), table 6.1.
/// A hull's motion three octaves below a band is damped by more than 10^6, lines two octaves above it by
/// more than 10^4.
const SCALING: [f64; TAPS] = [
    0.054_415_842_243_081_61,
    0.312_871_590_914_465_9,
    0.675_630_736_298_012_8,
    0.585_354_683_654_869_1,
    -0.015_829_105_256_023_893,
    -0.284_015_542_962_428_1,
    0.000_472_484_573_997_972_54,
    0.128_747_426_620_186,
    -0.017_369_301_002_022_11,
    -0.044_088_253_931_064_72,
    0.013_981_027_917_015_516,
    0.008_746_094_047_015_655,
    -0.004_870_352_993_010_66,
    -0.000_391_740_372_995_977_1,
    0.000_675_449_405_998_556_8,
    -0.000_117_476_784_002_281_92,
];
/// Variance of a coefficient of each octave in differenced white noise of variance 1; each below the last
/// has a quarter of the one above.
const DIFFERENCED: [f64; 5] = [3.234_1, 1.318_0, 0.372_68, 0.096_145, 0.024_228];
/// Longest time from one coefficient to the next: below that are the waves, s.
const LONGEST: f64 = 1.3;
/// Time over which a density is averaged, s; and over how many coefficients at least.
const MEMORY: f64 = 5.0;
const LEAST_MEMORY: f64 = 64.0;
/// Coefficients before an octave counts.
const READY: f64 = 8.0;
/// Octaves between the quietest and those that tell of the steps: there they are sixteen times as large.
const APART: usize = 2;
/// Density over what is explained up to which the explanation holds: the estimate's own scatter.
const TOLERANCE: f64 = 1.5;
/// How many times the floor's excess may be hidden in the octaves that the motion covers. Of a consumer IMU
/// on a car single samples show up to seven floors; with them the claims are honest, with the floor alone
/// the errors are 1.4 times what is claimed (docs/figures.md, a real drive).
const COVERED: f64 = 8.0;

impl Samples {
    /// Takes the mean over an interval of `duration` s.
    fn take(&mut self, mean: &Vector3<f64>, duration: f64) {
        let [a, b, c, d] = self.last;
        let difference = mean - d * 4.0 + c * 6.0 - b * 4.0 + a;
        self.last = [b, c, d, *mean];
        self.count = self.count.saturating_add(1);
        if self.count <= 4 {
            return;
        }
        let density = difference.component_mul(&difference) * (duration / GAIN);
        let steady = duration / MEMORY;
        let weight = steady.max(1.0 / f64::from(self.count - 4)).min(1.0);
        self.density += (density - self.density) * weight;
    }

    fn interrupt(&mut self) {
        self.last = [Vector3::zeros(); 4];
        self.count = 0;
    }
}

impl Octave {
    /// The octave of which coefficients come every `spacing` s.
    fn new(spacing: f64) -> Self {
        Octave {
            inputs: [Vector3::zeros(); TAPS],
            taken: 0,
            density: Vector3::zeros(),
            count: 0.0,
            memory: (MEMORY / spacing).max(LEAST_MEMORY),
        }
    }

    /// Takes the next input; every second one gives a coefficient of this octave and an input of the next:
    ///
    /// w = sum g_k x_(n-k), v = sum h_k x_(n-k), g_k = (-1)^k h_(L-1-k),
    ///
    /// which is orthonormal: in white noise both have the variance of the input. Percival and Walden,
    /// Wavelet Methods for Time Series Analysis (2000), eqs. (80a), (75a).
    fn take(&mut self, input: &Vector3<f64>) -> Option<(Vector3<f64>, Vector3<f64>)> {
        self.inputs[self.taken % TAPS] = *input;
        self.taken += 1;
        if self.taken < TAPS || self.taken % 2 == 1 {
            return None;
        }
        let (mut detail, mut smooth) = (Vector3::zeros(), Vector3::zeros());
        for (k, pair) in SCALING.chunks_exact(2).enumerate() {
            let newer = self.inputs[(self.taken - 1 - 2 * k) % TAPS];
            let older = self.inputs[(self.taken - 2 - 2 * k) % TAPS];
            smooth += newer * pair[0] + older * pair[1];
            let mirrored = TAPS - 1 - 2 * k;
            detail += newer * SCALING[mirrored] - older * SCALING[mirrored - 1];
        }
        Some((detail, smooth))
    }

    fn average(&mut self, density: &Vector3<f64>) {
        self.count = (self.count + 1.0).min(self.memory);
        self.density += (density - self.density) / self.count;
    }

    fn is_ready(&self) -> bool {
        self.count >= READY
    }

    fn interrupt(&mut self) {
        self.inputs = [Vector3::zeros(); TAPS];
        self.taken = 0;
        // an octave that gaps keep from filling must not speak of what was before them forever
        self.count *= 0.5;
    }
}

impl NoiseMonitor {
    /// For an IMU that states this random walk (unit of the sum per square root of a second) and has a
    /// sample every `interval` s.
    #[must_use]
    pub fn new(stated: f64, interval: f64) -> Self {
        let spacings = std::iter::successors(Some(2.0 * interval), |spacing| Some(2.0 * spacing));
        let octaves = spacings.take_while(|spacing| *spacing <= LONGEST).map(Octave::new).collect();
        NoiseMonitor { stated, samples: Samples::default(), octaves, excess: Vector3::zeros() }
    }

    /// Learns from the mean of a quantity over an interval of `duration` s.
    pub fn learn(&mut self, mean: &Vector3<f64>, duration: f64) {
        self.samples.take(mean, duration);
        let mut input = *mean;
        for octave in &mut self.octaves {
            let Some((detail, smooth)) = octave.take(&input) else { break };
            octave.average(&(detail.component_mul(&detail) * duration));
            input = smooth;
        }
        self.excess = Vector3::from_fn(|axis, _| self.excess_of(axis));
    }

    /// What is kept for the next start of the program: there is a gap before it.
    #[must_use]
    pub fn kept(&self) -> Self {
        let mut kept = self.clone();
        kept.interrupt();
        kept
    }

    /// Forgets the samples before a gap.
    pub fn interrupt(&mut self) {
        self.samples.interrupt();
        self.octaves.iter_mut().for_each(Octave::interrupt);
    }

    /// Density of white noise on each axis beyond what the stated random walk explains: square of the
    /// unit, times seconds.
    #[must_use]
    pub fn excess(&self) -> Vector3<f64> {
        self.excess
    }

    fn excess_of(&self, axis: usize) -> f64 {
        let of_samples = self.samples.density[axis] - TOLERANCE * self.stated * self.stated;
        if of_samples <= 0.0 {
            return 0.0;
        }
        of_samples.min(COVERED * self.floor_excess(axis))
    }

    /// What the quietest octave shows beyond the stated random walk and the steps. Of octaves that are as
    /// quiet the lowest is asked for the steps, as there they are smallest.
    fn floor_excess(&self, axis: usize) -> f64 {
        let ready = self.octaves.iter().enumerate().filter(|(_, octave)| octave.is_ready());
        let densities = ready.map(|(index, octave)| (index, octave.density[axis]));
        let floor = densities.clone().map(|(_, density)| density).fold(f64::INFINITY, f64::min);
        let mut quiet = densities.clone().filter(|(_, density)| *density <= TOLERANCE * floor);
        let Some((lowest, _)) = quiet.next_back() else { return 0.0 };
        let above = densities.take_while(|(index, _)| index + APART <= lowest);
        let steps = above.map(|(index, density)| density / differenced(index)).reduce(f64::min);
        let steps = steps.unwrap_or(0.0) * differenced(lowest);
        (floor - TOLERANCE * (self.stated * self.stated + steps)).max(0.0)
    }
}

/// See [`DIFFERENCED`].
fn differenced(octave: usize) -> f64 {
    let last = DIFFERENCED.len() - 1;
    DIFFERENCED[octave.min(last)] * 0.25_f64.powi(octave.saturating_sub(last) as i32)
}

#[cfg(test)]
mod tests;
