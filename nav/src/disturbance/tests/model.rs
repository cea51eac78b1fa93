//! The sea that is found on the way.

use std::f64::consts::TAU;

use approx::assert_relative_eq;
use nalgebra::{Matrix2, Vector2};

use super::super::{Model, ModelOrder};
use super::sea::{Dice, autoregressive, oscillator, oscillators, waves};
use super::{coupled, prefilter, push_all};

fn covariance() -> Matrix2<f64> {
    Matrix2::new(0.04, 0.01, 0.01, 0.02)
}

#[test]
fn the_spectrum_integrates_to_the_variance() {
    for interval in [0.5, 1.0, 2.0] {
        let model = Model::new(coupled().to_vec(), covariance(), interval);
        let count = 20_000;
        let step = 0.5 / interval / f64::from(count);
        let middle = |i: i32| (f64::from(i) + 0.5) * step;
        let density = |i| model.spectrum(middle(i)).unwrap().map(|s| s.re) * step;
        let sum: Matrix2<f64> = (0..count).map(density).sum();
        assert_relative_eq!(sum, model.variance().unwrap(), epsilon = 1e-9);
    }
}

#[test]
fn the_variance_is_that_of_the_process() {
    let root = covariance().cholesky().unwrap().l();
    let samples = autoregressive(&coupled(), &root, &mut Dice::new(1), 200_000);
    let sum: Matrix2<f64> = samples.iter().map(|d| d * d.transpose()).sum();
    let model = Model::new(coupled().to_vec(), covariance(), 1.0);
    assert_relative_eq!(sum / 200_000.0, model.variance().unwrap(), max_relative = 0.03);
}

#[test]
fn white_noise_has_a_flat_spectrum_and_no_period() {
    let model = Model::new(Vec::new(), covariance(), 1.0);
    for f in [0.0, 0.1, 0.5] {
        assert_relative_eq!(model.spectrum(f).unwrap().map(|s| s.re), covariance() * 2.0);
    }
    assert_eq!(model.variance(), Some(covariance()));
    assert_eq!(model.dominant_period(), None);
    assert!(model.is_stable());
}

#[test]
fn the_dominant_period_is_the_sharpest_resonance() {
    for (period, radius) in [(8.0, 0.97), (12.0, 0.9999), (90.0, 0.999), (3.0, 0.9)] {
        let model = Model::new(oscillators(period, radius).to_vec(), covariance(), 1.0);
        let found = model.dominant_period().unwrap();
        assert_relative_eq!(found, period, max_relative = 0.02);
    }
    let [fast, slow] = [oscillator(8.0, 0.97), oscillator(90.0, 0.999)];
    let both = [0, 1].map(|i| Matrix2::from_diagonal(&Vector2::new(fast[i], slow[i])));
    let surging = Model::new(both.to_vec(), Matrix2::identity(), 1.0);
    assert_relative_eq!(surging.dominant_period().unwrap(), 90.0, max_relative = 0.01);
}

#[test]
fn a_model_is_stable_inside_the_unit_circle() {
    for (radius, stable) in [(0.9, true), (0.9999, true), (1.0001, false), (1.2, false)] {
        let model = Model::new(oscillators(8.0, radius).to_vec(), covariance(), 1.0);
        assert_eq!(model.is_stable(), stable);
        assert_relative_eq!(model.radius(), radius, epsilon = 1e-6);
        assert_eq!(model.variance().is_some(), stable);
        assert_eq!(model.significant_motion().is_some(), stable);
    }
    let broken = Model::new(vec![Matrix2::repeat(f64::NAN)], covariance(), 1.0);
    assert!(!broken.is_stable() && broken.significant_motion().is_none());
    let lags = oscillators(8.0, 0.9).to_vec();
    for (covariance, interval) in [(Matrix2::repeat(f64::NAN), 1.0), (covariance(), f64::NAN)] {
        let broken = Model::new(lags.clone(), covariance, interval);
        assert_eq!((broken.significant_motion(), broken.dominant_period()), (None, None));
    }
}

#[test]
fn a_narrow_sea_moves_the_ship_by_its_velocity_over_its_frequency() {
    let period = 10.0;
    let lags = oscillators(period, 0.9995).to_vec();
    let model = Model::new(lags, Matrix2::new(0.04, 0.02, 0.02, 0.01), 1.0);
    let motion = model.significant_motion().unwrap();
    // all along (2, 1): one axis
    let along = motion.velocity_std.norm();
    assert_relative_eq!(motion.velocity_std.x, 2.0 * motion.velocity_std.y, max_relative = 1e-6);
    let expected = 4.0 * along * period / TAU;
    assert_relative_eq!(motion.double_amplitude, expected, max_relative = 0.01);
}

#[test]
fn the_residual_is_the_noise_that_drove_the_process() {
    let model = Model::new(coupled().to_vec(), covariance(), 1.0);
    let noise = Vector2::new(0.3, -0.2);
    let past = [Vector2::new(1.0, 2.0), Vector2::new(-1.0, 0.5)];
    let newest = coupled()[0] * past[0] + coupled()[1] * past[1] + noise;
    let found = model.residual(&[newest, past[0], past[1]]).unwrap();
    assert_relative_eq!(found, noise, epsilon = 1e-12);
    assert_eq!(model.residual(&[newest, past[0]]), None);
    assert_eq!(model.residual(&[]), None);
}

#[test]
fn a_fitted_model_whitens_the_waves_that_come_after() {
    let samples = waves(&mut Dice::new(12), 2120);
    let mut prefilter = prefilter(ModelOrder::Chosen { max: 8 });
    push_all(&mut prefilter, samples[..120].iter().copied());
    let model = prefilter.estimate().unwrap().model;
    let past = |k: usize| samples[k - model.order()..=k].iter().rev().copied().collect::<Vec<_>>();
    let residuals: Vec<f64> = (120..2120).map(|k| model.residual(&past(k)).unwrap().x).collect();
    let correlation = |of: &[f64], lag: usize| {
        let product = |lag| of.iter().zip(&of[lag..]).map(|(a, b)| a * b).sum::<f64>();
        product(lag) / product(0)
    };
    let before: Vec<f64> = samples[120..].iter().map(|d| d.x).collect();
    assert!(correlation(&before, 4) < -0.8);
    for lag in 1..10 {
        assert!(correlation(&residuals, lag).abs() < 0.15, "{lag}");
    }
}

#[test]
fn the_period_and_the_motion_of_fitted_waves_are_near_the_truth() {
    let mut prefilter = super::of_length(300);
    push_all(&mut prefilter, waves(&mut Dice::new(9), 300));
    let model = prefilter.estimate().unwrap().model;
    assert_relative_eq!(model.dominant_period().unwrap(), 8.0, epsilon = 0.4);
    let motion = model.significant_motion().unwrap();
    assert_relative_eq!(motion.velocity_std.norm(), 0.316, epsilon = 0.08);
    assert_relative_eq!(motion.double_amplitude, 4.0 * 0.3 * 8.0 / TAU, epsilon = 0.5);
}
