//! From where a visual odometry measures, and how far it is believed.

use insd_base::{Time, VisualOdometry};

use super::camera_standing::CameraStanding;
use crate::camera::sight::Pose;
use crate::camera::window::Keyframe;
use crate::error_state::ODOMETRY_POSES;

/// A step begins at a pose that was held if that is no farther from it in time, s: stamps of a clock that is followed move a little.
const SAME: f64 = 0.01;

/// What is remembered of a visual odometry.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Odometry {
    /// Poses by their places among the states.
    pub(super) poses: [Option<Keyframe>; ODOMETRY_POSES],
    /// From which of them the last step was measured.
    pub(super) keyframe: Option<usize>,
    pub(super) map: Option<u32>,
    /// The last step that was heard.
    pub(super) last: Option<VisualOdometry>,
    /// When one was heard last.
    pub(super) heard: Option<Time>,
    pub(super) standing: CameraStanding,
}

impl Odometry {
    /// The pose at which a step begins, if it is held.
    pub(super) fn begin_of(&self, step: &VisualOdometry) -> Option<Keyframe> {
        let off = |own: &Keyframe| (own.time - step.since).as_seconds().abs();
        let held = self.poses.iter().flatten().copied();
        held.filter(|own| off(own) < SAME).min_by(|one, other| off(one).total_cmp(&off(other)))
    }

    /// A place for the pose at the end of a step that began at `keyframe`: who measures from a keyframe does not go back before it.
    pub(super) fn make_room(&mut self, keyframe: Option<&Keyframe>) -> usize {
        let is_before = |own: &Keyframe| keyframe.is_none_or(|first| own.time < first.time);
        for pose in &mut self.poses {
            *pose = pose.filter(|own| !is_before(own));
        }
        self.keyframe = keyframe.map(|own| own.slot);
        self.poses.iter().position(Option::is_none).unwrap_or_else(|| self.oldest_but_keyframe())
    }

    fn oldest_but_keyframe(&self) -> usize {
        let others = self.poses.iter().flatten().filter(|own| Some(own.slot) != self.keyframe);
        others.min_by_key(|own| own.time).map_or(0, |own| own.slot)
    }

    /// No step is measured from a pose of before.
    pub(super) fn give_up_poses(&mut self) {
        (self.poses, self.keyframe) = ([None; ODOMETRY_POSES], None);
    }

    /// A pose is held in a place.
    pub(super) fn hold(&mut self, slot: usize, time: Time, first: Pose) {
        self.poses[slot] = Some(Keyframe { slot, time, first });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::sight::tests::pose;
    use nalgebra::{UnitQuaternion, Vector3};

    fn step(since: f64, time: f64) -> VisualOdometry {
        VisualOdometry {
            time: Time::from_seconds(time),
            since: Time::from_seconds(since),
            map: 0,
            rotation: UnitQuaternion::identity(),
            translation: Vector3::zeros(),
            rotation_std: 1e-3,
            translation_std: 1e-2,
        }
    }

    /// Which steps of a row find the pose that they begin at.
    fn found(steps: &[(f64, f64)]) -> Vec<bool> {
        let mut odometry = Odometry::default();
        let one = |(since, time): &(f64, f64)| {
            let step = step(*since, *time);
            let keyframe = odometry.begin_of(&step);
            let slot = odometry.make_room(keyframe.as_ref());
            odometry.hold(slot, step.time, pose());
            keyframe.is_some()
        };
        steps.iter().map(one).collect()
    }

    #[test]
    fn a_chain_finds_each_pose_but_the_first() {
        let chain: Vec<_> = (0..8).map(|i| (f64::from(i), f64::from(i + 1))).collect();
        let mut expected = vec![true; 8];
        expected[0] = false;
        assert_eq!(found(&chain), expected);
    }

    #[test]
    fn many_steps_are_measured_from_one_keyframe_and_the_next_keyframe_is_one_of_them() {
        let steps =
            [(0.0, 1.0), (1.0, 1.1), (1.0, 1.2), (1.0, 1.3), (1.0, 1.4), (1.3, 1.5), (1.3, 1.6)];
        assert_eq!(found(&steps), [false, true, true, true, true, true, true]);
    }

    #[test]
    fn after_a_gap_there_is_no_link() {
        assert_eq!(
            found(&[(0.0, 1.0), (1.0, 2.0), (2.5, 3.0), (3.0, 3.5)]),
            [false, true, false, true]
        );
    }
}
