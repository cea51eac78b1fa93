//! What Kalibr writes: a camera of its camchain.

use super::fault::Reason;
use super::node::Node;
use crate::lens::{CameraCalibration, Lens};

/// `camera_model: pinhole`, `intrinsics`, `distortion_model`, `distortion_coeffs`, `resolution`.
pub(crate) fn camera(camera: &Node) -> Result<CameraCalibration, Reason> {
    let model = camera.need("camera_model")?;
    let word = model.word("camera_model")?;
    if word != "pinhole" {
        return Err(Reason::new(
            model.line,
            "camera_model",
            &format!("{word} is not known here, pinhole is"),
        ));
    }
    let size = camera.need("resolution")?.sides("resolution")?;
    let intrinsics = camera.need("intrinsics")?;
    let axes = intrinsics.array::<4>("intrinsics")?;
    let (focal, centre) = intrinsics.checked_axes("intrinsics", axes, size)?;
    Ok(CameraCalibration { focal, centre, size, lens: lens(camera)? })
}

fn lens(camera: &Node) -> Result<Lens, Reason> {
    let model = camera.need("distortion_model")?;
    let coefficients = || camera.need("distortion_coeffs")?.array::<4>("distortion_coeffs");
    match model.word("distortion_model")? {
        "none" => Ok(Lens::STRAIGHT),
        "radtan" => {
            let [k1, k2, p1, p2] = coefficients()?;
            Ok(Lens::RadialTangential { k: [k1, k2, 0.0, 0.0, 0.0, 0.0], p: [p1, p2] })
        }
        "equidistant" => Ok(Lens::Equidistant { k: coefficients()? }),
        other => {
            let text = format!("{other} is not known here; radtan, equidistant and none are");
            Err(Reason::new(model.line, "distortion_model", &text))
        }
    }
}
