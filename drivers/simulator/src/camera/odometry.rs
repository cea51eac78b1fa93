//! What a visual odometry of another's making tells: how the camera moved from keyframe to keyframe, in the scale of its map.

use insd_base::{Time, VisualOdometry};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use rand_pcg::Pcg64;

use super::trouble::{Trouble, Troubles};
use super::view::{Rig, View};
use crate::random::{Purpose, normal, normal3, stream, uniform};
use crate::scenario::Camera;
use crate::sensors::epochs;

/// A map with its scale.
#[derive(Debug)]
struct Maps<'a> {
    camera: &'a Camera,
    number: u32,
    log_scale: f64,
    /// Whether the last keyframe belongs to the map.
    is_open: bool,
    rng: Pcg64,
}

impl Maps<'_> {
    /// Carries the scale on by a keyframe; whether the map holds.
    fn holds(&mut self, trouble: &Trouble<'_>) -> bool {
        let (camera, interval) = (self.camera, self.camera.keyframe_s);
        let walk = camera.log_scale_walk_sqrt_s * interval.sqrt() * normal(&mut self.rng);
        let breaks = uniform(&mut self.rng, 0.0, 1.0) < camera.maps_per_hour * interval / 3600.0;
        let is_lost = breaks || trouble.is_blinded || trouble.is_water || trouble.is_noise;
        if is_lost {
            self.is_open = false;
            return false;
        }
        if !self.is_open {
            self.is_open = true;
            self.number += 1;
            self.log_scale = camera.log_scale_std * normal(&mut self.rng);
        }
        self.log_scale += walk;
        true
    }
}

/// All steps of a voyage, from each keyframe but the first.
pub(super) fn steps(
    camera: &Camera,
    rig: &Rig<'_>,
    troubles: &Troubles,
    duration: f64,
    seed: u64,
) -> Vec<VisualOdometry> {
    let rng = stream(seed, Purpose::CameraOdometry);
    let log_scale = 0.0;
    let mut maps = Maps { camera, number: 0, log_scale, is_open: false, rng };
    let keyframes: Vec<Time> = epochs(1.0 / camera.keyframe_s, 1, duration).collect();
    let step = |pair: &[Time]| {
        let [since, time] = [pair[0], pair[1]];
        let trouble = troubles.at(time.as_seconds());
        let is_known = maps.holds(&trouble);
        is_known.then(|| maps.step(rig, &trouble, since, time))
    };
    keyframes.windows(2).filter_map(step).collect()
}

impl Maps<'_> {
    fn step(
        &mut self,
        rig: &Rig<'_>,
        trouble: &Trouble<'_>,
        since: Time,
        time: Time,
    ) -> VisualOdometry {
        let camera = self.camera;
        let [before, now] = [since, time].map(|own| rig.view(own.as_seconds()));
        let (rotation, way) = if trouble.is_frozen {
            (Rotation3::identity(), Vector3::zeros())
        } else {
            moved(&before, &now, trouble, (time - since).as_seconds())
        };
        let blur = trouble.blur();
        let rotation_std = camera.vo_rotation_std_rad;
        let std = camera.vo_translation_std_m + camera.vo_translation_std_share * way.norm();
        let turn = Rotation3::new(normal3(&mut self.rng) * (rotation_std * blur));
        let way = way + normal3(&mut self.rng) * (std * blur);
        let scale = self.log_scale.exp();
        VisualOdometry {
            time,
            since,
            map: self.number - 1,
            rotation: UnitQuaternion::from_rotation_matrix(&(rotation * turn)),
            translation: way * scale,
            rotation_std,
            translation_std: std * scale,
        }
    }
}

/// How the camera moved, as most of what it sees has it: axes of the later image to those of the earlier one, and the way in the latter, m.
fn moved(
    before: &View,
    now: &View,
    trouble: &Trouble<'_>,
    interval: f64,
) -> (Rotation3<f64>, Vector3<f64>) {
    let rotation = Rotation3::from_matrix_unchecked(before.c_qc.tr_mul(&now.c_qc));
    let ship = trouble.ship.filter(|_| trouble.on_ship > 0.5);
    let carried = ship.map_or_else(Vector3::zeros, |ship| ship.velocity * interval);
    (rotation, before.c_qc.tr_mul(&(now.place - before.place - carried)))
}
