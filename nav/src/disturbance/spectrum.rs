//! What the spectrum of the sea says to a person: its period and how far it moves the ship.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Vector2, Vector3};

use super::model::Model;

/// Shortest and longest period that is looked at, s: from chop to the surge of a moored ship.
const PERIODS: (f64, f64) = (2.0, 200.0);
/// Longest period that counts as waves, s. Below its frequency the error of the fit, divided by the
/// square of the frequency, would be read as a displacement of the ship.
const LONGEST_WAVE: f64 = 30.0;
/// Points of the first look at the spectrum.
const POINTS: usize = 64;
/// Share of the band at its ends in which a maximum is no peak.
const EDGE: f64 = 1e-3;
/// Halvings of a bracket around a peak, by golden section.
const SECTIONS: usize = 40;
/// Relative error of an integral over the spectrum.
const TOLERANCE: f64 = 1e-4;
/// Halvings of an interval of integration.
const DEPTH: usize = 24;

/// How the sea moves the ship.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralMotion {
    /// Standard deviation of the disturbance velocity, north and east, m/s, all frequencies.
    pub velocity_std: Vector2<f64>,
    /// Significant double amplitude of the horizontal displacement along its longest axis, m: four
    /// standard deviations, the mean of the highest third of the crest-to-trough motions if these
    /// are narrow-band (Longuet-Higgins 1952). From the displacement spectrum S / (2 pi f)^2 over
    /// periods from 2 s (or two samples) to 30 s: waves, not the surge of a moored ship.
    pub double_amplitude: f64,
}

impl Model {
    /// Period of the highest peak of the spectrum, north plus east, between 2 s (or two samples)
    /// and 200 s; `None` if the spectrum is highest at an end of that band: there is no peak then.
    #[must_use]
    pub fn dominant_period(&self) -> Option<f64> {
        let (low, high) = self.band(PERIODS.1);
        let ratio = (high / low).powf(1.0 / (POINTS - 1) as f64);
        let grid = (0..POINTS).map(|i| low * ratio.powi(i as i32)).map(|f| (f, f * (ratio - 1.0)));
        let damped = self.roots().iter().map(|root| {
            let width = (1.0 - root.norm()).abs().max(1e-9) / (TAU * self.interval());
            (root.arg() / (TAU * self.interval()), width)
        });
        let candidates = grid.chain(damped.filter(|(f, _)| (low..=high).contains(f)));
        let (near, width) =
            candidates.max_by(|a, b| self.power(a.0).total_cmp(&self.power(b.0)))?;
        let peak = self.refine((near - width).max(low), (near + width).min(high));
        let peak = if self.power(peak) >= self.power(near) { peak } else { near };
        let is_inside =
            !self.power(peak).is_nan() && peak > low * (1.0 + EDGE) && peak < high * (1.0 - EDGE);
        is_inside.then(|| 1.0 / peak)
    }

    /// How the sea moves the ship; `None` if the model is not stable.
    #[must_use]
    pub fn significant_motion(&self) -> Option<SpectralMotion> {
        let velocity_std = self.variance()?.diagonal().map(f64::sqrt);
        let (low, high) = self.band(LONGEST_WAVE);
        let mut ends = vec![low, high];
        let resonances = self.roots().iter().map(|root| root.arg() / (TAU * self.interval()));
        ends.extend(resonances.filter(|f| (low..high).contains(f)));
        ends.sort_by(f64::total_cmp);
        let density = |f: f64| self.displacement(f);
        let parts = ends.windows(2).map(|ends| integral(&density, ends[0], ends[1]));
        let sum: Vector3<f64> = parts.sum();
        if !sum.iter().all(|value| value.is_finite()) {
            return None;
        }
        let covariance = Matrix2::new(sum.x, sum.z, sum.z, sum.y);
        let largest = covariance.symmetric_eigenvalues().max();
        Some(SpectralMotion { velocity_std, double_amplitude: 4.0 * largest.max(0.0).sqrt() })
    }

    /// Lowest and highest frequency that is looked at, Hz.
    fn band(&self, longest: f64) -> (f64, f64) {
        let shortest = PERIODS.0.max(2.0 * self.interval());
        (1.0 / longest.max(2.0 * shortest), 1.0 / shortest)
    }

    /// Density of north plus east, (m/s)^2/Hz.
    fn power(&self, frequency: f64) -> f64 {
        self.spectrum(frequency).map_or(f64::INFINITY, |s| s.trace().re)
    }

    /// Density of the displacement, m^2/Hz: north, east, and in phase between them.
    fn displacement(&self, frequency: f64) -> Vector3<f64> {
        let scale = (TAU * frequency).powi(-2);
        self.spectrum(frequency).map_or(Vector3::zeros(), |s| {
            Vector3::new(s[(0, 0)].re, s[(1, 1)].re, s[(0, 1)].re) * scale
        })
    }

    /// The highest frequency of a bracket with one peak, by golden section.
    fn refine(&self, mut low: f64, mut high: f64) -> f64 {
        const GOLDEN: f64 = 0.618_033_988_749_895;
        for _ in 0..SECTIONS {
            let step = GOLDEN * (high - low);
            if self.power(high - step) > self.power(low + step) {
                high = low + step;
            } else {
                low = high - step;
            }
        }
        0.5 * (low + high)
    }
}

/// Integral by Simpson's rule, halved where it has not settled.
fn integral(f: &dyn Fn(f64) -> Vector3<f64>, from: f64, to: f64) -> Vector3<f64> {
    let middle = 0.5 * (from + to);
    settle(f, [from, middle, to], [f(from), f(middle), f(to)], DEPTH)
}

fn settle(
    f: &dyn Fn(f64) -> Vector3<f64>,
    x: [f64; 3],
    y: [Vector3<f64>; 3],
    depth: usize,
) -> Vector3<f64> {
    let (left, right) = (0.5 * (x[0] + x[1]), 0.5 * (x[1] + x[2]));
    let (f_left, f_right) = (f(left), f(right));
    let sixth = (x[2] - x[0]) / 6.0;
    let whole = (y[0] + y[1] * 4.0 + y[2]) * sixth;
    let halves = (y[0] + f_left * 4.0 + y[1] * 2.0 + f_right * 4.0 + y[2]) * (0.5 * sixth);
    let error = (halves - whole).norm();
    if depth == 0 || !error.is_finite() || error <= TOLERANCE * halves.norm() {
        return halves;
    }
    settle(f, [x[0], left, x[1]], [y[0], f_left, y[1]], depth - 1)
        + settle(f, [x[1], right, x[2]], [y[1], f_right, y[2]], depth - 1)
}
