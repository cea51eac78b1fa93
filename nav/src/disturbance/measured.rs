//! The spectrum of the sea as it is measured, to be laid beside that of a model.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, Vector2};

/// A segment is so long a share of the samples; they overlap by half.
const SHARE: f64 = 0.5;
/// Fewest samples of a segment.
const FEWEST: usize = 16;

/// Spectral density of both components together at frequencies, Hz, one-sided, by the mean over tapered segments
/// (Welch, IEEE Trans. Audio and Electroacoustics 15 (1967)): of samples at an interval, s, in m/s or m, it is in
/// (m/s)^2/Hz or m^2/Hz. Frequencies that a segment does not resolve are left out; nothing if there are too few samples.
#[must_use]
pub fn measured_spectrum(
    samples: &[Vector2<f64>],
    interval: f64,
    frequencies: &[f64],
) -> Vec<(f64, f64)> {
    let length = (samples.len() as f64 * SHARE) as usize;
    if length < FEWEST {
        return Vec::new();
    }
    let mean = samples.iter().sum::<Vector2<f64>>() / samples.len() as f64;
    let taper: Vec<f64> =
        (0..length).map(|k| (PI * (k as f64 + 0.5) / length as f64).sin().powi(2)).collect();
    let power: f64 = taper.iter().map(|weight| weight * weight).sum();
    let lowest = 1.0 / (length as f64 * interval);
    let resolved = frequencies.iter().copied().filter(|frequency| *frequency >= lowest);
    resolved
        .map(|frequency| {
            let turn = Complex::from_polar(1.0, -TAU * frequency * interval);
            let starts = (0..=samples.len() - length).step_by((length / 2).max(1));
            let (sum, count) = starts.fold((0.0, 0), |(sum, count), start| {
                let segment = &samples[start..start + length];
                (sum + squared(segment, &mean, &taper, turn), count + 1)
            });
            (frequency, 2.0 * interval * sum / (power * f64::from(count)))
        })
        .collect()
}

/// Square of the tapered sum at a frequency, both components.
fn squared(
    segment: &[Vector2<f64>],
    mean: &Vector2<f64>,
    taper: &[f64],
    turn: Complex<f64>,
) -> f64 {
    let start = (Vector2::<Complex<f64>>::zeros(), Complex::from(1.0));
    let (sum, _) = segment.iter().zip(taper).fold(start, |(sum, phase), (sample, weight)| {
        (sum + (sample - mean).map(|x| phase * (weight * x)), phase * turn)
    });
    sum.x.norm_sqr() + sum.y.norm_sqr()
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
        let measured = measured_spectrum(&samples, 4.0, &frequencies);
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
        let measured = measured_spectrum(&samples, 4.0, &frequencies);
        let peak = measured.iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("a spectrum");
        assert_relative_eq!(peak.0, 1.0 / 80.0, epsilon = 0.0013);
        assert!(measured_spectrum(&samples[..20], 4.0, &frequencies).is_empty());
    }
}
