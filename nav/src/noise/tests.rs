//! What is noise and what is not.

use std::f64::consts::TAU;

use super::*;

/// Sampling interval, s.
const DT: f64 = 0.01;
/// Random walk that is stated: 0.003 deg/sqrt(h), rad/sqrt(s).
const STATED: f64 = 8.7e-7;
/// A step of 0.7 arcsec, rad.
const STEP: f64 = 3.4e-6;

/// White noise of variance 1, uniform: the generator of Knuth's MMIX.
struct Dice(u64);

impl Dice {
    fn throw(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 12.0_f64.sqrt()
    }
}

/// Mean rate over sample `i` of a hull that rolls by degrees and trembles.
fn hull(i: u32) -> f64 {
    let t = DT * f64::from(i);
    0.02 * (TAU * 0.12 * t).sin() + 1e-3 * (TAU * 0.5 * t).sin()
}

/// Mean rate over sample `i` of an engine of two lines.
fn engine(i: u32) -> f64 {
    let t = DT * f64::from(i);
    8e-4 * (TAU * 12.4 * t).sin() + 5e-4 * (TAU * 27.3 * t + 1.0).sin()
}

/// The monitor after `seconds` of a mean rate.
fn after(seconds: f64, mut rate: impl FnMut(u32) -> f64) -> NoiseMonitor {
    let mut monitor = NoiseMonitor::new(STATED, DT);
    for i in 0..(seconds / DT) as u32 {
        monitor.learn(&Vector3::repeat(rate(i)), DT);
    }
    monitor
}

/// Excess density over the stated one.
fn excess(monitor: &NoiseMonitor) -> f64 {
    monitor.excess().x / (STATED * STATED)
}

/// A rate with white noise of `density` stated ones on it.
fn noisy(density: f64, rate: impl Fn(u32) -> f64) -> impl FnMut(u32) -> f64 {
    let mut dice = Dice(1);
    let std = STATED * (density / DT).sqrt();
    move |i| rate(i) + std * dice.throw()
}

/// The same rate as it is counted in steps of the angle; the rest of a step is `kept` or forgotten.
fn counted(step: f64, kept: bool, mut rate: impl FnMut(u32) -> f64) -> impl FnMut(u32) -> f64 {
    let mut rest = 0.0;
    move |i| {
        let due = rate(i) * DT + if kept { rest } else { 0.0 };
        let told = (due / step).round() * step;
        rest = due - told;
        told / DT
    }
}

#[test]
fn the_motion_of_a_hull_and_the_stated_noise_are_no_excess() {
    assert_eq!(excess(&after(60.0, hull)), 0.0);
    assert!(excess(&after(60.0, noisy(1.0, hull))) < 0.1);
}

#[test]
fn neither_steps_nor_the_lines_of_an_engine_are_taken_for_a_random_walk() {
    for step in [STEP / 7.0, STEP, 3.0 * STEP] {
        let mut rate = counted(step, true, noisy(1.0, |i| hull(i) + engine(i)));
        let mut monitor = after(60.0, &mut rate);
        let (mut sum, mut count) = (0.0, 0.0);
        for i in 6000..60_000 {
            monitor.learn(&Vector3::repeat(rate(i)), DT);
            (sum, count) = (sum + excess(&monitor), count + 1.0);
        }
        assert!(sum / count < 0.8, "steps of {step}: {}", sum / count);
        let samples = monitor.samples.density.x / (STATED * STATED);
        assert!(samples > 500.0, "single samples show only {samples}");
    }
}

#[test]
fn white_noise_beyond_the_stated_is_found_under_motion_steps_and_an_engine() {
    for density in [10.0, 1000.0] {
        let plain = excess(&after(120.0, noisy(density, hull)));
        assert!((plain / density - 1.0).abs() < 0.3, "{plain} instead of {density}");
    }
    let shaken = excess(&after(120.0, counted(STEP, true, noisy(100.0, |i| hull(i) + engine(i)))));
    assert!((50.0..900.0).contains(&shaken), "{shaken} instead of 100");
}

#[test]
fn an_imu_that_forgets_what_is_left_of_a_step_has_a_random_walk() {
    let due = STEP * STEP / 12.0 / DT / (STATED * STATED);
    let found = excess(&after(60.0, counted(STEP, false, hull)));
    assert!((found / due - 1.0).abs() < 0.3, "{found} instead of {due}");
}

#[test]
fn noise_that_sets_in_is_known_within_seconds() {
    let mut monitor = after(120.0, noisy(1.0, hull));
    let mut rate = noisy(1000.0, hull);
    for i in 0..500 {
        monitor.learn(&Vector3::repeat(rate(i)), DT);
    }
    assert!(excess(&monitor) > 300.0, "{}", excess(&monitor));
}

#[test]
fn an_octave_that_gaps_keep_from_filling_is_forgotten() {
    let mut monitor = after(60.0, noisy(1.0, hull));
    let mut rate = noisy(100.0, hull);
    for i in 0..3000 {
        if i % 50 == 0 {
            monitor.interrupt();
        }
        monitor.learn(&Vector3::repeat(rate(i)), DT);
    }
    assert!((excess(&monitor) / 100.0 - 1.0).abs() < 0.4, "{}", excess(&monitor));
}

#[test]
fn the_filters_are_orthonormal_and_the_shares_of_the_steps_are_theirs() {
    let product =
        |shift: usize| -> f64 { SCALING.iter().zip(&SCALING[shift..]).map(|(a, b)| a * b).sum() };
    assert!((product(0) - 1.0).abs() < 1e-11);
    assert!((1..8).all(|k| product(2 * k).abs() < 1e-11));
    // differenced white noise of variance 2: its coefficients, octave by octave
    let (mut dice, mut last) = (Dice(3), 0.0);
    let mut octaves: Vec<Octave> = (0..DIFFERENCED.len()).map(|_| Octave::new(1e-6)).collect();
    for _ in 0..400_000 {
        let now = dice.throw();
        let mut input = Vector3::repeat(now - last);
        last = now;
        for octave in &mut octaves {
            let Some((detail, smooth)) = octave.take(&input) else { break };
            octave.average(&detail.component_mul(&detail));
            input = smooth;
        }
    }
    for (index, octave) in octaves.iter().enumerate() {
        let share = octave.density.x / differenced(index);
        assert!((share - 1.0).abs() < 0.05, "octave {index}: {share}");
    }
}
