//! Smooth changes from one steady value to the next.

use std::f64::consts::FRAC_PI_2;

use super::jet::Jet;

/// Largest slope of the smooth step of unit height and length, at its middle.
pub(crate) const PEAK_SLOPE: f64 = 35.0 / 16.0;

/// A change by `height` that begins at `start` and takes `length`: the polynomial
/// S(x) = 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7 of x = (t - start) / length, constant before and after.
///
/// S is the lowest polynomial step with three vanishing derivatives at both ends, so a ramp is C3
/// and its integral C4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ramp {
    /// Beginning, s.
    pub(crate) start: f64,
    /// Duration, s, positive.
    pub(crate) length: f64,
    /// Change of value.
    pub(crate) height: f64,
}

impl Ramp {
    /// The instant at which the change is complete, s.
    pub(crate) fn end(&self) -> f64 {
        self.start + self.length
    }

    /// The step at time `t`, s.
    pub(crate) fn at(&self, t: f64) -> Jet {
        let x = (t - self.start) / self.length;
        if x <= 0.0 {
            return Jet::default();
        }
        if x >= 1.0 {
            return Jet::constant(self.height);
        }
        let y = 1.0 - x;
        Jet {
            value: x.powi(4) * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x))),
            rate: 140.0 * (x * y).powi(3) / self.length,
            accel: 420.0 * (x * y).powi(2) * (1.0 - 2.0 * x) / (self.length * self.length),
        } * self.height
    }

    /// The integral of the step from its beginning to `t`, s.
    pub(crate) fn integral(&self, t: f64) -> Jet {
        let step = self.at(t);
        let x = ((t - self.start) / self.length).max(0.0);
        let area =
            if x >= 1.0 { x - 0.5 } else { x.powi(5) * (7.0 + x * (-14.0 + x * (10.0 - 2.5 * x))) };
        Jet { value: self.height * self.length * area, rate: step.value, accel: step.rate }
    }

    /// Weights (of what was, of what comes) with which two uncorrelated random motions are blended
    /// over the ramp: their squares sum to one, so the blend keeps the power.
    pub(crate) fn blend(&self, t: f64) -> (Jet, Jet) {
        let unit = Ramp { height: FRAC_PI_2, ..*self };
        let (new, old) = unit.at(t).sin_cos();
        (old, new)
    }
}

/// The shortest ramp by `height` whose slope nowhere exceeds `slope`, s, and at least `shortest`.
pub(crate) fn length_for_slope(height: f64, slope: f64, shortest: f64) -> f64 {
    (height.abs() * PEAK_SLOPE / slope).max(shortest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    const RAMP: Ramp = Ramp { start: 5.0, length: 8.0, height: -3.0 };

    #[test]
    fn a_ramp_and_its_integral_carry_their_own_derivatives() {
        let h = 1e-4;
        for t in [4.0, 5.5, 7.0, 9.0, 12.5, 14.0] {
            for f in [Ramp::at, Ramp::integral] {
                let (before, now, after) = (f(&RAMP, t - h), f(&RAMP, t), f(&RAMP, t + h));
                let slope = (after.value - before.value) / (2.0 * h);
                let curvature = (after.rate - before.rate) / (2.0 * h);
                assert_relative_eq!(now.rate, slope, epsilon = 1e-7);
                assert_relative_eq!(now.accel, curvature, epsilon = 1e-6);
            }
        }
    }

    #[test]
    fn a_ramp_ends_at_its_height_and_its_integral_goes_on_at_that_slope() {
        assert_eq!(RAMP.at(RAMP.end()), Jet::constant(-3.0));
        assert_relative_eq!(RAMP.integral(RAMP.end() + 1.0).value, -3.0 * (4.0 + 1.0));
    }

    #[test]
    fn the_peak_slope_is_in_the_middle() {
        let middle = RAMP.at(RAMP.start + RAMP.length / 2.0);
        assert_relative_eq!(middle.rate, RAMP.height * PEAK_SLOPE / RAMP.length, epsilon = 1e-12);
    }

    #[test]
    fn blending_weights_keep_the_power() {
        for t in [0.0, 6.0, 9.0, 12.0, 20.0] {
            let (old, new) = RAMP.blend(t);
            assert_relative_eq!(old.value.powi(2) + new.value.powi(2), 1.0, epsilon = 1e-12);
        }
    }
}
