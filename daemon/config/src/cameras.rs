//! What the configuration makes of a camera.

use insd_intake::config::Kind;

use crate::file::Config;

/// All that is wrong with the camera.
pub(crate) fn faults(config: &Config) -> Vec<String> {
    let own = config.sensors.iter().filter(|sensor| sensor.kind == Kind::Camera);
    let Some(camera) = &config.camera else {
        let lacks = |name: &str| {
            format!(
                "[[sensor]] \"{name}\": kind: expected a section [camera] that tells how it sits"
            )
        };
        return own.map(|sensor| lacks(&sensor.name)).collect();
    };
    let mut faults = Vec::new();
    let names: Vec<&str> = own.map(|sensor| sensor.name.as_str()).collect();
    if names.len() > 1 {
        faults.push(format!("[[sensor]] \"{}\": kind: expected one camera at most", names[1]));
    }
    if !names.contains(&camera.sensor.as_str()) {
        faults
            .push("[camera]: sensor: expected the name of a [[sensor]] of kind camera".to_owned());
    }
    let wrong = camera.aid().err();
    faults.extend(wrong.map(|(key, expected)| format!("[camera]: {key}: expected {expected}")));
    faults
}

#[cfg(test)]
mod tests {
    use insd_base::Body;
    use insd_base::units::DEG;
    use insd_nav::config::OdometryModel;
    use nalgebra::Vector3;

    use super::*;

    const SURVEY: &str = include_str!("../../../systemd/examples/survey.toml");
    const CAMERA: &str = "
[[sensor]]
name = \"eyes\"
port = \"bridge-in\"
kind = \"camera\"
latency_s = 0.04
[camera]
sensor = \"eyes\"
lever_m = [25.0, 5.0, -8.0]
mounting_deg = [0.0, -12.0, 60.0]
k = [[800.0, 0.0, 640.0], [0.0, 800.0, 360.0], [0.0, 0.0, 1.0]]
size_px = [1280, 720]
axes_std_deg = 0.5
";

    fn with(from: &str, to: &str) -> String {
        assert!(CAMERA.contains(from), "{from}");
        format!("{SURVEY}{}", CAMERA.replacen(from, to, 1))
    }

    #[test]
    fn a_camera_is_an_aid_of_the_engine_and_looks_where_it_is_said_to() {
        let config = Config::of_text(&with("axes", "axes")).unwrap();
        let aid = config.engine().models.camera.unwrap();
        assert!((aid.axes_std - 0.5 * DEG).abs() < 1e-12 && aid.odometry.is_none());
        assert_eq!(aid.model.lever, Body::new(25.0, 5.0, -8.0));
        let axis = aid.model.c_bc * Vector3::z();
        let (sin, cos) = (60.0 * DEG).sin_cos();
        let level = (12.0 * DEG).cos();
        assert!((axis - Vector3::new(level * cos, level * sin, (12.0 * DEG).sin())).norm() < 1e-9);
        let config = Config::of_text(&with("axes_std_deg", "use = \"increments\"\n#")).unwrap();
        let aid = config.engine().models.camera.unwrap();
        assert_eq!(aid.odometry, Some(OdometryModel::default()));
    }

    #[test]
    fn each_mistake_is_told_with_its_key_and_what_was_expected() {
        for (from, to, told) in [
            ("sensor = \"eyes\"", "sensor = \"eye\"", "[camera]: sensor: expected the name"),
            ("[[800.0", "[[-800.0", "[camera]: k: expected"),
            ("[1280", "[0", "[camera]: size_px: expected width"),
            ("axes_std_deg = 0.5", "pixel_std = 0.0", "pixel_std: expected a number above zero"),
            ("mounting_deg", "#", "mounting_deg: expected either this or"),
            ("[25.0", "[2500.0", "[camera]: lever_m: expected"),
            ("[camera]", "[[camera]]", "camera"),
            ("kind = \"camera\"", "kind = \"ranging\"", "[camera]: sensor: expected"),
        ] {
            let fault = Config::of_text(&with(from, to)).unwrap_err().to_string();
            assert!(fault.contains(told), "{fault}");
        }
        let lonely = CAMERA.split("[camera]").next().unwrap();
        let fault = Config::of_text(&format!("{SURVEY}{lonely}")).unwrap_err().to_string();
        assert!(fault.contains("[camera]"), "{fault}");
    }
}
