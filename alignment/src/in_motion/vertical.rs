//! The vertical channel beside the eight states: height and down velocity, so that the full filter
//! starts with both. It hears GNSS, and where there is none, that a ship floats.

use nalgebra::{Matrix2, RowVector2, Vector2};

/// Height and down velocity with their covariance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VerticalChannel {
    /// Height over the ellipsoid, m.
    pub height: f64,
    /// Down velocity, m/s.
    pub down: f64,
    p: Matrix2<f64>,
    /// 1-sigma of what varies slowly in the measured height and velocity, which no mean removes.
    slow: Vector2<f64>,
    mean_height: f64,
}

/// Time over which the error of the vertical force is taken as one, s.
const CORRELATION: f64 = 10.0;
/// Error of the vertical force of a tilt of some degrees, m/s^2.
const TILTED: f64 = 0.02;
/// Heave and tide about the first height, 1-sigma, m.
const AFLOAT: f64 = 5.0;

impl VerticalChannel {
    /// From height, m, and down velocity, m/s, with 1-sigma of each.
    #[must_use]
    pub fn new(height: f64, height_std: f64, down: f64, down_std: f64) -> Self {
        let variance = Vector2::new(height_std, down_std).map(|std| std * std);
        VerticalChannel {
            height,
            down,
            p: Matrix2::from_diagonal(&variance),
            slow: Vector2::zeros(),
            mean_height: height,
        }
    }

    /// Moves on: acceleration downwards, m/s^2, over a time, s.
    pub fn advance(&mut self, acceleration: f64, duration: f64) {
        let before = self.down;
        self.down += acceleration * duration;
        self.height -= 0.5 * (before + self.down) * duration;
    }

    /// Lets the covariance grow over a time, s, with an accelerometer of this bias, m/s^2.
    pub fn settle(&mut self, duration: f64, accel_bias_std: f64) {
        let f = Matrix2::new(1.0, -duration, 0.0, 1.0);
        let density = (accel_bias_std.powi(2) + TILTED.powi(2)) * CORRELATION;
        let q = density * duration;
        let noise = Matrix2::new(
            q * duration * duration / 3.0,
            -q * duration / 2.0,
            -q * duration / 2.0,
            q,
        );
        self.p = f * self.p * f.transpose() + noise;
    }

    /// A measured height, m, with 1-sigma of its white and its slow part.
    pub fn measure_height(&mut self, height: f64, white: f64, slow: f64) {
        self.slow.x = slow;
        self.mean_height += 0.02 * (height - self.mean_height);
        self.update(&RowVector2::new(1.0, 0.0), height - self.height, white);
    }

    /// A measured down velocity, m/s, with 1-sigma of its white and its slow part.
    pub fn measure_down(&mut self, down: f64, white: f64, slow: f64) {
        self.slow.y = slow;
        self.update(&RowVector2::new(0.0, 1.0), down - self.down, white);
    }

    /// Without any measurement: ships stay about where the sea is and do not rise for long.
    pub fn hold_afloat(&mut self) {
        self.update(&RowVector2::new(1.0, 0.0), self.mean_height - self.height, AFLOAT);
    }

    /// Variances of height, m^2, and down velocity, (m/s)^2.
    #[must_use]
    pub fn variances(&self) -> (f64, f64) {
        let own = self.p.diagonal() + self.slow.component_mul(&self.slow);
        (own.x.max(0.0), own.y.max(0.0))
    }

    fn update(&mut self, h: &RowVector2<f64>, z: f64, std: f64) {
        let pht = self.p * h.transpose();
        let s = (h * pht).x + std * std;
        if !z.is_finite() || s <= 0.0 {
            return;
        }
        let gain = pht / s;
        self.height += gain.x * z;
        self.down += gain.y * z;
        self.p -= gain * pht.transpose();
        self.p = (self.p + self.p.transpose()) * 0.5;
    }
}
