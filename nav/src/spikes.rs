//! Single samples of an IMU that are far off: a bit that flipped, a byte that was lost.
//!
//! A hull does not change its rate or force by many times what it does from sample to sample and back within one. A
//! sample that is so far from the one before is left out, once: if the next is as far from it, the ship does so.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// A change of so many times its root mean square is none of the ship's,
const FAR: f64 = 12.0;
/// if it is beyond this, too: rate, rad/s, and force, m/s^2.
const LEAST: [f64; 2] = [0.02, 1.0];
/// Samples over which the mean square is averaged, and after which it is trusted.
const MEMORY: f64 = 200.0;
const KNOWN: u32 = 50;

/// How much rate and force change from sample to sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spikes {
    squares: [Vector3<f64>; 2],
    seen: u32,
    was_far: bool,
}

impl Spikes {
    /// Sees by how much rate, rad/s, and force, m/s^2, changed since the last sample that was used; tells whether
    /// this one is to be left out.
    pub fn see(&mut self, changes: [Vector3<f64>; 2]) -> bool {
        let is_far = self.seen >= KNOWN && (0..2).any(|i| self.is_far(i, &changes[i]));
        if is_far && !self.was_far {
            self.was_far = true;
            return true;
        }
        self.was_far = false;
        self.seen = self.seen.saturating_add(1);
        let weight = (1.0 / MEMORY).max(1.0 / f64::from(self.seen));
        for (square, change) in self.squares.iter_mut().zip(changes) {
            *square += (change.component_mul(&change) - *square) * weight;
        }
        false
    }

    fn is_far(&self, kind: usize, change: &Vector3<f64>) -> bool {
        let limit = |square: f64| LEAST[kind].max(FAR * square.sqrt());
        change.iter().zip(&self.squares[kind]).any(|(change, square)| change.abs() > limit(*square))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn used_to_waves() -> Spikes {
        let mut spikes = Spikes::default();
        for i in 0..400_i32 {
            let wave = Vector3::repeat(1e-3 * (0.05 * f64::from(i)).cos());
            assert!(!spikes.see([wave, wave * 50.0]), "{i}");
        }
        spikes
    }

    #[test]
    fn a_wild_sample_is_left_out_and_the_next_is_used() {
        let mut spikes = used_to_waves();
        assert!(spikes.see([Vector3::new(2.0, 0.0, 0.0), Vector3::zeros()]));
        assert!(!spikes.see([Vector3::repeat(1e-3), Vector3::repeat(0.05)]));
        assert!(spikes.see([Vector3::zeros(), Vector3::new(0.0, 0.0, -30.0)]));
    }

    #[test]
    fn what_stays_is_the_ships() {
        let mut spikes = used_to_waves();
        let slam = [Vector3::zeros(), Vector3::new(0.0, 0.0, 20.0)];
        assert!(spikes.see(slam));
        assert!(!spikes.see(slam));
    }
}
