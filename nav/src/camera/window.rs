//! Poses at times of images: which are kept, and what was seen from them.

use insd_base::{CameraModel, ImagePoint, Time};
use nalgebra::Vector2;

use super::sight::Pose;
use crate::error_state::CAMERA_POSES;

/// A pose is another one from which points are seen from another side, by so much, rad, or so much time after, s; and not before so much has passed, s.
/// Poses that are closer say the same again, in the place of others that would tell how far a point is.
const PARALLAX: f64 = 0.03;
const PASSED: f64 = 2.0;
const SOON: f64 = 0.4;

/// A pose that is held, in one of the places for it among the states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keyframe {
    /// Which of the places.
    pub slot: usize,
    /// When.
    pub time: Time,
    /// As it was first estimated.
    pub first: Pose,
}

/// A point in the images that were kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Its number.
    pub id: u64,
    /// From which pose it was seen where, px; in order of time.
    pub seen: Vec<(usize, Vector2<f64>)>,
    /// It is in the newest image.
    pub is_in_sight: bool,
}

/// Poses and tracks.
#[derive(Clone, Debug, Default)]
pub struct PoseWindow {
    /// In order of time.
    pub poses: Vec<Keyframe>,
    /// Of no particular order but the same in each replay.
    pub tracks: Vec<Track>,
}

impl PoseWindow {
    /// The pose of a place.
    #[must_use]
    pub fn pose(&self, slot: usize) -> Option<&Keyframe> {
        self.poses.iter().find(|own| own.slot == slot)
    }

    /// Takes in an image: its points but for those that are landmarks already.
    pub fn see<'a>(&mut self, slot: usize, points: impl Iterator<Item = &'a ImagePoint>) {
        self.tracks.iter_mut().for_each(|track| track.is_in_sight = false);
        for point in points {
            match self.tracks.iter_mut().find(|track| track.id == point.track) {
                Some(track) => {
                    track.is_in_sight = true;
                    track.seen.push((slot, point.at));
                }
                None => {
                    let seen = vec![(slot, point.at)];
                    self.tracks.push(Track { id: point.track, seen, is_in_sight: true });
                }
            }
        }
    }

    /// Which pose gives way to a new one: the newest where that is too near to the one before it, else the oldest where all places are taken.
    #[must_use]
    pub fn gives_way(&self, model: &CameraModel) -> Option<Leaving> {
        if let [.., before, newest] = self.poses.as_slice() {
            let passed = (newest.time - before.time).as_seconds();
            let is_other = passed > PASSED || self.parallax(model, [before, newest]) > PARALLAX;
            if !is_other || passed < SOON {
                return Some(Leaving::Newest(newest.slot));
            }
        }
        let oldest = self.poses.first().filter(|_| self.poses.len() == CAMERA_POSES);
        oldest.map(|oldest| Leaving::Oldest(oldest.slot))
    }

    /// By how much two poses see the middle one of the points that both saw in another direction over the Earth, rad; zero where there are none.
    fn parallax(&self, model: &CameraModel, poses: [&Keyframe; 2]) -> f64 {
        let ray = |track: &Track, pose: &Keyframe| {
            let (_, at) = track.seen.iter().find(|(own, _)| *own == pose.slot)?;
            Some(pose.first.attitude * (model.c_bc * model.ray(at)))
        };
        let between = |track: &Track| {
            let [one, other] = poses.map(|pose| ray(track, pose));
            Some(one?.angle(&other?))
        };
        let mut all: Vec<f64> = self.tracks.iter().filter_map(between).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or_default()
    }

    /// A place that no pose has.
    #[must_use]
    pub fn free(&self) -> Option<usize> {
        (0..CAMERA_POSES).find(|slot| self.pose(*slot).is_none())
    }

    /// A pose leaves, and what was seen from it.
    pub fn leave(&mut self, slot: usize) {
        self.poses.retain(|own| own.slot != slot);
        for track in &mut self.tracks {
            track.seen.retain(|(own, _)| *own != slot);
        }
        self.tracks.retain(|track| track.is_in_sight || !track.seen.is_empty());
    }
}

/// A pose that gives way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaving {
    /// The newest: nothing that matters was seen from it alone.
    Newest(usize),
    /// The oldest: what was seen from it is to be used before it leaves.
    Oldest(usize),
}
