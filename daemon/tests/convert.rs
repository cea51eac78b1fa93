//! `insd convert --to` from outside.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use assert_cmd::Command;

/// Standard error of a command that must end with this status.
fn told(arguments: &[&str], status: i32) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_insd")).args(arguments).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {message}");
    message
}

const SCENARIO: &str = r#"
name = "short"
mode = "underway"
start_utc = "2026-05-01T08:00:00Z"
[start]
lat_deg = 35.0
lon_deg = 61.75
height_m = 20.0
[[route.legs]]
heading_deg = 145.0
speed_kn = 12.0
duration_s = 60.0
[imu]
grade = "mems"
[gnss]
"#;

fn name(dir: &Path, file: &str) -> String {
    dir.join(file).display().to_string()
}

#[test]
fn a_voyage_and_its_solution_become_the_same_track() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    fs::write(dir.join("short.toml"), SCENARIO).unwrap();
    let [scenario, voyage, nav] =
        ["short.toml", "voyage", "voyage.csv"].map(|file| name(dir, file));
    told(&["simulate", &scenario, "--seed", "1", "--out", &voyage], 0);
    told(&["replay", &voyage, "--out", &nav], 0);
    let utc = "2026-05-01T08:00:00Z";
    for format in ["gpx", "geojson"] {
        let [own, other] = ["own", "other"].map(|file| name(dir, &format!("{file}.{format}")));
        let message = told(&["convert", &voyage, "--to", format, "--out", &own], 0);
        assert!(message.contains("rows in"), "{message}");
        told(&["convert", &nav, "--to", format, "--start-utc", utc, "--out", &other], 0);
        let [own, other] = [own, other].map(|file| fs::read_to_string(file).unwrap());
        assert!(own == other && own.contains("2026-05-01T08:00:10.1Z"), "{format}");
    }
    let mcap = name(dir, "own.mcap");
    told(&["convert", &voyage, "--to", "mcap", "--out", &mcap], 0);
    assert!(fs::read(&mcap).unwrap().starts_with(b"\x89MCAP0\r\n"));
}

#[test]
fn mcap_is_refused_where_utc_is_not_known_and_an_instant_must_be_one() {
    let dir = tempfile::tempdir().unwrap();
    let [nav, out] = ["nav.csv", "out"].map(|file| name(dir.path(), file));
    fs::write(&nav, "").unwrap();
    let message = told(&["convert", &nav, "--to", "mcap", "--out", &out], 2);
    assert!(message.contains("give --start-utc"), "{message}");
    let message = told(&["convert", &nav, "--to", "gpx", "--start-utc", "noon", "--out", &out], 2);
    assert!(message.contains("noon: expected an instant of RFC 3339"), "{message}");
    assert!(!Path::new(&out).exists());
}

/// Numbers behind a key of JSON messages, wherever they stand in the bytes of a file.
fn axes(bytes: &[u8], key: &str) -> Vec<[f64; 3]> {
    let text = String::from_utf8_lossy(bytes);
    let key = format!("\"{key}\":{{\"x\":");
    let values = |rest: &str| -> Option<[f64; 3]> {
        let (own, _) = rest.split_once('}')?;
        let (x, rest) = own.split_once(",\"y\":")?;
        let (y, z) = rest.split_once(",\"z\":")?;
        Some([x.parse().ok()?, y.parse().ok()?, z.parse().ok()?])
    };
    text.split(key.as_str()).skip(1).filter_map(values).collect()
}

/// Roll, pitch and heading of the truth once a second, rad.
fn true_attitude(voyage: &Path) -> Vec<[f64; 3]> {
    let text = fs::read_to_string(voyage.join("truth.csv")).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| names.iter().position(|own| *own == name).unwrap();
    let columns = ["t_s", "roll_deg", "pitch_deg", "heading_deg"].map(column);
    let rows = lines.map(|line| {
        let fields: Vec<&str> = line.split(',').collect();
        columns.map(|column| fields[column].parse::<f64>().unwrap())
    });
    let seconds = rows.filter(|row| (row[0] - row[0].round()).abs() < 1e-6);
    seconds.map(|row| [row[1], row[2], row[3]].map(f64::to_radians)).collect()
}

#[test]
fn the_imu_is_told_about_forward_left_and_up_as_the_truth_turns() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    let turning = "[[route.legs]]\nheading_deg = 235.0\nspeed_kn = 12.0\nduration_s = 60.0\nturn_rate_deg_s = 3.0\n[sea]\nstate = 4\n\
                   from_deg = 250.0\n[imu]";
    fs::write(dir.join("turn.toml"), SCENARIO.replace("[imu]", turning)).unwrap();
    let [scenario, voyage, out] = ["turn.toml", "voyage", "own.mcap"].map(|file| name(dir, file));
    told(&["simulate", &scenario, "--seed", "1", "--out", &voyage], 0);
    let message = told(&["convert", &voyage, "--to", "mcap", "--imu", "--out", &out], 0);
    assert!(message.contains("samples of the IMU"), "{message}");
    let bytes = fs::read(&out).unwrap();
    let (rates, forces) = (axes(&bytes, "angular_velocity"), axes(&bytes, "linear_acceleration"));
    let truth = true_attitude(&dir.join("voyage"));
    let each = (rates.len() as f64 / (truth.len() - 1) as f64).round() as usize;
    assert!(rates.len() == forces.len() && each >= 50, "{} {}", rates.len(), truth.len());
    // turned in a second, with the rotations of the Earth and the coupling of the axes left aside
    let turned = |second: usize, axis: usize| {
        let own = &rates[second * each..(second + 1) * each];
        own.iter().map(|rate| rate[axis] / each as f64).sum::<f64>()
    };
    let wrapped = |angle: f64| angle.sin().atan2(angle.cos());
    for (second, pair) in truth.windows(2).enumerate() {
        let [roll, pitch, heading] =
            [0, 1, 2].map(|angle| wrapped(pair[1][angle] - pair[0][angle]));
        for (axis, expected) in [roll, -pitch, -heading].into_iter().enumerate() {
            let own = turned(second, axis);
            assert!((own - expected).abs() < 0.01, "{second} {axis}: {own} {expected}");
        }
    }
    let starboard: f64 = (0..truth.len() - 1).map(|second| turned(second, 2)).sum();
    assert!((starboard.to_degrees() + 90.0).abs() < 5.0, "{starboard}");
    let up = forces.iter().map(|force| force[2]).sum::<f64>() / forces.len() as f64;
    assert!((up - 9.8).abs() < 0.1, "{up}");
    let refused = told(&["convert", &voyage, "--to", "gpx", "--imu", "--out", &out], 2);
    assert!(refused.contains("--imu is for"), "{refused}");
}
