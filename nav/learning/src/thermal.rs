//! How the biases of gyros follow the temperature of their IMU.
//!
//! With x = (T - 30 K above the freezing point) / 10, each axis: b = a_0 + a_1 x + a_2 x^2. Labels are what the aided filter takes the
//! biases to be. They are off by the same for minutes: one tells as much as its share of that time. What is taken away from the
//! samples is the difference to the temperature at which it was begun, so that nothing steps when more is known.

use crate::kept::{KeptGyros, in_triangle};
use nalgebra::{Matrix3, RowVector3, Vector3};
use serde::{Deserialize, Serialize};

/// Where x is zero, degrees Celsius, and what a unit of it is, K.
pub const MIDDLE: f64 = 30.0;
const UNIT: f64 = 10.0;
/// 1-sigma of the bias at the middle, of its slope and of its bend, per unit, in units of the turn-on bias of the data sheet.
const PRIOR: [f64; 3] = [10.0, 2.0, 1.0];
/// Errors of labels go on for so long, s.
const SHARED: f64 = 120.0;
/// Labels that are heard before anything is taken away, and the range of temperatures, K.
const FEWEST: u32 = 40;
pub(crate) const RANGE: f64 = 4.0;

/// What is known of three axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thermal {
    axes: [Axis; 3],
    count: u32,
    range: Option<[f64; 2]>,
    last: Option<f64>,
}

/// Coefficients of one axis, rad/s, and their covariance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Axis {
    x: Vector3<f64>,
    p: Matrix3<f64>,
}

impl Thermal {
    /// Nothing is known of gyros with such a turn-on bias, 1-sigma, rad/s.
    #[must_use]
    pub fn unknown(bias_std: f64) -> Self {
        let std = Vector3::from(PRIOR) * bias_std;
        let axis =
            Axis { x: Vector3::zeros(), p: Matrix3::from_diagonal(&std.component_mul(&std)) };
        Thermal { axes: [axis; 3], count: 0, range: None, last: None }
    }

    /// What was kept of an earlier voyage: gyros with such a turn-on bias, 1-sigma, rad/s, start with another each time.
    #[must_use]
    pub fn after(kept: &KeptGyros, bias_std: f64) -> Self {
        let axis = |i: usize| {
            let mut p = Matrix3::from_fn(|r, c| kept.covariance[i][in_triangle(r, c)]);
            p[(0, 0)] += bias_std * bias_std;
            Axis { x: Vector3::from(kept.bias_rad_s[i]), p }
        };
        let axes = std::array::from_fn(axis);
        Thermal { axes, count: kept.looks, range: Some(kept.range_c), last: None }
    }

    /// What is kept of it for the next voyage; `None` where nothing is known.
    #[must_use]
    pub fn kept(&self) -> Option<KeptGyros> {
        let triangle =
            |p: &Matrix3<f64>| [p[(0, 0)], p[(1, 0)], p[(1, 1)], p[(2, 0)], p[(2, 1)], p[(2, 2)]];
        Some(KeptGyros {
            looks: self.count,
            range_c: self.range?,
            bias_rad_s: std::array::from_fn(|i| self.axes[i].x.into()),
            covariance: std::array::from_fn(|i| triangle(&self.axes[i].p)),
        })
    }

    /// Learns from biases at a temperature, degrees Celsius, each with its 1-sigma, rad/s.
    pub fn hear(&mut self, now: f64, celsius: f64, bias: &Vector3<f64>, std: &Vector3<f64>) {
        let apart = self.last.replace(now).map_or(SHARED, |last| now - last);
        let share = (SHARED / apart.clamp(1.0, SHARED)).max(1.0);
        let h = basis(celsius);
        for (i, axis) in self.axes.iter_mut().enumerate() {
            axis.hear(&h, bias[i], std[i] * std[i] * share);
        }
        let range = self.range.get_or_insert([celsius; 2]);
        *range = [range[0].min(celsius), range[1].max(celsius)];
        self.count += 1;
    }

    /// Whether enough is known to be of use.
    #[must_use]
    pub fn is_known(&self) -> bool {
        self.count >= FEWEST && self.range.is_some_and(|[least, most]| most - least > RANGE)
    }

