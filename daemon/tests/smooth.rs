//! `insd smooth` from outside.

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
[start]
lat_deg = 35.0
lon_deg = 61.75
height_m = 20.0
[[route.legs]]
heading_deg = 145.0
speed_kn = 12.0
duration_s = 150.0
[sea]
state = 3
from_deg = 290.0
[imu]
grade = "mems"
[gnss]
"#;

fn name(dir: &Path, file: &str) -> String {
    dir.join(file).display().to_string()
}

fn simulated(dir: &Path) -> String {
    fs::write(dir.join("short.toml"), SCENARIO).unwrap();
    let voyage = name(dir, "voyage");
    told(&["simulate", &name(dir, "short.toml"), "--seed", "1", "--out", &voyage], 0);
    voyage
}

#[test]
fn the_same_voyage_is_smoothed_to_the_same_bytes_with_a_row_for_each_of_the_replay() {
    let dir = tempfile::tempdir().unwrap();
    let (dir, voyage) = (dir.path(), simulated(dir.path()));
    let [nav, again, replayed, sbet] =
        ["a.csv", "b.csv", "r.csv", "sbet.csv"].map(|file| name(dir, file));
    let message = told(&["smooth", &voyage, "--out", &nav, "--sbet", &sbet], 0);
    assert!(message.contains("rows smoothed over"), "{message}");
    told(&["smooth", &voyage, "--out", &again], 0);
    told(&["replay", &voyage, "--out", &replayed], 0);
    let [nav, again, replayed, sbet] =
        [nav, again, replayed, sbet].map(|file| fs::read_to_string(file).unwrap());
    assert!(nav == again && nav != replayed);
    let column = |text: &str, column: usize| -> Vec<String> {
        text.lines().map(|line| line.split(',').nth(column).unwrap_or("").to_owned()).collect()
    };
    assert_eq!(column(&nav, 0), column(&replayed, 0));
    assert_eq!(nav.lines().next(), replayed.lines().next());
    let levels = "hpl_m";
    let at = nav.lines().next().unwrap().split(',').position(|own| own == levels).unwrap();
    assert_eq!(column(&nav, at), column(&replayed, at), "a promise of the time stays");
    assert_eq!(sbet.lines().count(), nav.lines().count());
    assert_eq!(sbet.lines().next().unwrap().split(',').count(), 17);
}

#[test]
fn what_cannot_be_smoothed_is_refused_with_its_reason() {
    let dir = tempfile::tempdir().unwrap();
    let (dir, voyage) = (dir.path(), simulated(dir.path()));
    let out = name(dir, "nav.csv");
    let message = told(&["smooth", &name(dir, "nowhere"), "--out", &out], 2);
    assert!(message.contains("nowhere"), "{message}");
    let imu = Path::new(&voyage).join("imu.csv");
    let sound = fs::read_to_string(&imu).unwrap();
    let beginning = |rows: usize| -> String { sound.split_inclusive('\n').take(rows).collect() };
    fs::write(&imu, beginning(1)).unwrap();
    let message = told(&["smooth", &voyage, "--out", &out], 2);
    assert!(message.contains("imu.csv:1: no rows"), "{message}");
    fs::write(&imu, beginning(200)).unwrap();
    let message = told(&["smooth", &voyage, "--out", &out, "--without", "gnss"], 2);
    assert!(message.contains("no solution to smooth"), "{message}");
    assert!(!Path::new(&out).exists());
    let message = told(&["smooth", &voyage, "--out", &out, "--interval", "0"], 2);
    assert!(message.contains("from 0.1 to 60 s"), "{message}");
}
