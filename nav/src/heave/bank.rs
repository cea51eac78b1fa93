//! A bank of high-passes in a chain.
//!
//! The chain begins with a resonance and a pole that pass what is faster than a minute; each further
//! section takes away a little more of what is slow:
//!
//! y_0 = s^3 / ((s^2 + 2 zeta omega s + omega^2)(s + p)) r,
//! y_i = s^2 / (s^2 + 2 zeta_i omega_i s + omega_i^2) y_{i-1}   or   s / (s + p_i) y_{i-1}.
//!
//! r is the twice integrated acceleration, which is off by a parabola and a random walk. The bank gives
//! the last y and what each section took away, its band-pass and low-pass parts. The last y with any
//! weighed sum of these is a high-pass with three zeros at frequency zero, so that a constant error of the
//! acceleration leaves nothing, and passes fast motion as it is.
//!
//! The constants were found by minimising the mean logarithm of the best sum's error over its limit, for
//! spectra of Hs 0.9 to 5 m and Tp 5 to 20 s and IMUs of three grades. They are not critical: a chain of
//! ten equal poles of 10 s does nearly as well, but its weights are in the thousands.

use std::f64::consts::TAU;

use nalgebra::{Matrix2, SVector, Vector2};

use super::times::TICK;

/// Signals that the bank makes of one input: what the sections took away, and last what they left.
pub(super) const SIGNALS: usize = 2 * RESONANCES.len() + POLES.len() + 1;
/// What the sections took away.
pub(super) const TAKEN: usize = SIGNALS - 1;

/// All signals of the bank.
pub(super) type Signals = SVector<f64, SIGNALS>;

/// Period, s, and damping of the first section.
const FIRST: (f64, f64) = (47.5, 0.51);
/// Time constant of the second, s.
const SECOND: f64 = 42.7;
/// Periods, s, and dampings of the resonances that follow.
const RESONANCES: [(f64, f64); 3] = [(37.2, 0.15), (33.0, 0.68), (19.6, 0.11)];
/// Time constants of the poles that follow, s.
const POLES: [f64; 5] = [0.5; 5];

/// What a tick adds to the motion of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Kick {
    /// Increment of its velocity.
    pub(super) velocity: f64,
    /// What this increment, as it grew, added to the displacement over the tick.
    pub(super) displacement: f64,
}

/// The first section: a resonance driven by acceleration.
///
/// x'' + 2 zeta omega x' + omega^2 x = a, so that x = s^2 / (...) r. Over a tick the response to an
/// impulse is close to a straight line, so that the two moments of the acceleration are enough.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Entry {
    transition: Matrix2<f64>,
    /// Response of x to the displacement of a kick.
    displacement: f64,
    /// Response of x' to the displacement of a kick; that to its velocity is one.
    decay: f64,
}

impl Entry {
    fn new() -> Self {
        let (omega, damping) = (TAU / FIRST.0, FIRST.1);
        let (decay, ringing) = (damping * omega, omega * (1.0 - damping * damping).sqrt());
        let fade = (-decay * TICK).exp();
        let (s, c) = (ringing * TICK).sin_cos();
        let impulse = Vector2::new(s / ringing, c - decay * s / ringing) * fade;
        let held = fade * (c + decay * s / ringing);
        let transition = Matrix2::new(held, impulse.x, -omega * omega * impulse.x, impulse.y);
        Entry { transition, displacement: impulse.x / TICK, decay: (impulse.y - 1.0) / TICK }
    }

    fn step(&self, x: &mut Vector2<f64>, kick: Kick) -> f64 {
        *x = self.transition * *x;
        x.x += self.displacement * kick.displacement;
        x.y += kick.velocity + self.decay * kick.displacement;
        x.x
    }
}

/// A resonance with trapezoidal integrators (Zavalishin, The Art of VA Filter Design, chapter 4).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Resonance {
    half_step: f64,
    damping: f64,
}

impl Resonance {
    fn new((period, damping): (f64, f64)) -> Self {
        Resonance { half_step: 0.5 * TICK * TAU / period, damping }
    }

