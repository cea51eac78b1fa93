//! Faults of the GNSS receiver as they fall in one voyage.

use nalgebra::Vector3;
use rand_pcg::Pcg64;

use insd_base::units::DEG;

use super::windows::{Window, draw, windows};
use crate::random::{Purpose, stream, uniform};
use crate::scenario::{Gnss, StdFault};

/// A pull away from the truth.
#[derive(Clone, Copy, Debug)]
struct Pull {
    window: Window,
    /// Horizontal unit vector, north, east, down.
    direction: Vector3<f64>,
    /// Speed at the beginning, m/s.
    speed: f64,
    /// m/s^2.
    acceleration: f64,
}

/// All faults of a voyage.
#[derive(Debug)]
pub(crate) struct GnssFaults {
    outages: Vec<(Window, bool)>,
    /// Offsets north, east, down, m.
    jumps: Vec<(Window, Vector3<f64>)>,
    /// Dilution of precision and satellites.
    spikes: Vec<(Window, f64, u16)>,
    spoofing: Vec<Pull>,
    stds: Vec<(Window, StdFault)>,
}

/// What is wrong at one epoch.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Trouble {
    /// No fix; whether the receiver sends nevertheless.
    pub(crate) outage: Option<bool>,
    /// Error of position, north, east, down, m.
    pub(crate) position: Vector3<f64>,
    /// Error of velocity, north, east, down, m/s.
    pub(crate) velocity: Vector3<f64>,
    /// Dilution of precision and satellites.
    pub(crate) spike: Option<(f64, u16)>,
    /// Unbelievable sigmas.
    pub(crate) std: Option<StdFault>,
}

impl GnssFaults {
    /// The faults of a scenario under a seed.
    pub(crate) fn new(gnss: &Gnss, seed: u64) -> Self {
        let mut rng = stream(seed, Purpose::GnssOutages);
        let outages = gnss.outages.iter().flat_map(|fault| {
            let spans = windows(&fault.when, fault.duration_s, &mut rng);
            spans.into_iter().map(|window| (window, fault.rows))
        });
        let outages = outages.collect();
        let mut rng = stream(seed, Purpose::GnssBadStds);
        let stds = gnss.bad_stds.iter().flat_map(|fault| {
            let spans = windows(&fault.when, fault.duration_s, &mut rng);
            spans.into_iter().map(|window| (window, fault.fault))
        });
        GnssFaults {
            outages,
            stds: stds.collect(),
            jumps: jumps(gnss, stream(seed, Purpose::GnssJumps)),
            spikes: spikes(gnss, stream(seed, Purpose::GnssDopSpikes)),
            spoofing: spoofing(gnss, stream(seed, Purpose::GnssSpoofing)),
        }
    }

    /// What is wrong at time `t`, s.
    pub(crate) fn at(&self, t: f64) -> Trouble {
        let mut trouble = Trouble {
            outage: self.outages.iter().find(|(w, _)| w.contains(t)).map(|(_, rows)| *rows),
            spike: self.spikes.iter().find(|(w, ..)| w.contains(t)).map(|(_, d, s)| (*d, *s)),
            std: self.stds.iter().find(|(w, _)| w.contains(t)).map(|(_, fault)| *fault),
            ..Trouble::default()
        };
        for (_, offset) in self.jumps.iter().filter(|(window, _)| window.contains(t)) {
            trouble.position += offset;
        }
        for pull in self.spoofing.iter().filter(|pull| pull.window.contains(t)) {
            let since = t - pull.window.start;
            trouble.position +=
                pull.direction * (since * (pull.speed + pull.acceleration * since / 2.0));
            trouble.velocity += pull.direction * (pull.speed + pull.acceleration * since);
        }
        trouble
    }
}

fn horizontal(direction: f64) -> Vector3<f64> {
    Vector3::new(direction.cos(), direction.sin(), 0.0)
}

fn jumps(gnss: &Gnss, mut rng: Pcg64) -> Vec<(Window, Vector3<f64>)> {
    let mut all = Vec::new();
    for jump in &gnss.jumps {
        for window in windows(&jump.when, jump.duration_s, &mut rng) {
            let direction = horizontal(uniform(&mut rng, 0.0, 360.0) * DEG);
            let random = jump.size_m.map(|size| direction * draw(size, &mut rng));
            all.push((window, random.unwrap_or(Vector3::from(jump.offset_m.unwrap_or_default()))));
        }
    }
    all
}

fn spikes(gnss: &Gnss, mut rng: Pcg64) -> Vec<(Window, f64, u16)> {
    let mut all = Vec::new();
    for spike in &gnss.dop_spikes {
        for window in windows(&spike.when, spike.duration_s, &mut rng) {
            let hdop = draw(spike.hdop, &mut rng);
            all.push((window, hdop, uniform(&mut rng, 4.0, 8.0) as u16));
        }
    }
    all
}

fn spoofing(gnss: &Gnss, mut rng: Pcg64) -> Vec<Pull> {
    let mut all = Vec::new();
    for fault in &gnss.spoofing {
        for window in windows(&fault.when, fault.duration_s, &mut rng) {
            let random = uniform(&mut rng, 0.0, 360.0);
            all.push(Pull {
                window,
                direction: horizontal(fault.direction_deg.unwrap_or(random) * DEG),
                speed: draw(fault.speed_mps, &mut rng),
                acceleration: draw(fault.acceleration_mps2, &mut rng),
            });
        }
    }
    all
}
