//! The satellites of an epoch that have an orbit and a code.

use insd_base::{BroadcastRecord, SatelliteEpoch, SatelliteId, SignalObservation};

use super::witness::{Verdict, Witness};
use crate::budget::untold_std;
use crate::context::Context;
use crate::sight::Sight;
use crate::signals::{best_of_each_band, dispersion, first_band, group_delay, inflation};

/// One band of a satellite.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ranging {
    pub(super) band: u8,
    /// Code, m, with the satellite's clock and group delay taken out.
    pub(super) code: f64,
    /// How much more than on L1 the ionosphere delays it.
    pub(super) dispersion: f64,
    /// 1-sigma of what nobody tells of its delay, m.
    untold: f64,
    cn0: Option<f64>,
}

impl Ranging {
    /// Variance of its own part of the error, m^2; the noise of a good code at the zenith has this 1-sigma, m.
    pub(super) fn variance(&self, elevation: f64, code_std: f64) -> f64 {
        code_std * code_std * inflation(elevation, self.cn0) + self.untold * self.untold
    }
}

/// A satellite that may be used.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub(super) satellite: SatelliteId,
    pub(super) sight: Sight,
    /// Its bands, the one that positions rest on first.
    pub(super) rangings: Vec<Ranging>,
}

/// Candidates of an epoch, and the satellites that are none.
pub(super) fn of(context: &Context, epoch: &SatelliteEpoch) -> (Vec<Candidate>, Vec<Witness>) {
    let mut candidates = Vec::new();
    let mut refused = Vec::new();
    for signals in epoch.signals.chunk_by(|a, b| a.satellite == b.satellite) {
        let Some(first) = signals.first() else { continue };
        match candidate(context, epoch, signals) {
            Ok(candidate) => candidates.push(candidate),
            Err(verdict) => refused.push(Witness::refused(first.satellite, verdict)),
        }
    }
    (candidates, refused)
}

fn candidate(
    context: &Context,
    epoch: &SatelliteEpoch,
    signals: &[SignalObservation],
) -> Result<Candidate, Verdict> {
    let mut best = best_of_each_band(signals);
    let satellite = best.first().ok_or(Verdict::NoCode)?.satellite;
    let first = first_band(satellite.constellation);
    best.sort_by_key(|signal| (signal.signal.band != first, signal.signal.band));
    let leading = best.first().filter(|signal| signal.signal.band == first);
    let code = leading.and_then(|signal| signal.code).ok_or(Verdict::NoCode)?;
    let record = context.ephemerides.select(satellite, epoch.tag).map_err(Verdict::NoOrbit)?;
    let sight = Sight::new(record, epoch.tag, code);
    let rangings: Vec<_> =
        best.iter().filter_map(|signal| ranging(record, &sight, signal)).collect();
    match rangings.first() {
        Some(ranging) if ranging.band == first => Ok(Candidate { satellite, sight, rangings }),
        _ => Err(Verdict::NoCode),
    }
}

fn ranging(record: &BroadcastRecord, sight: &Sight, signal: &SignalObservation) -> Option<Ranging> {
    use insd_base::satellites::SPEED_OF_LIGHT;
    let clock = sight.satellite.clock - group_delay(record, signal.signal)?;
    Some(Ranging {
        band: signal.signal.band,
        code: signal.code? + clock * SPEED_OF_LIGHT,
        dispersion: dispersion(signal.satellite, signal.signal)?,
        untold: untold_std(signal.satellite, signal.signal),
        cn0: signal.cn0,
    })
}
