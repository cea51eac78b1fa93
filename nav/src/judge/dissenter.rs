//! Filters that believe everybody but one, whatever he does: for faults of no known shape.
//!
//! To whoever does not believe the IMU velocity and attitude are random walks; to whoever does not believe another
//! sensor it has noise twenty times as large as stated, and as large as it must be where even that is too little. How
//! much likelier such a filter finds what is said, of late, is the sum of its log-likelihoods less those of who believes
//! all, begun anew whenever it is negative (Page, Continuous Inspection Schemes, Biometrika 41 (1954)).

use insd_base::{Party, Time};
use nalgebra::UnitQuaternion;

use super::aid::Aid;
use super::shadow::{Shadow, agitate};
use crate::error_state::{Innovation, Weighed};

/// Variance of the noise of whom is not believed, times that stated, at the least.
const NOISY: f64 = 400.0;
/// Innovations that the memory spans.
const LATE: f64 = 20.0;

/// One of them.
#[derive(Clone, Debug)]
pub(super) struct Dissenter {
    /// Whom it does not believe.
    pub(super) whom: Party,
    pub(super) shadow: Shadow,
    pub(super) success: Success,
}

/// How well somebody who does not believe another finds what is said.
#[derive(Clone, Copy, Debug)]
pub(super) struct Success {
    /// By how much likelier of late, as a logarithm, and since when.
    pub(super) gain: f64,
    pub(super) since: Time,
    /// Mean of the normalised squares of its innovations of late.
    pub(super) strain: f64,
    /// The greatest of them since it has been likelier.
    pub(super) worst: f64,
}

impl Default for Success {
    fn default() -> Self {
        Success { gain: 0.0, since: Time::START, strain: 1.0, worst: 0.0 }
    }
}

impl Success {
    /// Enters an innovation as it is weighed there; `others` is how likely who believes all finds it, as a logarithm.
    fn enter(&mut self, now: Time, weighed: &Weighed, others: f64) {
        if self.gain <= 0.0 {
            (self.since, self.worst) = (now, 0.0);
        }
        let mean_square = weighed.nis() / weighed.rows() as f64;
        self.worst = self.worst.max(mean_square);
        self.gain = (self.gain + log_likelihood(weighed) - others).max(0.0);
        self.strain += (mean_square - self.strain) / LATE;
    }

    /// The same for who does not believe a receiver that no estimate lives by: his shadow is that of all.
    pub(super) fn hear(
        &mut self,
        (aid, now): (Aid, Time),
        innovation: &Innovation,
        weighed: &Weighed,
        shadow: &Shadow,
    ) {
        let others = log_likelihood(weighed);
        if aid.is_absorbed() {
            return self.enter(now, weighed, others);
        }
        let noisy = shadow.weigh(innovation, noise_of(innovation, shadow));
        noisy.iter().for_each(|noisy| self.enter(now, noisy, others));
    }
}

impl Dissenter {
    /// One that goes along with somebody's shadow up to now.
    pub(super) fn new(whom: Party, shadow: Shadow) -> Self {
        Dissenter { whom, shadow, success: Success::default() }
    }

    /// What a time without anybody's word, s, does to it.
    pub(super) fn agitate(&mut self, dt: f64) {
        if self.whom == Party::Imu {
            agitate(&mut self.shadow.covariance, dt);
        }
    }

    /// Hears an innovation of the navigator, said by somebody; `others` is how likely who believes all finds it, as
    /// a logarithm.
    pub(super) fn hear(
        &mut self,
        (aid, now): (Aid, Time),
        innovation: &Innovation,
        attitude: &UnitQuaternion<f64>,
        others: f64,
    ) {
        let is_own = aid.party() == Some(self.whom);
        let noise = if is_own { noise_of(innovation, &self.shadow) } else { 1.0 };
        let Some(weighed) = self.shadow.weigh(innovation, noise) else { return };
        self.success.enter(now, &weighed, others);
        if aid.is_absorbed() {
            self.shadow.absorb(&weighed, attitude);
        }
    }
}

/// The variance of noise, times that stated, of which an innovation is no more than an ordinary sample.
fn noise_of(innovation: &Innovation, shadow: &Shadow) -> f64 {
    let z = &innovation.z - innovation.h.times(&shadow.apart);
    let squares = z.component_mul(&z).component_div(&innovation.r.diagonal());
    squares.iter().copied().fold(NOISY, f64::max)
}

/// The logarithm of a likelihood, but for a constant.
pub(super) fn log_likelihood(weighed: &Weighed) -> f64 {
    -0.5 * weighed.nis() - weighed.log_root_determinant()
}
