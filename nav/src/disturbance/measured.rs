//! The spectrum of the sea as it is measured, to be laid beside that of a model.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, Vector2};

/// Fewest samples of a segment.
const FEWEST: usize = 16;

/// Spectral density of both components together at frequencies, Hz, one-sided, by the mean over segments of so many samples
/// that overlap by half, each without its mean and under a Hann window (Welch, IEEE Trans. Audio and Electroacoustics 15
/// (1967)): of samples at an interval, s, in m/s or m, it is in (m/s)^2/Hz or m^2/Hz. Frequencies that a segment does not
/// resolve are left out; nothing if there are too few samples.
#[must_use]
pub fn measured_spectrum(
    samples: &[Vector2<f64>],
    interval: f64,
    length: usize,
    frequencies: &[f64],
) -> Vec<(f64, f64)> {
    if length < FEWEST || samples.len() < length {
        return Vec::new();
    }
    let taper: Vec<f64> =
        (0..length).map(|k| (PI * (k as f64 + 0.5) / length as f64).sin().powi(2)).collect();
    let segments: Vec<Vec<Vector2<f64>>> =
        samples.windows(length).step_by(length / 2).map(|one| tapered(one, &taper)).collect();
    let power: f64 = taper.iter().map(|weight| weight * weight).sum();
    let scale = 2.0 * interval / (power * segments.len() as f64);
    let lowest = 1.0 / (length as f64 * interval);
    let density = |frequency: f64| {
        let turn = Complex::from_polar(1.0, -TAU * frequency * interval);
        let squares = segments.iter().map(|segment| transformed(segment, turn).norm_squared());
        (frequency, scale * squares.sum::<f64>())
    };
    frequencies.iter().copied().filter(|frequency| *frequency >= lowest).map(density).collect()
}

/// A segment without its mean, under a taper.
fn tapered(segment: &[Vector2<f64>], taper: &[f64]) -> Vec<Vector2<f64>> {
    let mean = segment.iter().sum::<Vector2<f64>>() / segment.len() as f64;
    segment.iter().zip(taper).map(|(sample, weight)| (sample - mean) * *weight).collect()
}

/// Sum of samples of which each is turned further than the one before.
fn transformed(samples: &[Vector2<f64>], turn: Complex<f64>) -> Vector2<Complex<f64>> {
    let start = (Vector2::zeros(), Complex::from(1.0));
    let (sum, _) = samples
        .iter()
        .fold(start, |(sum, phase), sample| (sum + sample.map(|x| phase * x), phase * turn));
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::disturbance::Model;
    use approx::assert_relative_eq;
    use nalgebra::Matrix2;

    #[test]
    fn white_noise_has_its_variance_spread_over_the_band() {
        let mut state = 5_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let samples: Vec<_> = (0..4000).map(|_| Vector2::new(noise(), noise())).collect();
        let frequencies: Vec<f64> = (1..200).map(|k| f64::from(k) * 0.0006).collect();
        let measured = measured_spectrum(&samples, 4.0, samples.len() / 2, &frequencies);
        let mean = measured.iter().map(|(_, density)| density).sum::<f64>() / measured.len() as f64;
        let model = Model::new(Vec::new(), Matrix2::from_diagonal_element(1.0 / 12.0), 4.0);
        let expected = model.spectrum(0.05).expect("a density").trace().re;
        assert_relative_eq!(mean, expected, max_relative = 0.15);
    }

    #[test]
    fn an_oscillation_shows_where_it_is() {
        let sway = |k: u32| Vector2::new((TAU * f64::from(k) * 4.0 / 80.0).cos() + 3.0, 1.0);
        let samples: Vec<_> = (0..225).map(sway).collect();
        let frequencies: Vec<f64> = (1..100).map(|k| f64::from(k) * 0.00125).collect();
        let measured = measured_spectrum(&samples, 4.0, samples.len() / 2, &frequencies);
        let peak = measured.iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("a spectrum");
        assert_relative_eq!(peak.0, 1.0 / 80.0, epsilon = 0.0013);
        assert!(measured_spectrum(&samples[..20], 4.0, 10, &frequencies).is_empty());
    }
}
