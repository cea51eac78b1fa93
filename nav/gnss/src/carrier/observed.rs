//! A satellite as one epoch has it, for whoever compares it with the next.

use insd_base::frames::Ecef;
use insd_base::satellites::SPEED_OF_LIGHT;
use insd_base::{BroadcastRecord, GpsTime, SatelliteId, SignalCode, SignalObservation, earth};
use nalgebra::Vector3;

use crate::budget::LOWEST;
use crate::context::{Context, Delays};
use crate::sight::Sight;
use crate::signals::{dispersion, first_band, inflation, told_code, told_phase};

/// One band of a satellite.
#[derive(Clone, Copy, Debug)]
pub(super) struct Phase {
    pub(super) signal: SignalCode,
    /// m.
    pub(super) phase: f64,
    pub(super) variance: f64,
    pub(super) dispersion: f64,
    lock: Option<f64>,
}

/// A satellite with all its phases.
#[derive(Clone, Debug)]
pub(super) struct Observed {
    pub(super) satellite: SatelliteId,
    pub(super) record: BroadcastRecord,
    /// Code as measured, m.
    pub(super) code: f64,
    pub(super) sight: Sight,
    pub(super) elevation: f64,
    pub(super) delays: Delays,
    pub(super) phases: Vec<Phase>,
    /// By how much the variance of its phases is to be multiplied where all epochs are used as if their errors were independent.
    pub(super) repeated: f64,
}

impl Observed {
    /// `None` for one without a code, without an orbit, or too low. `turns`: by how many turns the antenna has turned clockwise as seen from above;
    /// each adds a cycle to every phase (Wu et al., "Effects of antenna orientation on GPS carrier phase", 1993).
    pub(super) fn new(
        context: &Context,
        (tag, repeated): (GpsTime, f64),
        signals: &[SignalObservation],
        (antenna, turns): (&Vector3<f64>, f64),
    ) -> Option<Self> {
        let satellite = signals.first()?.satellite;
        let code = signals.iter().find_map(told_code)?;
        let record = context.ephemerides.select(satellite, tag).ok()?;
        let sight = Sight::new(record, tag, code);
        let direction = sight.direction(antenna);
        if direction.elevation < LOWEST {
            return None;
        }
        let delays = context.delays(&earth::geodetic(&Ecef(*antenna)), direction, tag);
        let noise = context.noise.phase * context.noise.phase;
        let phase = |signal: &SignalObservation| {
            Some(Phase {
                signal: signal.signal,
                phase: (told_phase(signal)? - turns) * signal.wavelength()?,
                // what phases are off by from epoch to epoch is of orbits and the air: weak ones are hardly worse
                variance: noise * inflation(direction.elevation, None),
                dispersion: dispersion(satellite, signal.signal)?,
                lock: if signal.slip { Some(0.0) } else { signal.lock },
            })
        };
        let whole = signals.iter().filter(|signal| !signal.half_cycle);
        let mut phases: Vec<Phase> = whole.filter_map(phase).collect();
        // where a receiver has lost the first band it slips on the others, and does not say so
        let first = first_band(satellite.constellation);
        if phases.iter().all(|phase| phase.signal.band != first) {
            phases.clear();
        }
        Some(Self {
            satellite,
            record: *record,
            code,
            sight,
            elevation: direction.elevation,
            delays,
            phases,
            repeated,
        })
    }

    /// Code with the satellite's clock taken out, m: near enough for the begin of an arc.
    pub(super) fn range(&self) -> f64 {
        self.code + SPEED_OF_LIGHT * self.sight.satellite.clock
    }
}

impl Phase {
    /// Whether the receiver tracked from an earlier epoch on without a break, by its own word.
    pub(super) fn continues(&self, earlier: &Phase, elapsed: f64) -> bool {
        match (earlier.lock, self.lock) {
            // lower bounds: they may stand, but not fall
            (Some(before), Some(now)) => now > 0.0 && (now >= before || now >= elapsed),
            (None, Some(now)) => now > 0.0,
            (_, None) => true,
        }
    }
}
