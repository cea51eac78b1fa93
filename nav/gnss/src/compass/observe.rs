//! Epochs of several receivers held against each other, each satellite as each antenna had it.

use insd_base::frames::Ecef;
use insd_base::satellites::{LineBias, SPEED_OF_LIGHT};
use insd_base::{GpsTime, SatelliteEpoch, SignalCode, SignalObservation, earth};
use nalgebra::{Matrix3, Vector3};

use super::outcome::{CompassObjection, CompassRejection};
use super::settings::CompassSettings;
use super::signal::{Common, Heard};
use crate::context::Context;
use crate::rtk::pairs;
use crate::sight::Sight;
use crate::signals::{phase_variance, told_code, told_phase};

/// Receivers that sampled further apart than this were not at one place, s.
pub const TOGETHER: f64 = 0.02;

/// Where the antennas are, ECEF, m, to ten metres, and how they move, m/s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) at: Vector3<f64>,
    pub(super) velocity: Vector3<f64>,
}

/// An epoch of all antennas.
#[derive(Clone, Debug)]
pub(super) struct Observed {
    pub(super) tag: GpsTime,
    pub(super) commons: Vec<Common>,
    pub(super) rejected: Vec<CompassRejection>,
    /// By how much each receiver's clock is ahead of that of the first by its codes, m.
    pub(super) clocks: Vec<Option<f64>>,
    /// Median C/N0 of each antenna, dB Hz.
    pub(super) strengths: Vec<Option<f64>>,
    /// From ECEF to north, east, down.
    pub(super) c_ne: Matrix3<f64>,
}

/// A signal of a satellite, and what each antenna has of it.
struct Tracked<'a> {
    signal: SignalCode,
    by: Vec<(usize, &'a SignalObservation)>,
}

/// One antenna's part of a signal, and the satellite as it was when that left.
struct Seen<'a> {
    antenna: usize,
    observed: &'a SignalObservation,
    sight: Sight,
}

/// Holds the epochs of all antennas against each other. `None` where nobody was heard.
pub(super) fn observe(
    context: &Context,
    settings: &CompassSettings,
    epochs: &[Option<&SatelliteEpoch>],
    place: Place,
) -> Option<Observed> {
    let tag = epochs.iter().flatten().next()?.tag;
    let c_ne = earth::c_ne(&earth::geodetic(&Ecef(place.at)));
    let mut observed = Observed {
        tag,
        commons: Vec::new(),
        rejected: Vec::new(),
        clocks: vec![None; epochs.len()],
        strengths: strengths(epochs),
        c_ne,
    };
    let mut seen = Vec::new();
    for tracked in tracked(epochs) {
        match sights(context, settings, epochs, &tracked, &place.at) {
            Ok(own) => seen.push((tracked.signal, own)),
            Err(why) => observed.reject(&tracked, why),
        }
    }
    observed.clocks = clocks(epochs.len(), &seen, &place.at);
    let late = lateness(epochs, tag, &observed.clocks);
    for (signal, own) in &seen {
        observed.take(settings, (*signal, own), &late, &place);
    }
    Some(observed)
}

/// Signals that two antennas track at the least, each with the first of them as what the others are paired with.
fn tracked<'a>(epochs: &[Option<&'a SatelliteEpoch>]) -> Vec<Tracked<'a>> {
    let mut all: Vec<Tracked<'a>> = Vec::new();
    for (anchor, first) in epochs.iter().enumerate() {
        let Some(first) = first else { continue };
        let known = all.len();
        for (antenna, other) in epochs.iter().enumerate().skip(anchor + 1) {
            let Some(other) = other else { continue };
            for (pair, own, at_anchor) in pairs(other, first) {
                let same = |tracked: &&mut Tracked<'_>| {
                    let by = tracked.by[0].1;
                    by.satellite == pair.satellite && by.signal.band == pair.base.band
                };
                let is_known = all[..known].iter_mut().any(|own| same(&own));
                if is_known {
                    continue;
                }
                match all[known..].iter_mut().find(same) {
                    Some(tracked) if tracked.signal == pair.base => tracked.by.push((antenna, own)),
                    Some(_) => {}
                    None => all.push(Tracked {
                        signal: pair.base,
                        by: vec![(anchor, at_anchor), (antenna, own)],
                    }),
                }
            }
        }
    }
    all
}

/// The satellite as each antenna had it, by its own tag and code.
fn sights<'a>(
    context: &Context,
    settings: &CompassSettings,
    epochs: &[Option<&SatelliteEpoch>],
    tracked: &Tracked<'a>,
    at: &Vector3<f64>,
) -> Result<Vec<Seen<'a>>, CompassObjection> {
    let tag_of = |antenna: usize| epochs[antenna].map(|epoch| epoch.tag);
    let (first, observed) = tracked.by[0];
    let tag = tag_of(first).ok_or(CompassObjection::NoOrbit)?;
    // the same record for all: its errors cancel
    let record = context.ephemerides.select(observed.satellite, tag);
    let record = record.map_err(|_| CompassObjection::NoOrbit)?;
    let sight = |(antenna, observed): &(usize, &'a SignalObservation)| {
        let sight = Sight::new(record, tag_of(*antenna)?, told_code(observed)?);
        Some(Seen { antenna: *antenna, observed, sight })
    };
    let seen: Vec<_> = tracked.by.iter().filter_map(sight).collect();
    let is_low = |own: &Seen<'_>| own.sight.direction(at).elevation < settings.lowest;
    if seen.iter().any(is_low) {
        return Err(CompassObjection::Low);
    }
    Ok(seen)
}

