//! The code of one band, with what its satellite says of itself taken out.

use insd_base::satellites::SPEED_OF_LIGHT;
use insd_base::{BroadcastRecord, SignalObservation};

use crate::budget::untold_std;
use crate::sight::Sight;
use crate::signals::{dispersion, group_delay, inflation};

/// One band of a satellite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BandCode {
    pub(crate) band: u8,
    /// Code, m, with the satellite's clock and group delay taken out.
    pub(crate) code: f64,
    /// How much more than on L1 the ionosphere delays it.
    pub(crate) dispersion: f64,
    /// 1-sigma of what nobody tells of its delay, m.
    pub(crate) untold: f64,
    cn0: Option<f64>,
}

impl BandCode {
    /// `None` without a code, or where the record does not tell the delay of the band.
    pub(crate) fn new(
        record: &BroadcastRecord,
        sight: &Sight,
        signal: &SignalObservation,
    ) -> Option<Self> {
        let clock = sight.satellite.clock - group_delay(record, signal.signal)?;
        Some(Self {
            band: signal.signal.band,
            code: signal.code? + clock * SPEED_OF_LIGHT,
            dispersion: dispersion(signal.satellite, signal.signal)?,
            untold: untold_std(signal.satellite, signal.signal),
            cn0: signal.cn0,
        })
    }

    /// Variance of its noise, m^2; that of a good code at the zenith has this 1-sigma, m.
    pub(crate) fn noise(&self, elevation: f64, code_std: f64) -> f64 {
        code_std * code_std * inflation(elevation, self.cn0)
    }
}
