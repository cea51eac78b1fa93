//! What a simulated camera tells, as the text of files.

use std::fmt::Write;

use insd_base::VisualOdometry;
use insd_drivers::recording::{CameraFiles, FEATURES_HEAD, feature_rows};
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
        features: features(footage),
        odometry: odometry(footage)?,
        table: toml::to_string(&Tables { camera: &footage.spec })?,
    })
}

fn features(footage: &Footage) -> String {
    let rows: String = footage.frames.iter().map(feature_rows).collect();
    format!("{FEATURES_HEAD}\n{rows}")
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

#[cfg(test)]
mod tests {
    use insd_simulator::{Scenario, footage, shipped};

    use super::*;

    fn written() -> (Footage, CameraFiles) {
        let text = shipped().iter().find(|(file, _)| file.starts_with("30")).unwrap().1;
        let scenario = Scenario::from_toml(text).unwrap().with_duration(5.0);
        let footage = footage(&scenario, 1).unwrap();
        let files = files(&footage).unwrap();
        (footage, files)
    }

    #[test]
    fn each_point_and_each_step_is_a_row() {
        let (footage, files) = written();
        let points: usize = footage.frames.iter().map(|frame| frame.points.len()).sum();
        assert_eq!(files.features.lines().count(), 1 + points);
        let first = &footage.frames[0].points[0];
        let row = format!("0.500,{},{:.2},{:.2}", first.track, first.at.x, first.at.y);
        assert_eq!(files.features.lines().nth(1), Some(row.as_str()));
        assert_eq!(files.odometry.lines().count(), 1 + footage.odometry.len());
        let numbers = |row: &str| -> Vec<f64> {
            row.split(',').map(|field| field.parse().unwrap()).collect()
        };
        let row = numbers(files.odometry.lines().nth(1).unwrap());
        assert_eq!((row.len(), &row[..4]), (13, &[1.0, 0.5, 1.0, 0.0][..]));
        assert!((row[4..8].iter().map(|part| part * part).sum::<f64>() - 1.0).abs() < 1e-8);
    }

    #[test]
    fn the_table_has_the_keys_of_the_format() {
        let table: toml::Table = written().1.table.parse().unwrap();
        let camera = &table["camera"];
        assert_eq!(camera["lever_arm_m"].as_array().map(Vec::len), Some(3));
        assert_eq!(camera["rotation_body_from_camera"][2].as_array().map(Vec::len), Some(3));
        assert_eq!(camera["k"][0][2].as_float(), Some(640.0));
        assert_eq!(camera["size_px"][1].as_integer(), Some(720));
        for key in ["pixel_std", "log_scale_std", "log_scale_walk_sqrt_s"] {
            assert!(camera[key].as_float().is_some(), "{key}");
        }
    }
}
