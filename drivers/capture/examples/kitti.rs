//! How far the front end drifts on images with poses, by the true length of each step:
//! `cargo run --release -p insd-capture --example kitti -- DIR`, with `DIR/image_l/*.png`, `DIR/poses.txt`, `DIR/calib.txt`.

use std::path::{Path, PathBuf};

use anyhow::Context;
use insd_base::Time;
use insd_capture::read_image;
use insd_vision::{CameraCalibration, CameraImage, FrontEnd, FrontEndConfig, Hints, Lens};
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector2, Vector3};

fn main() -> anyhow::Result<()> {
    let folder = PathBuf::from(std::env::args().nth(1).context("which folder?")?);
    let truth = poses(&folder)?;
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder.join("image_l"))?
        .map(|entry| Ok(entry?.path()))
        .collect::<anyhow::Result<_>>()?;
    files.sort();
    let size = read_image(&files[0])?.size;
    let mut eyes = FrontEnd::new(calibration(&folder, size)?, FrontEndConfig::default())
        .context("small images")?;
    let (mut pose, mut sailed) = (truth[0], 0.0);
    let (mut turns, mut aims) = (Vec::new(), Vec::new());
    for (i, file) in files.iter().enumerate() {
        let image = read_image(file)?;
        let time = Time::from_seconds(i as f64 / 10.0);
        let seen = eyes.take(&CameraImage { time, size, pixels: &image.pixels }, &Hints::default());
        let Some(seen) = seen.ok().filter(|_| i > 0) else { continue };
        let true_step = truth[i - 1].inverse() * truth[i];
        let length = true_step.translation.vector.norm();
        // the motion turns from the earlier camera to the later one; the step is its inverse
        let motion = eyes.motion();
        let turn = UnitQuaternion::from_rotation_matrix(&motion.rotation);
        let step =
            Isometry3::from_parts(Translation3::from(motion.direction.into_inner() * length), turn)
                .inverse();
        turns.push((step.rotation.inverse() * true_step.rotation).angle().to_degrees());
        aims.push(step.translation.vector.angle(&true_step.translation.vector).to_degrees());
        pose *= step;
        sailed += length;
        let off = (pose.translation.vector - truth[i].translation.vector).norm();
        println!(
            "{i:3} {:3} points go on, {:?}, off {off:.2} m",
            seen.lost.sought - seen.lost.gone,
            seen.lost
        );
    }
    let last = truth[files.len() - 1].translation.vector;
    let off = (pose.translation.vector - last).norm();
    println!(
        "turn {:.3} deg, direction {:.2} deg (medians of steps)",
        median(&mut turns),
        median(&mut aims)
    );
    println!("end drift {off:.2} m of {sailed:.1} m: {:.2} %", 100.0 * off / sailed);
    Ok(())
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn numbers(path: &Path) -> anyhow::Result<Vec<f64>> {
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    text.split_whitespace().map(|word| Ok(word.parse()?)).collect()
}

fn calibration(folder: &Path, size: [u32; 2]) -> anyhow::Result<CameraCalibration> {
    let k = numbers(&folder.join("calib.txt"))?;
    let (focal, centre) = (Vector2::new(k[0], k[5]), Vector2::new(k[2], k[6]));
    Ok(CameraCalibration { focal, centre, size, lens: Lens::STRAIGHT })
}

/// From camera axes to those of the first image.
fn poses(folder: &Path) -> anyhow::Result<Vec<Isometry3<f64>>> {
    let numbers = numbers(&folder.join("poses.txt"))?;
    let pose = |row: &[f64]| {
        let c =
            Matrix3::new(row[0], row[1], row[2], row[4], row[5], row[6], row[8], row[9], row[10]);
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix(&c));
        Isometry3::from_parts(Translation3::from(Vector3::new(row[3], row[7], row[11])), turn)
    };
    Ok(numbers.chunks_exact(12).map(pose).collect())
}
