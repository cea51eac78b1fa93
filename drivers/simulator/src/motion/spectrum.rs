//! The sea surface: a JONSWAP spectrum cut into wave components of equal energy.

use std::f64::consts::TAU;

use rand_pcg::Pcg64;

use crate::random::{normal, uniform};

/// Lowest and highest frequency that is represented, over the peak frequency.
const BAND: (f64, f64) = (0.5, 4.0);
/// Intervals of the numerical quadrature of the spectrum.
const GRID: usize = 4000;

/// A long-crested wave: elevation = amplitude cos(omega t - k x + phase), x along its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wave {
    /// Angular frequency at a fixed point, rad/s.
    pub(crate) omega: f64,
    /// Amplitude, m.
    pub(crate) amplitude: f64,
    /// Phase, rad.
    pub(crate) phase: f64,
    /// Where it comes from, relative to the mean direction, rad.
    pub(crate) direction: f64,
}

/// Shape of the JONSWAP spectrum, without its constant, at angular frequency `omega` for a peak at
/// `peak`, both rad/s:
///
/// S ~ omega^-5 exp(-5/4 (omega/peak)^-4) gamma^exp(-(omega/peak - 1)^2 / (2 sigma^2)),
/// sigma = 0.07 below and 0.09 above the peak.
///
/// Hasselmann et al., Ergaenzungsheft Deutsche Hydrographische Zeitschrift A8 (1973); with gamma = 1
/// it is that of Pierson and Moskowitz, J. Geophys. Res. 69 (1964).
pub(crate) fn jonswap_shape(omega: f64, peak: f64, gamma: f64) -> f64 {
    let x = omega / peak;
    let sigma = if x <= 1.0 { 0.07 } else { 0.09 };
    let enhancement = (-(x - 1.0).powi(2) / (2.0 * sigma * sigma)).exp();
    x.powi(-5) * (-1.25 * x.powi(-4)).exp() * gamma.powf(enhancement)
}

/// A realisation of the sea by `count` components: the spectrum is cut into bands of equal energy,
/// and each band is represented by one wave of random frequency within it, so that the frequencies
/// are not commensurate and lie close where the energy is. All amplitudes are equal, sqrt(2 m0 / N)
/// with m0 = (Hs/4)^2, and the significant height comes out exactly.
pub(crate) fn sea_surface(
    significant_height: f64,
    peak_period: f64,
    gamma: f64,
    spreading: f64,
    count: usize,
    rng: &mut Pcg64,
) -> Vec<Wave> {
    let peak = TAU / peak_period;
    let energy = cumulative_energy(peak, gamma);
    let variance = (significant_height / 4.0).powi(2);
    let amplitude = (2.0 * variance / count as f64).sqrt();
    let wave = |band: usize| {
        let share = (band as f64 + uniform(rng, 0.0, 1.0)) / count as f64;
        Wave {
            omega: frequency_below(&energy, peak, share),
            amplitude,
            phase: uniform(rng, 0.0, TAU),
            direction: spreading * normal(rng).clamp(-3.0, 3.0),
        }
    };
    (0..count).map(wave).collect()
}

/// Share of the energy below each of the frequencies of the grid, by the trapezoidal rule.
fn cumulative_energy(peak: f64, gamma: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let mut last = 0.0;
    let mut cumulative: Vec<f64> = (0..=GRID)
        .map(|i| {
            let density = jonswap_shape(grid_frequency(peak, i as f64), peak, gamma);
            sum += if i == 0 { 0.0 } else { (density + last) / 2.0 };
            last = density;
            sum
        })
        .collect();
    for value in &mut cumulative {
        *value /= sum;
    }
    cumulative
}

fn grid_frequency(peak: f64, index: f64) -> f64 {
    peak * (BAND.0 + (BAND.1 - BAND.0) * index / GRID as f64)
}

/// The frequency below which `share` of the energy lies, rad/s.
fn frequency_below(energy: &[f64], peak: f64, share: f64) -> f64 {
    let above = energy.partition_point(|e| *e < share).clamp(1, GRID);
    let (low, high) = (energy[above - 1], energy[above]);
    let fraction = if high > low { (share - low) / (high - low) } else { 0.5 };
    grid_frequency(peak, above as f64 - 1.0 + fraction)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, stream};
    use approx::assert_relative_eq;

    fn sea(gamma: f64, count: usize) -> Vec<Wave> {
        sea_surface(3.25, 9.7, gamma, 0.0, count, &mut stream(3, Purpose::Sea))
    }

    #[test]
    fn the_surface_has_the_significant_height() {
        let waves = sea(3.3, 40);
        let elevation = |t: f64| -> f64 {
            waves.iter().map(|w| w.amplitude * (w.omega * t + w.phase).cos()).sum()
        };
        let n = 200_000;
        let variance = (0..n).map(|i| elevation(f64::from(i)).powi(2)).sum::<f64>() / f64::from(n);
        assert_relative_eq!(4.0 * variance.sqrt(), 3.25, max_relative = 0.01);
    }

    #[test]
    fn the_mean_period_is_that_of_the_jonswap_spectrum() {
        // T1 = 2 pi m0 / m1 = 0.834 Tp for gamma 3.3, 0.772 Tp for gamma 1 (Faltinsen, section 2.4)
        for (gamma, ratio) in [(3.3, 0.834), (1.0, 0.772)] {
            let waves = sea(gamma, 2000);
            let mean = waves.iter().map(|w| w.omega).sum::<f64>() / waves.len() as f64;
            assert_relative_eq!(TAU / mean, ratio * 9.7, max_relative = 0.015);
        }
    }

    #[test]
    fn frequencies_are_distinct_and_in_order_of_their_bands() {
        let waves = sea(3.3, 40);
        assert!(waves.windows(2).all(|w| w[0].omega < w[1].omega));
    }
}
