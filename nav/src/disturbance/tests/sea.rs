//! A sea for the tests, the same on every run.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Vector2};

/// SplitMix64 (Steele, Lea and Flood 2014) with the Box-Muller transform.
pub(super) struct Dice(u64);

impl Dice {
    pub(super) fn new(seed: u64) -> Self {
        Dice(seed.wrapping_mul(0xD134_2543_DE82_EF95).wrapping_add(1))
    }

    /// Even between 0 and 1.
    pub(super) fn even(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Two independent numbers of the standard normal distribution.
    pub(super) fn normal(&mut self) -> Vector2<f64> {
        let radius = (-2.0 * (1.0 - self.even()).ln()).sqrt();
        let (sin, cos) = (TAU * self.even()).sin_cos();
        Vector2::new(radius * cos, radius * sin)
    }
}

/// `count` samples of an autoregressive process, after it has forgotten its start.
pub(super) fn autoregressive(
    coefficients: &[Matrix2<f64>],
    root_of_covariance: &Matrix2<f64>,
    dice: &mut Dice,
    count: usize,
) -> Vec<Vector2<f64>> {
    const FORGOTTEN: usize = 2000;
    let mut samples: Vec<Vector2<f64>> = Vec::new();
    for _ in 0..FORGOTTEN + count {
        let past = coefficients.iter().zip(samples.iter().rev());
        let foretold: Vector2<f64> = past.map(|(a, d)| a * d).sum();
        samples.push(foretold + root_of_covariance * dice.normal());
    }
    samples.split_off(FORGOTTEN)
}

/// Coefficients of an oscillator of this period, in samples, and modulus of its roots.
pub(super) fn oscillator(period: f64, radius: f64) -> [f64; 2] {
    [2.0 * radius * (TAU / period).cos(), -radius * radius]
}

/// Coefficients of the same oscillator in both components.
pub(super) fn oscillators(period: f64, radius: f64) -> [Matrix2<f64>; 2] {
    oscillator(period, radius).map(|a| Matrix2::identity() * a)
}

/// Waves of a period of 8 s, mostly along one direction, 0.3 m/s there and 0.1 m/s across.
pub(super) fn waves(dice: &mut Dice, count: usize) -> Vec<Vector2<f64>> {
    let direction = nalgebra::Rotation2::new(0.6).into_inner();
    let spread = direction * Matrix2::from_diagonal(&Vector2::new(0.3, 0.1));
    let radius: f64 = 0.97;
    let [a, b] = oscillator(8.0, radius);
    // variance of an AR(2) that is driven by unit noise
    let variance = (1.0 - b) / ((1.0 + b) * ((1.0 - b) * (1.0 - b) - a * a));
    let root = spread / variance.sqrt();
    autoregressive(&oscillators(8.0, radius), &root, dice, count)
}

/// A surge of 90 s with this amplitude, m/s, along the quay, in any phase.
pub(super) fn surge(dice: &mut Dice, amplitude: f64, count: usize) -> Vec<Vector2<f64>> {
    let phase = TAU * dice.even();
    let along = Vector2::new(0.5, 0.75_f64.sqrt()) * amplitude;
    (0..count).map(|k| along * (TAU * k as f64 / 90.0 + phase).sin()).collect()
}
