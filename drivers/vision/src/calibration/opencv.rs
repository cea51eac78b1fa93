//! What OpenCV's calibration writes, and ROS's `camera_info`, which has the same fields.

use super::fault::Reason;
use super::node::{Node, Value};
use crate::lens::{CameraCalibration, Lens};

/// `camera_matrix`, `distortion_coefficients`, `image_width`, `image_height`; a fisheye by `fisheye_model` or `distortion_model`.
pub(crate) fn camera(root: &Node) -> Result<CameraCalibration, Reason> {
    let size = [
        root.need("image_width")?.side("image_width")?,
        root.need("image_height")?.side("image_height")?,
    ];
    let matrix = data(root.need("camera_matrix")?, "camera_matrix")?;
    let k: [f64; 9] = matrix.array("camera_matrix")?;
    if k[1] != 0.0 || [k[3], k[6], k[7]] != [0.0; 3] || k[8] != 1.0 {
        return Err(Reason::new(matrix.line, "camera_matrix", "wants [fx 0 cx; 0 fy cy; 0 0 1]"));
    }
    let (focal, centre) = matrix.checked_axes("camera_matrix", [k[0], k[4], k[2], k[5]], size)?;
    let name = "distortion_coefficients";
    let lens = lens(data(root.need(name)?, name)?, name, is_fisheye(root)?)?;
    Ok(CameraCalibration { focal, centre, size, lens })
}

/// The numbers of a matrix of OpenCV, or a bare list.
fn data<'a>(node: &'a Node, name: &str) -> Result<&'a Node, Reason> {
    if matches!(node.value, Value::Map(_)) {
        return node.get("data").ok_or_else(|| Reason::new(node.line, name, "has no data"));
    }
    Ok(node)
}

fn is_fisheye(root: &Node) -> Result<bool, Reason> {
    let name = "distortion_model";
    if let Some(node) = root.get(name) {
        return match node.word(name)? {
            "plumb_bob" | "rational_polynomial" | "radtan" => Ok(false),
            "equidistant" | "fisheye" => Ok(true),
            other => Err(Reason::new(node.line, name, &format!("{other} is not known here"))),
        };
    }
    let name = "fisheye_model";
    root.get(name).map_or(Ok(false), |node| Ok(node.array::<1>(name)? != [0.0]))
}

fn lens(node: &Node, name: &str, fisheye: bool) -> Result<Lens, Reason> {
    if fisheye {
        return Ok(Lens::Equidistant { k: node.array(name)? });
    }
    let numbers = node.numbers(name)?;
    // k1 k2 p1 p2, k3, k4 k5 k6; then thin prisms and tilts, which are not known here
    let beyond = numbers.get(8..).unwrap_or_default();
    if ![0, 4, 5, 8, 12, 14].contains(&numbers.len()) || beyond.iter().any(|number| *number != 0.0)
    {
        let text = format!("has {} numbers, understood are 0, 4, 5 and 8", numbers.len());
        return Err(Reason::new(node.line, name, &text));
    }
    let at = |index: usize| numbers.get(index).copied().unwrap_or(0.0);
    Ok(Lens::RadialTangential { k: [at(0), at(1), at(4), at(5), at(6), at(7)], p: [at(2), at(3)] })
}
