//! What is known of the place and not told yet.

use insd_base::Time;
use nalgebra::{Vector2, Vector3};

/// What is held back.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Held {
    /// The estimate less what is told, level, ECEF axes, m.
    pub(super) back: Vector3<f64>,
    pub(super) watch: Option<Watch>,
}

/// Since when what moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Watch {
    /// When ranges began to tell the place.
    pub(super) begun: Time,
    /// When the place of before was that of then.
    pub(super) noted: Time,
    /// When it was looked at last.
    pub(super) looked: Time,
}

/// What is held back after the place of before was `moved`. A correction of more than may be held back is told at once, and all that was held back with it.
pub(super) fn kept(
    back: Vector2<f64>,
    moved: Vector2<f64>,
    most: f64,
    is_way_known: bool,
) -> Vector2<f64> {
    if moved.norm() > most {
        return Vector2::zeros();
    }
    let all = if is_way_known { back + moved } else { back };
    all.cap_magnitude(most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_corrections_are_held_back_and_no_more_than_the_place_is_uncertain_by() {
        let step = Vector2::new(0.0, -0.01);
        let held = |steps| (0..steps).fold(Vector2::zeros(), |back, _| kept(back, step, 0.5, true));
        assert!((held(20) - step * 20.0).norm() < 1e-12);
        assert!((held(200).norm() - 0.5).abs() < 1e-12);
    }

    #[test]
    fn a_leap_is_told_at_once_and_a_way_that_nobody_knows_is_not_held_back() {
        let back = Vector2::new(0.3, 0.0);
        assert_eq!(kept(back, Vector2::new(0.0, 3.0), 0.5, true), Vector2::zeros());
        assert_eq!(kept(back, Vector2::new(0.1, 0.0), 0.5, false), back);
        // satellites are back: the place is good to less than is held
        assert!((kept(back, Vector2::zeros(), 0.02, true).norm() - 0.02).abs() < 1e-12);
    }
}
