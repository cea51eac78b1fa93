//! From epoch to epoch the change of each satellite's phase, with what is no motion of the antenna taken out.

use std::collections::BTreeMap;

use insd_base::satellites::{ArcPhase, Measured, SPEED_OF_LIGHT};
use insd_base::{GpsTime, SatelliteEpoch, SatelliteId, SignalCode};
use nalgebra::Vector3;

use super::change::PhaseChange;
use super::ionosphere::IonosphereTrack;
use super::observed::{Observed, Phase};
use super::scatter::{Scatter, Tracked};
use crate::context::Context;
use crate::sight::Sight;

/// The longest that two epochs may lie apart, s: the ionosphere and a satellite's clock move by centimetres in a minute.
const LONGEST: f64 = 60.0;
/// 1-sigma of the rate of the ionosphere on L1 at the zenith that its model does not have, m/s.
const IONOSPHERE_RATE: f64 = 0.002;

/// A satellite whose phase is tracked.
#[derive(Clone, Copy, Debug)]
struct Arc {
    phase: ArcPhase,
    ionosphere: Option<Dispersive>,
}

/// The ionosphere as two bands see it: of which phases, by their place.
#[derive(Clone, Copy, Debug)]
struct Dispersive {
    bands: [SignalCode; 2],
    track: IonosphereTrack,
}

/// Remembers the epoch before.
#[derive(Clone, Debug, Default)]
pub struct CarrierTracker {
    tag: Option<GpsTime>,
    seen: BTreeMap<SatelliteId, (Observed, Arc)>,
    /// Arcs begun so far.
    arcs: u32,
    /// What phases scatter by.
    scatter: Scatter,
}

impl CarrierTracker {
    /// The changes since the epoch before, for an antenna at about this place, ECEF, m: an error of 100 m there makes one of 15 mm/s at the most
    /// (satellites move by 1.5e-4 rad/s as seen from the Earth), and none in a solution that knows its place before. `turned`: by what the antenna
    /// has turned so far, from wherever that is counted, rad, clockwise as seen from above.
    pub fn advance(
        &mut self,
        context: &Context,
        epoch: &SatelliteEpoch,
        antenna: &Vector3<f64>,
        turned: f64,
    ) -> Vec<PhaseChange> {
        let elapsed = self.tag.map(|before| epoch.tag.since(before).as_seconds());
        let elapsed =
            elapsed.filter(|elapsed| *elapsed > 0.0 && *elapsed < LONGEST && !epoch.clock_reset);
        let repeated = self.scatter.repeated(elapsed);
        let before = std::mem::take(&mut self.seen);
        let mut changes = Vec::new();
        for signals in epoch.signals.chunk_by(|a, b| a.satellite == b.satellite) {
            let antenna = (antenna, turned / std::f64::consts::TAU);
            let Some(now) = Observed::new(context, (epoch.tag, repeated), signals, antenna) else {
                continue;
            };
            let kept = elapsed.zip(before.get(&now.satellite)).zip(self.tag);
            let change = kept.and_then(|((elapsed, (earlier, arc)), tag)| {
                change((tag, earlier, arc), &now, elapsed, antenna.0)
            });
            let arc = match change {
                Some((change, arc)) => {
                    changes.push(change);
                    arc
                }
                None => self.begin(&now),
            };
            self.seen.insert(now.satellite, (now, arc));
        }
        self.tag = Some(epoch.tag);
        if self.scatter.is_due(epoch.tag) {
            self.scatter.hear(epoch.tag, antenna, self.tracked());
        }
        changes
    }

    /// By how much more than they are taken for phases scatter: the ratio of variances, at least one, over the newest half minute.
    #[must_use]
    pub fn scatter(&self) -> f64 {
        self.scatter.ratio()
    }

    fn tracked(&self) -> Vec<Tracked> {
        let seen = self.seen.iter().filter(|(_, (observed, _))| !observed.phases.is_empty());
        let tracked = |(satellite, (observed, arc)): (&SatelliteId, &(Observed, Arc))| Tracked {
            satellite: *satellite,
            record: observed.record,
            sight: observed.sight,
            phase: arc.phase,
        };
        seen.map(tracked).collect()
    }

    /// The phase of a satellite in the newest epoch, as noisy as phases have been found to be: reflections that last from epoch to epoch count as often.
    #[must_use]
    pub fn phase(&self, satellite: SatelliteId) -> Option<ArcPhase> {
        let (observed, arc) = self.seen.get(&satellite)?;
        let mut told = arc.phase;
        told.phase.variance *= observed.repeated;
        (!observed.phases.is_empty()).then_some(told)
    }

    fn begin(&mut self, now: &Observed) -> Arc {
        self.arcs += 1;
        let weights: f64 = now.phases.iter().map(|phase| 1.0 / phase.variance).sum();
        let phase = Measured { value: now.range(), variance: 1.0 / weights };
        Arc { phase: ArcPhase { phase, arc: self.arcs }, ionosphere: dispersive(now, None) }
    }
}

