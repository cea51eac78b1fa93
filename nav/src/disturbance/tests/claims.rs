//! Whether the claimed covariance is true: 200 seas each, always the same.

use nalgebra::Vector2;

use super::super::Prefilter;
use super::sea::{Dice, surge, waves};
use super::{of_length, push_all, slow};

/// What 200 seas gave.
#[derive(Debug)]
struct Claims {
    /// Of a component of the slow velocity, m/s.
    rms: f64,
    /// What was claimed for it, m/s.
    claimed: f64,
    /// Root of the mean of e^T P^-1 e over its two components: 1 for a true claim.
    factor: f64,
    /// Of a component of the sample itself, m/s.
    unfiltered: f64,
    refused: usize,
}

/// Waves of 8 s, a surge of 90 s, white noise of 0.02 m/s and a slow error, seen for so many
/// seconds.
fn claims(seconds: usize, surge_amplitude: f64) -> Claims {
    let (mut errors, mut claims, mut normalised, mut raw) = (0.0, 0.0, 0.0, 0.0);
    let mut refused = 0;
    for seed in 0..200 {
        let mut dice = Dice::new(seed);
        let sway: Vec<Vector2<f64>> = waves(&mut dice, seconds)
            .into_iter()
            .zip(surge(&mut dice, surge_amplitude, seconds))
            .map(|(wave, surge)| wave + surge + dice.normal() * 0.02)
            .collect();
        let mut prefilter: Prefilter = of_length(seconds);
        push_all(&mut prefilter, sway.iter().enumerate().map(|(k, v)| v + slow(k)));
        let Ok(found) = prefilter.estimate() else {
            refused += 1;
            continue;
        };
        let error = found.value - slow(seconds - 1);
        errors += error.norm_squared();
        claims += found.covariance.trace();
        normalised += (found.covariance.try_inverse().unwrap() * error).dot(&error);
        raw += sway[seconds - 1].norm_squared();
    }
    let components = 2.0 * f64::from(200 - refused);
    let root = |sum: f64| (sum / components).sqrt();
    Claims {
        rms: root(errors),
        claimed: root(claims),
        factor: root(normalised),
        unfiltered: root(raw),
        refused: refused as usize,
    }
}

#[test]
fn the_claimed_sigma_is_the_real_error_under_waves() {
    for (seconds, rms) in [(120, 0.030), (300, 0.018), (600, 0.013)] {
        let claims = claims(seconds, 0.0);
        assert!(claims.rms < rms, "{claims:?}");
        assert!((0.9..1.15).contains(&claims.factor), "{claims:?}");
        assert!((0.9..1.15).contains(&(claims.rms / claims.claimed)), "{claims:?}");
        assert!(claims.unfiltered > 7.0 * claims.rms && claims.refused == 0, "{claims:?}");
    }
}

#[test]
fn a_surge_nearly_as_long_as_the_window_makes_the_claim_too_small_by_two() {
    for amplitude in [0.05, 0.2] {
        let claims = claims(120, amplitude);
        assert!((1.5..2.5).contains(&claims.factor), "{claims:?}");
        assert!(claims.rms < 1.1 * amplitude && claims.refused < 50, "{claims:?}");
    }
}

#[test]
fn a_window_of_three_surges_makes_the_claim_true_again() {
    for amplitude in [0.05, 0.2] {
        let claims = claims(300, amplitude);
        assert!((0.7..1.15).contains(&claims.factor), "{claims:?}");
        assert!(claims.rms < 0.45 * amplitude && claims.refused == 0, "{claims:?}");
    }
}
