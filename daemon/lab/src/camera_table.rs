//! The table `[camera]` of `voyage.toml`: how a camera looks at the world.

use std::fs;
use std::path::Path;

use insd_config::{BadInput, CameraSection, CameraTold};
use insd_nav::config::CameraAid;
use serde::Deserialize;

use crate::camera_voyage::CameraWay;

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
    let aid = table.section(way).aid().map_err(|(key, expected)| {
        BadInput(format!("{}: camera.{key}: expected {expected}", path.display()))
    })?;
    Ok(Some(aid))
}

impl CameraTable {
    /// The same as the section of a ship that uses it in a way.
    fn section(self, way: CameraWay) -> CameraSection {
        CameraSection {
            lever_m: self.lever_arm_m,
            rotation_body_from_camera: Some(self.rotation_body_from_camera),
            k: self.k,
            size_px: self.size_px,
            pixel_std: self.pixel_std,
            axes_std_deg: self.axes_std_deg,
            delay_std_s: self.delay_std_s,
            way: match way {
                CameraWay::Tracks => CameraTold::Tracks,
                CameraWay::Increments => CameraTold::Increments,
            },
            log_scale_std: self.log_scale_std,
            log_scale_walk_sqrt_s: self.log_scale_walk_sqrt_s,
            ..CameraSection::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use insd_base::units::DEG;

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
