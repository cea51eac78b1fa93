mod claims;
mod model;
mod sea;
mod window;

use approx::assert_relative_eq;
use insd_base::{Span, Time};
use nalgebra::{Matrix2, Vector2};

use self::sea::{Dice, autoregressive};
use super::{ModelOrder, Prefilter, PrefilterConfig, PrefilterRefusal};

/// A prefilter of the last 120 s.
fn prefilter(order: ModelOrder) -> Prefilter {
    let window = Span::from_seconds(120.0);
    Prefilter::new(&PrefilterConfig { order, window, ..PrefilterConfig::default() })
}

/// Of so many seconds, with the order chosen.
fn of_length(seconds: usize) -> Prefilter {
    let window = Span::from_seconds(seconds as f64);
    Prefilter::new(&PrefilterConfig { window, ..PrefilterConfig::default() })
}

fn at(k: usize) -> Time {
    Time::from_seconds(k as f64)
}

/// Pushes a sample a second.
fn push_all(prefilter: &mut Prefilter, samples: impl IntoIterator<Item = Vector2<f64>>) {
    for (k, sample) in samples.into_iter().enumerate() {
        let _ = prefilter.push(at(k), &sample);
    }
}

/// A slow error, m/s, as alignment sees it.
fn slow(k: usize) -> Vector2<f64> {
    let t = k as f64 - 100.0;
    Vector2::new(0.4 + 2e-3 * t - 1e-5 * t * t, -0.2 + 1e-3 * t + 2e-5 * t * t)
}

fn with_slow(disturbance: &[Vector2<f64>]) -> Vec<Vector2<f64>> {
    disturbance.iter().enumerate().map(|(k, d)| d + slow(k)).collect()
}

/// Two damped oscillators that drive each other.
fn coupled() -> [Matrix2<f64>; 2] {
    [Matrix2::new(1.30, 0.10, -0.05, 0.90), Matrix2::new(-0.93, 0.02, 0.03, -0.88)]
}

/// Swings out from a start, without noise.
fn free(coefficients: &[Matrix2<f64>; 2], count: usize) -> Vec<Vector2<f64>> {
    let mut samples = vec![Vector2::new(1.0, 0.0), Vector2::new(0.5, -1.0)];
    while samples.len() < count {
        let k = samples.len();
        samples.push(coefficients[0] * samples[k - 1] + coefficients[1] * samples[k - 2]);
    }
    samples
}

#[test]
fn a_noise_free_model_and_its_drift_are_found_exactly() {
    let mut prefilter = prefilter(ModelOrder::Fixed(2));
    push_all(&mut prefilter, with_slow(&free(&coupled(), 120)));
    let found = prefilter.estimate().unwrap();
    for (a, truth) in found.model.coefficients().iter().zip(coupled()) {
        assert_relative_eq!(*a, truth, epsilon = 1e-8);
    }
    assert_relative_eq!(found.value, slow(119), epsilon = 1e-8);
    assert_relative_eq!(found.acceleration, Vector2::new(1.62e-3, 1.76e-3), epsilon = 1e-9);
    assert_relative_eq!(found.jerk, Vector2::new(-2e-5, 4e-5), epsilon = 1e-11);
    assert_relative_eq!(found.at(-60.0), slow(59), epsilon = 1e-8);
    assert_eq!((found.time, found.rows), (at(119), 118));
}

#[test]
fn the_drift_is_found_under_a_pure_sinusoid() {
    let sinusoid = |k: usize| Vector2::new(0.3, -0.2) * (0.8 * k as f64 + 0.4).sin();
    for order in [ModelOrder::Fixed(2), ModelOrder::Fixed(6), ModelOrder::Chosen { max: 8 }] {
        let mut prefilter = prefilter(order);
        push_all(&mut prefilter, (0..120).map(|k| slow(k) + sinusoid(k)));
        let found = prefilter.estimate().unwrap();
        assert_relative_eq!(found.value, slow(119), epsilon = 1e-6);
    }
}

#[test]
fn the_criterion_finds_an_order_of_four() {
    let lags = [1.2, -1.1, 0.5, -0.5].map(|a| Matrix2::identity() * a);
    let root = Matrix2::identity() * 0.1;
    let orders: Vec<usize> = (0..50)
        .map(|seed| {
            let samples = autoregressive(&lags, &root, &mut Dice::new(seed), 240);
            let mut prefilter = of_length(240);
            push_all(&mut prefilter, with_slow(&samples));
            prefilter.estimate().unwrap().model.order()
        })
        .collect();
    assert!(orders.iter().all(|order| *order >= 4), "{orders:?}");
    assert!(orders.iter().filter(|order| **order == 4).count() >= 40, "{orders:?}");
}