    /// What is left of `input`, and the band-pass and low-pass parts that were taken away.
    fn step(&self, state: &mut [f64; 2], input: f64) -> (f64, [f64; 2]) {
        let (g, double) = (self.half_step, 2.0 * self.damping);
        let left = (input - (double + g) * state[0] - state[1]) / (1.0 + double * g + g * g);
        let band = g * left + state[0];
        let low = g * band + state[1];
        *state = [band + g * left, low + g * band];
        (left, [double * band, low])
    }
}

/// A first-order high-pass with a trapezoidal integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pole {
    gain: f64,
}

impl Pole {
    fn new(time: f64) -> Self {
        let half_step = 0.5 * TICK / time;
        Pole { gain: half_step / (1.0 + half_step) }
    }

    /// What is left of `input`, and what was taken away.
    fn step(&self, state: &mut f64, input: f64) -> (f64, f64) {
        let change = (input - *state) * self.gain;
        let low = change + *state;
        *state = low + change;
        (input - low, low)
    }
}

/// The coefficients of the bank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bank {
    entry: Entry,
    second: Pole,
    resonances: [Resonance; RESONANCES.len()],
    poles: [Pole; POLES.len()],
}

/// Where the bank stands with one input.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub(super) struct Chain {
    entry: Vector2<f64>,
    second: f64,
    resonances: [[f64; 2]; RESONANCES.len()],
    poles: [f64; POLES.len()],
}

impl Bank {
    pub(super) fn new() -> Self {
        Bank {
            entry: Entry::new(),
            second: Pole::new(SECOND),
            resonances: RESONANCES.map(Resonance::new),
            poles: POLES.map(Pole::new),
        }
    }

    /// The signals after one more tick of an input.
    pub(super) fn step(&self, chain: &mut Chain, kick: Kick) -> Signals {
        let mut signals = Signals::zeros();
        let entered = self.entry.step(&mut chain.entry, kick);
        let (mut left, _) = self.second.step(&mut chain.second, entered);
        let mut next = 0;
        let mut put = |taken: f64| {
            signals[next] = taken;
            next += 1;
        };
        for (resonance, state) in self.resonances.iter().zip(&mut chain.resonances) {
            let (rest, taken) = resonance.step(state, left);
            left = rest;
            taken.into_iter().for_each(&mut put);
        }
        for (pole, state) in self.poles.iter().zip(&mut chain.poles) {
            let (rest, taken) = pole.step(state, left);
            left = rest;
            put(taken);
        }
        signals[TAKEN] = left;
        signals
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The signals `seconds` after the start of a motion given by its displacement and velocity.
    fn signals(seconds: f64, motion: impl Fn(f64) -> (f64, f64)) -> Signals {
        let (bank, mut chain) = (Bank::new(), Chain::default());
        let mut signals = Signals::zeros();
        for i in 0..(seconds / TICK) as usize {
            let (from, to) = (motion(i as f64 * TICK), motion((i + 1) as f64 * TICK));
            let kick =
                Kick { velocity: to.1 - from.1, displacement: to.0 - from.0 - from.1 * TICK };
            signals = bank.step(&mut chain, kick);
        }
        signals
    }

    #[test]
    fn a_constant_acceleration_leaves_nothing() {
        let left = signals(1500.0, |t| (0.5 * t * t, t));
        assert!(left.amax() < 1e-6, "{left}");
    }

    #[test]
    fn fast_motion_is_left_and_slow_motion_is_taken_away() {
        let of = |period: f64| {
            let omega = TAU / period;
            let motion = |t: f64| ((omega * t).sin(), omega * (omega * t).cos());
            let [early, late] = [600.0, 600.0 + 0.25 * period].map(|t| signals(t, motion)[TAKEN]);
            early.hypot(late)
        };
        assert!((of(0.4) - 1.0).abs() < 0.2, "{}", of(0.4));
        assert!(of(60.0) < 1e-4, "{}", of(60.0));
    }

    #[test]
    fn what_is_left_and_what_was_taken_away_is_what_entered() {
        let omega = TAU / 8.0;
        let motion = |t: f64| ((omega * t).sin(), omega * (omega * t).cos());
        let all: f64 = signals(600.0, motion).iter().sum();
        assert!((all - motion(600.0).0).abs() < 0.25, "{all}");
    }
}
