//! Whether gravity turns in the axes of the IMU as its gyros say that it is turned.
//!
//! Over a block of time the specific force is added up as it is measured, and turned back to the beginning by
//! the gyros. The shorter the sum of vectors beside the sum of their lengths, 1 - scatter^2 / 2, the more
//! their directions scatter. Gyros that swing widely while the force stands still in the body do not tell how the ship is
//! turned, however she moves: to keep her apparent gravity that steady she would have to ride every wave
//! as a raft does, ten times better than any does.

use insd_base::units::DEG;
use insd_nav::Increment;
use nalgebra::{UnitQuaternion, Vector3};

/// Length of a block, s, and how many in a row must say so.
const BLOCK: f64 = 20.0;
const BLOCKS: u8 = 2;
/// Scatter that is worth a look, rad, and the share of it that gravity must follow at least.
const WIDE: f64 = 1.5 * DEG;
const FOLLOWS: f64 = 0.1;

/// The block that runs, and how many before it said so.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Swing {
    turned: UnitQuaternion<f64>,
    level: Vector3<f64>,
    body: Vector3<f64>,
    length: f64,
    lasts: f64,
    blocks: u8,
}

impl Swing {
    /// Sees an increment that was measured, s its duration.
    pub(super) fn see(&mut self, increment: &Increment, duration: f64) {
        self.level += self.turned * increment.velocity;
        self.body += increment.velocity;
        self.length += increment.velocity.norm();
        self.turned *= UnitQuaternion::new(increment.rotation);
        self.lasts += duration;
        if self.lasts >= BLOCK {
            let blocks = if self.disagrees() { self.blocks.saturating_add(1) } else { 0 };
            *self = Swing { blocks, ..Swing::default() };
        }
    }

    /// Whether the gyros tell turns that gravity does not.
    pub(super) fn is_wrong(&self) -> bool {
        self.blocks >= BLOCKS
    }

    fn disagrees(&self) -> bool {
        let scatter = |sum: &Vector3<f64>| {
            let coherence = sum.norm() / self.length.max(f64::MIN_POSITIVE);
            (2.0 * (1.0 - coherence).max(0.0)).sqrt()
        };
        let told = scatter(&self.level);
        told > WIDE && scatter(&self.body) < FOLLOWS * told
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Time;

    /// Two minutes of a ship that rolls by so much about the wave's slope, deg, with gyros that tell it
    /// times a factor; `follows` the share of the slope that she rides as a raft.
    fn is_found(roll: f64, follows: f64, factor: f64) -> bool {
        let mut swing = Swing::default();
        for k in 0..12_000 {
            let at = f64::from(k) * 0.01;
            let angle = |t: f64| roll * DEG * (t * 0.8).sin();
            let (from, to) = (angle(at), angle(at + 0.01));
            let lean = 0.5 * (from + to) * (1.0 - follows);
            swing.see(
                &Increment {
                    from: Time::from_seconds(at),
                    to: Time::from_seconds(at + 0.01),
                    rotation: Vector3::new((to - from) * factor, 0.0, 0.0),
                    velocity: Vector3::new(0.0, -lean.sin(), -lean.cos()) * 0.0981,
                    end_rate: Vector3::zeros(),
                    end_rate_variance: 0.0,
                    angular_acceleration: Vector3::zeros(),
                    rate_noise: Vector3::zeros(),
                    force_noise: Vector3::zeros(),
                    bridged: None,
                },
                0.01,
            );
        }
        swing.is_wrong()
    }

    #[test]
    fn degrees_for_radians_are_found_at_a_calm_berth() {
        assert!(is_found(0.2, 0.0, 57.3));
        assert!(is_found(1.0, 0.5, 57.3));
    }

    #[test]
    fn gyros_that_tell_the_truth_are_not_doubted_in_any_sea() {
        for (roll, follows) in [(0.2, 0.0), (25.0, 0.0), (10.0, 0.8), (20.0, -1.0), (6.0, 0.85)] {
            assert!(!is_found(roll, follows, 1.0), "{roll} {follows}");
        }
    }
}
