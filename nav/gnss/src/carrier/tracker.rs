//! From epoch to epoch the change of each satellite's phase, with what is no motion of the antenna taken out.

use std::collections::BTreeMap;

use insd_base::frames::Ecef;
use insd_base::satellites::SPEED_OF_LIGHT;
use insd_base::{
    BroadcastRecord, GpsTime, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation, earth,
};
use nalgebra::Vector3;

use crate::context::{Context, Delays};
use crate::sight::Sight;
use crate::signals::{dispersion, inflation};

/// The longest that two epochs may lie apart, s: the ionosphere and a satellite's clock move by centimetres in a minute.
const LONGEST: f64 = 60.0;
/// Satellites below this elevation are not used, rad: 10 degrees.
const LOWEST: f64 = 0.1745;
/// 1-sigma of the rate of the ionosphere on L1 at the zenith that its model does not have, m/s.
const IONOSPHERE_RATE: f64 = 0.002;

/// The change of a satellite's phase between two epochs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhaseChange {
    /// The satellite.
    pub satellite: SatelliteId,
    /// As it stood at the epoch before.
    pub before: Sight,
    /// As it stands.
    pub now: Sight,
    /// `range(now) - range(before) + c (change of the receiver's clock)` as the phase has it, m.
    pub change: f64,
    /// Its variance, m^2.
    pub variance: f64,
    /// Elevation, rad.
    pub elevation: f64,
}

/// One band of a satellite, as it was at an epoch.
#[derive(Clone, Copy, Debug)]
struct Phase {
    signal: SignalCode,
    /// m.
    phase: f64,
    variance: f64,
    dispersion: f64,
    lock: Option<f64>,
}

/// A satellite as it was at an epoch.
#[derive(Clone, Debug)]
struct Seen {
    record: BroadcastRecord,
    code: f64,
    sight: Sight,
    delays: Delays,
    phases: Vec<Phase>,
}

/// Remembers the epoch before.
#[derive(Clone, Debug, Default)]
pub struct CarrierTracker {
    tag: Option<GpsTime>,
    seen: BTreeMap<SatelliteId, Seen>,
}

impl CarrierTracker {
    /// The changes since the epoch before, for an antenna at about this place, ECEF, m: an error of 100 m there makes one of 15 mm/s at the most
    /// (gnss.md, section 6), and none in a solution that knows its place before.
    pub fn advance(
        &mut self,
        context: &Context,
        epoch: &SatelliteEpoch,
        antenna: &Vector3<f64>,
    ) -> Vec<PhaseChange> {
        let now: BTreeMap<_, _> = epoch
            .signals
            .chunk_by(|a, b| a.satellite == b.satellite)
            .filter_map(|signals| {
                Some((signals.first()?.satellite, seen(context, epoch, signals, antenna)?))
            })
            .collect();
        let elapsed = self.tag.map(|before| epoch.tag.since(before).as_seconds());
        let usable =
            elapsed.filter(|elapsed| *elapsed > 0.0 && *elapsed < LONGEST && !epoch.clock_reset);
        let changes = usable.map_or_else(Vec::new, |elapsed| {
            let both = now.iter().filter_map(|(id, now)| Some((*id, self.seen.get(id)?, now)));
            both.filter_map(|(id, before, now)| {
                change(id, before, now, elapsed, self.tag?, antenna)
            })
            .collect()
        });
        self.tag = Some(epoch.tag);
        self.seen = now;
        changes
    }
}

fn seen(
    context: &Context,
    epoch: &SatelliteEpoch,
    signals: &[SignalObservation],
    antenna: &Vector3<f64>,
) -> Option<Seen> {
    let satellite = signals.first()?.satellite;
    let code = signals.iter().find_map(|signal| signal.code)?;
    let record = context.ephemerides.select(satellite, epoch.tag).ok()?;
    let sight = Sight::new(record, epoch.tag, code);
    let direction = sight.direction(antenna);
    if direction.elevation < LOWEST {
        return None;
    }
    let delays = context.delays(&earth::geodetic(&Ecef(*antenna)), direction, epoch.tag);
    let noise = context.noise.phase * context.noise.phase;
    let phases: Vec<_> = signals
        .iter()
        .filter(|signal| !signal.half_cycle)
        .filter_map(|signal| {
            Some(Phase {
                signal: signal.signal,
                phase: signal.phase? * signal.wavelength()?,
                variance: noise * inflation(direction.elevation, signal.cn0),
                dispersion: dispersion(satellite, signal.signal)?,
                lock: if signal.slip { Some(0.0) } else { signal.lock },
            })
        })
        .collect();
    Some(Seen { record: *record, code, sight, delays, phases })
}

/// `None` where no phase was tracked through both epochs.
fn change(
    satellite: SatelliteId,
    before: &Seen,
    now: &Seen,
    elapsed: f64,
    tag_before: GpsTime,
    antenna: &Vector3<f64>,
) -> Option<PhaseChange> {
    // the same record on both sides: another one is another orbit and another clock
    let sight_before = if before.record == now.record {
        before.sight
    } else {
        Sight::new(&now.record, tag_before, before.code)
    };
    let clock = SPEED_OF_LIGHT * (now.sight.satellite.clock - sight_before.satellite.clock);
    let troposphere = now.delays.troposphere - before.delays.troposphere;
    let ionosphere = now.delays.ionosphere - before.delays.ionosphere;
    let elevation = now.sight.direction(antenna).elevation;
    let rate = IONOSPHERE_RATE * elapsed / elevation.sin().max(0.3);
    let tracked: Vec<_> = now
        .phases
        .iter()
        .filter_map(|phase| {
            let earlier = before.phases.iter().find(|earlier| earlier.signal == phase.signal)?;
            kept(earlier, phase, elapsed).then(|| {
                let moved = phase.phase - earlier.phase + phase.dispersion * ionosphere;
                (moved, phase.variance + earlier.variance, phase.dispersion)
            })
        })
        .collect();
    let (moved, variance) = without_ionosphere(&tracked, rate)?;
    Some(PhaseChange {
        satellite,
        before: sight_before,
        now: now.sight,
        change: moved + clock - troposphere,
        variance,
        elevation,
    })
}

/// Whether the receiver tracked without a break, by its own word.
fn kept(before: &Phase, now: &Phase, elapsed: f64) -> bool {
    match (before.lock, now.lock) {
        // lower bounds: they may stand, but not fall
        (Some(before), Some(now)) => now >= before || now >= elapsed,
        (None, Some(now)) => now > 0.0,
        (_, None) => true,
    }
}

/// The change of the way by those of all bands, and its variance: the ionosphere's change on L1 is zero to within `rate`, m, and each band has
/// its own noise; so that one band rests on the model, and two take its place by what each is worth.
fn without_ionosphere(tracked: &[(f64, f64, f64)], rate: f64) -> Option<(f64, f64)> {
    // unknowns: the change of the way and of the ionosphere; 2 x 2 normal equations
    let (mut n11, mut n12, mut n22) = (0.0, 0.0, 1.0 / (rate * rate));
    let (mut b1, mut b2) = (0.0, 0.0);
    for (moved, variance, dispersion) in tracked {
        n11 += 1.0 / variance;
        n12 -= dispersion / variance;
        n22 += dispersion * dispersion / variance;
        b1 += moved / variance;
        b2 -= dispersion * moved / variance;
    }
    let determinant = n11 * n22 - n12 * n12;
    (n11 > 0.0).then(|| ((n22 * b1 - n12 * b2) / determinant, n22 / determinant))
}
