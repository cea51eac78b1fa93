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
