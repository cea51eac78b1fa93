//! A receiver with its antenna.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use insd_base::satellites::{
    Constellation, SPEED_OF_LIGHT, SatelliteEpoch, SatelliteId, SignalObservation,
};
use insd_base::units::wrap_pi;
use insd_base::{GpsTime, Span, Time};
use nalgebra::Vector3;
use rand_pcg::Pcg64;

use super::channel::{Channel, Heard, Source};
use super::clock::Clock;
use super::faults::{Effect, SatelliteFault};
use super::installation::loss;
use super::path::{Air, Path, Site, ray};
use super::satellite::Satellite;
use super::scene::{Reception, Scene};
use super::truth::InjectedSlip;
use crate::random::{Purpose, normal, numbered};
use crate::scenario::Raw;

/// Half the time over which rates are differences of ranges, s. The jerk of a mast in a seaway makes 1e-5 m/s of it, the 53 bits of
/// a range 1e-6 m/s.
const STEP: f64 = 0.01;

/// GPS - UTC, s, that receivers tell.
const LEAP_SECONDS: i8 = 18;

/// What is the same for all receivers.
#[derive(Debug)]
pub(crate) struct World {
    /// GPS time of the start.
    pub(crate) start: GpsTime,
    /// The satellites.
    pub(crate) satellites: Vec<Satellite>,
    /// The air below them.
    pub(crate) air: Air,
    /// What they do that nobody is told.
    pub(crate) faults: Vec<SatelliteFault>,
}

/// How antennas move: position, ECEF, m, at time t, s.
pub(crate) type Motion<'a> = &'a dyn Fn(f64) -> Vector3<f64>;

/// A receiver.
#[derive(Debug)]
pub(crate) struct Receiver<'a> {
    raw: &'a Raw,
    /// Number of its antenna, 0 for the base station.
    antenna: usize,
    channels: BTreeMap<SatelliteId, Channel>,
    /// Offset of each constellation, m.
    offsets: BTreeMap<Constellation, f64>,
    /// Delay of the phase in its line, m.
    line: f64,
    line_rng: Pcg64,
    /// How often the antenna has turned so far, clockwise as seen from above, and how it lay at the newest epoch, rad.
    turns: (f64, Option<f64>),
    slips: Vec<InjectedSlip>,
}

/// One instant of a receiver: an antenna shortly before, then, and shortly after.
struct Moment {
    t: f64,
    sites: [Site; 3],
    source: Source,
}

impl<'a> Receiver<'a> {
    /// The receiver of one antenna.
    pub(crate) fn new(raw: &'a Raw, antenna: usize, world: &World, seed: u64) -> Self {
        let channel = |satellite: &Satellite| {
            let id = satellite.id();
            (id, Channel::new(raw, id, satellite.group_delays(), antenna, seed))
        };
        let offset = |constellation: Constellation| {
            let number = 200_000 + antenna as u64 * 1000 + constellation as u64;
            let mut rng = numbered(seed, Purpose::RawConstant, number);
            (constellation, raw.constellation_offset_std_m * normal(&mut rng))
        };
        Receiver {
            raw,
            antenna,
            channels: world.satellites.iter().map(channel).collect(),
            offsets: [Constellation::Galileo, Constellation::BeiDou].map(offset).into(),
            line: 0.0,
            line_rng: numbered(seed, Purpose::RawConstant, 300_000 + antenna as u64),
            turns: (0.0, None),
            slips: Vec::new(),
        }
    }

