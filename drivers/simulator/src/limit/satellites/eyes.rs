//! What a camera tells: points at rest by their tracks, each with its place as a state as long as its track lasts, or the steps of a visual odometry.
//!
//! With phi the error of attitude such that the system's axes are (1 - phi x) the true ones, and d the way from the IMU to a point: the point in
//! camera axes is off by C_cn (df - dp - d x phi); with m that of the mounting, likewise, by -C_cb ((C_bn d - l) x m); and, with that of the clock, by how
//! fast it moves. Of a step of the odometry the way w from camera to camera, in axes of the earlier one, is off
//! by C_cn (dp + l x phi - dp' - l' x phi' - w x phi'), ' the earlier one, l the lever of the camera, and the turn by C_cn (phi' - phi).

use insd_base::earth::c_ne;
use insd_base::units::DEG;
use nalgebra::{Matrix2x3, Matrix3, Vector3};

use super::super::model::cross;
use super::inertial::{ATTITUDE, POSITION};
use super::knowledge::Knowledge;
use crate::camera::{Sighting, mounting, sightings};
use crate::scenario::{Camera, Scenario};
use crate::sensors::epochs;
use crate::track::Track;

/// 1-sigma of the place of a point of which nothing is known, m.
const POINT: f64 = 1000.0;

/// To both sides of an image its points are looked at to see how fast they move, s.
const ASIDE: f64 = 0.01;
/// States before those of points: the turn of the mounting, body axes, rad, and the clock, s.
const INSTALLED: usize = 4;

/// What of a camera is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CameraUse {
    /// Tracks of points.
    Tracks,
    /// Steps of a visual odometry.
    Odometry,
}

/// The camera of a voyage.
#[derive(Clone, Debug)]
pub(super) struct Eyes<'a> {
    camera: &'a Camera,
    track: &'a Track,
    /// When the images, or keyframes, were taken, s.
    times: Vec<f64>,
    what: What,
    /// How many of them have been looked at.
    done: usize,
}

#[derive(Clone, Debug)]
enum What {
    Tracks(Points),
    Odometry(Steps),
}

/// What is seen in each image, and of which track the states of each point are.
#[derive(Clone, Debug)]
struct Points {
    images: Vec<Sighting>,
    slots: Vec<Option<u64>>,
}

/// Of each keyframe the map in which the step to it is, where there is one; the last keyframe and its map.
#[derive(Clone, Debug)]
struct Steps {
    maps: Vec<Option<u32>>,
    last: Option<Box<Pose>>,
    map: Option<u32>,
}

/// The camera at one instant.
#[derive(Clone, Copy, Debug)]
struct Pose {
    /// Position of the IMU, ECEF, m.
    position: Vector3<f64>,
    c_ne: Matrix3<f64>,
    c_cn: Matrix3<f64>,
    c_nb: Matrix3<f64>,
    /// From the IMU, north, east, down, m.
    lever: Vector3<f64>,
}

impl<'a> Eyes<'a> {
    /// The camera of the voyage of a seed along its track; `None` where there is no quay.
    pub(super) fn new(
        scenario: &Scenario,
        camera: &'a Camera,
        track: &'a Track,
        seed: u64,
        by: CameraUse,
    ) -> Option<Self> {
        let (images, steps) = sightings(scenario, camera, track, seed)?;
        let (times, what): (Vec<f64>, What) = match by {
            CameraUse::Tracks => {
                let slots = vec![None; camera.tracks as usize];
                let times = images.iter().map(|image| image.t).collect();
                (times, What::Tracks(Points { images, slots }))
            }
            CameraUse::Odometry => {
                let keyframes: Vec<_> =
                    epochs(1.0 / camera.keyframe_s, 1, scenario.duration()).collect();
                let map = |time| {
                    let step = steps.binary_search_by_key(time, |step| step.time).ok()?;
                    Some(steps[step].map)
                };
                let maps = keyframes.iter().map(map).collect();
                let times = keyframes.iter().map(|time| time.as_seconds()).collect();
                (times, What::Odometry(Steps { maps, last: None, map: None }))
            }
        };
        let times = times.into_iter().map(|t| t + camera.time_offset_s).collect();
        Some(Eyes { camera, track, times, what, done: 0 })
    }

    /// How many states there are: mounting, clock and the places of points, or position and attitude at the last keyframe and the scale.
    pub(super) fn states(&self) -> usize {
        match &self.what {
            What::Tracks(points) => INSTALLED + 3 * points.slots.len(),
            What::Odometry(_) => 7,
        }
    }

    /// States of which something is known at the start, the first of the camera being `first`, with their 1-sigma.
    pub(super) fn begin(&self, first: usize) -> impl Iterator<Item = (usize, f64)> + use<> {
        let (mounting, clock) = (self.camera.mounting_std_deg * DEG, self.camera.time_offset_std_s);
        let count = if matches!(self.what, What::Tracks(_)) { INSTALLED } else { 0 };
        (first..).zip([mounting, mounting, mounting, clock]).take(count)
    }

    /// When what is to be looked at next was taken, up to `to`, s.
    pub(super) fn until(&self, to: f64) -> impl Iterator<Item = f64> + '_ {
        self.times[self.done..].iter().copied().take_while(move |t| *t <= to)
    }

    /// Takes into account what was seen up to `t`, s; the states of the camera begin at `first`.
    pub(super) fn look(&mut self, t: f64, first: usize, knowledge: &mut Knowledge) {
        while self.times.get(self.done).is_some_and(|at| *at <= t) {
            let at = self.times[self.done];
            let pose = |t| Pose::new(self.camera, self.track, t);
            match &mut self.what {
                What::Tracks(points) => {
                    let poses = [pose(at - ASIDE), pose(at), pose(at + ASIDE)];
                    points.look(self.camera, self.done, &poses, first, knowledge);
                }
                What::Odometry(steps) => {
                    steps.look(self.camera, self.done, pose(at), first, knowledge);
                }
            }
            self.done += 1;
        }
    }
}

