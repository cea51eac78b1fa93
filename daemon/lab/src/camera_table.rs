//! The table `[camera]` of `voyage.toml`: how a camera looks at the world.

use std::fs;
use std::path::Path;

use insd_base::units::DEG;
use insd_base::{Body, CameraModel};
use insd_config::BadInput;
use insd_nav::config::{CameraAid, OdometryModel};
use nalgebra::{Matrix3, Vector2};
use serde::Deserialize;

use crate::camera_voyage::CameraWay;

/// Error of an image point where nobody says, px.
const PIXEL_STD: f64 = 1.0;

#[derive(Debug, Deserialize)]
struct File {
    camera: Option<CameraTable>,
}

#[derive(Clone, Debug, Deserialize)]
struct CameraTable {
    lever_arm_m: [f64; 3],
    rotation_body_from_camera: [[f64; 3]; 3],
    k: [[f64; 3]; 3],
    size_px: [u32; 2],
    pixel_std: Option<f64>,
    axes_std_deg: Option<f64>,
    delay_std_s: Option<f64>,
    log_scale_std: Option<f64>,
    log_scale_walk_sqrt_s: Option<f64>,
}

/// Reads the table for a way in which the camera is used; `None` where there is none.
///
/// # Errors
/// The file is no TOML, or no camera is like that.
pub(crate) fn read(dir: &Path, way: CameraWay) -> anyhow::Result<Option<CameraAid>> {
    let path = dir.join("voyage.toml");
    let text = fs::read_to_string(&path)?;
    let file: File =
        toml::from_str(&text).map_err(|error| BadInput(format!("{}: {error}", path.display())))?;
    let Some(table) = file.camera else { return Ok(None) };
    let aid = table.aid().map_err(|(key, expected)| {
        BadInput(format!("{}: camera.{key}: {expected}", path.display()))
    })?;
    let odometry = (way == CameraWay::Increments).then(|| table.odometry());
    Ok(Some(CameraAid { odometry, ..aid }))
}

impl CameraTable {
    /// The camera, or which key is wrong and what was expected.
    fn aid(&self) -> Result<CameraAid, (&'static str, &'static str)> {
        let rows = |m: &[[f64; 3]; 3]| Matrix3::from_fn(|i, j| m[i][j]);
        let c_bc = rows(&self.rotation_body_from_camera);
        let is_rotation = (c_bc.transpose() * c_bc - Matrix3::identity()).amax() < 1e-3
            && c_bc.determinant() > 0.0;
        if !is_rotation {
            return Err((
                "rotation_body_from_camera",
                "expected a rotation, rows of three numbers",
            ));
        }
        let k = rows(&self.k);
        let is_upright = k[(0, 0)] > 0.0 && k[(1, 1)] > 0.0 && k.iter().all(|x| x.is_finite());
        if !is_upright {
            return Err((
                "k",
                "expected [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] with fx and fy above zero",
            ));
        }
        if self.size_px.contains(&0) {
            return Err(("size_px", "expected width and height, above zero"));
        }
        let sigmas = [
            self.pixel_std,
            self.axes_std_deg,
            self.delay_std_s,
            self.log_scale_std,
            self.log_scale_walk_sqrt_s,
        ];
        let names =
            ["pixel_std", "axes_std_deg", "delay_std_s", "log_scale_std", "log_scale_walk_sqrt_s"];
        let is_none = |std: &Option<f64>| std.is_some_and(|std| !(std > 0.0 && std.is_finite()));
        if let Some(place) = sigmas.iter().position(is_none) {
            return Err((names[place], "expected a number above zero"));
        }
        let model = CameraModel {
            lever: Body(self.lever_arm_m.into()),
            c_bc,
            focal: Vector2::new(k[(0, 0)], k[(1, 1)]),
            centre: Vector2::new(k[(0, 2)], k[(1, 2)]),
            size: self.size_px,
            pixel_std: self.pixel_std.unwrap_or(PIXEL_STD),
        };
        let usual = CameraAid::new(model);
        Ok(CameraAid {
            axes_std: self.axes_std_deg.map_or(usual.axes_std, |std| std * DEG),
            delay_std: self.delay_std_s.unwrap_or(usual.delay_std),
            ..usual
        })
    }

    /// Its visual odometry. The logarithm of a scale is off by what the scale is, as a ratio, to the first order.
    fn odometry(&self) -> OdometryModel {
        let usual = OdometryModel::default();
        OdometryModel {
            scale_std: self.log_scale_std.unwrap_or(usual.scale_std),
            scale_walk: self.log_scale_walk_sqrt_s.unwrap_or(usual.scale_walk),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "[camera]\nlever_arm_m = [25.0, 5.0, -8.0]\n\
        rotation_body_from_camera = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]\n\
        k = [[800.0, 0.0, 640.0], [0.0, 800.0, 360.0], [0.0, 0.0, 1.0]]\nsize_px = [1280, 720]\n";

    fn read_text(text: &str) -> anyhow::Result<Option<CameraAid>> {
        let desk = tempfile::tempdir().unwrap();
        fs::write(desk.path().join("voyage.toml"), text).unwrap();
        read(desk.path(), CameraWay::Tracks)
    }

    #[test]
    fn a_camera_is_read_and_what_is_not_said_is_usual() {
        let aid = read_text(&format!("{TABLE}axes_std_deg = 0.1\n")).unwrap().unwrap();
        assert_eq!(aid.model.focal.x, 800.0);
        assert!((aid.axes_std - 0.1 * DEG).abs() < 1e-12 && aid.delay_std == 0.02);
        assert_eq!(read_text("mode = \"moored\"\n").unwrap(), None);
    }

    #[test]
    fn what_no_camera_is_like_is_refused_with_its_key() {
        for (from, to, key) in [
            ("[[0.0, 0.0, 1.0]", "[[0.0, 0.0, 2.0]", "rotation_body_from_camera"),
            ("[[800.0", "[[-800.0", "camera.k"),
            ("[1280", "[0", "size_px"),
        ] {
            let fault = read_text(&TABLE.replace(from, to)).unwrap_err().to_string();
            assert!(fault.contains(key), "{fault}");
        }
        let fault = read_text(&format!("{TABLE}pixel_std = 0\n")).unwrap_err().to_string();
        assert!(fault.contains("pixel_std"), "{fault}");
    }
}
