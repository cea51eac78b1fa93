//! Symmetric averages over the past and the future of an instant.
//!
//! A low-pass without phase: a sinc under a Kaiser window (Oppenheim and Schafer, Discrete-Time Signal
//! Processing, section 7.5.3), then mended so that it leaves every parabola as it is: what the constant
//! errors of the acceleration make of a displacement goes through whole.

use std::f64::consts::PI;
#[cfg(test)]
use std::f64::consts::TAU;

/// Spacing of the taps, s.
pub(super) const SPACING: f64 = 0.5;
/// Shape of the window: side lobes of some -65 dB.
const KAISER: f64 = 6.5;

/// Taps of a symmetric average, from its middle outwards.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Kernel(pub(super) Vec<f64>);

/// Standard deviation of what a kernel leaves of an error of the acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Response {
    /// For white noise of density 1 (m/s)/sqrt(s): m.
    pub(super) noise: f64,
    /// For a random walk of 1 m/s^2/sqrt(s): m.
    pub(super) walk: f64,
}

impl Response {
    /// Variance for a white noise, (m/s)/sqrt(s), and a random walk, m/s^2/sqrt(s), of these densities.
    pub(super) fn variance(&self, noise: f64, walk: f64) -> f64 {
        (self.noise * noise).powi(2) + (self.walk * walk).powi(2)
    }
}

impl Kernel {
    /// The mean over `half` seconds to either side that stops periods shorter than `stop` and passes
    /// those longer than `pass`, s.
    pub(super) fn low_pass(half: f64, stop: f64, pass: f64) -> Self {
        let cut = PI * (1.0 / stop + 1.0 / pass);
        let count = (half / SPACING).round() as usize;
        let window = |i: usize| {
            let x = i as f64 / count as f64;
            bessel_i0(KAISER * (1.0 - x * x).max(0.0).sqrt())
        };
        let sinc = |i: usize| {
            let x = cut * i as f64 * SPACING;
            if i == 0 { 1.0 } else { x.sin() / x }
        };
        let plain = Kernel((0..=count).map(|i| sinc(i) * window(i)).collect());
        let mend = Kernel((0..=count).map(window).collect());
        let [[a, b], [c, d]] = [&plain, &mend].map(|kernel| [kernel.moment(0), kernel.moment(2)]);
        let determinant = a * d - b * c;
        let (share, mending) = (d / determinant, -b / determinant);
        Kernel(plain.0.iter().zip(&mend.0).map(|(p, m)| share * p + mending * m).collect())
    }

    /// The fourth difference of this average over intervals of `apart` seconds: it leaves nothing of a
    /// parabola.
    pub(super) fn fourth_difference(&self, apart: f64) -> Self {
        let shift = (apart / SPACING).round() as usize;
        let tap = |i: usize| self.0.get(i).copied().unwrap_or(0.0);
        let pair = |i: usize, by: usize| tap(i.abs_diff(by)) + tap(i + by);
        let at = |i: usize| 6.0 * tap(i) - 4.0 * pair(i, shift) + pair(i, 2 * shift);
        Kernel((0..self.0.len() + 2 * shift).map(at).collect())
    }

    /// Sum of the taps times the power of their time, s.
    fn moment(&self, power: i32) -> f64 {
        let term = |(i, tap): (usize, &f64)| tap * (i as f64 * SPACING).powi(power);
        2.0 * self.0.iter().enumerate().map(term).sum::<f64>()
            - if power == 0 { self.0.first().copied().unwrap_or(0.0) } else { 0.0 }
    }

    /// What this average leaves of errors of the acceleration.
    pub(super) fn response(&self) -> Response {
        Self::response_of(self.both_sides())
    }

    /// What the instant less this average leaves of errors of the acceleration.
    pub(super) fn response_of_rest(&self) -> Response {
        let mut taps: Vec<f64> = self.both_sides().map(|tap| -tap).collect();
        if let Some(middle) = taps.get_mut(self.0.len() - 1) {
            *middle += 1.0;
        }
        Self::response_of(taps.into_iter())
    }

    fn both_sides(&self) -> impl Iterator<Item = f64> {
        self.0.iter().skip(1).rev().chain(&self.0).copied()
    }

    /// Sums of the taps twice over are the weights of the acceleration, three times over those of its
    /// increments.
    fn response_of(taps: impl Iterator<Item = f64>) -> Response {
        let (mut first, mut second, mut third) = (0.0, 0.0, 0.0);
        let (mut noise, mut walk) = (0.0, 0.0);
        for tap in taps {
            second += first * SPACING;
            third += second * SPACING;
            first += tap;
            noise += second * second * SPACING;
            walk += third * third * SPACING;
        }
        Response { noise: noise.sqrt(), walk: walk.sqrt() }
    }

    /// How much of an oscillation of this period, s, the average passes.
    #[cfg(test)]
    pub(super) fn gain(&self, period: f64) -> f64 {
        let term = |(i, tap): (usize, &f64)| tap * (TAU / period * i as f64 * SPACING).cos();
        2.0 * self.0.iter().enumerate().map(term).sum::<f64>()
            - self.0.first().copied().unwrap_or(0.0)
    }
}

/// Modified Bessel function of the first kind and order zero, by its power series.
fn bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..40 {
        term *= quarter / f64::from(k * k);
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_average_passes_what_is_slow_and_stops_what_is_fast() {
        let kernel = Kernel::low_pass(120.0, 40.0, 100.0);
        for (period, gain) in [(2.0, 0.0), (20.0, 0.0), (38.0, 0.0), (120.0, 1.0), (1e4, 1.0)] {
            assert!(
                (kernel.gain(period) - gain).abs() < 3e-3,
                "{period} s: {}",
                kernel.gain(period)
            );
        }
    }

    #[test]
    fn a_parabola_passes_whole() {
        let kernel = Kernel::low_pass(75.0, 30.0, 80.0);
        assert!((kernel.moment(0) - 1.0).abs() < 1e-12);
        assert!(kernel.moment(2).abs() < 1e-6);
    }
}
