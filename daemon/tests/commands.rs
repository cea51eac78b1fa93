//! The commands from outside: exit status, messages, files.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use tempfile::TempDir;

fn insd(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_insd"));
    command.args(arguments);
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Standard error of a command that must end with this status.
fn told(arguments: &[&str], status: i32) -> String {
    let output = insd(arguments).output().unwrap();
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(status), "{arguments:?}: {message}");
    message
}

fn printed(arguments: &[&str]) -> String {
    let output = insd(arguments).output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// A directory to work in, with a short simulated voyage.
struct Desk {
    dir: TempDir,
}

impl Desk {
    fn with_voyage() -> Self {
        let desk = Desk { dir: tempfile::tempdir().unwrap() };
        fs::write(desk.path("short.toml"), SCENARIO_TEXT).unwrap();
        let out = desk.voyage();
        told(&["simulate", &desk.name("short.toml"), "--seed", "1", "--out", &out], 0);
        desk
    }

    fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    fn name(&self, name: &str) -> String {
        self.path(name).display().to_string()
    }

    fn voyage(&self) -> String {
        self.name("voyage")
    }

    /// Replays the voyage to a file and gives the summary.
    fn replay(&self, out: &str, more: &[&str]) -> String {
        let (dir, out) = (self.voyage(), self.name(out));
        let mut arguments = vec!["replay", &dir, "--out", &out];
        arguments.extend(more);
        told(&arguments, 0)
    }

    /// Changes a file of the voyage and gives what the replay says to that.
    fn refused(&self, file: &str, change: impl FnOnce(&str) -> String) -> String {
        let path = Path::new(&self.voyage()).join(file);
        let sound = fs::read_to_string(&path).unwrap();
        fs::write(&path, change(&sound)).unwrap();
        let message = told(&["replay", &self.voyage(), "--out", &self.name("bad.csv")], 2);
        assert!(!self.path("bad.csv").exists() && !self.path("bad.csv.part").exists());
        fs::write(&path, sound).unwrap();
        message
    }
}

/// Four minutes under way with a turn.
const SCENARIO_TEXT: &str = r#"
name = "short"
description = "Four minutes under way with a turn."
mode = "underway"
[start]
lat_deg = 35.0
lon_deg = -59.956
height_m = 28.0
[[route.legs]]
heading_deg = 150.0
speed_kn = 10.0
duration_s = 120.0
[[route.legs]]
heading_deg = 80.0
speed_kn = 10.0
duration_s = 120.0
[sea]
state = 3
from_deg = 210.0
[imu]
grade = "navigation"
[gnss]
"#;

#[test]
fn a_voyage_is_simulated_replayed_and_scored() {
    let desk = Desk::with_voyage();
    let innovations = desk.name("innovations.csv");
    let summary = desk.replay("nav.csv", &["--innovations", &innovations]);
    assert!(summary.contains("gnss_position"), "{summary}");
    let (nav, truth) = (desk.name("nav.csv"), format!("{}/truth.csv", desk.voyage()));
    let table = printed(&["evaluate", &nav, &truth]);
    assert!(table.contains("horizontal") && table.contains("velocity north"), "{table}");
    let picture = desk.name("errors.png");
    let plot = ["--plot", &picture, "--innovations", &innovations];
    let json =
        printed(&[&["evaluate", &nav, &truth, "--json", "--from", "60"], &plot[..]].concat());
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert!(report["components"]["horizontal"]["rms"].as_f64().unwrap() < 20.0, "{json}");
    assert!(report["from_s"].as_f64().unwrap() >= 60.0);
    assert!(table.contains("not hazardous"), "{table}");
    assert_eq!(report["evidence"]["hazardous"], false, "{json}");
    assert_eq!(report["evidence"]["excluded"], serde_json::json!([]), "{json}");
    assert!(fs::metadata(picture).unwrap().len() > 10_000);
}

#[test]
fn every_state_that_is_carried_is_told_with_its_unit_and_sigma() {
    let desk = Desk { dir: tempfile::tempdir().unwrap() };
    fs::write(desk.path("short.toml"), SCENARIO_TEXT).unwrap();
    told(&["simulate", &desk.name("short.toml"), "--seed", "1", "--out", &desk.voyage()], 0);
    desk.replay("nav.csv", &["--states", &desk.name("states.csv")]);
    let text = fs::read_to_string(desk.path("states.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0], ["t_s", "state", "component", "unit", "axes", "value", "sigma"]);
    let last = rows.last().unwrap()[0];
    let newest = || rows.iter().filter(|row| row[0] == last);
    let count = |name: &str| newest().filter(|row| row[1] == name).count();
    assert_eq!(["position", "gnss_delay", "poses"].map(count), [3, 1, 0], "she has no camera");
    assert_eq!(newest().find(|row| row[1] == "attitude").unwrap()[3..6], ["rad", "ecef", ""]);
    assert!(newest().all(|row| row[6].parse::<f64>().unwrap() >= 0.0));
}

#[test]
fn satellites_are_scored_where_there_are_any_and_the_report_is_as_it_was_where_not() {
    let desk = Desk { dir: tempfile::tempdir().unwrap() };
    fs::write(desk.path("short.toml"), format!("{SCENARIO_TEXT}[raw]\n")).unwrap();
    told(&["simulate", &desk.name("short.toml"), "--seed", "1", "--out", &desk.voyage()], 0);
    let (innovations, sky) = (desk.name("innovations.csv"), desk.name("sky.csv"));
    let truth = format!("{}/truth.csv", desk.voyage());
    let scored = |out: &str, more: &[&str]| {
        let told = ["--innovations", &innovations, "--sky", &sky];
        desk.replay(out, &[&told[..], more].concat());
        let (nav, picture) = (desk.name(out), desk.name("all.svg"));
        let drawn = ["--plot", &picture, "--innovations", &innovations, "--sky", &sky];
        let json = printed(&[&["evaluate", &nav, &truth, "--json"], &drawn[..]].concat());
        let report: serde_json::Value = serde_json::from_str(&json).unwrap();
        let table = printed(&["evaluate", &nav, &truth]);
        (report, table, fs::read_to_string(picture).unwrap())
    };
    let (report, table, picture) = scored("tight.csv", &["--mask", "180..200:3"]);
    let rows = report["satellites"].as_array().unwrap();
    assert_eq!(rows[0]["satellites"], 3, "{rows:?}");
    assert!(rows.len() > 1 && rows[0]["count"].as_u64().unwrap() > 150, "{rows:?}");
    assert!(table.contains("horizontal position by satellites in use"), "{table}");
    assert!(picture.contains("sky: tracks") && picture.contains("innovations of satellites"));
    let seen = fs::read_to_string(&sky).unwrap();
    assert!(seen.contains(",used,") && seen.contains(",waiting,waiting"), "{seen}");

    let (report, table, picture) = scored("loose.csv", &["--gnss", "loose"]);
    assert!(report.get("satellites").is_none() && !table.contains("satellites"), "{table}");
    assert!(!picture.contains("sky: tracks") && fs::read_to_string(&sky).unwrap().is_empty());
    let nav = fs::read_to_string(desk.path("loose.csv")).unwrap();
    assert!(nav.lines().next().unwrap().ends_with(",excluded,satellites,source"));
    assert!(nav.lines().skip(1).all(|row| row.rsplit(',').nth(1) == Some("")));
}

#[test]
fn two_replays_give_the_same_bytes() {
    let desk = Desk::with_voyage();
    desk.replay("a.csv", &[]);
    desk.replay("b.csv", &[]);
    let a = fs::read(desk.path("a.csv")).unwrap();
    assert!(a.len() > 1000 && a == fs::read(desk.path("b.csv")).unwrap());
}

#[test]
fn the_same_seed_gives_the_same_voyage_compressed_or_not() {
    let desk = Desk::with_voyage();
    let (scenario, out) = (desk.name("short.toml"), desk.name("again"));
    told(&["simulate", &scenario, "--seed", "1", "--out", &out, "--compress"], 0);
    assert!(desk.path("again/imu.csv.zst").exists());
    let (plain, compressed) = (desk.name("plain.csv"), desk.name("compressed.csv"));
    told(&["replay", &desk.voyage(), "--out", &plain], 0);
    told(&["replay", &out, "--out", &compressed], 0);
    assert_eq!(fs::read(plain).unwrap(), fs::read(compressed).unwrap());
}

#[test]
fn a_sensor_can_be_taken_away() {
    let desk = Desk::with_voyage();
    let summary =
        desk.replay("nav.csv", &["--outage", "gnss:100..200", "--outage", "gnss:210..220"]);
    assert!(summary.contains("messages dropped by --outage"), "{summary}");
    let (dir, nav) = (desk.voyage(), desk.name("nav.csv"));
    let message = told(&["replay", &dir, "--out", &nav, "--outage", "radar:1..2"], 2);
    assert!(message.contains("gnss:600..900"), "{message}");
}

#[test]
fn what_is_left_out_is_as_if_it_were_not_there() {
    let desk = Desk { dir: tempfile::tempdir().unwrap() };
    let scenario = format!("{SCENARIO_TEXT}[log]\n[raw]\n");
    fs::write(desk.path("short.toml"), scenario).unwrap();
    let (name, voyage) = (desk.name("short.toml"), desk.voyage());
    told(&["simulate", &name, "--seed", "1", "--out", &voyage], 0);
    let replayed = |out: &str, more: &[&str]| {
        desk.replay(out, more);
        fs::read(desk.path(out)).unwrap()
    };
    let all = replayed("all.csv", &["--without", "learning,camera"]);
    assert!(all == replayed("all.csv", &[]));
    let without_raw = replayed("raw.csv", &["--without", "raw"]);
    let without_more = replayed("more.csv", &["--without", "log,raw"]);
    let deaf = replayed("deaf.csv", &["--without", "log,gnss"]);
    assert!(all != without_raw && without_raw != without_more);

    let nav = desk.name("bad.csv");
    let refused =
        |more: &[&str]| told(&[&["replay", &voyage, "--out", &nav, "--without"], more].concat(), 2);
    assert!(refused(&["radar"]).contains("learning, camera, raw, log, gnss"));
    assert!(refused(&["raw", "--gnss", "tight"]).contains("--gnss tight"));
    assert!(refused(&["gnss", "--gnss", "loose"]).contains("--without gnss"));

    for (file, replayed_before) in [("raw", without_raw), ("log.csv", without_more)] {
        fs::rename(Path::new(&voyage).join(file), desk.path(file)).unwrap();
        assert!(replayed("less.csv", &[]) == replayed_before, "{file}");
    }
    fs::rename(Path::new(&voyage).join("gnss.csv"), desk.path("gnss.csv")).unwrap();
    assert!(replayed("less.csv", &[]) == deaf);
}

#[test]
fn bad_voyages_end_with_status_2_and_a_message_with_the_place() {
    let desk = Desk::with_voyage();
    let header = desk.refused("imu.csv", |text| text.replacen("dvel_x_mps", "x", 1));
    assert!(header.contains("imu.csv:1: missing column dvel_x_mps"), "{header}");
    let long = desk.refused("imu.csv", |text| format!("{text}{}", "9".repeat(200_000)));
    assert!(long.contains("line longer than 65536 bytes"), "{long}");
    let nan = desk.refused("imu.csv", |text| {
        let time_of = |row: &str| row.split(',').next().unwrap_or_default().to_owned();
        let rows = text.lines().skip(1).map(|row| time_of(row) + ",nan,0,0,0,0,0\n");
        format!("{}\n{}", text.lines().next().unwrap(), rows.collect::<String>())
    });
    assert!(nan.contains("imu.csv:2:dtheta_x_rad: expected a finite number"), "{nan}");
    let toml = desk.refused("voyage.toml", |text| text.replace("rate_hz", "rate"));
    assert!(toml.contains("missing key imu.rate_hz"), "{toml}");
    fs::remove_file(Path::new(&desk.voyage()).join("imu.csv")).unwrap();
    let missing = told(&["replay", &desk.voyage(), "--out", &desk.name("nav.csv")], 2);
    assert!(missing.contains("imu.csv: no such file"), "{missing}");
}

#[test]
fn a_few_bad_rows_are_skipped_and_told() {
    let desk = Desk::with_voyage();
    let path = Path::new(&desk.voyage()).join("gnss.csv");
    let sound = fs::read_to_string(&path).unwrap();
    fs::write(&path, &sound[..sound.len() - 60]).unwrap();
    let summary = desk.replay("nav.csv", &[]);
    assert!(
        summary.contains("gnss.csv: 1 of") && summary.contains("1 too_few_fields"),
        "{summary}"
    );
}

#[test]
fn files_that_cannot_be_compared_are_refused() {
    let desk = Desk::with_voyage();
    desk.replay("nav.csv", &[]);
    let (nav, truth) = (desk.name("nav.csv"), format!("{}/truth.csv", desk.voyage()));
    let late = told(&["evaluate", &nav, &truth, "--from", "99999"], 2);
    assert!(late.contains("no common time"), "{late}");
    assert!(told(&["evaluate", &truth, &truth], 2).contains("missing columns std_n_m"));
    assert!(told(&["evaluate", "none.csv", &truth], 2).contains("none.csv: no such file"));
    assert!(told(&["evaluate", &nav, &truth, "--plot", "a.gif"], 2).contains(".png or .svg"));
}

#[test]
fn errors_are_held_against_the_levels_that_were_told() {
    let desk = Desk::with_voyage();
    desk.replay("nav.csv", &[]);
    let (nav, truth) = (desk.name("nav.csv"), format!("{}/truth.csv", desk.voyage()));
    let picture = desk.name("stanford.png");
    let table = printed(&["integrity", &nav, &truth, "--alert-limit", "100", "--plot", &picture]);
    assert!(table.contains("horizontal at 100 m") && table.contains("vertical at"), "{table}");
    assert!(fs::metadata(picture).unwrap().len() > 10_000);
    let port = printed(&["integrity", &nav, &truth, "--alert-limit", "port", "--json"]);
    let port: serde_json::Value = serde_json::from_str(&port).unwrap();
    assert_eq!(port["horizontal"]["limit_m"], 2.5);
    assert_eq!(port["alert_limit"]["accuracy_m"], 1.0);
    assert!(told(&["integrity", &nav, &truth, "--alert-limit", "x"], 2).contains("docking"));

    // a level of a millimetre misleads, and ends with a status of its own
    let rows = fs::read_to_string(&nav).unwrap();
    let mut lines = rows.lines();
    let header = lines.next().unwrap();
    let at = header.split(',').position(|name| name == "hpl_m").unwrap();
    let boast = |line: &str| {
        let mut fields: Vec<&str> = line.split(',').collect();
        (fields[at], fields[at + 2]) = ("0.00100", "available");
        fields.join(",") + "\n"
    };
    let boasts: String = lines.map(boast).collect();
    fs::write(&nav, format!("{header}\n{boasts}")).unwrap();
    let tight = ["integrity", &nav, &truth, "--alert-limit", "0.01"];
    assert!(told(&tight, 3).contains("hazardous epochs"));
    let without: String = rows.replace("hpl_m", "hpl");
    fs::write(&nav, without).unwrap();
    assert!(told(&["integrity", &nav, &truth], 2).contains("no column hpl_m"));
}

#[test]
fn an_integrity_that_cannot_be_read_ends_with_status_2_and_its_place() {
    let desk = Desk::with_voyage();
    desk.replay("nav.csv", &[]);
    let (nav, truth) = (desk.name("nav.csv"), format!("{}/truth.csv", desk.voyage()));
    let text = fs::read_to_string(&nav).unwrap();
    fs::write(&nav, text.replacen(",available,", ",perhaps,", 1)).unwrap();
    let message = told(&["evaluate", &nav, &truth], 2);
    assert!(message.contains(":integrity: unknown word \"perhaps\""), "{message}");
}

#[test]
fn what_cannot_be_written_is_not_the_fault_of_the_input() {
    let desk = Desk::with_voyage();
    let message = told(&["replay", &desk.voyage(), "--out", "/nowhere/nav.csv"], 1);
    assert!(message.contains("/nowhere/nav.csv: cannot be written"), "{message}");
}

#[test]
fn scenarios_are_refused_by_name_and_by_content() {
    let desk = Desk::with_voyage();
    let out = desk.name("out");
    let unknown = told(&["simulate", "atlantis", "--seed", "1", "--out", &out], 2);
    assert!(
        unknown.contains("shipped scenarios are") && unknown.contains("underway-restart"),
        "{unknown}"
    );
    fs::write(desk.path("broken.toml"), "duration_s = \"long\"").unwrap();
    let broken = told(&["simulate", &desk.name("broken.toml"), "--seed", "1", "--out", &out], 2);
    assert!(broken.contains("broken.toml"), "{broken}");
}

#[test]
fn a_campaign_gives_estimates_with_their_confidence() {
    let desk = Desk::with_voyage();
    let scenario = desk.name("short.toml");
    let campaign = ["campaign", &scenario, "--seeds", "1..4", "--from", "120"];
    let table = printed(&campaign);
    assert!(table.contains("3 seeds") && table.contains('['), "{table}");
    let json = printed(&[&campaign[..], &["--json", "--jobs", "1"]].concat());
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(report["seeds"], serde_json::json!([1, 2, 3]));
    assert!(report["components"]["heading"]["nees"]["mean"].as_f64().is_some(), "{json}");
    assert!(told(&["campaign", &scenario, "--seeds", "4..1"], 2).contains("A < B"));
}

#[test]
fn a_campaign_at_instants_holds_the_heading_against_the_limit() {
    let desk = Desk::with_voyage();
    let scenario = desk.name("short.toml");
    let campaign = ["campaign", &scenario, "--seeds", "1..3", "--at", "200", "--at", "100"];
    let table = printed(&campaign);
    assert!(table.contains("RMS / limit") && table.contains("claimed σ first below"), "{table}");
    let json = printed(&[&campaign[..], &["--json", "--set", "start.lat_deg=60"]].concat());
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert!(report["scenario"].as_str().unwrap().ends_with("start.lat_deg=60"), "{json}");
    assert_eq!(report["instants"][0]["at_s"], 100.0);
    assert!(report["instants"][1]["rms_over_limit"].as_f64().is_some(), "{json}");
    assert!((report["aligned"]["bar_deg"].as_f64().unwrap() - 0.2).abs() < 1e-6);
    assert!(report["worst_heading"]["seed"].as_u64().is_some(), "{json}");
    let late = told(&["campaign", &scenario, "--seeds", "1..2", "--at", "9999"], 2);
    assert!(late.contains("found 9999 s"), "{late}");
}

#[test]
fn a_stored_state_is_saved_confirmed_and_dropped_after_a_turn() {
    let desk = Desk { dir: tempfile::tempdir().unwrap() };
    let (first, second) = (desk.name("first"), desk.name("second"));
    let short = ["--set", "route.legs.0.duration_s=200"];
    for (seed, out) in [("1", &first), ("2", &second)] {
        told(&[&["simulate", "17", "--seed", seed, "--out", out][..], &short].concat(), 0);
    }
    let (nav, state) = (desk.name("nav.csv"), desk.name("state.toml"));
    told(&["replay", &first, "--out", &nav, "--save-state", &state], 0);
    let warm = ["replay", &second, "--out", &nav, "--stored-state", &state];
    assert!(told(&warm, 0).contains("stored heading confirmed"));
    let text = fs::read_to_string(&state).unwrap();
    let line = text.lines().find(|line| line.starts_with("heading_deg = 11")).unwrap().to_owned();
    fs::write(&state, text.replace(&line, "heading_deg = 208.0")).unwrap();
    assert!(told(&warm, 0).contains("stored state dropped: turned"));
    fs::write(&state, text.replace(&line, "heading_deg = 1180.0")).unwrap();
    let message = told(&warm, 2);
    assert!(message.contains("state.toml:") && message.contains("from 0 to 360"), "{message}");
    assert!(told(&[&warm[..5], &["none.toml"]].concat(), 2).contains("none.toml"));
    let under_way = Desk::with_voyage();
    let (dir, nav) = (under_way.voyage(), under_way.name("nav.csv"));
    let told = told(&["replay", &dir, "--out", &nav, "--save-state", &under_way.name("s.toml")], 1);
    assert!(told.contains("no state stored") && !under_way.path("s.toml").exists());
}

#[test]
fn a_campaign_can_start_from_stored_states() {
    let short = ["--set", "route.legs.0.duration_s=150"];
    let campaign = ["campaign", "17", "--seeds", "1..3", "--at", "100", "--stored", "90"];
    let table = printed(&[&campaign[..], &short].concat());
    assert!(table.contains("dropped 2 turned"), "{table}");
}

#[test]
fn the_limit_is_told_as_a_table_and_as_json_and_refused_where_it_is_not_known() {
    let table = printed(&["limit", "7"]);
    assert!(table.contains("heading deg") && table.lines().count() == 9, "{table}");
    let json = printed(&["limit", "7", "--at", "600", "--set", "start.lat_deg=60", "--json"]);
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    let heading = report["limits"][0]["heading_deg"].as_f64().unwrap();
    assert!((heading - 0.065 * 1.638).abs() < 0.003, "{json}");
    let log = told(&["limit", "2"], 2);
    assert!(log.contains("not known for a scenario with a velocity log"), "{log}");
    let unknown = told(&["limit", "7", "--set", "sea.stat=5"], 2);
    assert!(unknown.contains("sea.stat: unknown field"), "{unknown}");
    let syntax = told(&["limit", "7", "--set", "sea.state"], 2);
    assert!(syntax.contains("expected KEY=VALUE"), "{syntax}");
}

#[test]
fn a_report_of_a_voyage_is_one_page_and_one_of_nothing_is_refused() {
    let desk = Desk::with_voyage();
    let (empty, page) = (desk.name("empty-000001.insdraw"), desk.name("page.html"));
    fs::write(&empty, "").unwrap();
    for missing in [empty.as_str(), &desk.name("nowhere"), &desk.name("")] {
        told(&["report", missing, "--out", &page], 2);
        assert!(!desk.path("page.html").exists() && !desk.path("page.html.part").exists());
    }
    told(&["report", &desk.voyage(), "--out", &page], 0);
    let page = fs::read_to_string(desk.path("page.html")).unwrap();
    assert!(page.contains("<h1>voyage</h1>") && page.ends_with("</html>\n"));
    assert!(page.contains("not known: a voyage directory") && !page.contains("NaN"));
}

/// How a command ends whose reader has gone before it says a word, and what it complains of.
fn unread(arguments: &[&str]) -> (Option<i32>, String) {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_insd"));
    let output = command
        .args(arguments)
        .stdout(writer)
        .stderr(std::process::Stdio::piped())
        .output()
        .unwrap();
    (output.status.code(), text(&output.stderr))
}

#[test]
fn a_reader_that_has_seen_enough_ends_every_command_quietly() {
    let desk = Desk::with_voyage();
    let (file, nav) = (desk.name("insd.toml"), desk.name("nav.csv"));
    fs::write(&file, printed(&["example-config"])).unwrap();
    desk.replay("nav.csv", &[]);
    let truth = desk.name("voyage/truth.csv");
    let scenario = desk.name("short.toml");
    for arguments in [
        &["check-config", &file][..],
        &["doctor", &file, "--json", "--seconds", "0"],
        &["example-config"],
        &["example-config", "--list"],
        &["simulate", "--list"],
        &["ports"],
        &["limit", "7"],
        &["evaluate", &nav, &truth],
        &["campaign", &scenario, "--seeds", "1..2"],
    ] {
        let (status, said) = unread(arguments);
        let quiet = !said.contains("panicked") && !said.contains("Broken pipe");
        assert!(quiet, "{arguments:?}: {said}");
        // what was found counts, whether it is read or not
        let expected = if arguments[0] == "doctor" { 2 } else { 0 };
        assert_eq!(status, Some(expected), "{arguments:?}: {said}");
    }
}

#[test]
fn the_shipped_scenarios_are_listed_with_what_they_are_for() {
    let list = printed(&["simulate", "--list"]);
    assert_eq!(list.lines().count(), insd_simulator::shipped().len(), "{list}");
    assert!(list.contains("02  coastal-2h-navigation  Departs after ten minutes"), "{list}");
    assert_eq!(insd(&["simulate"]).output().unwrap().status.code(), Some(2));
}