#[test]
fn white_noise_needs_no_lags_and_claims_what_a_parabola_does() {
    let mut dice = Dice::new(3);
    let mut prefilter = prefilter(ModelOrder::Fixed(0));
    push_all(&mut prefilter, (0..120).map(|k| slow(k) + dice.normal() * 0.1));
    let found = prefilter.estimate().unwrap();
    // the end of a parabola through N white samples has nine times the variance of their mean
    let claimed = found.covariance.trace() * 120.0 / found.model.residual_covariance().trace();
    assert_relative_eq!(claimed, 9.0, epsilon = 0.3);
}

#[test]
fn a_shift_is_as_good_as_shifted_samples() {
    let disturbance = sea::waves(&mut Dice::new(7), 150);
    let dv = Vector2::new(0.5, -0.3);
    let da = Vector2::new(2e-3, 1e-3);
    let dj = Vector2::new(-3e-5, 4e-5);
    let corrected = |k: usize| {
        let t = k as f64 - 149.0;
        disturbance[k] + dv + da * t + dj * (0.5 * t * t)
    };
    let (mut shifted, mut fresh) =
        (prefilter(ModelOrder::Chosen { max: 8 }), prefilter(ModelOrder::Chosen { max: 8 }));
    push_all(&mut shifted, disturbance.iter().copied());
    shifted.shift(&[dv, da, dj]);
    push_all(&mut fresh, (0..150).map(corrected));
    let (shifted, fresh) = (shifted.estimate().unwrap(), fresh.estimate().unwrap());
    assert_relative_eq!(shifted.value, fresh.value, epsilon = 1e-10);
    assert_relative_eq!(shifted.acceleration, fresh.acceleration, epsilon = 1e-12);
    assert_relative_eq!(shifted.covariance, fresh.covariance, epsilon = 1e-12);
}

#[test]
fn a_shift_moves_the_estimate_by_itself() {
    let mut prefilter = prefilter(ModelOrder::Chosen { max: 8 });
    push_all(&mut prefilter, sea::waves(&mut Dice::new(8), 120));
    let before = prefilter.estimate().unwrap();
    let (dv, da) = (Vector2::new(1.0, 2.0), Vector2::new(0.01, -0.02));
    prefilter.shift(&[dv, da]);
    let after = prefilter.estimate().unwrap();
    assert_relative_eq!(after.value, before.value + dv, epsilon = 1e-9);
    assert_relative_eq!(after.acceleration, before.acceleration + da, epsilon = 1e-9);
    assert_relative_eq!(after.covariance, before.covariance, epsilon = 1e-9);
}

#[test]
fn a_growing_oscillation_is_refused() {
    let mut prefilter = prefilter(ModelOrder::Fixed(2));
    let growing =
        |k: usize| Vector2::new(1.0, 0.5) * 1.05_f64.powi(k as i32) * (0.8 * k as f64).sin();
    push_all(&mut prefilter, (0..120).map(growing));
    let refusal = prefilter.estimate().unwrap_err();
    assert!(
        matches!(refusal, PrefilterRefusal::Unstable { radius } if radius > 1.04),
        "{refusal:?}"
    );
}

#[test]
fn zero_and_constant_and_parabolic_velocities_are_refused_as_still() {
    let shapes: [fn(usize) -> Vector2<f64>; 3] =
        [|_| Vector2::zeros(), |_| Vector2::new(3.0, -1.0), slow];
    for shape in shapes {
        for order in [ModelOrder::Fixed(0), ModelOrder::Fixed(4), ModelOrder::Chosen { max: 8 }] {
            let mut prefilter = prefilter(order);
            push_all(&mut prefilter, (0..120).map(shape));
            assert_eq!(prefilter.estimate().unwrap_err(), PrefilterRefusal::Still);
        }
    }
}

#[test]
fn a_sea_in_one_component_only_is_no_difficulty() {
    let mut prefilter = prefilter(ModelOrder::Chosen { max: 8 });
    let samples = sea::waves(&mut Dice::new(5), 120);
    push_all(&mut prefilter, samples.iter().map(|d| Vector2::new(d.x, 0.0)));
    let found = prefilter.estimate().unwrap();
    assert!(found.covariance[(0, 0)] > 1e-6 && found.value.y.abs() < 1e-5, "{found:?}");
}

#[test]
fn numbers_beyond_all_bounds_are_refused() {
    let mut prefilter = prefilter(ModelOrder::Chosen { max: 8 });
    let wild = |k: usize| Vector2::repeat(if k.is_multiple_of(3) { f64::MAX } else { f64::MIN });
    push_all(&mut prefilter, (0..120).map(wild));
    assert_eq!(prefilter.estimate().unwrap_err(), PrefilterRefusal::NotFinite);
}

#[test]
fn a_lonely_north_sample_after_stillness_does_no_harm() {
    let mut prefilter = prefilter(ModelOrder::Chosen { max: 8 });
    push_all(&mut prefilter, (0..120).map(|k| Vector2::new(f64::from(u8::from(k == 119)), 0.0)));
    if let Ok(found) = prefilter.estimate() {
        assert!(found.value.norm() < 2.0, "{found:?}");
    }
}
