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

/// Gyros that are turned fast and still hold gravity to this, rad, tell how: those that tell degrees for radians do not, nor a hand that
/// swings them as it walks more than half of it.
const HELD: f64 = 20.0 * DEG;
/// How much of a block must have been seen to say so, s.
const ENOUGH: f64 = 5.0;

/// The block that runs, how many before it said so, and how far gravity was scattered by the gyros of the last one, rad.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Swing {
    turned: UnitQuaternion<f64>,
    level: Vector3<f64>,
    body: Vector3<f64>,
    length: f64,
    lasts: f64,
    blocks: u8,
    scattered: Option<f64>,
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
            *self =
                Swing { blocks, scattered: Some(self.scatter(&self.level)), ..Swing::default() };
        }
    }

    /// Whether the gyros tell turns that gravity does not.
    pub(super) fn is_wrong(&self) -> bool {
        self.blocks >= BLOCKS
    }

    /// Whether gravity stands where it stood when it is turned back by the gyros, so that they tell how they are turned.
    pub(super) fn holds_gravity(&self) -> bool {
        let running = (self.lasts >= ENOUGH).then(|| self.scatter(&self.level));
        let known = [running, self.scattered].into_iter().flatten().reduce(f64::max);
        known.is_some_and(|scattered| scattered < HELD)
    }

    fn disagrees(&self) -> bool {
        let told = self.scatter(&self.level);
        told > WIDE && self.scatter(&self.body) < FOLLOWS * told
    }

    /// How far directions lie apart whose sum this is, rad.
    fn scatter(&self, sum: &Vector3<f64>) -> f64 {
        let coherence = sum.norm() / self.length.max(f64::MIN_POSITIVE);
        (2.0 * (1.0 - coherence).max(0.0)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use insd_base::Time;

    fn is_found(roll: f64, follows: f64, factor: f64) -> bool {
        sailed(roll, follows, factor).is_wrong()
    }

    /// Two minutes of a ship that rolls by so much about the wave's slope, deg, with gyros that tell it
    /// times a factor; `follows` the share of the slope that she rides as a raft.
    fn sailed(roll: f64, follows: f64, factor: f64) -> Swing {
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
                    celsius: None,
                },
                0.01,
            );
        }
        swing
    }

    #[test]
    fn gyros_that_tell_the_truth_hold_gravity_however_fast_they_are_turned_and_degrees_do_not() {
        // 46 deg/s at the most
        assert!(sailed(57.0, 0.0, 1.0).holds_gravity());
        for roll in [1.0, 5.0, 20.0] {
            assert!(!sailed(roll, 0.0, 57.3).holds_gravity(), "{roll}");
        }
        assert!(!Swing::default().holds_gravity());
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
