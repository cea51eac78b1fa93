//! Tracks of points out of a camera's images, and the calibration of its lens.
//!
//! Pure: images with their times come in ([`CameraImage`]), what is left of each is a `CameraFrame` ([`FrontEnd`]). A bad image is counted
//! with its reason ([`BadImage`]) and changes nothing. Image points are counted as OpenCV does: the middle of the first pixel is (0, 0).

mod attitude;
mod calibration;
mod corners;
mod flow;
mod front_end;
mod image;
mod lens;
mod mask;
mod quality;
mod two_view;

pub use attitude::CameraAttitude;
pub use calibration::{CalibrationFault, read_calibration};
pub use front_end::{Eyesight, FrontEnd, FrontEndConfig, Hints, Lost, SeenTrack, Tracked};
pub use image::{BadImage, CameraImage, ImageCounts};
pub use lens::{CameraCalibration, Lens};
pub use mask::{ImageMask, Polygon};
pub use quality::ImageQuality;
pub use two_view::{RayPair, TwoView};

/// Head of a file of tracks (`features.csv`).
pub const FEATURES_HEAD: &str = "t_s,id,u_px,v_px";

/// Rows of a file of tracks for one image: seconds to 3 decimals, pixels to 2.
#[must_use]
pub fn feature_rows(frame: &insd_base::CameraFrame) -> String {
    let t = frame.time.as_seconds();
    let row =
        |p: &insd_base::ImagePoint| format!("{t:.3},{},{:.2},{:.2}\n", p.track, p.at.x, p.at.y);
    frame.points.iter().map(row).collect()
}
