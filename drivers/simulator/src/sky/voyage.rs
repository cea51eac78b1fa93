//! The raw GNSS of a whole voyage.

use insd_base::earth::{c_ne, ecef, geodetic};
use insd_base::satellites::{BroadcastRecord, SatelliteEpoch};
use insd_base::units::DEG;
use insd_base::{Body, Ecef, Geodetic, GpsTime, Time};
use nalgebra::Vector3;

use super::clock::Clock;
use super::constellation::{Nominal, satellites};
use super::faults::faults;
use super::installation::{injected, own_clock};
use super::output::{RawBaseStation, RawGnss, RawSpec};
use super::path::{Air, Site};
use super::receiver::{Receiver, World};
use super::records::{IONOSPHERE, records, reference_before};
use super::satellite::{Departure, Satellite};
use super::scene::Scene;
use super::truth::{InjectedSlip, RawTruth};
use crate::camera;
use crate::feed::Calendar;
use crate::scenario::{Raw, RawBase, Scenario};
use crate::sensors::epochs;
use crate::track::Track;

/// What receivers measure in a voyage that follows `track`; `None` where the start is no instant.
pub(crate) fn raw_gnss(
    scenario: &Scenario,
    raw: &Raw,
    track: &Track,
    seed: u64,
) -> Option<RawGnss> {
    let voyage = Sailing { raw, track, duration: scenario.duration(), seed };
    let (nominal, world, scene) = voyage.surroundings(&scenario.start_utc)?;
    let mut slips = Vec::new();
    let antennas =
        (0..raw.antennas_m.len()).map(|index| voyage.receive(&world, &scene, index, &mut slips));
    let antennas = antennas.collect();
    let base = raw.base.map(|base| voyage.receive_ashore(&world, &base, &mut slips));
    let satellite_faults = world.faults.iter().map(|fault| fault.injected(voyage.duration));
    Some(RawGnss {
        spec: RawSpec::of(raw),
        antennas,
        base,
        broadcast: voyage.broadcast(&world, &nominal),
        ionosphere: IONOSPHERE,
        truth: RawTruth {
            scenario: scenario.name.clone(),
            segments: scene.segments(),
            satellite_faults: satellite_faults.collect(),
            spoofs: scene.injected_spoofs(),
            slips,
            antenna_faults: injected(&raw.antenna_fault, voyage.duration),
            swapped: raw.swapped,
            camera: scenario
                .camera
                .as_ref()
                .map(|own| camera::truth(&camera::installed(own, seed), voyage.duration)),
        },
    })
}

/// Satellites and air of a voyage that follows `track`, and what stands between her and the sky; `None` where the start is no instant.
pub(crate) fn setting(
    scenario: &Scenario,
    raw: &Raw,
    track: &Track,
    seed: u64,
) -> Option<(World, Scene)> {
    let voyage = Sailing { raw, track, duration: scenario.duration(), seed };
    let (_, world, scene) = voyage.surroundings(&scenario.start_utc)?;
    Some((world, scene))
}

/// A voyage to be heard.
#[derive(Clone, Copy, Debug)]
struct Sailing<'a> {
    raw: &'a Raw,
    track: &'a Track,
    duration: f64,
    seed: u64,
}

