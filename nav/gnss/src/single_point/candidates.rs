//! The satellites of an epoch that have an orbit and a code.

use insd_base::{SatelliteEpoch, SatelliteId, SignalObservation};

use super::witness::{Verdict, Witness};
use crate::band_code::BandCode;
use crate::context::Context;
use crate::sight::Sight;
use crate::signals::{best_of_each_band, first_band};

/// A satellite that may be used.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub(super) satellite: SatelliteId,
    pub(super) sight: Sight,
    /// Its bands, the one that positions rest on first.
    pub(super) bands: Vec<BandCode>,
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
    let bands: Vec<_> =
        best.iter().filter_map(|signal| BandCode::new(record, &sight, signal)).collect();
    match bands.first() {
        Some(leading) if leading.band == first => Ok(Candidate { satellite, sight, bands }),
        _ => Err(Verdict::NoCode),
    }
}