impl Pose {
    /// The camera in an image that was truly taken at `t`, s.
    fn new(camera: &Camera, track: &Track, t: f64) -> Self {
        let ship = track.at(t);
        let c_ne = c_ne(&ship.point);
        let c_nb = c_ne * ship.c_eb;
        Pose {
            position: ship.position,
            c_ne,
            c_cn: (c_nb * mounting(camera, t - camera.time_offset_s)).transpose(),
            c_nb,
            lever: c_nb * Vector3::from(camera.lever_arm_m),
        }
    }

    /// From the IMU to a place in ECEF axes, north, east, down, m.
    fn way(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.c_ne * (point - self.position)
    }

    /// A place in ECEF axes, m, in those of the camera.
    fn seen(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.c_cn * (self.way(point) - self.lever)
    }
}

impl Points {
    fn look(
        &mut self,
        camera: &Camera,
        image: usize,
        poses: &[Pose; 3],
        first: usize,
        knowledge: &mut Knowledge,
    ) {
        let seen = &self.images[image].points;
        for slot in &mut self.slots {
            *slot = slot.filter(|own| seen.iter().any(|(track, _)| track == own));
        }
        for (track, point) in seen {
            let known = self.slots.iter().position(|slot| *slot == Some(*track));
            let slot = known.or_else(|| self.slots.iter().position(Option::is_none));
            let Some(slot) = slot else { continue };
            let place = first + INSTALLED + 3 * slot;
            if known.is_none() {
                self.slots[slot] = Some(*track);
                (place..place + 3).for_each(|own| knowledge.reset(own, POINT * POINT));
            }
            measure(camera, poses, point, [place, first], knowledge);
        }
    }
}

/// Both coordinates of a point (ECEF, m) in the image, before and after which the camera is looked at, too. Its place is a state from `place` on, mounting and
/// clock are from `installed` on.
fn measure(
    camera: &Camera,
    [before, pose, after]: &[Pose; 3],
    point: &Vector3<f64>,
    [place, installed]: [usize; 2],
    knowledge: &mut Knowledge,
) {
    let (way, h) = (pose.way(point), pose.seen(point));
    let scale = camera.focal_px / h.z;
    let image = Matrix2x3::new(scale, 0.0, -scale * h.x / h.z, 0.0, scale, -scale * h.y / h.z);
    let moving = image * (after.seen(point) - before.seen(point)) / (2.0 * ASIDE);
    let to_point = image * pose.c_cn;
    let turn = to_point * -cross(&way);
    let mounting = to_point * -cross(&(way - pose.lever)) * pose.c_nb;
    for row in 0..2 {
        let mut own = vec![(installed + 3, moving[row])];
        own.extend((0..3).flat_map(|axis| {
            [
                (place + axis, to_point[(row, axis)]),
                (POSITION.at(axis), -to_point[(row, axis)]),
                (ATTITUDE.at(axis), turn[(row, axis)]),
                (installed + axis, mounting[(row, axis)]),
            ]
        }));
        knowledge.measure(&own, camera.pixel_std.powi(2));
    }
}

impl Steps {
    fn look(
        &mut self,
        camera: &Camera,
        keyframe: usize,
        pose: Pose,
        first: usize,
        knowledge: &mut Knowledge,
    ) {
        let scale = first + 6;
        if let (Some(map), Some(before)) = (self.maps[keyframe], &self.last) {
            let walk = camera.log_scale_walk_sqrt_s.powi(2) * camera.keyframe_s;
            if self.map == Some(map) {
                knowledge.add_together(&[scale], walk);
            } else {
                knowledge.reset(scale, camera.log_scale_std.powi(2));
            }
            self.map = Some(map);
            step(camera, [before, &pose], first, knowledge);
        }
        for axis in 0..3 {
            knowledge.copy(POSITION.at(axis), first + axis);
            knowledge.copy(ATTITUDE.at(axis), first + 3 + axis);
        }
        self.last = Some(Box::new(pose));
    }
}

/// Turn and way from one keyframe, whose position, attitude and scale are states from `first` on, to the next.
fn step(camera: &Camera, [before, now]: [&Pose; 2], first: usize, knowledge: &mut Knowledge) {
    let way = before.c_ne * (now.position - before.position) + now.lever - before.lever;
    let seen = before.c_cn * way;
    let std = camera.vo_translation_std_m + camera.vo_translation_std_share * way.norm();
    let turn = before.c_cn;
    let lever_now = before.c_cn * cross(&now.lever);
    let lever_before = -before.c_cn * (cross(&before.lever) + cross(&way));
    for row in 0..3 {
        let parts = |from: usize, of: &Matrix3<f64>, sign: f64| {
            [0, 1, 2].map(|axis| (from + axis, sign * of[(row, axis)]))
        };
        let translation = [
            parts(POSITION.at(0), &turn, 1.0),
            parts(ATTITUDE.at(0), &lever_now, 1.0),
            parts(first, &turn, -1.0),
            parts(first + 3, &lever_before, 1.0),
        ];
        let mut translation = translation.concat();
        translation.push((first + 6, seen[row]));
        knowledge.measure(&translation, std * std);
        let rotation = [parts(ATTITUDE.at(0), &turn, -1.0), parts(first + 3, &turn, 1.0)];
        knowledge.measure(&rotation.concat(), camera.vo_rotation_std_rad.powi(2));
    }
}