impl Sailing<'_> {
    fn surroundings(&self, start_utc: &str) -> Option<(Vec<Nominal>, World, Scene)> {
        let start = Calendar::new(start_utc)?.gps(Time::START);
        let letters = &self.raw.sky.constellations;
        let nominal = satellites(letters, reference_before(start), self.seed);
        let world = self.world(&nominal, start);
        let site = |t| Site::new(t, self.antenna(0, t));
        let scene = Scene::new(self.raw, &world.satellites, site, self.seed);
        Some((nominal, world, scene))
    }

    /// Place of an antenna by its index at time `t`, s, ECEF, m.
    fn antenna(&self, index: usize, t: f64) -> Vector3<f64> {
        let lever = self.raw.antennas_m.get(index).copied().unwrap_or_default();
        self.track.at(t).at_lever(&Body(Vector3::from(lever))).0.0
    }

    fn world(&self, nominal: &[Nominal], start: GpsTime) -> World {
        let sky = &self.raw.sky;
        let departure =
            Departure { orbit: sky.orbit_std_m, clock: sky.clock_std_m, period: sky.period_s };
        let satellite = |own: &Nominal| Satellite::new(own.clone(), start, departure, self.seed);
        let mut satellites: Vec<Satellite> = nominal.iter().map(satellite).collect();
        let site = |t: f64| Site::new(t, self.antenna(0, t));
        let faults = faults(&self.raw.fault, &satellites, site, self.duration, self.seed);
        for fault in &faults {
            let Some((t, acceleration)) = fault.leaves() else { continue };
            let own = satellites.iter_mut().filter(|own| own.id() == fault.satellite());
            own.for_each(|own| own.leave(t, acceleration));
        }
        let air = Air::new(sky, start, &satellites, self.seed);
        World { start, satellites, air, faults }
    }

    fn broadcast(&self, world: &World, nominal: &[Nominal]) -> Vec<BroadcastRecord> {
        let reference = reference_before(world.start);
        let into = world.start.since(reference).as_seconds();
        let stale = |satellite: &Nominal| {
            let own = world.faults.iter().filter(|fault| fault.satellite() == satellite.id);
            let from = own.filter_map(|fault| fault.leaves().map(|(t, _)| t));
            into + from.fold(f64::INFINITY, f64::min)
        };
        let step = self.raw.sky.record_step_m;
        records(nominal, (reference, into + self.duration), step, self.seed, stale)
    }

    /// The epochs of an antenna by its index.
    fn receive(
        &self,
        world: &World,
        scene: &Scene,
        index: usize,
        slips: &mut Vec<InjectedSlip>,
    ) -> Vec<SatelliteEpoch> {
        let mut receiver = Receiver::new(self.raw, index + 1, world, self.seed);
        let own = |t: f64| self.antenna(index, t);
        let first = |t: f64| self.antenna(0, t);
        let epochs = receiver.epochs(world, scene, self.clocks(index + 1), [&own, &first], &|t| {
            self.track.at(t).attitude().heading
        });
        slips.extend(receiver.slips());
        epochs
    }

    fn receive_ashore(
        &self,
        world: &World,
        base: &RawBase,
        slips: &mut Vec<InjectedSlip>,
    ) -> RawBaseStation {
        let point = Geodetic::from_degrees(base.lat_deg, base.lon_deg, base.height_m);
        let still = |_| ecef(&point).0;
        let mut receiver = Receiver::new(self.raw, 0, world, self.seed);
        let scene = Scene::open(self.raw.mask_deg * DEG);
        let epochs = receiver.epochs(world, &scene, self.clocks(0), [&still, &still], &|_| 0.0);
        slips.extend(receiver.slips());
        let off = c_ne(&point).tr_mul(&Vector3::from(base.told_off_m));
        let position = geodetic(&Ecef(ecef(&point).0 + off));
        RawBaseStation { position, is_surveyed: base.surveyed, epochs }
    }

    /// The tags of the receiver of one antenna, 0 for the base station, each with what its clock is then.
    fn clocks(&self, antenna: usize) -> impl Iterator<Item = (Time, Clock)> {
        // those that share an oscillator have that of the first of them
        let shared = self.raw.common_clock.iter().min().copied();
        let oscillator =
            shared.filter(|_| self.raw.common_clock.contains(&antenna)).unwrap_or(antenna);
        let clock = Clock::new(self.raw, oscillator as u64, self.seed);
        let (dt, seed) = (1.0 / self.raw.rate_hz, self.seed);
        let mut leaves = own_clock(&self.raw.antenna_fault, antenna);
        epochs(self.raw.rate_hz, 1, self.duration).scan(clock, move |clock, tag| {
            if let Some((_, faster)) = leaves.take_if(|(t, _)| tag.as_seconds() > *t) {
                *clock = clock.apart(antenna as u64, faster, seed);
            }
            clock.advance(dt);
            Some((tag, clock.clone()))
        })
    }
}