    /// All epochs at the tags `tags`, each with its clock, s and m; those without a satellite are absent.
    ///
    /// `own` moves as the antenna does, `first` as the ship's first antenna: it is that one's ranges that a spoofer sends to all. `heading`: how the
    /// antenna lies, rad, at time t, s.
    pub(crate) fn epochs(
        &mut self,
        world: &World,
        scene: &Scene,
        clocks: impl Iterator<Item = (Time, Clock)>,
        [own, first]: [Motion<'_>; 2],
        heading: &dyn Fn(f64) -> f64,
    ) -> Vec<SatelliteEpoch> {
        let mut epochs = Vec::new();
        for (tag, clock) in clocks {
            let t = tag.as_seconds();
            let moment = self.moment(t, t - clock.bias / SPEED_OF_LIGHT, scene, [own, first]);
            self.turn(heading(t));
            self.line += self.raw.line_bias_walk_m_sqrt_s / self.raw.rate_hz.sqrt()
                * normal(&mut self.line_rng);
            let heard = world.satellites.iter();
            let signals: Vec<_> =
                heard.flat_map(|own| self.receive(world, scene, own, &moment, &clock)).collect();
            if !signals.is_empty() {
                epochs.push(SatelliteEpoch {
                    tag: world.start.plus(Span::from_nanos(tag.as_nanos())),
                    signals,
                    leap_seconds: Some(LEAP_SECONDS),
                    clock_reset: clock.was_set,
                });
            }
        }
        epochs
    }

    fn turn(&mut self, heading: f64) {
        let (turns, before) = self.turns;
        let turned = before.map_or(0.0, |before| wrap_pi(heading - before));
        self.turns = (turns + turned / TAU, Some(heading));
    }

    /// The slips that happened.
    pub(crate) fn slips(self) -> Vec<InjectedSlip> {
        self.slips
    }

    /// The moment of the tag `t` that is truly `instant`, s.
    fn moment(&self, t: f64, instant: f64, scene: &Scene, [own, first]: [Motion<'_>; 2]) -> Moment {
        let instants = [instant - STEP, instant, instant + STEP];
        let Some(spoof) = scene.spoof(t) else {
            return Moment {
                t,
                sites: instants.map(|at| Site::new(at, own(at))),
                source: Source::Direct,
            };
        };
        let bearing = spoof.direction_deg.to_radians();
        let pulled = |at: f64| {
            let position = first(at);
            let way =
                Site::new(at, position).direction(bearing) * (spoof.speed_mps * (at - spoof.t0_s));
            Site::new(at, position + way)
        };
        let source = Source::Spoofed { unbroken: self.antenna == 1 };
        Moment { t, sites: instants.map(pulled), source }
    }

    /// What is received of one satellite.
    fn receive(
        &mut self,
        world: &World,
        scene: &Scene,
        satellite: &Satellite,
        moment: &Moment,
        clock: &Clock,
    ) -> Vec<SignalObservation> {
        let id = satellite.id();
        let Some(channel) = self.channels.get_mut(&id) else { return Vec::new() };
        let now = ray(satellite, &moment.sites[1]);
        let reception = scene.reception(id, &now, moment.t);
        let (source, reflector) = match reception {
            Reception::Hidden => {
                channel.lose();
                return Vec::new();
            }
            Reception::Direct => (moment.source, None),
            Reception::Reflected(reflector) => (Source::Reflected, Some(reflector)),
        };
        let paths = moment.sites.map(|site| {
            let Path { range, ionosphere } = world.air.path(id, &site, &ray(satellite, &site));
            [range + reflector.map_or(0.0, |own| own.detour(&site)), ionosphere]
        });
        let rate = |kind: usize| (paths[2][kind] - paths[0][kind]) / (2.0 * STEP);
        let offset = self.offsets.get(&id.constellation).copied().unwrap_or(0.0);
        let spoofed = scene.spoof(moment.t).map_or(0.0, |spoof| spoof.clock_m);
        let heard = Heard {
            t: moment.t,
            source,
            elevation: now.elevation,
            range: [paths[1][0] + clock.bias + offset + spoofed, rate(0) + clock.drift],
            ionosphere: [paths[1][1], rate(1)],
            line: self.line,
            turns: self.turns.0,
            effect: effect(&world.faults, id, moment.t),
            multipath: scene.multipath(moment.t),
            weaker: loss(&self.raw.antenna_fault, self.antenna, moment.t),
        };
        if heard.is_too_weak() {
            channel.lose();
            return Vec::new();
        }
        channel.observe(self.raw, &heard, &mut self.slips)
    }
}

/// What all faults of a satellite add at time `t`, s.
fn effect(faults: &[SatelliteFault], id: SatelliteId, t: f64) -> Effect {
    let own = faults.iter().filter(|fault| fault.satellite() == id).map(|fault| fault.effect(t));
    own.fold(Effect::default(), |a, b| Effect {
        code: a.code + b.code,
        phase: a.phase + b.phase,
        rate: a.rate + b.rate,
    })
}
