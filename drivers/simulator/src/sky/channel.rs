//! One satellite in one receiver: its phase arcs, its noise, its multipath.

use insd_base::satellites::{SatelliteId, SignalObservation};
use nalgebra::Vector3;
use rand_pcg::Pcg64;

use super::constellation::number;
use super::faults::Effect;
use super::installation::TRACKED_FROM;
use super::signals::{Signal, signals};
use super::truth::InjectedSlip;
use crate::random::{GaussMarkov, Purpose, normal, numbered, uniform};
use crate::scenario::Raw;

/// Chance at each epoch that the lock on a reflection is lost.
const REFLECTION_LOST: f64 = 0.3;
/// Largest integer by which the phase of a new arc is off.
const LARGEST_AMBIGUITY: f64 = 1e6;

/// Whose signal it is that is received.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// The satellite's.
    Direct,
    /// The satellite's, from a wall.
    Reflected,
    /// A spoofer's, who takes the carrier over without a break or not.
    Spoofed { unbroken: bool },
}

/// What reaches a receiver of one satellite, without noise; with its clock in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heard {
    /// The receiver's tag, s since the start.
    pub(crate) t: f64,
    /// Whose signal it is.
    pub(crate) source: Source,
    /// Elevation of the satellite, rad.
    pub(crate) elevation: f64,
    /// Pseudorange but for the ionosphere and the delays of single signals, m, and its rate, m/s.
    pub(crate) range: [f64; 2],
    /// Delay of the code on L1, m, and its rate, m/s.
    pub(crate) ionosphere: [f64; 2],
    /// Delay of the phase in the antenna's line, m.
    pub(crate) line: f64,
    /// How often the antenna has turned so far, clockwise as seen from above: each time adds a cycle (Wu et al. 1993).
    pub(crate) turns: f64,
    /// What a fault of the satellite adds.
    pub(crate) effect: Effect,
    /// How many times as large as stated multipath is.
    pub(crate) multipath: f64,
    /// By how much it is weaker than it should be, dB.
    pub(crate) weaker: f64,
}

impl Heard {
    /// Whether a receiver loses it.
    pub(crate) fn is_too_weak(&self) -> bool {
        strength(self, 1) < TRACKED_FROM
    }
}

/// A signal as it is tracked.
#[derive(Debug)]
struct Tracked {
    signal: Signal,
    /// Of satellite and line, cycles.
    constant: f64,
    /// Of the arc, an integer.
    ambiguity: f64,
    /// Whether the phase is half a cycle off while that is unresolved.
    is_half_off: bool,
    multipath: GaussMarkov,
}

/// A satellite in a receiver.
#[derive(Debug)]
pub(crate) struct Channel {
    id: SatelliteId,
    antenna: usize,
    tracked: Vec<Tracked>,
    noise: Pcg64,
    arcs: Pcg64,
    /// What was received at the epoch before.
    before: Option<Source>,
    /// Tag of the last epoch, s; before any, minus infinity.
    last: f64,
    /// Since when the phase is tracked without a loss of lock that the receiver knows of, s.
    since: f64,
    /// Until when half a cycle is unresolved, s.
    half_until: f64,
}

/// What a receiver tells of its lock.
#[derive(Clone, Copy, Debug)]
struct Lock {
    is_new: bool,
    is_half: bool,
    /// s.
    age: f64,
}

impl Channel {
    /// A satellite of these group delays, s, in the receiver of one antenna, 0 for the base station.
    pub(crate) fn new(
        raw: &Raw,
        id: SatelliteId,
        delays: [f64; 2],
        antenna: usize,
        seed: u64,
    ) -> Self {
        let own = antenna as u64 * 1000 + number(id);
        let tracked = |(index, signal): (u64, Signal)| {
            let satellite = numbered(seed, Purpose::RawConstant, number(id) * 10 + index);
            let kind = 100_000 + antenna as u64 * 1000 + id.constellation as u64 * 10 + index;
            let constant = [satellite, numbered(seed, Purpose::RawConstant, kind)];
            let std = Vector3::new(raw.multipath_code_std_m, raw.multipath_phase_std_m, 0.0);
            let rng = numbered(seed, Purpose::RawMultipath, own * 10 + index);
            Tracked {
                signal,
                constant: constant.map(|mut rng| uniform(&mut rng, 0.0, 1.0)).iter().sum(),
                ambiguity: 0.0,
                is_half_off: false,
                multipath: GaussMarkov::new(std, raw.multipath_time_constant_s, rng),
            }
        };
        let signals = signals(id, delays, raw.frequencies).into_iter();
        Channel {
            id,
            antenna,
            tracked: (0..).zip(signals).map(tracked).collect(),
            noise: numbered(seed, Purpose::RawNoise, own),
            arcs: numbered(seed, Purpose::RawArc, own),
            before: None,
            last: f64::NEG_INFINITY,
            since: f64::NEG_INFINITY,
            half_until: f64::NEG_INFINITY,
        }
    }

    /// Nothing was received at an epoch.
    pub(crate) fn lose(&mut self) {
        self.before = None;
    }

