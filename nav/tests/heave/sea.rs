//! A sea of many waves, and a ship that follows it.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const GRAVITY: f64 = 9.81;
/// Waves of each system.
const COMPONENTS: usize = 60;
/// Length over which the hull averages the slope of the waves, m.
const HULL: f64 = 60.0;
/// Natural period of roll, s, and its damping.
const ROLL: (f64, f64) = (9.0, 0.1);

/// One system of waves: significant height, m, and period of the peak, s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct System {
    pub(crate) height: f64,
    pub(crate) peak: f64,
    /// Peak enhancement of the JONSWAP spectrum.
    pub(crate) gamma: f64,
}

impl System {
    pub(crate) fn new(height: f64, peak: f64) -> Self {
        System { height, peak, gamma: 3.3 }
    }
}

#[derive(Clone, Copy, Debug)]
struct Wave {
    omega: f64,
    amplitude: f64,
    phase: f64,
    pitch: f64,
    roll: f64,
    roll_phase: f64,
}

/// A realisation of the sea.
#[derive(Clone, Debug)]
pub(crate) struct Sea(Vec<Wave>);

/// How the ship moves: heave, up, m; its rate; roll and pitch, rad.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Move {
    pub(crate) heave: f64,
    pub(crate) rate: f64,
    pub(crate) roll: f64,
    pub(crate) pitch: f64,
}

impl Move {
    /// Direction of down in body axes.
    pub(crate) fn down_b(&self) -> Vector3<f64> {
        let (sr, cr) = self.roll.sin_cos();
        let (sp, cp) = self.pitch.sin_cos();
        Vector3::new(-sp, cp * sr, cp * cr)
    }
}

impl Sea {
    pub(crate) fn new(systems: &[System], seed: u64) -> Self {
        let mut rng = Pcg64::seed_from_u64(seed);
        let of = |system: &System| waves(system, &mut rng);
        Sea(systems.iter().flat_map(of).collect())
    }

    /// The ship at `t`, s.
    pub(crate) fn at(&self, t: f64) -> Move {
        let mut ship = Move::default();
        for wave in &self.0 {
            let phase = wave.omega * t + wave.phase;
            let (sin, cos) = phase.sin_cos();
            ship.heave += wave.amplitude * cos;
            ship.rate -= wave.amplitude * wave.omega * sin;
            ship.pitch += wave.pitch * sin;
            ship.roll += wave.roll * (phase + wave.roll_phase).sin();
        }
        ship
    }
}

/// Bands of equal energy of a JONSWAP spectrum, one wave in each.
fn waves(system: &System, rng: &mut Pcg64) -> Vec<Wave> {
    const GRID: usize = 2000;
    let ratio = |i: usize| 0.5 + 3.5 * i as f64 / GRID as f64;
    let mut energy = vec![0.0];
    for i in 1..=GRID {
        let sum = energy[i - 1] + jonswap(ratio(i), system.gamma);
        energy.push(sum);
    }
    let total = energy[GRID];
    let amplitude = system.height / 4.0 * (2.0 / COMPONENTS as f64).sqrt();
    let draw = |band: usize| {
        let share = (band as f64 + rng.random::<f64>()) / COMPONENTS as f64;
        let index = energy.partition_point(|e| e / total < share).min(GRID);
        let omega = TAU / system.peak * ratio(index);
        let number = omega * omega / GRAVITY;
        let hull = (-(number * HULL / 2.0).powi(2) / 6.0).exp();
        let r = omega * ROLL.0 / TAU;
        let resonance = 1.0 / ((1.0 - r * r).hypot(2.0 * ROLL.1 * r));
        Wave {
            omega,
            amplitude,
            phase: TAU * rng.random::<f64>(),
            pitch: amplitude * number * hull,
            roll: 0.3 * amplitude * number * hull * resonance,
            roll_phase: TAU * rng.random::<f64>(),
        }
    };
    (0..COMPONENTS).map(draw).collect()
}

/// The shape of the JONSWAP spectrum at a frequency over that of the peak.
fn jonswap(x: f64, gamma: f64) -> f64 {
    let width = if x <= 1.0 { 0.07 } else { 0.09 };
    let enhancement = (-(x - 1.0).powi(2) / (2.0 * width * width)).exp();
    x.powi(-5) * (-1.25 * x.powi(-4)).exp() * gamma.powf(enhancement)
}
