//! What is remembered of a camera, and how far it is believed.

use std::sync::Arc;

use insd_base::{CameraFrame, CameraTurn, Time};
use nalgebra::Vector3;

use crate::camera::window::PoseWindow;
use crate::error_state::LANDMARKS;

/// An image of fewer points tells too little to be trusted.
pub(super) const FEWEST_POINTS: usize = 15;
/// It is doubtful, and believed again, after so long, s.
const LASTS: f64 = 2.0;

/// What is remembered of a camera.
#[derive(Clone, Debug, Default)]
pub(super) struct Camera {
    pub(super) window: PoseWindow,
    pub(super) landmarks: [Option<Landmark>; LANDMARKS],
    pub(super) standing: CameraStanding,
    /// The newest image.
    pub(super) last: Option<Arc<CameraFrame>>,
}

/// How many points or tracks were asked, and how many contradicted; and whether anything was used.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub(super) asked: usize,
    pub(super) refused: usize,
    pub(super) is_used: bool,
}

/// A point of the world that is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Landmark {
    /// Its track.
    pub(super) id: u64,
    /// As it was first estimated, ECEF, m.
    pub(super) first: Vector3<f64>,
    /// How often in a row it was seen where it cannot be.
    pub(super) contradicted: u8,
}

/// How far one is believed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CameraStanding {
    /// Since when it is well, or not.
    run: Option<(bool, Time)>,
    is_doubted: bool,
}

impl CameraStanding {
    /// Whether it is not to be used.
    pub(super) fn is_doubted(&self) -> bool {
        self.is_doubted
    }

    /// Takes note of an image: whether it has points enough, and what they told. Nothing told is no news.
    pub(super) fn hear(&mut self, now: Time, is_lit: bool, tally: &Tally) -> Option<CameraTurn> {
        if is_lit && tally.asked == 0 {
            return None;
        }
        let is_well = is_lit && 2 * tally.refused <= tally.asked;
        let run = self.run.filter(|(own, _)| *own == is_well);
        let (_, since) = *self.run.insert(run.unwrap_or((is_well, now)));
        if self.is_doubted != is_well || (now - since).as_seconds() < LASTS {
            return None;
        }
        self.is_doubted = !is_well;
        Some(if is_well { CameraTurn::Agrees } else { CameraTurn::Doubtful })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turns(told: &[(f64, bool, usize)]) -> Vec<(f64, CameraTurn)> {
        let mut standing = CameraStanding::default();
        let turn = |(at, is_lit, refused): &(f64, bool, usize)| {
            let tally = Tally { asked: 10, refused: *refused, is_used: true };
            Some((*at, standing.hear(Time::from_seconds(*at), *is_lit, &tally)?))
        };
        told.iter().filter_map(turn).collect()
    }

    #[test]
    fn who_sees_little_or_is_refused_mostly_for_two_seconds_is_doubtful_until_he_agrees() {
        let mut told: Vec<(f64, bool, usize)> = (0..4).map(|i| (f64::from(i), true, 1)).collect();
        told.extend((4..8).map(|i| (f64::from(i), i < 6, 8)));
        told.extend((8..12).map(|i| (f64::from(i), true, 2)));
        assert_eq!(turns(&told), [(6.0, CameraTurn::Doubtful), (10.0, CameraTurn::Agrees)]);
    }

    #[test]
    fn one_bad_image_is_no_reason() {
        assert_eq!(turns(&[(0.0, true, 0), (1.0, true, 9), (2.0, true, 0), (3.5, true, 9)]), []);
    }
}