    /// The observations of an epoch. A slip that happens is put down.
    pub(crate) fn observe(
        &mut self,
        raw: &Raw,
        heard: &Heard,
        slips: &mut Vec<InjectedSlip>,
    ) -> Vec<SignalObservation> {
        let is_first = self.last == f64::NEG_INFINITY;
        let dt = if is_first { 0.0 } else { heard.t - self.last };
        self.last = heard.t;
        let is_lost = !self.holds(heard.source);
        self.before = Some(heard.source);
        let mut is_new = is_lost && !is_first;
        if is_lost {
            self.acquire(heard.t, raw.half_cycle_s);
        } else if let Some(slip) = self.slip(raw, heard.t) {
            is_new = slip.told;
            slips.push(slip);
        }
        if is_new {
            self.since = heard.t;
        }
        let is_half = heard.t < self.half_until;
        let lock = Lock { is_new, is_half, age: heard.t - self.since };
        let (id, noise) = (self.id, &mut self.noise);
        self.tracked.iter_mut().map(|own| own.observe(raw, id, heard, lock, dt, noise)).collect()
    }

    /// Whether the lock on the signal of the epoch before holds.
    fn holds(&mut self, source: Source) -> bool {
        match (self.before, source) {
            (Some(Source::Reflected), Source::Reflected) => {
                uniform(&mut self.arcs, 0.0, 1.0) >= REFLECTION_LOST
            }
            (Some(Source::Direct), Source::Spoofed { unbroken }) => unbroken,
            (before, source) => before == Some(source),
        }
    }

    /// Begins new arcs.
    fn acquire(&mut self, t: f64, half_cycle: f64) {
        (self.since, self.half_until) = (t, t + half_cycle);
        for own in &mut self.tracked {
            let largest = LARGEST_AMBIGUITY;
            own.ambiguity = uniform(&mut self.arcs, -largest, largest).round();
            own.is_half_off = uniform(&mut self.arcs, 0.0, 1.0) < 0.5;
        }
    }

    /// The slip of the first signal that happens at this epoch, if one does: mostly one cycle.
    fn slip(&mut self, raw: &Raw, t: f64) -> Option<InjectedSlip> {
        let [chance, size, sign, told] = std::array::from_fn(|_| uniform(&mut self.arcs, 0.0, 1.0));
        if chance >= raw.slips_per_hour / (3600.0 * raw.rate_hz) {
            return None;
        }
        let size = if size < 0.6 { 1 } else { 2 + ((size - 0.6) / 0.4 * 29.0) as i32 };
        let cycles = if sign < 0.5 { -size } else { size };
        self.tracked.first_mut()?.ambiguity += f64::from(cycles);
        let (antenna, satellite) = (self.antenna, self.id);
        Some(InjectedSlip { t_s: t, antenna, satellite, cycles, told: told < raw.slips_told })
    }
}

impl Tracked {
    /// The observation of this signal at an epoch that comes `dt`, s, after the one before.
    fn observe(
        &mut self,
        raw: &Raw,
        id: SatelliteId,
        heard: &Heard,
        lock: Lock,
        dt: f64,
        rng: &mut Pcg64,
    ) -> SignalObservation {
        let weight = weight(heard.elevation);
        let multipath = self.multipath.advance(dt) * (weight * heard.multipath);
        let Signal { code, wavelength, ionosphere, group_delay } = self.signal;
        let delay = heard.ionosphere.map(|delay| delay * ionosphere);
        let weaker = 10_f64.powf(heard.weaker / 20.0);
        let mut noise = |std: f64| std * weight * weaker * normal(rng);
        let range = heard.range[0] + delay[0] + group_delay + heard.effect.code + multipath.x;
        let phase = heard.range[0] - delay[0] + heard.effect.phase + heard.line + multipath.y;
        let rate = heard.range[1] - delay[1] + heard.effect.rate;
        let half = if lock.is_half && self.is_half_off { 0.5 } else { 0.0 };
        let cycles = (phase + noise(raw.phase_std_m)) / wavelength + half;
        SignalObservation {
            code: Some(range + noise(raw.code_std_m)),
            phase: Some(cycles + heard.turns + self.constant + self.ambiguity),
            doppler: Some(-(rate + noise(raw.doppler_std_mps)) / wavelength),
            cn0: Some(strength(heard, code.band) + 0.7 * normal(rng)),
            lock: Some(lock.age),
            half_cycle: lock.is_half,
            slip: lock.is_new,
            ..SignalObservation::unknown(id, code)
        }
    }
}

/// Factor on all noise: 1 at the zenith.
pub(crate) fn weight(elevation: f64) -> f64 {
    ((1.0 + elevation.sin().powi(-2)) / 2.0).sqrt()
}

/// Mean carrier to noise density, dB Hz: what a marine antenna gives; a second frequency is weaker, a reflection loses 10 dB.
fn strength(heard: &Heard, band: u8) -> f64 {
    let second = if band == 1 { 0.0 } else { -2.0 };
    let reflected = if heard.source == Source::Reflected { -10.0 } else { 0.0 };
    36.0 + 12.0 * heard.elevation.sin() + second + reflected - heard.weaker
}
