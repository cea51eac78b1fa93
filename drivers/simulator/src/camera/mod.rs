//! A camera on the hull: what it sees of a quay, the tracks that a front end makes of it, and what a visual odometry makes of the same.
//!
//! The quay ([`quay`]) is an upright wall along the line of the berth, with bollards and what lies about behind it, and buildings, which hide what is
//! behind them. A point is projected by a pinhole of the simulator's own ([`view`]); of the navigator nothing but the vocabulary is shared. Tracks
//! ([`tracker`]) last while a point is in view, unless they are lost. What goes wrong is in [`trouble`]. Lenses do not bend anything, shutters do not roll, and the
//! ship's own hull hides nothing.

mod axes;
mod installation;
mod odometry;
mod output;
mod quay;
mod subject;
mod tracker;
mod trouble;
mod view;

use insd_base::{CameraFrame, ImagePoint, Time, VisualOdometry};
use nalgebra::Vector3;

use crate::scenario::{Camera, Scenario};
use crate::sensors::epochs;
use crate::track::Track;

pub(crate) use installation::installed;
pub(crate) use output::truth;
pub use output::{Footage, FootageSpec, FootageTruth, InjectedCameraFault};
use quay::Quay;
use tracker::Tracker;
use trouble::Troubles;
use view::Rig;
pub(crate) use view::mounting;

/// What an installed camera makes of a voyage along `track`; `None` where there is no quay.
pub(crate) fn footage(
    scenario: &Scenario,
    camera: &Camera,
    track: &Track,
    seed: u64,
) -> Option<Footage> {
    let frame = |time: Time, points: Vec<ImagePoint>, _: &Tracker<'_>| CameraFrame { time, points };
    let (frames, odometry) = film(scenario, camera, track, seed, frame)?;
    Some(Footage {
        spec: FootageSpec::of(camera),
        frames,
        odometry,
        keyframe_interval: camera.keyframe_s,
    })
}

/// The points at rest that are tracked in one image: for those who reckon what could be known.
#[derive(Clone, Debug)]
pub(crate) struct Sighting {
    /// When the image was said to be taken, s.
    pub(crate) t: f64,
    /// The tracks, and where their points are, ECEF, m.
    pub(crate) points: Vec<(u64, Vector3<f64>)>,
}

/// What an installed camera tracks in each image of a voyage along `track`, and the steps of the visual odometry; `None` where there is no quay.
pub(crate) fn sightings(
    scenario: &Scenario,
    camera: &Camera,
    track: &Track,
    seed: u64,
) -> Option<(Vec<Sighting>, Vec<VisualOdometry>)> {
    let sighting = |time: Time, _: Vec<ImagePoint>, tracker: &Tracker<'_>| Sighting {
        t: time.as_seconds(),
        points: tracker.at_rest().collect(),
    };
    film(scenario, camera, track, seed, sighting)
}

/// Goes through all images, and keeps of each what `keep` makes of its time, its points and the tracks.
fn film<T>(
    scenario: &Scenario,
    camera: &Camera,
    track: &Track,
    seed: u64,
    keep: impl Fn(Time, Vec<ImagePoint>, &Tracker<'_>) -> T,
) -> Option<(Vec<T>, Vec<VisualOdometry>)> {
    let duration = scenario.duration();
    let quay = Quay::new(scenario, &camera.quay, track, seed)?;
    let rig = Rig::new(camera, &quay.axes, track);
    let troubles = Troubles::new(camera, &rig, duration);
    let mut tracker = Tracker::new(camera, &quay, seed);
    let image = |time: Time| {
        let t = time.as_seconds();
        let points = tracker.image(t, &rig.view(t), &troubles.at(t));
        keep(time, points, &tracker)
    };
    let images = epochs(camera.rate_hz, 1, duration).map(image).collect();
    Some((images, odometry::steps(camera, &rig, &troubles, duration, seed)))
}

#[cfg(test)]
mod tests;
