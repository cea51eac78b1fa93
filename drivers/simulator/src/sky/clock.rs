//! The clock of a receiver.

use insd_base::satellites::SPEED_OF_LIGHT;
use rand_pcg::Pcg64;

use crate::random::{Purpose, normal, numbered, uniform};
use crate::scenario::Raw;

/// By how much a receiver sets its clock, m.
const MILLISECOND: f64 = 1e-3 * SPEED_OF_LIGHT;

/// A clock whose bias and drift walk at random.
#[derive(Clone, Debug)]
pub(crate) struct Clock {
    /// Ahead of the time of GPS, m.
    pub(crate) bias: f64,
    /// Its rate, m/s.
    pub(crate) drift: f64,
    /// Whether it was set since the epoch before.
    pub(crate) was_set: bool,
    walks: [f64; 2],
    jumps: bool,
    rng: Pcg64,
}

impl Clock {
    /// The oscillator of one number.
    pub(crate) fn new(raw: &Raw, number: u64, seed: u64) -> Self {
        let mut rng = numbered(seed, Purpose::RawClock, number);
        let bias = raw.clock_offset_ms * MILLISECOND * uniform(&mut rng, -1.0, 1.0);
        let drift = raw.clock_drift_mps * normal(&mut rng);
        let walks = [raw.clock_bias_walk_m_sqrt_s, raw.clock_drift_walk_mps_sqrt_s];
        Clock { bias, drift, was_set: false, walks, jumps: raw.clock_jumps, rng }
    }

    /// An oscillator of its own for the receiver of one antenna, which goes on from this one, faster by `faster`, m/s.
    pub(crate) fn apart(&self, antenna: u64, faster: f64, seed: u64) -> Self {
        let rng = numbered(seed, Purpose::RawClock, 1000 + antenna);
        Clock { drift: self.drift + faster, rng, ..self.clone() }
    }

    /// Goes on by `dt`, s: both walks with the covariance that they have together, q_f [dt^3/3, dt^2/2; dt^2/2, dt] for the drift's.
    pub(crate) fn advance(&mut self, dt: f64) {
        let [first, second, third] = std::array::from_fn(|_| normal(&mut self.rng));
        let [bias_walk, drift_walk] = self.walks;
        let curve = dt.powf(1.5) * (first / 2.0 + second / 12.0_f64.sqrt());
        self.bias += self.drift * dt + drift_walk * curve + bias_walk * dt.sqrt() * third;
        self.drift += drift_walk * dt.sqrt() * first;
        self.was_set = self.jumps && self.bias.abs() > 0.5 * MILLISECOND;
        if self.was_set {
            self.bias -= MILLISECOND.copysign(self.bias);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_clock_walks_as_its_table_says() {
        let raw = Raw { clock_offset_ms: 0.0, clock_drift_mps: 0.0, ..Raw::default() };
        let ends: Vec<[f64; 2]> = (0..4000)
            .map(|number| {
                let mut clock = Clock::new(&raw, number, 1);
                (0..25).for_each(|_| clock.advance(1.0));
                [clock.bias, clock.drift]
            })
            .collect();
        let rms = |axis: usize| (ends.iter().map(|e| e[axis].powi(2)).sum::<f64>() / 4000.0).sqrt();
        let bias = (25.0_f64 * 1e-4 + 25.0_f64.powi(3) / 3.0 * 1e-4).sqrt();
        assert_relative_eq!(rms(0), bias, max_relative = 0.04);
        assert_relative_eq!(rms(1), 0.05, max_relative = 0.04);
    }

    #[test]
    fn a_clock_that_is_set_stays_within_half_a_millisecond_and_says_when() {
        let raw = Raw { clock_jumps: true, clock_drift_mps: 3000.0, ..Raw::default() };
        let mut clock = Clock::new(&raw, 0, 4);
        let mut count = 0;
        for _ in 0..1000 {
            let before = clock.bias + clock.drift;
            clock.advance(1.0);
            let jump = (clock.bias - before) / MILLISECOND;
            assert_relative_eq!(jump.abs(), f64::from(u8::from(clock.was_set)), epsilon = 1e-4);
            assert!(clock.bias.abs() <= 0.5 * MILLISECOND);
            count += u32::from(clock.was_set);
        }
        assert!(count > 0);
    }
}
