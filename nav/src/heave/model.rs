//! What the bank makes of all it may meet: the sea, noise and drift of the accelerometer, a gap.
//!
//! The error of the estimate y_last + c h is e_0 - c h, with e_0 the heave less y_last and h what the
//! sections took away. An [`Errors`] is the covariance of (h, e_0). It need not be derived: the bank is
//! shown waves, an impulse and a step of the acceleration from the moment it starts, and its answers are
//! the covariance, in the transient as in the steady state:
//!
//! - waves of random phase and amplitude sqrt(2 S): S (e_cos e_cos^T + e_sin e_sin^T);
//! - white noise of density N: N^2 times the integral of e_v e_v^T, e_v the response to a step of the
//!   velocity (Gelb, Applied Optimal Estimation, chapter 3); a random walk of the acceleration likewise
//!   with the response to a step of the acceleration.

use std::f64::consts::TAU;

use nalgebra::SMatrix;

use super::bank::{Bank, Chain, Kick, SIGNALS, Signals, TAKEN};
use super::times::TICK;

/// Covariance of what the bank took away and of the error of what it left.
pub(super) type Errors = SMatrix<f64, SIGNALS, SIGNALS>;

/// Waves that are shown to the bank.
const WAVES: usize = 14;
/// Shortest and longest period of them, s.
const PERIODS: (f64, f64) = (3.0, 25.0);
/// Changes of the velocity that stand for a gap.
const MISSED: usize = 4;
/// Time after which the bank has forgotten how it started, s.
const FORGOTTEN: f64 = 300.0;

/// An oscillation that is shown to the bank.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wave {
    omega: f64,
    power: f64,
    cosine: Chain,
    sine: Chain,
}

impl Wave {
    /// The waves: as much power in each octave as the wave is long, one square metre in all.
    fn all() -> [Wave; WAVES] {
        let ratio = (PERIODS.1 / PERIODS.0).powf(1.0 / (WAVES - 1) as f64);
        let period = |i: usize| PERIODS.0 * ratio.powi(i as i32);
        let sum: f64 = (0..WAVES).map(period).sum();
        std::array::from_fn(|i| Wave {
            omega: TAU / period(i),
            power: period(i) / sum,
            cosine: Chain::default(),
            sine: Chain::default(),
        })
    }

    /// One more tick from `age` on; its share of the covariance.
    fn step(&mut self, bank: &Bank, age: f64) -> Errors {
        let (sin, cos) = (self.omega * age).sin_cos();
        let (sin_next, cos_next) = (self.omega * (age + TICK)).sin_cos();
        let kick = |from: (f64, f64), to: (f64, f64)| Kick {
            velocity: to.1 - from.1,
            displacement: to.0 - from.0 - from.1 * TICK,
        };
        let omega = self.omega;
        let along = kick((cos, -omega * sin), (cos_next, -omega * sin_next));
        let across = kick((sin, omega * cos), (sin_next, omega * cos_next));
        let cosine = error_of(&bank.step(&mut self.cosine, along), cos_next);
        let sine = error_of(&bank.step(&mut self.sine, across), sin_next);
        (cosine * cosine.transpose() + sine * sine.transpose()) * self.power
    }
}

/// The signals with the error of the last in its place.
pub(super) fn error_of(signals: &Signals, heave: f64) -> Signals {
    let mut error = *signals;
    error[TAKEN] = heave - signals[TAKEN];
    error
}

/// An unknown change of the velocity at a known instant: the bank's response to 1 m/s, and its 1-sigma.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Missed {
    chain: Chain,
    response: Signals,
    sigma: f64,
}

impl Missed {
    /// What was missed so many ticks ago.
    fn new(bank: &Bank, sigma: f64, ago: usize) -> Self {
        let mut missed = Missed { chain: Chain::default(), response: Signals::zeros(), sigma };
        missed.step(bank, at_once(true));
        (0..ago).for_each(|_| missed.step(bank, at_once(false)));
        missed
    }

    fn step(&mut self, bank: &Bank, kick: Kick) {
        self.response = error_of(&bank.step(&mut self.chain, kick), 0.0);
    }

    fn covariance(&self) -> Errors {
        let scaled = self.response * self.sigma;
        scaled * scaled.transpose()
    }
}

/// What a gap hides, as changes of the velocity at even distances in it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Gap {
    missed: [Missed; MISSED],
    age: f64,
}

/// The covariances, growing until the bank has forgotten its start.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Model {
    age: f64,
    waves: [Wave; WAVES],
    impulse: Chain,
    step: Chain,
    gap: Option<Gap>,
    /// For a sea of one square metre.
    pub(super) sea: Errors,
    /// For white noise of density 1 (m/s)/sqrt(s).
    pub(super) noise: Errors,
    /// For a random walk of the acceleration of 1 m/s^2/sqrt(s).
    pub(super) walk: Errors,
    /// For a constant error of the acceleration of 1 m/s^2 since the start: its response.
    pub(super) constant: Signals,
}

