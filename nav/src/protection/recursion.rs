//! The levels of the fifth source (docs/systems.md, S5), the reference method: a receiver with fixed ambiguities begins anew at each
//! fix; while the position is carried on by the velocity of GNSS, or by log and IMU, each step adds to the level before,
//!
//! `HPL_RTK = b + a s_RTK`,   `HPL_GV(t) = b + HPL(t-1) + a s_GV`,   `HPL_DR(t) = b + HPL(t-1) + a s_DR`   (11)
//!
//! a the root of C of the ellipse that holds all but the risk, P = 1 - exp(-C/2), s the sigma along its major axis, b a bias that is
//! allowed for at each step. It knows of no fault: an error that no sigma tells, as of a receiver that is led astray, is not in it. Errors of steps add up as if they
//! were all alike, which is more than errors do that are not.

/// Where a step of the position comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A fix with integers; sigma of the position along the major axis, m.
    Fixed(f64),
    /// Carried on by a velocity, of GNSS or of log and IMU; sigma of the way along the major axis, m.
    Carried(f64),
}

/// The recursion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recursion {
    sigmas: f64,
    bias: f64,
    level: Option<f64>,
}

impl Recursion {
    /// For a risk at each instant and a bias, m, that is allowed for.
    #[must_use]
    pub fn new(risk: f64, bias: f64) -> Self {
        Recursion { sigmas: (-2.0 * risk.ln()).sqrt(), bias, level: None }
    }

    /// The level after a step, m; `None` before the first fix.
    pub fn step(&mut self, step: Step) -> Option<f64> {
        self.level = match step {
            Step::Fixed(std) => Some(self.bias + self.sigmas * std),
            Step::Carried(std) => self.level.map(|before| self.bias + before + self.sigmas * std),
        };
        self.level
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sigmas_are_those_of_the_source() {
        for (risk, c) in [(0.01, 9.21_f64), (0.001, 13.8)] {
            assert!((Recursion::new(risk, 0.0).sigmas.powi(2) - c).abs() < 0.05);
        }
    }

    #[test]
    fn the_level_grows_with_each_step_that_is_carried_and_begins_anew_with_a_fix() {
        let mut own = Recursion::new(1e-3, 0.1);
        assert_eq!(own.step(Step::Carried(1.0)), None);
        let fixed = own.step(Step::Fixed(0.02)).unwrap();
        let after: Vec<f64> = (0..3).filter_map(|_| own.step(Step::Carried(0.1))).collect();
        let apart = after[1] - after[0];
        assert!((apart - (0.1 + 0.1 * own.sigmas)).abs() < 1e-12 && after[0] > fixed);
        assert_eq!(own.step(Step::Fixed(0.02)), Some(fixed));
    }
}
