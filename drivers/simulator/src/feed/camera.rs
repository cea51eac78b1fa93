//! Images: the points that are followed in them, as the front end of a camera tells them.

use insd_base::CameraFrame;
use insd_wire::nmea::{Pinsd, PinsdTracks, TRACK_NUMBERS, TrackedPoint};

use super::line::{Line, LineSending};
use super::sensor::{Encoding, FeedConfig};

/// The front end's clock begins again after this, s.
const TURN: f64 = 1e6;

/// Everything that the cameras of a ship send of these images, in order of time. The voyage itself has none: they are of
/// [`crate::footage`].
#[must_use]
pub fn film(frames: &[CameraFrame], config: &FeedConfig) -> Vec<LineSending> {
    let mut all = Vec::new();
    for (port, sensor) in config.sensors.iter().enumerate() {
        if sensor.encoding != Encoding::Tracks {
            continue;
        }
        let mut line = Line::new(config.port_of(port), sensor);
        for frame in frames {
            let own = sensor.clock.nanos(frame.time) as f64 * 1e-9;
            for told in PinsdTracks::of_image(own.rem_euclid(TURN), &points(frame)) {
                line.send(frame.time, Pinsd::Tracks(told).write().as_bytes());
            }
        }
        all.append(&mut line.sent);
    }
    all.sort_by_key(|sending| sending.at);
    all
}

fn points(frame: &CameraFrame) -> Vec<TrackedPoint> {
    let track = |number: u64| u32::try_from(number % u64::from(TRACK_NUMBERS)).unwrap_or_default();
    let point =
        |own: &insd_base::ImagePoint| TrackedPoint { track: track(own.track), at: own.at.into() };
    frame.points.iter().map(point).collect()
}
