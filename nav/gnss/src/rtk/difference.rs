//! Differences between rover and base, satellite by satellite.

use insd_base::frames::Ecef;
use insd_base::satellites::SPEED_OF_LIGHT;
use insd_base::{BroadcastRecord, Geodetic, GpsTime, SatelliteEpoch, SignalObservation, earth};
use nalgebra::Vector3;

use super::pairing::{SignalPair, pairs};
use super::settings::RtkSettings;
use crate::atmosphere::LookAngles;
use crate::context::{Context, Delays};
use crate::sight::Sight;
use crate::signals::{dispersion, told_code, told_phase};

/// An epoch of the base, and where its antenna was then; of a base that moves, wherever that was.
#[derive(Clone, Copy, Debug)]
pub struct PlacedEpoch<'a> {
    /// What it measured.
    pub epoch: &'a SatelliteEpoch,
    /// Its antenna, ECEF, m.
    pub position: Vector3<f64>,
}

/// One signal, rover less base. What the satellite, the base's place and the models of the atmosphere make of it is taken out; what is left is the
/// rover's range and what all satellites of a group share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Difference {
    pub(super) pair: SignalPair,
    /// The satellite as the rover saw it.
    pub(super) sight: Sight,
    pub(super) code: f64,
    pub(super) phase: Option<f64>,
    pub(super) wavelength: f64,
    pub(super) dispersion: f64,
    pub(super) code_variance: f64,
    pub(super) phase_variance: f64,
    /// Variance that all signals of a satellite share, as of its clock and the troposphere, m^2.
    pub(super) shared: f64,
    /// Variance of the ionosphere on L1, m^2.
    pub(super) ionosphere: f64,
    /// How long rover and base have tracked it without a break, s, by their own word.
    pub(super) locks: [Option<f64>; 2],
    /// A phase is there, but may be wrong by half a cycle.
    pub(super) is_half: bool,
}

/// What both receivers share.
struct Scene<'a> {
    context: &'a Context,
    settings: &'a RtkSettings,
    rover: (GpsTime, Vector3<f64>, Geodetic),
    base: (GpsTime, Vector3<f64>, Geodetic),
}

/// The differences of an epoch for a rover at about this place, ECEF, m.
pub(super) fn differences(
    context: &Context,
    settings: &RtkSettings,
    (rover, near): (&SatelliteEpoch, &Vector3<f64>),
    base: &PlacedEpoch<'_>,
) -> Vec<Difference> {
    let geodetic = |at: &Vector3<f64>| earth::geodetic(&Ecef(*at));
    let scene = Scene {
        context,
        settings,
        rover: (rover.tag, *near, geodetic(near)),
        base: (base.epoch.tag, base.position, geodetic(&base.position)),
    };
    let pairs = pairs(rover, base.epoch);
    let of_satellite = pairs.chunk_by(|(a, ..), (b, ..)| a.satellite == b.satellite);
    of_satellite.flat_map(|pairs| scene.of_satellite(pairs).unwrap_or_default()).collect()
}

impl Scene<'_> {
    /// `None` without an orbit, or where it stands too low.
    fn of_satellite(
        &self,
        pairs: &[(SignalPair, &SignalObservation, &SignalObservation)],
    ) -> Option<Vec<Difference>> {
        let (pair, first, other) = pairs.first()?;
        // the same record for both: its errors cancel
        let record = self.context.ephemerides.select(pair.satellite, self.rover.0).ok()?;
        let rover = self.seen(record, &self.rover, told_code(first)?);
        let base = self.seen(record, &self.base, told_code(other)?);
        let is_low = |own: &Seen| own.direction.elevation < self.settings.lowest;
        if is_low(&rover) || is_low(&base) {
            return None;
        }
        let told = |(pair, own, other): &(SignalPair, &SignalObservation, &SignalObservation)| {
            self.of_signal(*pair, (own, &rover), (other, &base))
        };
        Some(pairs.iter().filter_map(told).collect())
    }

    fn seen(
        &self,
        record: &BroadcastRecord,
        (tag, antenna, place): &(GpsTime, Vector3<f64>, Geodetic),
        code: f64,
    ) -> Seen {
        let sight = Sight::new(record, *tag, code);
        let direction = sight.direction(antenna);
        Seen { sight, direction, delays: self.context.delays(place, direction, *tag) }
    }

    fn of_signal(
        &self,
        pair: SignalPair,
        (own, rover): (&SignalObservation, &Seen),
        (other, base): (&SignalObservation, &Seen),
    ) -> Option<Difference> {
        let dispersion = dispersion(pair.satellite, pair.rover)?;
        let wavelength = own.wavelength()?;
        let elevation = rover.direction.elevation;
        let at_base = base.sight.transmitter().range(&self.base.1);
        let clocks = SPEED_OF_LIGHT * (rover.sight.satellite.clock - base.sight.satellite.clock)
            + at_base
            - (rover.delays.troposphere - base.delays.troposphere);
        let model = f64::from(u8::from(self.settings.ionosphere_model));
        let bent = model * dispersion * (rover.delays.ionosphere - base.delays.ionosphere);
        let is_half = own.half_cycle || other.half_cycle;
        let phases = told_phase(own).zip(told_phase(other)).filter(|_| !is_half);
        let variance = |of: &dyn Fn(Option<f64>) -> f64| of(own.cn0) + of(other.cn0);
        let (shared, ionosphere) = self.slow(elevation);
        Some(Difference {
            pair,
            sight: rover.sight,
            code: told_code(own)? - told_code(other)? + clocks - bent,
            phase: phases.map(|(own, other)| (own - other) * wavelength + clocks + bent),
            wavelength,
            dispersion,
            code_variance: variance(&|cn0| self.settings.code_variance(elevation, cn0)),
            phase_variance: variance(&|cn0| self.settings.phase_variance(elevation, cn0)),
            shared,
            ionosphere,
            locks: [own.lock, other.lock],
            is_half,
        })
    }

    /// Variances of what all signals of a satellite share and of the ionosphere, m^2.
    fn slow(&self, elevation: f64) -> (f64, f64) {
        // broadcast clocks wander by this much against their record, s/s (RTKLIB manual 2.4.2, E.6)
        const WANDER: f64 = 5e-12;
        // of the dry air of a standard atmosphere, a share of what is between two heights
        const BY_HEIGHT: f64 = 1e-5;
        let apart = (self.rover.1 - self.base.1).norm();
        let height = (self.rover.2.height - self.base.2.height).abs();
        let slant = 1.0 / elevation.sin().max(0.1);
        let age = self.rover.0.since(self.base.0).as_seconds();
        let air = (self.settings.troposphere * apart + BY_HEIGHT * height) * slant;
        let clock = WANDER * SPEED_OF_LIGHT * age;
        // a thin layer at 350 km: less slanted than the air
        let ionosphere = self.settings.ionosphere * apart * slant.min(3.0);
        (air * air + clock * clock, ionosphere * ionosphere)
    }
}

/// A satellite as one of both receivers has it.
struct Seen {
    sight: Sight,
    direction: LookAngles,
    delays: Delays,
}