/// `None` where no phase was tracked through both epochs.
fn change(
    (tag, before, arc): (GpsTime, &Observed, &Arc),
    now: &Observed,
    elapsed: f64,
    antenna: &Vector3<f64>,
) -> Option<(PhaseChange, Arc)> {
    // the same record on both sides: another one is another orbit and another clock
    let sight_before = if before.record == now.record {
        before.sight
    } else {
        Sight::new(&now.record, tag, before.code)
    };
    let clock = SPEED_OF_LIGHT * (now.sight.satellite.clock - sight_before.satellite.clock);
    let troposphere = now.delays.troposphere - before.delays.troposphere;
    let kept: Vec<(&Phase, &Phase)> = now
        .phases
        .iter()
        .filter_map(|phase| {
            let earlier = before.phases.iter().find(|earlier| earlier.signal == phase.signal)?;
            phase.continues(earlier, elapsed).then_some((earlier, phase))
        })
        .collect();
    let (ionosphere, tracked) = tracked(arc.ionosphere, now, &kept, elapsed);
    // a leap between two bands: the lower one is the weaker
    let leapt = tracked.is_none() && ionosphere.is_some() && arc.ionosphere.is_some();
    let kept = if leapt { first_band_alone(&kept) } else { kept };
    let untracked = (0.0, IONOSPHERE_RATE * elapsed / now.elevation.sin().max(0.3));
    let (beyond_model, delay_std) = tracked.unwrap_or(untracked);
    let delay = now.delays.ionosphere - before.delays.ionosphere + beyond_model;
    let (moved, variance) = without_ionosphere(&kept, delay, delay_std)?;
    let change = moved + clock - troposphere;
    // what is constant stays so when another record has the satellite elsewhere
    let elsewhere =
        sight_before.transmitter().range(antenna) - before.sight.transmitter().range(antenna);
    let value = arc.phase.phase.value + elsewhere + change;
    let phase = ArcPhase { phase: Measured { value, variance: variance / 2.0 }, ..arc.phase };
    let (satellite, now) = (now.satellite, now.sight);
    let change = PhaseChange { satellite, before: sight_before, now, change, variance };
    Some((change, Arc { phase, ionosphere }))
}

/// What two bands make of the ionosphere: the track as it goes on, and the change of the delay with its 1-sigma if it was tracked.
fn tracked(
    before: Option<Dispersive>,
    now: &Observed,
    kept: &[(&Phase, &Phase)],
    elapsed: f64,
) -> (Option<Dispersive>, Option<(f64, f64)>) {
    let is_kept = |band: &SignalCode| kept.iter().any(|(_, phase)| phase.signal == *band);
    let same = before.zip(two_bands(now)).filter(|(known, (bands, ..))| known.bands == *bands);
    if let Some((mut known, (_, delay, variance))) =
        same.filter(|(known, _)| known.bands.iter().all(is_kept))
        && let Some(change) = known.track.advance(elapsed, (delay, variance), now.repeated)
    {
        return (Some(known), Some(change));
    }
    (dispersive(now, before), None)
}

fn first_band_alone<'a>(kept: &[(&'a Phase, &'a Phase)]) -> Vec<(&'a Phase, &'a Phase)> {
    let least = kept.iter().map(|(_, phase)| phase.dispersion).fold(f64::INFINITY, f64::min);
    kept.iter().filter(|(_, phase)| phase.dispersion < least + 0.1).copied().collect()
}

/// Two bands begin to track the ionosphere, at the rate that was known.
fn dispersive(now: &Observed, before: Option<Dispersive>) -> Option<Dispersive> {
    let (bands, delay, variance) = two_bands(now)?;
    let rate = before.map_or(0.0, |known| known.track.rate());
    Some(Dispersive { bands, track: IonosphereTrack::begin(delay, variance, rate) })
}

/// The delay on L1 but for a constant by the two bands that lie farthest apart, less that of the model, m, and its variance.
fn two_bands(now: &Observed) -> Option<([SignalCode; 2], f64, f64)> {
    let by_dispersion = |a: &&Phase, b: &&Phase| a.dispersion.total_cmp(&b.dispersion);
    let low = now.phases.iter().min_by(by_dispersion)?;
    let high = now.phases.iter().max_by(by_dispersion)?;
    let apart = high.dispersion - low.dispersion;
    (apart > 0.1).then(|| {
        let variance = (low.variance + high.variance) / (apart * apart);
        let beyond_model = (low.phase - high.phase) / apart - now.delays.ionosphere;
        ([low.signal, high.signal], beyond_model, variance)
    })
}

/// The change of the way by those of all bands, and its variance. The ionosphere's change on L1 is known to within its 1-sigma, m, and each band has
/// its own noise: one band rests on what is known, and two take its place by what each is worth.
fn without_ionosphere(kept: &[(&Phase, &Phase)], delay: f64, std: f64) -> Option<(f64, f64)> {
    // unknowns: the change of the way and the rest of the ionosphere's; 2 x 2 normal equations
    let (mut n11, mut n12, mut n22) = (0.0, 0.0, 1.0 / (std * std).max(1e-12));
    let (mut b1, mut b2) = (0.0, 0.0);
    for (before, now) in kept {
        let moved = now.phase - before.phase + now.dispersion * delay;
        let weight = 1.0 / (now.variance + before.variance);
        n11 += weight;
        n12 -= now.dispersion * weight;
        n22 += now.dispersion * now.dispersion * weight;
        b1 += moved * weight;
        b2 -= now.dispersion * moved * weight;
    }
    let determinant = n11 * n22 - n12 * n12;
    (n11 > 0.0).then(|| ((n22 * b1 - n12 * b2) / determinant, n22 / determinant))
}
