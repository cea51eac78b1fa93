//! `insd camera`: folders and pipes of images in, words, pictures and tables out.

#![cfg(feature = "vision")]
#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use tempfile::TempDir;

const SIZE: [usize; 2] = [160, 120];
const CALIBRATION: &str = "image_width: 160\nimage_height: 120\ncamera_matrix: [150, 0, 80, 0, 150, 60, 0, 0, 1]\n\
                           distortion_coefficients: [-0.1, 0.01, 0, 0]\n";

/// Grey squares of a scene that goes by at 2 px an image.
fn image(index: usize) -> Vec<u8> {
    let [width, height] = SIZE;
    let pixel = |x: usize, y: usize| {
        let (column, row) = ((x + 2 * index) / 9, y / 9);
        let grey = (column * 7919 + row * 104_729 + column * row * 31) % 199;
        // the noise of a sensor
        (grey + (x * 31 + y * 17 + index * 13) % 5) as u8
    };
    (0..height).flat_map(|y| (0..width).map(move |x| pixel(x, y))).collect()
}

/// A folder of images with what belongs to it; the last image has the time of the one before.
fn folder() -> (TempDir, PathBuf) {
    let folder = TempDir::new().unwrap();
    let mut times = "t_s,file\n".to_owned();
    let mut attitude = "t_s,roll_deg,pitch_deg,heading_deg\n".to_owned();
    for index in 0..12 {
        let t = index.min(10) as f64 / 10.0;
        let bytes =
            [format!("P5\n{} {}\n255\n", SIZE[0], SIZE[1]).into_bytes(), image(index)].concat();
        fs::write(folder.path().join(format!("{index}.pgm")), bytes).unwrap();
        times += &format!("{t:.1},{index}.pgm\n");
        attitude += &format!("{t:.1},0,0,0\n");
    }
    fs::write(folder.path().join("times.csv"), times).unwrap();
    fs::write(folder.path().join("nav.csv"), attitude).unwrap();
    let calibration = folder.path().join("camera.yaml");
    fs::write(&calibration, CALIBRATION).unwrap();
    (folder, calibration)
}

fn insd(what: &str, calibration: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_insd"));
    command.args(["camera", what, "--calibration"]).arg(calibration);
    command
}

fn said(command: &mut Command) -> String {
    String::from_utf8(command.assert().success().get_output().stdout.clone()).unwrap()
}

#[test]
fn a_folder_is_checked_in_words_and_as_a_picture() {
    let (folder, calibration) = folder();
    let picture = folder.path().join("seen.png");
    let mut check = insd("check", &calibration);
    check
        .arg(folder.path())
        .arg("--picture")
        .arg(&picture)
        .arg("--attitude")
        .arg(folder.path().join("nav.csv"));
    // all of the image is quay: the squares below the horizon are looked at
    let text = said(check.args(["--quay-px", "0,0,160,0,160,120,0,120"]));
    assert!(text.starts_with("images    11 used, 1 time stood still\ntracks    "), "{text}");
    for word in ["lost ", "refused ", "sharpness ", "exposure ", "doubtful  0 of 11 images"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert_eq!(fs::read(picture).unwrap()[..4], *b"\x89PNG");
}

#[test]
fn tracks_are_written_as_a_recording_holds_them() {
    let (folder, calibration) = folder();
    let out = folder.path().join("features.csv");
    said(insd("track", &calibration).arg(folder.path()).arg("--out").arg(&out));
    let table = fs::read_to_string(out).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0], ["t_s", "id", "u_px", "v_px"]);
    let of_the_first = rows.iter().filter(|row| row[1] == rows[1][1]);
    assert!(rows.len() > 200 && of_the_first.count() > 1, "{table}");
    assert!(
        rows[1..]
            .iter()
            .all(|row| row[0].len() == 5 && row[2].split_once('.').unwrap().1.len() == 2)
    );
}

#[test]
fn a_pipe_is_read_until_it_ends() {
    let (folder, calibration) = folder();
    let raw = folder.path().join("raw");
    fs::write(&raw, [image(0), image(1), vec![7; 100]].concat()).unwrap();
    let text =
        said(insd("check", &calibration).arg("--pipe").arg(format!("cat {}", raw.display())));
    assert!(text.starts_with("images    "), "{text}");
}

#[test]
fn a_calibration_that_is_wrong_is_told_with_its_place() {
    let (folder, calibration) = folder();
    fs::write(&calibration, CALIBRATION.replace("150, 0, 80", "150, 0")).unwrap();
    let output =
        insd("check", &calibration).arg(folder.path()).assert().code(2).get_output().stderr.clone();
    let text = String::from_utf8(output).unwrap();
    assert!(text.contains("camera.yaml:3: camera_matrix: wants 9 numbers, has 8"), "{text}");
}
