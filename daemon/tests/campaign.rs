//! Campaigns in parts: shards, files of runs, sweeps, and all of it put together again.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use assert_cmd::Command;

/// Seven short voyages at the berth.
const CAMPAIGN: [&str; 6] =
    ["campaign", "7", "--seeds", "0..7", "--set", "route.legs.0.duration_s=90"];

fn insd(dir: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_insd"));
    command.current_dir(dir).args(arguments);
    for name in ["SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX", "SLURM_CPUS_PER_TASK"] {
        command.env_remove(name);
    }
    command
}

/// Standard output of a command that must end well.
fn printed(dir: &Path, arguments: &[&str]) -> String {
    let output = insd(dir, arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Standard error of a command that must be refused.
fn refused(dir: &Path, arguments: &[&str]) -> String {
    let output = insd(dir, arguments).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    said
}

fn campaign(dir: &Path, more: &[&str]) -> String {
    printed(dir, &[&CAMPAIGN[..], more].concat())
}

#[test]
fn shards_in_any_number_make_the_bytes_of_one_run() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    let [table, json] = [campaign(dir, &[]), campaign(dir, &["--json"])];
    for of in [1, 3, 9] {
        let names: Vec<String> = (0..of).map(|k| format!("{k}-{of}.jsonl")).collect();
        for (k, name) in names.iter().enumerate() {
            campaign(dir, &["--runs", name, "--shard", &format!("{k}/{of}")]);
        }
        let names: Vec<&str> = names.iter().rev().map(String::as_str).collect();
        let merge = [&["campaign", "--merge"], &names[..]].concat();
        assert_eq!(printed(dir, &merge), table);
        assert_eq!(printed(dir, &[&merge[..], &["--json"]].concat()), json);
    }
}

#[test]
fn merged_runs_can_be_kept_and_merged_again() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    for k in ["0/2", "1/2"] {
        campaign(dir, &["--runs", &format!("{}.jsonl", &k[..1]), "--shard", k]);
    }
    let once = printed(dir, &["campaign", "--merge", "0.jsonl", "1.jsonl", "--runs", "all.jsonl"]);
    assert_eq!(printed(dir, &["campaign", "--merge", "all.jsonl"]), once);
    let all = fs::read_to_string(dir.join("all.jsonl")).unwrap();
    let seeds: Vec<u64> = all
        .lines()
        .filter_map(|line| {
            serde_json::from_str::<serde_json::Value>(line).unwrap()["run"]["seed"].as_u64()
        })
        .collect();
    assert_eq!(seeds, [0, 1, 2, 3, 4, 5, 6]);
}

#[test]
fn a_shard_that_was_killed_is_resumed_to_the_same_bytes() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    let whole = campaign(dir, &["--runs", "whole.jsonl"]);
    let runs = fs::read(dir.join("whole.jsonl")).unwrap();
    for cut in [0, 100, runs.len() / 2, runs.len() - 1] {
        fs::write(dir.join("cut.jsonl"), &runs[..cut]).unwrap();
        let resumed = campaign(dir, &["--runs", "cut.jsonl", "--resume"]);
        assert_eq!(resumed, whole);
        assert_eq!(printed(dir, &["campaign", "--merge", "cut.jsonl"]), whole);
    }
    assert!(refused(dir, &[&CAMPAIGN[..], &["--runs", "cut.jsonl"]].concat()).contains("--resume"));
}

#[test]
fn what_does_not_belong_together_is_refused_with_its_place() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    campaign(dir, &["--runs", "a.jsonl", "--shard", "0/4"]);
    campaign(dir, &["--runs", "b.jsonl", "--shard", "1/4", "--rate", "2"]);
    let merge = |files: &[&str]| refused(dir, &[&["campaign", "--merge"], files].concat());
    let options = merge(&["a.jsonl", "b.jsonl"]);
    assert!(options.contains("b.jsonl") && options.contains("--rate 2"), "{options}");
    assert!(merge(&["a.jsonl", "a.jsonl"]).contains("seed 0 is in a file before it already"));
    let text = fs::read_to_string(dir.join("a.jsonl")).unwrap();
    fs::write(dir.join("older.jsonl"), text.replace("\"insd\":\"", "\"insd\":\"0.")).unwrap();
    assert!(merge(&["a.jsonl", "older.jsonl"]).contains("version is 0.0"));
    fs::write(dir.join("torn.jsonl"), &text[..text.len() - 9]).unwrap();
    assert!(merge(&["torn.jsonl"]).contains("torn.jsonl:3: no line of a campaign's runs"));
    fs::write(dir.join("empty.jsonl"), "").unwrap();
    assert!(merge(&["empty.jsonl"]).contains("no line says"));
    let part = printed(dir, &["campaign", "--merge", "a.jsonl"]);
    assert!(part.ends_with("5 seeds of the campaign are missing: 1..4, 5..7\n"), "{part}");
    assert!(refused(dir, &["campaign", "--merge", "a.jsonl", "--resume"]).contains("--resume"));
}

#[test]
fn a_sweep_is_a_report_for_each_value_in_one_campaign() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    let sweep = ["--sweep", "sea.state=3,5", "--json"];
    let whole = campaign(dir, &sweep);
    for k in ["0/2", "1/2"] {
        let name = format!("{}.jsonl", &k[..1]);
        campaign(dir, &[&sweep[..], &["--runs", &name, "--shard", k]].concat());
    }
    let merged = printed(dir, &["campaign", "--merge", "1.jsonl", "0.jsonl", "--json"]);
    assert_eq!(merged, whole);
    let reports: serde_json::Value = serde_json::from_str(&whole).unwrap();
    let name = |index: usize| reports[index]["scenario"].as_str().unwrap().to_owned();
    assert!(name(0).ends_with("sea.state=3") && name(1).ends_with("sea.state=5"), "{whole}");
}

#[test]
fn job_systems_give_shards_out() {
    let desk = tempfile::tempdir().unwrap();
    let dir = desk.path();
    let stated = campaign(dir, &["--shard", "2/4", "--json"]);
    let automatic = |shard: &str, set: &[(&str, &str)]| {
        let arguments = [&CAMPAIGN[..], &["--json", "--shard", shard]].concat();
        let output = insd(dir, &arguments).envs(set.iter().copied()).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let slurm = [
        ("SLURM_ARRAY_TASK_ID", "3"),
        ("SLURM_ARRAY_TASK_MIN", "1"),
        ("SLURM_ARRAY_TASK_COUNT", "4"),
        ("SLURM_CPUS_PER_TASK", "1"),
    ];
    assert_eq!(automatic("auto", &slurm), stated);
    assert_eq!(automatic("auto/4", &[("JOB_COMPLETION_INDEX", "2")]), stated);
    assert!(refused(dir, &[&CAMPAIGN[..], &["--shard", "auto"]].concat()).contains("--shard K/N"));
}
