//! What real-time kinematic positioning takes its receivers for, and what it asks before it believes integers.

use crate::signals::{inflation, phase_variance};

/// Receivers, limits and demands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RtkSettings {
    /// 1-sigma of a receiver's code at the zenith, m: `sigma^2 (1 + 1/sin^2 E)`, tenfold for each 10 dB that the signal is below 42 dB Hz.
    pub code: f64,
    /// 1-sigma of a receiver's phase, m, likewise; tenfold for each 10 dB below [`Self::weak`].
    pub phase: f64,
    /// C/N0 below which phases are worse than their elevation says, dB Hz: that of a signal that comes through leaves or round a corner.
    pub weak: f64,
    /// Whether the broadcast model of the ionosphere is taken out of the differences.
    pub ionosphere_model: bool,
    /// 1-sigma of what the ionosphere adds on L1 at the zenith for each metre between the antennas.
    pub ionosphere: f64,
    /// The same of the troposphere.
    pub troposphere: f64,
    /// Satellites below this elevation are not used, rad.
    pub lowest: f64,
    /// Base data older than this are not used, s.
    pub oldest: f64,
    /// The chance of wrong integers that is allowed an epoch, all subsets that are tried together.
    pub risk: f64,
    /// The least success rate by bootstrapping of a part of the ambiguities, if not all are fixed.
    pub success: f64,
    /// Subsets tried at the most, the whole among them.
    pub attempts: usize,
}

impl Default for RtkSettings {
    fn default() -> Self {
        Self {
            code: 0.3,
            phase: 0.003,
            weak: 34.0,
            ionosphere_model: false,
            ionosphere: 3e-7,
            troposphere: 3e-7,
            lowest: 10_f64.to_radians(),
            oldest: 30.0,
            risk: 3e-3,
            success: 0.99,
            attempts: 10,
        }
    }
}

impl RtkSettings {
    /// The risk of one attempt: half of it for the whole, and the other half shared among parts.
    pub(super) fn share(&self, attempt: usize) -> f64 {
        if attempt == 1 || self.attempts < 2 {
            return self.risk / 2.0;
        }
        self.risk / (2 * (self.attempts - 1)) as f64
    }

    /// Variance of one receiver's code, m^2.
    pub(super) fn code_variance(&self, elevation: f64, cn0: Option<f64>) -> f64 {
        2.0 * self.code.powi(2) * inflation(elevation, cn0)
    }

    /// Variance of one receiver's phase, m^2.
    pub(super) fn phase_variance(&self, elevation: f64, cn0: Option<f64>) -> f64 {
        phase_variance((self.phase, self.weak), elevation, cn0)
    }
}
