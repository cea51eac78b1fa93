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