impl Model {
    pub(super) fn new() -> Self {
        Model {
            age: 0.0,
            waves: Wave::all(),
            impulse: Chain::default(),
            step: Chain::default(),
            gap: None,
            sea: Errors::zeros(),
            noise: Errors::zeros(),
            walk: Errors::zeros(),
            constant: Signals::zeros(),
        }
    }

    /// Time since the start, s.
    pub(super) fn age(&self) -> f64 {
        self.age
    }

    /// One more tick.
    pub(super) fn advance(&mut self, bank: &Bank) {
        self.advance_gap(bank);
        if self.age < FORGOTTEN {
            self.advance_start(bank);
        } else {
            self.constant = Signals::zeros();
        }
        self.age += TICK;
    }

    fn advance_start(&mut self, bank: &Bank) {
        let age = self.age;
        self.sea = self.waves.iter_mut().map(|wave| wave.step(bank, age)).sum();
        let respond = |chain: &mut Chain, kick: Kick| error_of(&bank.step(chain, kick), 0.0);
        let impulse = respond(&mut self.impulse, at_once(age == 0.0));
        let ramp = Kick { velocity: TICK, displacement: 0.5 * TICK * TICK };
        self.constant = respond(&mut self.step, ramp);
        self.noise += impulse * impulse.transpose() * TICK;
        self.walk += self.constant * self.constant.transpose() * TICK;
    }

    fn advance_gap(&mut self, bank: &Bank) {
        let Some(gap) = &mut self.gap else { return };
        gap.missed.iter_mut().for_each(|missed| missed.step(bank, at_once(false)));
        gap.age += TICK;
        if gap.age > FORGOTTEN {
            self.gap = None;
        }
    }

    /// A gap of `length` seconds has just ended, which hides an unknown change of the velocity, 1-sigma
    /// m/s. What an earlier gap hid is taken to have been in this one.
    pub(super) fn gap(&mut self, bank: &Bank, velocity: f64, length: f64) {
        let sigma = velocity / (MISSED as f64).sqrt();
        let before = self.gap.map_or(0.0, |gap| gap.missed[0].sigma);
        let ago = |i: usize| (length * (i as f64 + 0.5) / MISSED as f64 / TICK) as usize;
        let missed = |i: usize| Missed::new(bank, sigma.hypot(before), ago(i));
        self.gap = Some(Gap { missed: std::array::from_fn(missed), age: 0.0 });
    }

    /// Covariance for what happened at known instants: a constant error of the acceleration, 1-sigma
    /// m/s^2, that has been there since the start, and the last gap.
    pub(super) fn known(&self, constant: f64) -> Errors {
        let start = self.constant * constant;
        let missed = self.gap.iter().flat_map(|gap| &gap.missed);
        start * start.transpose() + missed.map(Missed::covariance).sum::<Errors>()
    }
}

/// A step of the velocity by 1 m/s at the beginning of a tick, if `now`.
fn at_once(now: bool) -> Kick {
    if now {
        Kick { velocity: 1.0, displacement: TICK }
    } else {
        Kick { velocity: 0.0, displacement: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(seconds: f64) -> Model {
        let (bank, mut model) = (Bank::new(), Model::new());
        (0..(seconds / TICK) as usize).for_each(|_| model.advance(&bank));
        model
    }

    #[test]
    fn the_bank_forgets_how_it_started() {
        let (settled, later) = (after(260.0), after(300.0));
        let change = (settled.sea - later.sea).amax() / later.sea.amax();
        assert!(change < 1e-3, "{change}");
        assert!(later.constant.amax() < 0.5, "{}", later.constant);
    }

    #[test]
    fn the_covariance_of_noise_is_that_of_many_trials() {
        use rand::SeedableRng;
        use rand_distr::{Distribution, StandardNormal};
        let (bank, model) = (Bank::new(), after(300.0));
        let mut rng = rand_pcg::Pcg64::seed_from_u64(1);
        let mut chain = Chain::default();
        let mut sum = Errors::zeros();
        let count = 200_000;
        for _ in 0..count {
            let draw: f64 = StandardNormal.sample(&mut rng);
            let velocity = draw * TICK.sqrt();
            let kick = Kick { velocity, displacement: velocity * TICK };
            let error = error_of(&bank.step(&mut chain, kick), 0.0);
            sum += error * error.transpose() / f64::from(count);
        }
        for i in 0..SIGNALS {
            let ratio = sum[(i, i)] / model.noise[(i, i)];
            assert!((ratio - 1.0).abs() < 0.15, "{i}: {ratio}");
        }
    }

    #[test]
    fn a_gap_is_remembered_for_five_minutes() {
        let (bank, mut model) = (Bank::new(), after(300.0));
        model.gap(&bank, 0.1, 1.0);
        model.advance(&bank);
        assert!(model.known(0.0).amax() > 1e-4);
        (0..3100).for_each(|_| model.advance(&bank));
        assert!(model.known(0.0).amax() == 0.0);
    }
}
