//! Lever arms that are found one after the other: an antenna does not move.

use insd_base::Time;
use nalgebra::Vector3;

use crate::separate_bias::ConstantsFinding;

/// Two findings contradict each other beyond so many sigmas of both.
const CONTRADICT: f64 = 4.5;
/// Share of a correction that it is unsure of, 1-sigma: what it does to the estimate is not linear.
const BENT: f64 = 0.2;
/// A finding counts for so long, s.
const RECENT: f64 = 300.0;

/// What was found last.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FoundLever(Option<Found>);

#[derive(Clone, Copy, Debug)]
struct Found {
    time: Time,
    /// From the IMU, body axes, m, with 1-sigma.
    arm: Vector3<f64>,
    std: Vector3<f64>,
}

impl FoundLever {
    /// Notes that the antenna is found at an arm, unless that contradicts what was found a while ago, and tells whether it is
    /// noted. One who is found elsewhere again and again is found by something that is no lever arm, as a gyro that tells
    /// turns backwards.
    pub(super) fn note(
        &mut self,
        now: Time,
        arm: &Vector3<f64>,
        finding: &ConstantsFinding,
    ) -> bool {
        let std = finding.gnss_lever_std();
        let contradicts = |last: &Found| {
            let apart = (arm - last.arm).component_div(&std.zip_map(&last.std, f64::hypot));
            (now - last.time).as_seconds() < RECENT && apart.amax() > CONTRADICT
        };
        if self.0.as_ref().is_some_and(contradicts) {
            return false;
        }
        let bent = BENT * finding.gnss_lever().norm();
        self.0 = Some(Found { time: now, arm: *arm, std: std.map(|std| std.hypot(bent)) });
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::separate_bias::{Constants, ConstantsCovariance};

    /// Notes a finding by a step along her, m, that ends at an arm, good to a metre.
    fn note(found: &mut FoundLever, second: f64, step: f64, arm: f64) -> bool {
        let mut value = Constants::zeros();
        value[0] = step;
        let finding = ConstantsFinding { value, covariance: ConstantsCovariance::identity() };
        found.note(Time::from_seconds(second), &Vector3::new(arm, 0.0, 0.0), &finding)
    }

    #[test]
    fn an_antenna_that_is_found_elsewhere_a_minute_later_is_not_believed() {
        let mut found = FoundLever::default();
        assert!(note(&mut found, 100.0, 6.0, 6.0));
        assert!(!note(&mut found, 160.0, 11.0, 17.0));
        assert!(!note(&mut found, 220.0, 25.0, 31.0));
        assert!(note(&mut found, 500.0, 11.0, 17.0), "what was found long ago is no witness");
    }

    #[test]
    fn a_large_correction_may_be_followed_by_another() {
        let mut found = FoundLever::default();
        assert!(note(&mut found, 100.0, -35.0, 25.0));
        assert!(note(&mut found, 110.0, -31.0, -6.0));
        assert!(note(&mut found, 120.0, 1.0, -5.0));
    }
}