/// What is left of a code or phase when way and satellite's clock are taken out, m.
fn remainder(measured: f64, sight: &Sight, at: &Vector3<f64>) -> f64 {
    measured + SPEED_OF_LIGHT * sight.satellite.clock - sight.transmitter().range(at)
}

/// By how much each clock is ahead of the first antenna's that is heard, m: medians of codes.
fn clocks(
    antennas: usize,
    seen: &[(SignalCode, Vec<Seen<'_>>)],
    at: &Vector3<f64>,
) -> Vec<Option<f64>> {
    let code = |own: &Seen<'_>| told_code(own.observed).map(|code| remainder(code, &own.sight, at));
    let mut clocks: Vec<Option<f64>> = vec![None; antennas];
    let anchors = seen.iter().filter_map(|(_, own)| own.first().map(|own| own.antenna));
    let Some(first) = anchors.min() else { return clocks };
    clocks[first] = Some(0.0);
    for antenna in 0..antennas {
        let differences = seen.iter().filter_map(|(_, all)| {
            let own = all.iter().find(|own| own.antenna == antenna)?;
            let against = all.iter().find(|own| clocks[own.antenna].is_some())?;
            Some(code(own)? - code(against)? + clocks[against.antenna]?)
        });
        let middle = median(differences.collect());
        clocks[antenna] = clocks[antenna].or(middle);
    }
    clocks
}

/// By how much later than the first each antenna sampled, s: its tag less what its clock is ahead; `None` of one that is not heard or sampled elsewhere.
fn lateness(
    epochs: &[Option<&SatelliteEpoch>],
    tag: GpsTime,
    clocks: &[Option<f64>],
) -> Vec<Option<f64>> {
    let late = |(epoch, clock): (&Option<&SatelliteEpoch>, &Option<f64>)| {
        let late = epoch.as_ref()?.tag.since(tag).as_seconds() - (*clock)? / SPEED_OF_LIGHT;
        (late.abs() < TOGETHER).then_some(late)
    };
    epochs.iter().zip(clocks).map(late).collect()
}

/// Median C/N0 of each antenna.
fn strengths(epochs: &[Option<&SatelliteEpoch>]) -> Vec<Option<f64>> {
    let strength = |epoch: &Option<&SatelliteEpoch>| {
        let signals = epoch.as_ref()?.signals.iter();
        median(signals.filter_map(|own| own.cn0).collect())
    };
    epochs.iter().map(strength).collect()
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.retain(|value| value.is_finite());
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

impl Observed {
    fn reject(&mut self, tracked: &Tracked<'_>, why: CompassObjection) {
        let satellite = tracked.by[0].1.satellite;
        let rejection = CompassRejection { satellite, signal: tracked.signal, antenna: None, why };
        self.rejected.push(rejection);
    }

    /// Takes a signal: each phase less the way to where the antennas were when that receiver sampled.
    fn take(
        &mut self,
        settings: &CompassSettings,
        (signal, seen): (SignalCode, &[Seen<'_>]),
        late: &[Option<f64>],
        place: &Place,
    ) {
        let Some(first) = seen.first() else { return };
        let satellite = first.observed.satellite;
        let Some(wavelength) = first.observed.wavelength() else { return };
        let direction = first.sight.direction(&place.at);
        let mut heard = Vec::with_capacity(seen.len());
        for own in seen {
            let (observed, Some(late)) = (own.observed, late[own.antenna]) else { continue };
            let Some(phase) = told_phase(observed) else { continue };
            if observed.half_cycle {
                let (antenna, why) = (Some(own.antenna), CompassObjection::HalfCycle);
                self.rejected.push(CompassRejection { satellite, signal, antenna, why });
                continue;
            }
            let at = place.at + place.velocity * late;
            let (noise, elevation) = ((settings.phase, settings.weak), direction.elevation);
            heard.push(Heard {
                antenna: own.antenna,
                phase: remainder(phase * wavelength, &own.sight, &at),
                variance: phase_variance(noise, elevation, observed.cn0),
                line: LineBias::new(own.antenna, satellite, observed.signal, signal),
            });
        }
        if heard.len() >= 2 {
            self.commons.push(Common {
                satellite,
                signal,
                wavelength,
                line_of_sight: -(self.c_ne * first.sight.transmitter().gradient(&place.at)),
                heard,
            });
        }
    }
}