    /// Bias at a temperature, rad/s: beyond the range that was heard it is that of its end.
    #[must_use]
    pub fn bias(&self, celsius: f64) -> Vector3<f64> {
        let [least, most] = self.range.unwrap_or([MIDDLE; 2]);
        let h = basis(celsius.clamp(least, most));
        Vector3::from_fn(|i, _| (h * self.axes[i].x).x)
    }
}

impl Axis {
    fn hear(&mut self, h: &RowVector3<f64>, bias: f64, variance: f64) {
        let s = (h * self.p * h.transpose()).x + variance;
        let k = self.p * h.transpose() / s;
        let left = Matrix3::identity() - k * h;
        self.x += k * (bias - (h * self.x).x);
        self.p = left * self.p * left.transpose() + k * variance * k.transpose();
    }
}

impl KeptGyros {
    /// By how much the bias of each axis is other than at [`MIDDLE`], rad/s.
    #[must_use]
    pub fn against_middle(&self, celsius: f64) -> Vector3<f64> {
        let apart = basis(celsius) - basis(MIDDLE);
        Vector3::from_fn(|i, _| (apart * Vector3::from(self.bias_rad_s[i])).x)
    }
}

fn basis(celsius: f64) -> RowVector3<f64> {
    let x = (celsius - MIDDLE) / UNIT;
    RowVector3::new(1.0, x, x * x)
}

/// What is taken away from samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compensation {
    thermal: Thermal,
    /// What makes it begin where the one before ended, rad/s.
    offset: Vector3<f64>,
}

impl Compensation {
    /// One that begins at a temperature with what was taken away until then, rad/s.
    #[must_use]
    pub fn beginning(thermal: &Thermal, celsius: f64, until_then: &Vector3<f64>) -> Self {
        Compensation { thermal: *thermal, offset: until_then - thermal.bias(celsius) }
    }

    /// What is to be taken away at a temperature, rad/s.
    #[must_use]
    pub fn rate(&self, celsius: f64) -> Vector3<f64> {
        self.thermal.bias(celsius) + self.offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bias that follows the temperature with a bend, rad/s.
    fn bias(celsius: f64) -> Vector3<f64> {
        let off = celsius - 30.0;
        Vector3::new(1e-4 - 1e-5 * off, -4e-5, 5e-5 - 1.2e-6 * off * off)
    }

    fn heard() -> Thermal {
        let mut own = Thermal::unknown(1e-4);
        for i in 0..120 {
            let celsius = 32.0 + 10.0 * (f64::from(i) / 20.0).sin();
            let ripple = Vector3::repeat(1e-5 * (f64::from(i) * 1.7).sin());
            own.hear(
                30.0 * f64::from(i),
                celsius,
                &(bias(celsius) + ripple),
                &Vector3::repeat(2e-5),
            );
        }
        own
    }

    #[test]
    fn biases_that_follow_the_temperature_are_found() {
        let own = heard();
        assert!(own.is_known());
        for celsius in [23.0, 30.0, 41.0] {
            assert!((own.bias(celsius) - bias(celsius)).amax() < 1e-5, "{celsius}");
        }
        assert_eq!(own.bias(60.0), own.bias(42.0_f64.min(60.0).max(own.range.unwrap()[1])));
    }

    #[test]
    fn what_is_kept_goes_on_with_the_shape_and_another_turn_on_bias() {
        let kept = heard().kept().unwrap();
        let mut own = Thermal::after(&kept, 1e-4);
        let step = Vector3::repeat(7e-5);
        for i in 0..20 {
            own.hear(30.0 * f64::from(i), 31.0, &(bias(31.0) + step), &Vector3::repeat(2e-5));
        }
        assert!((own.bias(41.0) - bias(41.0) - step).amax() < 2e-5);
    }

    #[test]
    fn what_is_taken_away_does_not_step_when_more_is_known() {
        let own = heard();
        let first = Compensation::beginning(&own, 25.0, &Vector3::zeros());
        assert!(first.rate(25.0).norm() < 1e-18);
        let second = Compensation::beginning(&Thermal::unknown(1.0), 33.0, &first.rate(33.0));
        assert!((second.rate(33.0) - first.rate(33.0)).norm() < 1e-18);
    }
}
