//! The sea as the ship feels it: period and height of her motion in the waves, from the velocity that
//! the filter computes anyway.
//!
//! A high-pass takes out what is slower than any wave: the filter's own corrections, the swaying on
//! the moorings, the ship's way. What is left, integrated, is the displacement. For a narrow-banded
//! motion the mean time between upward zero crossings is T = 2 pi sigma_d / sigma_v (Rice, Bell System
//! Technical Journal 24 (1945); in the sea: Faltinsen, Sea Loads on Ships and Offshore Structures, eq.
//! (2.26)), and the significant double amplitude four times sigma_d.

use std::f64::consts::TAU;

use crate::Filter;
use insd_base::{Span, Time};
use nalgebra::Vector3;

/// Watches the motion of one filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeaTracker {
    start: Time,
    next: Time,
    /// States of the two halves of the high-pass.
    halves: [Biquad; 2],
    displacement: Vector3<f64>,
    velocity_variance: Vector3<f64>,
    displacement_variance: Vector3<f64>,
    looks: f64,
}

/// Motion in the waves, north, east, down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaveMotion {
    /// Standard deviation of the displacement, m.
    pub displacement: Vector3<f64>,
    /// Standard deviation of the velocity, m/s.
    pub velocity: Vector3<f64>,
}

/// Spacing of looks, s.
const SPACING: f64 = 0.25;
/// Slower than this is no wave, s.
const SLOWEST: f64 = 32.0;
/// The displacement is forgotten over this time, s: only the high-pass counts.
const FORGETTING: f64 = 60.0;
/// Before this the filter is still finding its tilt, s.
const SETTLING: f64 = 45.0;
/// The motion must have been seen for this long, s.
const SEEN: f64 = 40.0;
/// Time over which it is averaged, s: some ten to fifty waves.
const AVERAGE: f64 = 300.0;
/// Least heave of which a period is told, 1-sigma, m.
const LEAST: f64 = 0.003;

impl SeaTracker {
    /// From now on.
    #[must_use]
    pub fn new(now: Time) -> Self {
        SeaTracker {
            start: now,
            next: now,
            halves: [Biquad::default(); 2],
            displacement: Vector3::zeros(),
            velocity_variance: Vector3::zeros(),
            displacement_variance: Vector3::zeros(),
            looks: 0.0,
        }
    }

    /// Looks at the filter, if it is time to.
    pub fn watch(&mut self, filter: &Filter) {
        let now = filter.time();
        if now < self.next {
            return;
        }
        self.next = now + Span::from_seconds(SPACING);
        let c_ne = insd_base::earth::c_ne(&filter.nominal().geodetic());
        let mut velocity = c_ne * filter.nominal().velocity;
        // the sea level corrects the vertical velocity now and then by more than a calm moves it
        velocity.z = (c_ne * filter.smooth_velocity()).z;
        self.take(now, &velocity);
    }

    fn take(&mut self, now: Time, velocity: &Vector3<f64>) {
        // the two halves of a Butterworth high-pass of fourth order
        let [first, second] = &mut self.halves;
        let wave = second.pass(&first.pass(velocity, 0.541_196_1), 1.306_563);
        self.displacement = (self.displacement + wave * SPACING) * (-SPACING / FORGETTING).exp();
        if (now - self.start).as_seconds() < SETTLING {
            return;
        }
        self.looks += 1.0;
        let share = (SPACING / AVERAGE).max(1.0 / self.looks);
        let square = |v: &Vector3<f64>| v.component_mul(v);
        self.velocity_variance += (square(&wave) - self.velocity_variance) * share;
        self.displacement_variance +=
            (square(&self.displacement) - self.displacement_variance) * share;
    }

    /// The motion, once it has been seen for long enough.
    #[must_use]
    pub fn motion(&self) -> Option<WaveMotion> {
        (self.looks * SPACING >= SEEN).then(|| WaveMotion {
            displacement: self.displacement_variance.map(f64::sqrt),
            velocity: self.velocity_variance.map(f64::sqrt),
        })
    }
}

impl WaveMotion {
    /// Mean zero-crossing period of the heave, s, unless there is too little of it.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        let (heave, speed) = (self.displacement.z, self.velocity.z);
        (heave > LEAST && speed > 0.0).then(|| TAU * heave / speed)
    }

    /// Significant heave, m.
    #[must_use]
    pub fn significant_heave(&self) -> f64 {
        4.0 * self.displacement.z
    }

    /// Significant horizontal motion, m.
    #[must_use]
    pub fn significant_horizontal(&self) -> f64 {
        4.0 * self.displacement.xy().norm()
    }
}

/// A high-pass of second order for three components, transposed direct form II by the bilinear
/// transform (Oppenheim and Schafer, Discrete-Time Signal Processing, section 7.2).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Biquad {
    states: [Vector3<f64>; 2],
    started: bool,
}

impl Biquad {
    fn pass(&mut self, x: &Vector3<f64>, quality: f64) -> Vector3<f64> {
        let k = (std::f64::consts::PI * SPACING / SLOWEST).tan();
        let norm = 1.0 / (1.0 + k / quality + k * k);
        let (b, a1) = (norm, 2.0 * (k * k - 1.0) * norm);
        let a2 = (1.0 - k / quality + k * k) * norm;
        if !self.started {
            // as if the first value had been there forever: a high-pass gives nothing
            self.started = true;
            self.states = [-x * b, x * b];
        }
        let y = x * b + self.states[0];
        self.states[0] = x * (-2.0 * b) - y * a1 + self.states[1];
        self.states[1] = x * b - y * a2;
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(amplitude: f64, period: f64, disturbance: impl Fn(f64) -> f64) -> WaveMotion {
        let mut tracker = SeaTracker::new(Time::START);
        for look in 0..2400 {
            let t = SPACING * f64::from(look);
            let v = amplitude * TAU / period * (TAU / period * t).cos() + disturbance(t);
            tracker.take(Time::from_seconds(t), &Vector3::new(0.0, 0.0, v));
        }
        tracker.motion().unwrap()
    }

    #[test]
    fn a_regular_wave_is_found_with_its_period_and_height() {
        for period in [3.0, 5.0, 9.7, 18.0] {
            let motion = seen(0.5, period, |_| 0.0);
            let found = motion.period().unwrap();
            assert!((found / period - 1.0).abs() < 0.05, "{period} s: {found} s");
            let height = motion.significant_heave() / (4.0 * 0.5 / 2.0_f64.sqrt());
            assert!((height - 1.0).abs() < 0.07, "{period} s: {height}");
        }
    }

    #[test]
    fn swaying_on_the_moorings_and_a_steady_speed_are_no_waves() {
        let sway = |t: f64| 3.0 + 0.7 * TAU / 68.0 * (TAU / 68.0 * t).cos();
        let found = seen(0.1, 8.0, sway).period().unwrap();
        assert!((found / 8.0 - 1.0).abs() < 0.1, "{found}");
    }

    #[test]
    fn a_calm_has_no_period() {
        assert_eq!(seen(0.0, 8.0, |_| 0.0).period(), None);
        assert_eq!(SeaTracker::new(Time::START).motion(), None);
    }
}
