use nalgebra::Vector2;
use proptest::prelude::*;

use super::read_calibration;
use crate::lens::{CameraCalibration, Lens};

const OPENCV: &str = "%YAML:1.0
---
calibration_time: \"Tue 03 Mar 2026 10:00:00\"
image_width: 1280
image_height: 720
flags: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 8.0125e+02, 0., 6.4050000000000000e+02, 0., 8.02e+02, # rows
       3.605e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.8e-01, 7.0e-02, 2.0e-04, -1.0e-04, 3.0e-03 ]
";

const OPENCV_XML: &str = "<?xml version=\"1.0\"?>
<opencv_storage>
<!-- a camera
  on the bridge -->
<image_width>1280</image_width>
<image_height>720</image_height>
<camera_matrix type_id=\"opencv-matrix\">
  <rows>3</rows>
  <cols>3</cols>
  <dt>d</dt>
  <data>
    8.0125e+02 0. 6.4050000000000000e+02 0. 8.02e+02
    3.605e+02 0. 0. 1.</data></camera_matrix>
<distortion_coefficients type_id=\"opencv-matrix\">
  <rows>5</rows>
  <cols>1</cols>
  <dt>d</dt>
  <data>
    -2.8e-01 7.0e-02 2.0e-04 -1.0e-04 3.0e-03</data></distortion_coefficients>
</opencv_storage>
";

const KALIBR: &str = "cam0:
  T_cam_imu:
  - [0.0, -1.0, 0.0, 0.1]
  - [0.0, 0.0, -1.0, 0.2]
  - [1.0, 0.0, 0.0, 0.3]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.01, 0.02, -0.01, 0.002]
  distortion_model: equidistant
  intrinsics: [460.0, 461.0, 370.5, 240.5]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
cam1:
  camera_model: omni
";

fn expected() -> CameraCalibration {
    CameraCalibration {
        focal: Vector2::new(801.25, 802.0),
        centre: Vector2::new(640.5, 360.5),
        size: [1280, 720],
        lens: Lens::RadialTangential { k: [-0.28, 0.07, 0.003, 0.0, 0.0, 0.0], p: [2e-4, -1e-4] },
    }
}

fn told(text: &str) -> String {
    read_calibration("camera", text).unwrap_err().to_string()
}

#[test]
fn opencv_says_the_same_in_yaml_and_xml() {
    assert_eq!(read_calibration("camera", OPENCV), Ok(expected()));
    assert_eq!(read_calibration("camera", OPENCV_XML), Ok(expected()));
}

#[test]
fn a_camera_of_kalibr_is_read() {
    let read = read_calibration("camera", KALIBR).unwrap();
    assert_eq!((read.focal, read.size), (Vector2::new(460.0, 461.0), [752, 480]));
    assert_eq!(read.lens, Lens::Equidistant { k: [-0.01, 0.02, -0.01, 0.002] });
}

#[test]
fn dashes_are_a_list_as_brackets_are() {
    let dashed = KALIBR
        .replace("[460.0, 461.0, 370.5, 240.5]", "\n  - 460.0\n  - 461.0\n  - 370.5\n  - 240.5");
    assert_eq!(read_calibration("camera", &dashed), read_calibration("camera", KALIBR));
}

#[test]
fn a_fisheye_of_ros_is_read() {
    let fisheye = "image_width: 640\nimage_height: 480\ncamera_matrix:\n  data: [300, 0, 320, 0, 300, 240, 0, 0, 1]\n\
                   distortion_model: equidistant\ndistortion_coefficients:\n  data: [0.1, 0, 0, 0]\n";
    assert_eq!(
        read_calibration("camera", fisheye).unwrap().lens,
        Lens::Equidistant { k: [0.1, 0.0, 0.0, 0.0] }
    );
}

#[test]
fn what_is_wrong_is_told_with_line_and_field() {
    let opencv = |from: &str, to: &str| told(&OPENCV.replace(from, to));
    let kalibr = |from: &str, to: &str| told(&KALIBR.replace(from, to));
    for (told, expected) in [
        (opencv("image_width: 1280\n", ""), "camera:3: image_width: is missing"),
        (opencv("1280", "1280.5"), "camera:4: image_width: 1280.5 is no count of pixels"),
        (opencv("0., 0., 1. ]", "0., 1. ]"), "camera:11: camera_matrix: wants 9 numbers, has 8"),
        (opencv("3.605e+02", "3.6o5e+02"), "camera:12: camera_matrix: 3.6o5e+02 is no number"),
        (opencv("8.02e+02", "-8.02e+02"), "camera:11: camera_matrix: focal lengths are positive"),
        (
            opencv("6.4050000000000000e+02", "6405"),
            "camera:11: camera_matrix: the centre 6405, 360.5 lies outside the image",
        ),
        (
            opencv(", 3.0e-03 ]", ", 0, 0 ]"),
            "camera:17: distortion_coefficients: has 6 numbers, understood are 0, 4, 5 and 8",
        ),
        (
            opencv("1. ]", "1."),
            "camera:11: data: [ 8.0125e+02, 0., 6.4050000000000000e+02, 0., 8.02e+02,: has a bracket that is not closed",
        ),
        (kalibr("pinhole", "omni"), "camera:8: camera_model: omni is not known here, pinhole is"),
        (
            kalibr("equidistant", "fov"),
            "camera:10: distortion_model: fov is not known here; radtan, equidistant and none are",
        ),
        (kalibr("370.5, ", ""), "camera:11: intrinsics: wants 4 numbers, has 3"),
        (
            told(
                "image_width: 9\nimage_height: 9\ncamera_matrix: [9, 0, 4, 0, 9, 4, 0, 0, 1]\ndistortion_coefficients:\n",
            ),
            "camera:4: distortion_coefficients: wants numbers",
        ),
        (
            told("width: 3\n"),
            "camera:1: camera_matrix: neither this (OpenCV, ROS) nor cam0 (Kalibr) is there",
        ),
        (told("width\n"), "camera:1: width: wants `name: value`"),
        (told(""), "camera:1: file: is empty"),
        (told("<a>\n<b>1</a>"), "camera:2: a: closes what is not open"),
        (told("<a><b>1</b>"), "camera:1: a: is not closed"),
    ] {
        assert_eq!(told, expected);
    }
}

proptest! {
    #[test]
    fn damaged_files_never_make_it_panic(at in 0..2000_usize, with in "[\\[\\]<>:#\"' \n-]{0,4}", cut in 0..40_usize) {
        for text in [OPENCV, OPENCV_XML, KALIBR] {
            let at = at % text.len();
            let damaged = format!("{}{with}{}", &text[..at], &text[(at + cut).min(text.len())..]);
            let _ = read_calibration("camera", &damaged);
        }
    }
}
