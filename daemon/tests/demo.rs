//! `insd demo` as a user meets it: started, read from, ended.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use std::collections::HashSet;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};

use assert_cmd::cargo::cargo_bin;
use insd_wire::nmea::{HeadingMode, Sentence};
use rustix::process::{Pid, Signal, kill_process};

/// Starts a demo without a terminal and gives its output.
fn start(options: &[&str]) -> (Child, BufReader<impl Read + use<>>) {
    let mut child = Command::new(cargo_bin!("insd"))
        .args(["demo", "--plain"])
        .args(options)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let output = BufReader::new(child.stdout.take().unwrap());
    (child, output)
}

fn line(output: &mut impl BufRead) -> String {
    let mut line = String::new();
    output.read_line(&mut line).unwrap();
    line
}

#[test]
fn a_demo_writes_readable_nmea_that_is_marked_as_simulated() {
    let (mut child, mut output) = start(&["--scenario", "06", "--speed", "20"]);
    assert!(line(&mut output).starts_with("simulated ship: "));
    let second = line(&mut output);
    let path = second.trim_end().rsplit(' ').next().unwrap();
    let mut kinds = HashSet::new();
    let mut cut = 0;
    let port = BufReader::new(std::fs::File::open(path).unwrap());
    for line in port.split(b'\n').map(Result::unwrap).skip(1).take(3000) {
        let Ok((_, sentence)) = Sentence::read(&line) else {
            cut += 1;
            continue;
        };
        kinds.insert(std::mem::discriminant(&sentence));
        if let Sentence::Ths(ths) = sentence {
            assert!(matches!(ths.mode, HeadingMode::Simulator | HeadingMode::NotValid));
        }
        if kinds.len() == 6 {
            break;
        }
    }
    assert!(cut <= 1, "at most the sentence under way when the reader came is cut");
    assert_eq!(kinds.len(), 6, "HDT THS ROT GGA VTG ZDA");
    kill_process(Pid::from_child(&child), Signal::TERM).unwrap();
    assert!(child.wait().unwrap().success());
}

#[test]
fn the_demo_of_a_berthing_tells_how_she_stands_to_the_quay_and_shows_it_on_a_page() {
    // a port that is free now
    let port = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let page = port.to_string();
    let options = ["--scenario", "berthing", "--speed", "20", "--page", page.as_str()];
    let (mut child, mut output) = start(&options);
    let told = (0..120).map(|_| line(&mut output)).find(|line| line.contains("Pier 1: bow "));
    assert!(told.is_some_and(|line| line.contains(", stern ")));
    let asked = format!("http://{page}/api/v1/status");
    let text = ureq::get(&asked).call().unwrap().body_mut().read_to_string().unwrap();
    let status: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(status["docking"]["berth"], "Pier 1");
    assert_eq!(status["docking"]["state"], "valid");
    assert!(status["docking"]["bow"]["distance_m"].as_f64().unwrap() > 0.0);
    assert_eq!(status["program"]["simulated"], true);
    kill_process(Pid::from_child(&child), Signal::TERM).unwrap();
    assert!(child.wait().unwrap().success());
}

#[test]
fn a_demo_ends_by_itself_and_on_every_polite_signal_with_status_0() {
    let (mut child, _output) = start(&["--duration", "0.5"]);
    assert!(child.wait().unwrap().success());
    for signal in [Signal::INT, Signal::TERM, Signal::HUP] {
        let (mut child, mut output) = start(&["--speed", "50"]);
        line(&mut output);
        kill_process(Pid::from_child(&child), signal).unwrap();
        assert!(child.wait().unwrap().success(), "{signal:?}");
    }
}

#[test]
fn a_demo_of_an_unknown_scenario_ends_with_status_2() {
    let (mut child, _output) = start(&["--scenario", "nowhere"]);
    assert_eq!(child.wait().unwrap().code(), Some(2));
}
