//! What leaves and cheap antennas do to a rover, laid over sound epochs: errors that last, satellites that come and go, slips told and untold.

use std::collections::BTreeMap;

use super::random::Random;
use insd_base::{GpsTime, SatelliteEpoch, SatelliteId, SignalCode, SignalObservation};

/// A signal as it is damaged.
#[derive(Clone, Copy, Default)]
struct Track {
    code: f64,
    phase: f64,
    is_open: bool,
    is_poor: bool,
    cycles: f64,
    lock: f64,
}

/// Damages epoch after epoch.
pub(crate) struct Damage {
    random: Random,
    tracks: BTreeMap<(SatelliteId, SignalCode), Track>,
    before: Option<GpsTime>,
    /// How long errors last, s.
    lasts: f64,
}

impl Damage {
    pub(crate) fn new(seed: u64, lasts: f64) -> Self {
        Self { random: Random(seed * 7919 + 17), tracks: BTreeMap::new(), before: None, lasts }
    }

    /// Codes 0.8 m and phases 6 mm worse; a satellite goes in one of ten epochs and comes back in one of five; every fifth comes back poor, with 2.4 m,
    /// 2 cm and 6 dB less. Phases that come back are counted from elsewhere: told by the flag in four of five, by the time of lock always; one of
    /// two hundred is off by half a cycle without a word.
    pub(crate) fn done_to(&mut self, rover: &SatelliteEpoch) -> SatelliteEpoch {
        let elapsed = self.before.map_or(1.0, |before| rover.tag.since(before).as_seconds());
        self.before = Some(rover.tag);
        let mut damaged = rover.clone();
        let mut open: BTreeMap<SatelliteId, bool> = BTreeMap::new();
        for signal in &mut damaged.signals {
            let sound = Track { is_open: true, ..Track::default() };
            let track = self.tracks.entry((signal.satellite, signal.signal)).or_insert(sound);
            let chance = if track.is_open { 0.9 } else { 0.2 };
            let random = &mut self.random;
            let is_open =
                *open.entry(signal.satellite).or_insert_with(|| random.uniform() < chance);
            track.go_on(random, (-elapsed / self.lasts).exp());
            if is_open && !track.is_open {
                track.come_back(random);
                signal.slip = random.uniform() > 0.2;
            }
            track.is_open = is_open;
            track.lock += elapsed;
            track.spoil(signal);
        }
        damaged
    }
}

impl Track {
    fn go_on(&mut self, random: &mut Random, last: f64) {
        let (code, phase) = if self.is_poor { (2.4, 0.02) } else { (0.8, 0.006) };
        let new = (1.0 - last * last).sqrt();
        self.code = last * self.code + new * code * random.gauss();
        self.phase = last * self.phase + new * phase * random.gauss();
    }

    fn come_back(&mut self, random: &mut Random) {
        self.is_poor = random.uniform() < 0.2;
        self.cycles = (random.uniform() * 40.0 - 20.0).round();
        if random.uniform() < 0.005 {
            self.cycles += 0.5;
        }
        self.lock = 0.0;
    }

    fn spoil(&self, signal: &mut SignalObservation) {
        let wavelength = signal.wavelength().unwrap_or(0.19);
        signal.lock = Some(self.lock);
        signal.code = signal.code.filter(|_| self.is_open).map(|code| code + self.code);
        signal.phase = signal
            .phase
            .filter(|_| self.is_open)
            .map(|phase| phase + self.cycles + self.phase / wavelength);
        if self.is_poor {
            signal.cn0 = signal.cn0.map(|cn0| cn0 - 6.0);
        }
    }
}
