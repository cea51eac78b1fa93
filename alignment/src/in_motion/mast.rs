//! What a mast of unknown length does to the place of its antenna as the ship leans.
//!
//! A list that stays is no different from an antenna that sits to the side, and is counted with the lever arm; so only what she
//! leans otherwise than usual is noise. Where the position was taken as that of the antenna, what she leans otherwise than
//! at that moment is.

use nalgebra::{Matrix2, Vector2};

/// Time constant of what is usual, s.
const USUAL: f64 = 60.0;

/// How the mast leans: the sines of its angles with the vertical.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mast {
    usual: Vector2<f64>,
    seen: f64,
    held: Option<Vector2<f64>>,
}

impl Mast {
    /// Sees how it leans, computed frame, for a time, s; `hull` turns hull axes into that frame.
    pub fn see(&mut self, mast: &Vector2<f64>, hull: &Matrix2<f64>, dt: f64) {
        self.seen = (self.seen + dt).min(USUAL);
        let share = if self.seen > 0.0 { dt / self.seen } else { 0.0 };
        self.usual += (hull.transpose() * mast - self.usual) * share;
    }

    /// The position is that of the antenna now, while it leans so.
    pub fn hold(&mut self, mast: &Vector2<f64>) {
        self.held = Some(*mast);
    }

    /// Whether the position is that of the antenna.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.held.is_some()
    }

    /// The position is that of the IMU, or of nobody.
    pub fn release(&mut self) {
        self.held = None;
    }

    /// Square of how much it leans otherwise.
    #[must_use]
    pub fn swung(&self, mast: &Vector2<f64>, hull: &Matrix2<f64>) -> f64 {
        (mast - self.held.unwrap_or(hull * self.usual)).norm_squared()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_that_stays_is_no_noise_and_a_roll_is() {
        let mut mast = Mast::default();
        for second in 0..600 {
            let roll = 0.1 * (0.7 * f64::from(second)).sin();
            let (sin, cos) = (0.01 * f64::from(second)).sin_cos();
            let hull = Matrix2::new(cos, -sin, sin, cos);
            let leans = hull * Vector2::new(0.05, roll);
            let swung = mast.swung(&leans, &hull);
            assert!(second < 60 || (swung.sqrt() - roll.abs()).abs() < 0.02, "{second}: {swung}");
            mast.see(&leans, &hull, 1.0);
        }
    }

    #[test]
    fn what_was_held_counts_from_then_on() {
        let mut mast = Mast::default();
        let leans = Vector2::new(0.0, 0.2);
        mast.see(&leans, &Matrix2::identity(), 1.0);
        mast.hold(&Vector2::new(0.0, 0.1));
        assert!((mast.swung(&leans, &Matrix2::identity()) - 0.01).abs() < 1e-12);
        mast.release();
        assert!(mast.swung(&leans, &Matrix2::identity()) < 1e-12);
    }
}
