//! Calibrations of cameras from files: OpenCV (YAML, XML; also the YAML of ROS) and Kalibr (camchain).

mod fault;
mod kalibr;
mod node;
mod opencv;
#[cfg(test)]
mod tests;
mod xml;
mod yaml;

use crate::lens::CameraCalibration;

pub use fault::CalibrationFault;
use fault::Reason;
use node::Node;

/// Reads the text of a calibration, whichever of the forms it has; `place` is for complaints. Of several cameras the first is taken.
///
/// # Errors
/// With line and field what is wrong.
pub fn read_calibration(place: &str, text: &str) -> Result<CameraCalibration, CalibrationFault> {
    read(text).map_err(|reason| reason.at(place))
}

fn read(text: &str) -> Result<CameraCalibration, Reason> {
    let is_xml = text.trim_start().starts_with('<');
    let root = if is_xml { xml::parse(text)? } else { yaml::parse(text)? };
    if let Some(camera) = first_camera(&root) {
        return kalibr::camera(camera);
    }
    if root.get("camera_matrix").is_some() {
        return opencv::camera(&root);
    }
    Err(Reason::new(
        root.line,
        "camera_matrix",
        "neither this (OpenCV, ROS) nor cam0 (Kalibr) is there",
    ))
}

fn first_camera(root: &Node) -> Option<&Node> {
    let mut entries = root.entries().iter();
    entries
        .find(|(name, _)| name.starts_with("cam") && name[3..].parse::<u32>().is_ok())
        .map(|(_, node)| node)
}
