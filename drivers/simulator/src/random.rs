//! Seeded random streams and the two processes that sensor errors are made of.

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

/// What a random stream is for. Every error source draws from a stream of its own, so that
/// switching one off, or adding a fault, leaves all the others as they were.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    Sea,
    Mooring,
    StartPosition,
    GyroTurnOn,
    GyroScale,
    GyroInRun,
    GyroWhite,
    AccelTurnOn,
    AccelScale,
    AccelInRun,
    AccelWhite,
    ImuJitter,
    ImuGaps,
    ImuDuplicates,
    GnssPositionWhite,
    GnssPositionCorrelated,
    GnssVelocityWhite,
    GnssVelocityCorrelated,
    GnssDop,
    GnssOutages,
    GnssJumps,
    GnssDopSpikes,
    GnssSpoofing,
    GnssBadStds,
    GnssArrival,
    LogConstant,
    LogWhite,
    LogDropouts,
    LogArrival,
    Current,
    ReferenceNoise,
    ImuLosses,
    Lies,
    Lying,
    Compass,
    SecondReceiver,
    Vibration,
    Constellation,
    OrbitError,
    Ionosphere,
    Troposphere,
    RawClock,
    RawConstant,
    RawNoise,
    RawMultipath,
    RawArc,
    RawScene,
    CameraScene,
    CameraTracks,
    CameraPixels,
    CameraOdometry,
    CameraMounting,
}

/// The stream of one purpose in the voyage of one seed.
pub(crate) fn stream(seed: u64, purpose: Purpose) -> Pcg64 {
    Pcg64::seed_from_u64(mix(mix(seed) ^ purpose as u64))
}

/// One of many streams of one purpose, told apart by a number.
pub(crate) fn numbered(seed: u64, purpose: Purpose, number: u64) -> Pcg64 {
    Pcg64::seed_from_u64(mix(mix(mix(seed) ^ purpose as u64) ^ number))
}

/// The finaliser of `SplitMix64` (Steele, Lea and Flood, OOPSLA 2014): neighbouring inputs give
/// unrelated outputs.
fn mix(input: u64) -> u64 {
    let mut z = input.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A standard normal number.
pub(crate) fn normal(rng: &mut Pcg64) -> f64 {
    StandardNormal.sample(rng)
}

/// Three independent standard normal numbers.
pub(crate) fn normal3(rng: &mut Pcg64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| normal(rng))
}

/// A number from the uniform distribution on [low, high); `low` if the two are equal.
pub(crate) fn uniform(rng: &mut Pcg64, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.random::<f64>()
}

/// Three independent first-order Gauss-Markov processes of one correlation time, begun in their
/// steady state: E[x(t) x(t+s)] = std^2 exp(-|s|/tau).
///
/// Discretised exactly: x <- e x + std sqrt(1 - e^2) w, e = exp(-dt/tau) (Gelb, Applied Optimal
/// Estimation, section 3.8).
#[derive(Debug)]
pub(crate) struct GaussMarkov {
    value: Vector3<f64>,
    std: Vector3<f64>,
    correlation_time: f64,
    rng: Pcg64,
}

impl GaussMarkov {
    /// Processes with standard deviations `std` and correlation time, s.
    pub(crate) fn new(std: Vector3<f64>, correlation_time: f64, mut rng: Pcg64) -> Self {
        let value = std.component_mul(&normal3(&mut rng));
        GaussMarkov { value, std, correlation_time, rng }
    }

    /// The value after another `dt`, s.
    pub(crate) fn advance(&mut self, dt: f64) -> Vector3<f64> {
        let memory = (-dt / self.correlation_time).exp();
        let fresh = (1.0 - memory * memory).max(0.0).sqrt();
        self.value = self.value * memory + self.std.component_mul(&normal3(&mut self.rng)) * fresh;
        self.value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_gauss_markov_process_has_its_std_and_its_correlation_time() {
        let std = Vector3::new(1.0, 2.0, 0.5);
        let mut process = GaussMarkov::new(std, 20.0, stream(7, Purpose::GyroInRun));
        let values: Vec<_> = (0..400_000).map(|_| process.advance(1.0)).collect();
        for axis in 0..3 {
            let mean_square = |lag: usize| {
                let products = values.windows(lag + 1).map(|w| w[0][axis] * w[lag][axis]);
                products.sum::<f64>() / (values.len() - lag) as f64
            };
            assert_relative_eq!(mean_square(0).sqrt(), std[axis], max_relative = 0.03);
            let correlation = mean_square(20) / mean_square(0);
            assert_relative_eq!(correlation, (-1.0_f64).exp(), epsilon = 0.03);
        }
    }

    #[test]
    fn streams_of_neighbouring_seeds_and_purposes_are_uncorrelated() {
        let draw = |seed, purpose| {
            let mut rng = stream(seed, purpose);
            (0..20_000).map(|_| normal(&mut rng)).collect::<Vec<f64>>()
        };
        let base = draw(1, Purpose::Sea);
        for other in [draw(2, Purpose::Sea), draw(1, Purpose::Mooring)] {
            let correlation: f64 =
                base.iter().zip(&other).map(|(a, b)| a * b).sum::<f64>() / base.len() as f64;
            assert!(correlation.abs() < 0.03, "{correlation}");
        }
    }
}
