//! How much worse the IMU is than assumed.
//!
//! A filter that believes everybody, as the judge's shadow does, but takes in-run biases and scale factors of the IMU to be a
//! step worse. A data sheet does not tell how biases follow the temperature, or scale factors the rate: if for a long
//! time the pessimist finds what is said likelier, he is right. The sum of his log-likelihoods less the
//! shadow's is begun anew whenever it is negative (Page, Continuous Inspection Schemes, Biometrika 41 (1954)).

use insd_base::{ImuSpec, Time};
use nalgebra::UnitQuaternion;

use super::dissenter::log_likelihood;
use super::shadow::Shadow;
use crate::error_state::{Covariance, Innovation};
use crate::initial::take_for_worse;

/// By how much likelier he must be, as a logarithm, and for how long he must have been, s: what is bad of a sudden is
/// something else.
pub(super) const CONVINCED: f64 = 10.0;
const PATIENT: f64 = 200.0;
/// Where he is as much likelier as this, so long is enough.
const MUCH: f64 = 40.0;
const BRIEF: f64 = 60.0;

/// One of them.
#[derive(Clone, Debug)]
pub(super) struct Pessimist {
    pub(super) shadow: Shadow,
    /// By how much likelier he finds what is said, as a logarithm.
    pub(super) gain: f64,
    /// Since when he finds it likelier.
    since: Time,
}

impl Pessimist {
    /// Of a navigator with a covariance that takes the IMU to be so.
    pub(super) fn new(covariance: &Covariance, imu: &ImuSpec) -> Self {
        let mut shadow = Shadow::of(covariance);
        take_for_worse(&mut shadow.covariance, imu);
        Pessimist { shadow, gain: 0.0, since: Time::START }
    }

    /// Hears an innovation of the navigator; `others` is how likely the shadow finds it, as a logarithm.
    pub(super) fn hear(
        &mut self,
        now: Time,
        innovation: &Innovation,
        attitude: &UnitQuaternion<f64>,
        others: f64,
    ) {
        let Some(weighed) = self.shadow.weigh(innovation, 1.0) else { return };
        if self.gain <= 0.0 {
            self.since = now;
        }
        self.gain = (self.gain + log_likelihood(&weighed) - others).max(0.0);
        self.shadow.absorb(&weighed, attitude);
    }

    /// Somebody lies, or did: what that did is no evidence.
    pub(super) fn forget(&mut self) {
        self.gain = 0.0;
    }

    /// Whether he may be right.
    pub(super) fn is_likely(&self) -> bool {
        self.gain > CONVINCED
    }

    /// Whether he is right.
    pub(super) fn is_right(&self, now: Time) -> bool {
        let needed = if self.gain > MUCH { BRIEF } else { PATIENT };
        self.is_likely() && (now - self.since).as_seconds() > needed
    }
}
