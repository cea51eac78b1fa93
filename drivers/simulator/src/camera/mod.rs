//! A camera on the hull: what it sees of a quay, the tracks that a front end makes of it, and what a visual odometry makes of the same.
//!
//! The quay ([`quay`]) is an upright wall along the line of the berth, with bollards and what lies about behind it, and buildings, which hide what is
//! behind them. A point is projected by a pinhole of the simulator's own ([`view`]); of the navigator nothing but the vocabulary is shared. Tracks
//! ([`tracker`]) last while a point is in view, unless they are lost. What goes wrong is in [`trouble`]. Lenses do not bend anything, shutters do not roll, and the
//! ship's own hull hides nothing.

mod odometry;
mod output;
mod quay;
mod subject;
mod tracker;
mod trouble;
mod view;

use insd_base::CameraFrame;

use crate::scenario::{Camera, Scenario};
use crate::sensors::epochs;
use crate::track::Track;

pub(crate) use output::truth;
pub use output::{Footage, FootageSpec, FootageTruth, InjectedCameraFault};
use quay::Quay;
use tracker::Tracker;
use trouble::Troubles;
use view::Rig;

/// What a camera makes of a voyage along `track`; `None` where there is no quay.
pub(crate) fn footage(
    scenario: &Scenario,
    camera: &Camera,
    track: &Track,
    seed: u64,
) -> Option<Footage> {
    let duration = scenario.duration();
    let quay = Quay::new(scenario, &camera.quay, track, seed)?;
    let rig = Rig::new(camera, &quay.axes, track);
    let troubles = Troubles::new(camera, &rig, duration);
    let mut tracker = Tracker::new(camera, &quay, seed);
    let image = |time: insd_base::Time| {
        let t = time.as_seconds();
        CameraFrame { time, points: tracker.image(t, &rig.view(t), &troubles.at(t)) }
    };
    Some(Footage {
        spec: FootageSpec::of(camera),
        frames: epochs(camera.rate_hz, 1, duration).map(image).collect(),
        odometry: odometry::steps(camera, &rig, &troubles, duration, seed),
        keyframe_interval: camera.keyframe_s,
    })
}

#[cfg(test)]
mod tests;
