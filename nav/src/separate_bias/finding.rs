//! What was found of the constants.

use nalgebra::Vector3;

use super::{Constants, ConstantsCovariance, DELAY_AT, LEAST, LOG_AT};

/// What the constants are found to be off by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstantsFinding {
    /// True minus configured.
    pub value: Constants,
    /// Its covariance.
    pub covariance: ConstantsCovariance,
}

impl ConstantsFinding {
    /// Whether lever arm or delay of GNSS are off by much.
    #[must_use]
    pub fn is_of_antenna(&self) -> bool {
        (0..LOG_AT).any(|i| self.value[i].abs() > LEAST[i])
    }

    /// Whether the delay of GNSS is off by much.
    #[must_use]
    pub fn is_of_delay(&self) -> bool {
        self.value[DELAY_AT].abs() > LEAST[DELAY_AT]
    }

    /// What the lever arm of the antenna is found to be off by, m.
    #[must_use]
    pub fn gnss_lever(&self) -> Vector3<f64> {
        self.value.fixed_rows::<3>(0).into_owned()
    }

    /// 1-sigma of the same.
    #[must_use]
    pub fn gnss_lever_std(&self) -> Vector3<f64> {
        self.covariance.diagonal().fixed_rows::<3>(0).map(|variance| variance.max(0.0).sqrt())
    }

    /// What the lever arm of the log is found to be off by, m, with 1-sigma, if it is by much.
    #[must_use]
    pub fn log_lever(&self) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let value = self.value.fixed_rows::<3>(LOG_AT).into_owned();
        let variance = self.covariance.diagonal().fixed_rows::<3>(LOG_AT).into_owned();
        (value.amax() > LEAST[LOG_AT]).then(|| (value, variance.map(|v| v.max(0.0).sqrt())))
    }
}
