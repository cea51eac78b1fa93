//! What both commands are told of the camera.

use std::fs;
use std::path::PathBuf;

use anyhow::Context;
use insd_config::BadInput;
use insd_vision::{
    CameraCalibration, FrontEnd, FrontEndConfig, ImageMask, Polygon, read_calibration,
};
use nalgebra::{Matrix3, Rotation3, Vector2};

use super::attitude::Attitudes;

/// The camera and how it is mounted.
#[derive(Clone, Debug, clap::Args)]
pub(super) struct CameraOptions {
    /// Calibration as OpenCV (YAML, XML), ROS or Kalibr (camchain) writes it
    #[arg(long, value_name = "FILE")]
    calibration: PathBuf,
    /// Attitude of the ship: any table with t_s, roll_deg, pitch_deg and heading_deg, as a replay writes it
    #[arg(long, value_name = "CSV")]
    attitude: Option<PathBuf>,
    /// How the camera is turned from one that looks ahead and level: clockwise, up, to starboard
    #[arg(long, value_name = "ROLL,PITCH,YAW", default_value = "0,0,0", allow_hyphen_values = true, value_parser = angles)]
    mounting_deg: [f64; 3],
    /// Corners of the quay in the image: below the horizon nothing else is looked at; may be repeated
    #[arg(long, value_name = "X,Y,X,Y,...", value_parser = polygon)]
    quay_px: Vec<Corners>,
    /// Corners of the own ship in the image, which are left out; may be repeated
    #[arg(long, value_name = "X,Y,X,Y,...", value_parser = polygon)]
    own_ship_px: Vec<Corners>,
}

/// A polygon of the command line.
#[derive(Clone, Debug)]
struct Corners(Polygon);

fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let number = |word: &str| word.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    text.split(',').map(|word| number(word).ok_or_else(|| format!("{word} is no number"))).collect()
}

fn angles(text: &str) -> Result<[f64; 3], String> {
    numbers(text)?.try_into().map_err(|_| "wants three angles".to_owned())
}

fn polygon(text: &str) -> Result<Corners, String> {
    let numbers = numbers(text)?;
    if numbers.len() < 6 || numbers.len() % 2 == 1 {
        return Err("wants three corners or more".to_owned());
    }
    Ok(Corners(numbers.chunks_exact(2).map(|corner| Vector2::new(corner[0], corner[1])).collect()))
}

impl CameraOptions {
    /// The calibration of the file.
    pub(super) fn camera(&self) -> anyhow::Result<CameraCalibration> {
        let place = self.calibration.display().to_string();
        let text = fs::read_to_string(&self.calibration).with_context(|| place.clone())?;
        Ok(read_calibration(&place, &text).map_err(|fault| BadInput(fault.to_string()))?)
    }

    /// Attitudes of the camera, where there is a table.
    pub(super) fn attitudes(&self) -> anyhow::Result<Attitudes> {
        let read = |path: &PathBuf| Attitudes::read(path, &self.c_bc());
        Ok(self.attitude.as_ref().map(read).transpose()?.unwrap_or_default())
    }

    /// Eyes for this camera.
    pub(super) fn front_end(&self, camera: &CameraCalibration) -> anyhow::Result<FrontEnd> {
        let [width, height] = camera.size;
        let small = || {
            BadInput(format!("images of {width} x {height} px are too small to follow points in"))
        };
        let mut eyes = FrontEnd::new(*camera, FrontEndConfig::default()).ok_or_else(small)?;
        let polygons =
            |corners: &[Corners]| corners.iter().map(|corners| corners.0.clone()).collect();
        eyes.mask =
            ImageMask { quay: polygons(&self.quay_px), own_ship: polygons(&self.own_ship_px) };
        Ok(eyes)
    }

    /// From camera axes (x right, y down, z ahead) to body axes.
    fn c_bc(&self) -> Rotation3<f64> {
        let ahead = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
        let [roll, pitch, yaw] = self.mounting_deg.map(f64::to_radians);
        Rotation3::from_euler_angles(roll, pitch, yaw) * Rotation3::from_matrix_unchecked(ahead)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;

    #[test]
    fn a_camera_that_is_turned_to_starboard_and_up_looks_there() {
        let options = CameraOptions {
            calibration: PathBuf::new(),
            attitude: None,
            mounting_deg: [0.0, 10.0, 90.0],
            quay_px: Vec::new(),
            own_ship_px: Vec::new(),
        };
        // forward, starboard, down
        let (sin, cos) = 10.0_f64.to_radians().sin_cos();
        assert!((options.c_bc() * Vector3::z() - Vector3::new(0.0, cos, -sin)).norm() < 1e-12);
        assert!((options.c_bc() * Vector3::x() - Vector3::new(-1.0, 0.0, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn a_polygon_has_three_corners_at_least() {
        assert_eq!(polygon("1,2, 3,4,5,6").map(|corners| corners.0.len()), Ok(3));
        for wrong in ["1,2,3,4", "1,2,3,4,5,6,7", "1,2,3,4,5,x", ""] {
            assert!(polygon(wrong).is_err(), "{wrong}");
        }
    }
}
