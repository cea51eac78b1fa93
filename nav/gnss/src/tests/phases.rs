//! What phases are off by that is no motion: noise that nobody told, and the antenna's own turning.

use std::f64::consts::TAU;

use insd_base::satellites::SatelliteRange;
use insd_base::{Body, ImuSample, SatelliteEpoch, SignalObservation, Time};

use super::random::Random;
use super::sky::{berth, context, epoch};
use super::still;
use crate::ranging::{Guess, Ranging};
use crate::turns::Turns;

/// Adds so many cycles to the phase of each signal.
fn add(epoch: &mut SatelliteEpoch, mut cycles: impl FnMut(&SignalObservation) -> f64) {
    for signal in &mut epoch.signals {
        let more = cycles(signal);
        signal.phase = signal.phase.map(|phase| phase + more);
    }
}

/// The 1-sigma of the phase of the highest satellite after a minute of phases that scatter by so much, m.
fn told_std(scatter: f64) -> f64 {
    let context = context();
    let (mut ranging, mut random) = (Ranging::default(), Random(7));
    let told = (0..60).map(|second| {
        let mut epoch = epoch(&context, f64::from(second), &berth(), &still());
        add(&mut epoch, |signal| scatter * random.gauss() / signal.wavelength().unwrap());
        ranging.take(&context, &epoch, Guess::default()).ranges
    });
    let ranges = told.last().unwrap();
    let highest = ranges.iter().max_by(|a, b| a.elevation.total_cmp(&b.elevation)).unwrap();
    highest.phase.unwrap().phase.variance.sqrt()
}

#[test]
fn phases_that_scatter_by_centimetres_are_told_so() {
    let usual = told_std(0.003);
    assert!(usual < 0.005, "{usual}");
    assert!((told_std(0.0) - usual).abs() < 0.2 * usual);
    let noisy = told_std(0.02);
    assert!((0.012..0.05).contains(&noisy), "{noisy}");
}

#[test]
fn an_antenna_that_turns_changes_no_range() {
    let context = context();
    let mut rangings = [Ranging::default(), Ranging::default()];
    let mut turns = Turns::default();
    for second in 0..30 {
        let plain = epoch(&context, f64::from(second), &berth(), &still());
        let mut turning = plain.clone();
        let so_far = 0.05 * f64::from(second);
        add(&mut turning, |_| so_far);
        if second > 0 {
            turns.hear(&ImuSample {
                time: Time::from_seconds(f64::from(second)),
                delta_theta: Body::new(0.01, 0.0, 0.05 * TAU),
                delta_velocity: Body::default(),
            });
        }
        let guess = Guess { turned: turns.so_far(), ..Guess::default() };
        let [still, turned] = [
            rangings[0].take(&context, &plain, Guess::default()),
            rangings[1].take(&context, &turning, guess),
        ];
        for (still, turned) in still.ranges.iter().zip(&turned.ranges) {
            let phase = |range: &SatelliteRange| range.phase.unwrap().phase.value;
            assert!((phase(still) - phase(turned)).abs() < 1e-6);
        }
    }
}
