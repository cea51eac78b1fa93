//! `insd monitor` against a page that is really served.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::io::{BufRead, BufReader};
use std::net::TcpListener;
use std::process::{Command, Stdio};
use std::time::Duration;

use assert_cmd::cargo::cargo_bin;
use insd_web::snapshot::{ShownMotion, Snapshot};
use insd_web::{Listen, Publisher, WebConfig, WebHandle};

fn serving(mode: &str) -> (WebHandle, Publisher) {
    let (publisher, viewer) = insd_web::channel();
    let (sender, _orders) = insd_web::orders::channel();
    let listen = Listen::Inherited(TcpListener::bind(("127.0.0.1", 0)).unwrap());
    let config = WebConfig { listen, ..WebConfig::default() };
    let page = insd_web::start(config, viewer, sender).unwrap();
    publisher.publish(snapshot(mode));
    // until it has been seen
    std::thread::sleep(Duration::from_millis(200));
    (page, publisher)
}

fn snapshot(mode: &str) -> Snapshot {
    let motion = ShownMotion { heading_deg: Some(62.04), ..ShownMotion::default() };
    let mut snapshot = Snapshot { motion: Some(motion), ..Snapshot::default() };
    snapshot.mode.name = mode.to_owned();
    snapshot
}

fn monitor(page: &WebHandle, option: &str) -> Command {
    let mut command = Command::new(cargo_bin("insd"));
    command.args(["monitor", option, "--url", &format!("http://{}", page.address())]);
    command
}

#[test]
fn once_ends_with_status_0_only_if_she_navigates() {
    for (mode, code) in [("aided", 0), ("inertial", 0), ("fine_alignment", 1), ("fault", 1)] {
        let (page, _publisher) = serving(mode);
        let output = monitor(&page, "--once").output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{mode}");
        assert!(String::from_utf8(output.stdout).unwrap().contains("62.04 deg"), "{mode}");
    }
}

#[test]
fn who_cannot_be_reached_does_not_navigate() {
    let (page, _publisher) = serving("aided");
    let mut command = monitor(&page, "--once");
    drop(page);
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8(output.stderr).unwrap().contains("/api/v1/status"));
}

#[test]
fn json_is_what_the_page_is_given() {
    let (page, _publisher) = serving("aided");
    let output = monitor(&page, "--json").output().unwrap();
    let read: Snapshot = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(read, snapshot("aided"));
}

#[test]
fn plain_tells_a_line_a_second_and_notices_when_nothing_new_comes() {
    let (page, publisher) = serving("aided");
    // what is older than a second is not told: the ship goes on for a while, and then says no more
    let ship = std::thread::spawn(move || {
        for tick in 0..60 {
            let mut newer = snapshot("aided");
            newer.time.at_s = 0.05 * f64::from(tick);
            newer.motion.iter_mut().for_each(|motion| motion.valid_at_s = newer.time.at_s);
            publisher.publish(newer);
            std::thread::sleep(Duration::from_millis(50));
        }
        publisher
    });
    let mut child = monitor(&page, "--plain").stdout(Stdio::piped()).spawn().unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let mut lines = lines.take(20).map_while(Result::ok);
    let told = lines.any(|line| line.contains("aided  - -  heading 62.04 deg"));
    let noticed = lines.any(|line| line == "no new data");
    child.kill().unwrap();
    child.wait().unwrap();
    drop(ship.join().unwrap());
    assert!(told, "the ship");
    assert!(noticed, "that she says no more");
}
