//! What a simulated camera tells, as the text of files.

use std::fmt::Write;

use insd_base::VisualOdometry;
use insd_drivers::recording::CameraFiles;
use insd_simulator::{Footage, FootageSpec};
use serde::Serialize;

/// The table of `voyage.toml`.
#[derive(Debug, Serialize)]
struct Tables<'a> {
    camera: &'a FootageSpec,
}

/// The files of the camera of a voyage.
///
/// # Errors
/// Something in it cannot be written as TOML.
pub(super) fn files(footage: &Footage) -> anyhow::Result<CameraFiles> {
    Ok(CameraFiles {
        features: features(footage)?,
        odometry: odometry(footage)?,
        table: toml::to_string(&Tables { camera: &footage.spec })?,
    })
}

fn features(footage: &Footage) -> Result<String, std::fmt::Error> {
    let mut text = "t_s,id,u_px,v_px\n".to_owned();
    for frame in &footage.frames {
        let t = frame.time.as_seconds();
        for point in &frame.points {
            writeln!(text, "{t:.3},{},{:.2},{:.2}", point.track, point.at.x, point.at.y)?;
        }
    }
    Ok(text)
}

fn odometry(footage: &Footage) -> Result<String, std::fmt::Error> {
    let mut text =
        "t_s,t_prev_s,keyframe,map,qw,qx,qy,qz,tx,ty,tz,std_rot_rad,std_trans\n".to_owned();
    for VisualOdometry { time, since, map, rotation, translation, rotation_std, translation_std } in
        &footage.odometry
    {
        let [t, since] = [time, since].map(|own| own.as_seconds());
        let keyframe = (t / footage.keyframe_interval).round() - 1.0;
        write!(text, "{t:.3},{since:.3},{keyframe},{map}")?;
        let q = rotation.quaternion();
        for part in [q.w, q.i, q.j, q.k] {
            write!(text, ",{part:.9}")?;
        }
        for part in translation.iter().chain([rotation_std, translation_std]) {
            write!(text, ",{part:.6}")?;
        }
        text.push('\n');
    }
    Ok(text)
}
