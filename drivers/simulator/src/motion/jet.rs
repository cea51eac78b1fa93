//! A scalar function of time known at one instant with its first two derivatives.
//!
//! Motion is composed of such jets, so that velocity and acceleration are the exact derivatives of
//! position and no formula is differentiated by hand.

use std::ops::{Add, Mul, Neg, Sub};

/// Value, first and second time derivative of a function at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Jet {
    /// Value.
    pub(crate) value: f64,
    /// First derivative, 1/s.
    pub(crate) rate: f64,
    /// Second derivative, 1/s^2.
    pub(crate) accel: f64,
}

impl Jet {
    /// A function that does not change.
    pub(crate) fn constant(value: f64) -> Self {
        Jet { value, rate: 0.0, accel: 0.0 }
    }

    /// f(self) for an outer function with value `f`, slope `df` and curvature `ddf` at `self.value`
    /// (chain rule).
    fn chain(self, f: f64, df: f64, ddf: f64) -> Self {
        Jet { value: f, rate: df * self.rate, accel: ddf * self.rate * self.rate + df * self.accel }
    }

    /// The quintic that meets `before` at its beginning and `after` at its end, `length` s later, in
    /// value, slope and curvature; at the fraction `x` of the way. Its error is
    /// length^6 f^(6) / 46080 in the value.
    pub(crate) fn between(before: Jet, after: Jet, length: f64, x: f64) -> Self {
        let h = length;
        let (slope, bend) = (before.rate * h, before.accel * h * h);
        let gap = after.value - before.value - slope - bend / 2.0;
        let slope_gap = after.rate * h - slope - bend;
        let bend_gap = after.accel * h * h - bend;
        let c3 = 10.0 * gap - 4.0 * slope_gap + 0.5 * bend_gap;
        let c4 = -15.0 * gap + 7.0 * slope_gap - bend_gap;
        let c5 = 6.0 * gap - 3.0 * slope_gap + 0.5 * bend_gap;
        Jet {
            value: before.value + x * (slope + x * (bend / 2.0 + x * (c3 + x * (c4 + x * c5)))),
            rate: (slope + x * (bend + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)))) / h,
            accel: (bend + x * (6.0 * c3 + x * (12.0 * c4 + x * 20.0 * c5))) / (h * h),
        }
    }

    /// Sine and cosine.
    pub(crate) fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c, -s), self.chain(c, -s, -c))
    }
}

impl Add for Jet {
    type Output = Jet;
    fn add(self, other: Jet) -> Jet {
        Jet {
            value: self.value + other.value,
            rate: self.rate + other.rate,
            accel: self.accel + other.accel,
        }
    }
}

impl Neg for Jet {
    type Output = Jet;
    fn neg(self) -> Jet {
        self * -1.0
    }
}

impl Sub for Jet {
    type Output = Jet;
    fn sub(self, other: Jet) -> Jet {
        self + -other
    }
}

impl Mul<f64> for Jet {
    type Output = Jet;
    fn mul(self, factor: f64) -> Jet {
        Jet { value: self.value * factor, rate: self.rate * factor, accel: self.accel * factor }
    }
}

impl Mul for Jet {
    type Output = Jet;
    fn mul(self, other: Jet) -> Jet {
        Jet {
            value: self.value * other.value,
            rate: self.rate * other.value + self.value * other.rate,
            accel: self.accel * other.value
                + 2.0 * self.rate * other.rate
                + self.value * other.accel,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_sinusoid_of_the_sea_is_interpolated_to_a_hundred_millionth() {
        let omega = 2.0;
        let wave = |t: f64| {
            let (s, c) = (omega * t).sin_cos();
            Jet { value: s, rate: omega * c, accel: -omega * omega * s }
        };
        let (before, after) = (wave(0.3), wave(0.4));
        for x in [0.0, 0.2, 0.5, 0.9, 1.0] {
            let (now, exact) = (Jet::between(before, after, 0.1, x), wave(0.3 + 0.1 * x));
            assert_relative_eq!(now.value, exact.value, epsilon = 1e-8);
            assert_relative_eq!(now.rate, exact.rate, epsilon = 2e-7);
            assert_relative_eq!(now.accel, exact.accel, epsilon = 2e-5);
        }
    }

    /// t^2 - t as a jet.
    fn parabola(t: f64) -> Jet {
        Jet { value: t * t - t, rate: 2.0 * t - 1.0, accel: 2.0 }
    }

    #[test]
    fn products_and_sines_carry_the_derivatives_of_finite_differences() {
        let f = |t: f64| {
            let (s, c) = parabola(t).sin_cos();
            s * parabola(t) - c * 3.0 + Jet::constant(1.0)
        };
        let (t, h) = (0.7, 1e-4);
        let (before, now, after) = (f(t - h), f(t), f(t + h));
        assert_relative_eq!(now.rate, (after.value - before.value) / (2.0 * h), epsilon = 1e-6);
        assert_relative_eq!(now.accel, (after.rate - before.rate) / (2.0 * h), epsilon = 1e-6);
    }
}
