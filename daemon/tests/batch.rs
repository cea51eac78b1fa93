//! An archive of recordings: a line for each, whatever its state, in parts and put together again.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use insd_base::{Arrival, Input, PortId, Span, Stamp, Time, UtcTime};
use insd_drivers::raw::{RawHeader, RawWriter, RecordingConfig};
use serde_json::Value;

/// Two minutes at the berth with what a MEMS ship has.
const SCENARIO: &str = r#"
name = "short"
mode = "moored"
start_utc = "2026-05-01T08:00:00Z"
[start]
lat_deg = 35.0
lon_deg = 61.75
height_m = 20.0
[[route.legs]]
moored = true
speed_kn = 0.0
heading_deg = 145.0
duration_s = 120.0
[imu]
grade = "navigation"
[gnss]
"#;

fn insd(dir: &Path, arguments: &[&str]) -> std::process::Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_insd"));
    command.current_dir(dir).args(arguments).output().unwrap()
}

fn printed(dir: &Path, arguments: &[&str]) -> String {
    let output = insd(dir, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Runs of a program that hears a compass for a second each.
fn record(folder: &Path, runs: u32) {
    let config = fs::read_to_string(format!(
        "{}/../systemd/examples/minimal.toml",
        env!("CARGO_MANIFEST_DIR")
    ));
    let config = config.unwrap();
    for _ in 0..runs {
        let recording = RecordingConfig {
            name: "insd".to_owned(),
            rotate_bytes: 1_000_000,
            rotate_span: Span::from_seconds(3600.0),
            quota_bytes: None,
        };
        let header = RawHeader { program: "insd 0.0.1".to_owned(), config: config.clone() };
        let mut writer = RawWriter::create(folder, recording, header).unwrap();
        for tenth in 0..=10_u32 {
            let monotonic = Time::from_seconds(f64::from(tenth) / 10.0);
            let system = UtcTime::from_nanos(monotonic.as_nanos());
            let input = Input::Bytes(b"$HETHS,145.70,A*14\r\n".to_vec());
            let stamp = Stamp { monotonic, system };
            writer.record(&Arrival { stamp, port: PortId(0), input }).unwrap();
        }
        writer.flush().unwrap();
    }
}

/// Two voyages, one that breaks off, one without a file that it must have, a recording of two runs, and one that is none.
fn archive(dir: &Path) {
    fs::write(dir.join("short.toml"), SCENARIO).unwrap();
    for (seed, place) in [("1", "ships/a/01"), ("2", "ships/b/01"), ("3", "ships/b/02")] {
        fs::create_dir_all(dir.join(place)).unwrap();
        printed(dir, &["simulate", "short.toml", "--seed", seed, "--out", place]);
    }
    fs::remove_file(dir.join("ships/b/02/imu.csv")).unwrap();
    let torn = dir.join("ships/b/01/imu.csv");
    let text = fs::read_to_string(&torn).unwrap();
    fs::write(&torn, &text[..text.len() * 3 / 4]).unwrap();
    for folder in ["ships/a/raw", "ships/a/worse"] {
        fs::create_dir_all(dir.join(folder)).unwrap();
    }
    record(&dir.join("ships/a/raw"), 2);
    fs::write(dir.join("ships/a/worse/insd-000001.insdraw"), b"no recording").unwrap();
}

#[test]
fn each_recording_of_an_archive_is_a_line_and_a_damaged_one_is_not_the_end() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    archive(dir);
    let whole: Value = serde_json::from_str(&printed(dir, &["batch", "ships", "--json"])).unwrap();
    let all = whole["recordings"].as_array().unwrap();
    let told: Vec<(&str, &str)> = all
        .iter()
        .map(|own| (own["case"].as_str().unwrap(), own["score"]["outcome"].as_str().unwrap()))
        .collect();
    let expected = [
        ("ships/a/01", "navigated"),
        ("ships/a/raw", "silent"),
        ("ships/a/worse", "error"),
        ("ships/b/01", "navigated"),
        ("ships/b/02", "error"),
    ];
    assert_eq!(told, expected, "{whole:#}");
    let score = |index: usize| &all[index]["score"];
    assert!((score(0)["runs"][0]["duration_s"].as_f64().unwrap() - 120.0).abs() < 1.0);
    assert!(score(0)["truth"]["components"]["heading"]["rms"].as_f64().unwrap() >= 0.0);
    let short = score(3)["runs"][0]["duration_s"].as_f64().unwrap();
    assert!((80.0..125.0).contains(&short) && score(3)["damaged"].as_u64().unwrap() <= 1);
    assert_eq!(score(1)["recorded_by"], "insd 0.0.1");
    assert_eq!(score(1)["runs"].as_array().unwrap().len(), 2);
    assert_eq!((&score(1)["damaged"], &score(1)["missing"]), (&0.into(), &0.into()));
    assert!(score(4)["error"].as_str().unwrap().contains("imu.csv"));
    let sum: f64 = all
        .iter()
        .flat_map(|own| own["score"]["runs"].as_array().unwrap())
        .map(|run| run["sum_heading_rad2"].as_f64().unwrap())
        .sum();
    assert_eq!(whole["total"]["sum_heading_rad2"].as_f64().unwrap(), sum);
}

#[test]
fn an_archive_in_shards_killed_and_resumed_makes_the_bytes_of_one_run() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    archive(dir);
    let whole = printed(dir, &["batch", "ships"]);
    assert!(whole.contains("5 recordings: 2 error, 2 navigated, 1 silent\n"), "{whole}");
    for k in ["0", "1"] {
        let (runs, shard) = (format!("{k}.jsonl"), format!("{k}/2"));
        printed(dir, &["batch", "ships", "--runs", &runs, "--shard", &shard]);
    }
    let part = printed(dir, &["batch", "--merge", "1.jsonl"]);
    assert!(
        part.ends_with(
            "3 cases of the campaign are missing: ships/a/01, ships/a/worse, ships/b/02\n"
        )
    );
    let text = fs::read(dir.join("0.jsonl")).unwrap();
    fs::write(dir.join("0.jsonl"), &text[..text.len() - 30]).unwrap();
    let resume = ["batch", "ships", "--runs", "0.jsonl", "--shard", "0/2", "--resume"];
    printed(dir, &resume);
    assert_eq!(printed(dir, &["batch", "--merge", "1.jsonl", "0.jsonl"]), whole);
    let other = insd(dir, &[&resume[..], &["--rate", "2"]].concat());
    let said = String::from_utf8_lossy(&other.stderr).into_owned();
    assert!(other.status.code() == Some(2) && said.contains("options is"), "{said}");
}

#[test]
fn where_there_is_no_recording_or_none_can_be_replayed_the_batch_ends_with_2() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    fs::create_dir_all(dir.join("empty/deep")).unwrap();
    assert_eq!(insd(dir, &["batch", "empty"]).status.code(), Some(2));
    fs::write(dir.join("empty/deep/voyage.toml"), "nonsense").unwrap();
    let vain = insd(dir, &["batch", "empty"]);
    let table = String::from_utf8_lossy(&vain.stdout).into_owned();
    assert!(vain.status.code() == Some(2) && table.contains("empty/deep"), "{table}");
    assert_eq!(insd(dir, &["batch"]).status.code(), Some(2));
}
