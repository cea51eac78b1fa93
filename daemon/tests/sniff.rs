//! `insd sniff` and `insd ports` from outside: a device that speaks, one that is not there, files.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

use std::fs;
use std::process::{Command as Process, Stdio};
use std::time::Duration;

use assert_cmd::Command;
use insd_base::{Arrival, Input, PortId, PortState, Span, Stamp, Time, UtcTime};
use insd_drivers::raw::{RawHeader, RawWriter, RecordingConfig};
use insd_lab::pty::PseudoTerminal;
use serde_json::Value;

const PROGRAM: &str = env!("CARGO_BIN_EXE_insd");

/// Exit status, standard output and standard error.
fn told(arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(PROGRAM).args(arguments).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

fn corpus(name: &str) -> String {
    format!("{}/../fuzz/corpus/nmea/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// What the command says while the test speaks into a pseudo terminal.
fn spoken(arguments: &[&str], speech: &[u8], times: usize) -> String {
    let mut pty = PseudoTerminal::open().unwrap();
    let path = pty.path().display().to_string();
    let device = |argument: &&str| argument.replace("PTY", &path);
    let arguments: Vec<String> = arguments.iter().map(device).collect();
    let child = Process::new(PROGRAM)
        .args(&arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    for _ in 0..times {
        pty.push(speech);
        pty.pump();
        std::thread::sleep(Duration::from_millis(100));
    }
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_device_that_speaks_is_described_with_rates_and_a_suggestion() {
    let speech = b"$HETHS,316.70,E*1A\r\n";
    let text = spoken(&["sniff", "PTY,4800", "--seconds", "2"], speech, 30);
    assert!(text.contains("HETHS") && text.contains("% of 4800 baud"), "{text}");
    assert!(text.contains("kind = \"compass\"") && text.contains("baud = 4800"), "{text}");
}

#[test]
fn a_baud_rate_is_found_by_listening() {
    let speech = b"$HETHS,316.70,E*1A\r\n";
    let text = spoken(&["sniff", "PTY", "--seconds", "1", "--json"], speech, 25);
    let report: Value = serde_json::from_str(&text).unwrap();
    let port = &report["ports"][0];
    assert_eq!((&port["state"], &port["baud"]), (&"open".into(), &115_200.into()), "{text}");
    let message = &port["messages"][0];
    assert!(message["rate_hz"].as_f64().unwrap() > 2.0, "{text}");
    assert_eq!((&message["protocol"], &message["name"]), (&"nmea".into(), &"HETHS".into()));
}

#[test]
fn frames_are_printed_as_they_come() {
    let speech = b"$HETHS,316.70,E*1A\r\n\xB5\x62\x05\x01\x02\x00\x06\x01\x0F\x38";
    let text = spoken(&["sniff", "PTY,4800", "--seconds", "1", "--raw"], speech, 20);
    assert!(text.contains("nmea HETHS  $HETHS,316.70,E*1A\n"), "{text}");
    assert!(text.contains("ubx UBX 05-01 (10 bytes)\n    B5 62 05 01"), "{text}");
}

#[test]
fn a_captured_log_is_counted_at_once_and_without_rates() {
    let (status, text, _) = told(&["sniff", &corpus("saab-r4.log"), "--seconds", "60"]);
    assert_eq!(status, 0);
    assert!(text.contains("read to its end") && !text.contains("Hz"), "{text}");
    assert!(text.contains("nmea      GPGGA       12  used"), "{text}");
    assert!(text.contains("kind = \"nmea_gnss\"") && text.contains("talkers = [\"HE\"]"), "{text}");
}

#[test]
fn the_search_can_be_restricted_to_a_protocol() {
    let log = corpus("tnt-revolution.log");
    let (status, text, _) = told(&["sniff", &log, "--protocol", "ubx", "--json"]);
    let report: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((status, report["ports"][0]["frames"].as_u64()), (1, Some(0)));
    assert!(text.contains("only ubx was looked for"), "{text}");
    let (status, _, error) = told(&["sniff", &log, "--protocol", "morse"]);
    assert!(status == 2 && error.contains("expected one of nmea, ubx"), "{error}");
}

#[test]
fn a_device_that_is_not_there_is_part_of_the_report() {
    let device = "/dev/insd-nonesuch";
    let (status, text, error) = told(&["sniff", &format!("{device},4800"), "--seconds", "0.3"]);
    assert_eq!(status, 1);
    assert!(error.contains("nothing that insd reads came from /dev/insd-nonesuch"), "{error}");
    assert!(text.contains("/dev/insd-nonesuch: absent: No such file"), "{text}");
    assert!(text.contains("`insd ports` lists"), "{text}");
    let (_, json, _) = told(&["sniff", device, "--seconds", "0.3", "--json"]);
    let report: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(report["ports"][0]["state"], "absent");
}

#[test]
fn what_is_no_port_is_refused() {
    for (port, why) in [("udp://nowhere", "no ADDRESS:PORT"), ("/dev/x,fast", "no baud rate")] {
        let (status, _, error) = told(&["sniff", port]);
        assert!(status == 2 && error.contains(why), "{error}");
    }
    let (status, _, error) = told(&["sniff"]);
    assert!(status == 2 && error.contains("PORT"), "{error}");
}

fn stamp(seconds: f64) -> Stamp {
    let since = Span::from_seconds(seconds);
    Stamp { monotonic: Time::START + since, system: UtcTime::from_nanos(0).plus(since) }
}

#[test]
fn each_port_of_a_recording_is_shown_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let recording = RecordingConfig {
        name: "insd".to_owned(),
        rotate_bytes: 1 << 20,
        rotate_span: Span::from_seconds(3600.0),
        quota_bytes: None,
    };
    let config = "[[port]]\nname = \"gyro\"\n[[port]]\nname = \"log\"\n".to_owned();
    let header = RawHeader { program: "test".to_owned(), config };
    let mut writer = RawWriter::create(folder.path(), recording, header).unwrap();
    let what = "/dev/ttyS0 at 4800 baud".to_owned();
    let open = Input::State(PortState::Open { what });
    writer.record(&Arrival { stamp: stamp(0.0), port: PortId(0), input: open }).unwrap();
    for tenth in 1..=50 {
        let input = Input::Bytes(b"$HETHS,316.70,E*1A\r\n".to_vec());
        let arrival = Arrival { stamp: stamp(f64::from(tenth) / 10.0), port: PortId(0), input };
        writer.record(&arrival).unwrap();
    }
    writer.flush().unwrap();
    let path = folder.path().display().to_string();
    let (status, text, _) = told(&["sniff", &path, "--json"]);
    let report: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(status, 0);
    assert!(report["ports"][0]["name"].as_str().unwrap().ends_with(": gyro"), "{text}");
    let rate = report["ports"][0]["messages"][0]["rate_hz"].as_f64().unwrap();
    assert!((rate - 10.0).abs() < 1e-6, "{text}");
    assert_eq!(report["ports"][1]["state"], "opening", "{text}");
}

#[test]
fn a_file_that_is_no_recording_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.insdraw");
    fs::write(&path, "text").unwrap();
    let (status, _, error) = told(&["sniff", &path.display().to_string()]);
    assert!(status == 2 && error.contains("x.insdraw"), "{error}");
}

#[test]
fn ports_are_listed_for_people_and_programs() {
    let (status, text, _) = told(&["ports"]);
    assert!(status == 0 && !text.is_empty());
    let (status, json, _) = told(&["ports", "--json"]);
    let ports: Value = serde_json::from_str(&json).unwrap();
    assert!(status == 0 && ports.is_array(), "{json}");
}

#[test]
fn the_status_tells_whether_every_port_had_something_to_read() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path.display().to_string()
    };
    let good = file("good.log", b"$HETHS,316.70,E*1A\r\n");
    let bare = file("bare.log", b"$GPZDA,000000,01,08,2014,7\r\n");
    let console = file("console.log", &b"U-Boot 2020.01 starting kernel\r\n".repeat(9));
    let empty = file("empty.log", b"");
    let damaged = file("damaged.log", b"$HETHS,316.71,E*1A\r\n");
    let status = |ports: &[&str]| told(&[&["sniff"], ports].concat()).0;
    assert_eq!((status(&[&good]), status(&[&bare]), status(&[&good, &bare])), (0, 0, 0));
    assert_eq!((status(&[&console]), status(&[&empty]), status(&[&damaged])), (1, 1, 1));
    assert_eq!(status(&[&good, &console]), 1);
    assert_eq!(status(&[&file("none.insdraw", b"no recording")]), 2);
}

#[test]
fn a_log_of_a_gateway_is_named_and_its_devices_listed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bus.raw");
    let lines = "00:29:58.626 R 0DF11313 00 9D F3 FC FF FF 7F FD\r\n\
                 00:29:58.627 R 09F11213 00 16 3A FF 7F FF 7F FD\r\n";
    fs::write(&path, lines.repeat(5)).unwrap();
    let (status, text, _) = told(&["sniff", &path.display().to_string()]);
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("Yacht Devices gateway (YDWG RAW)"), "{text}");
    assert!(text.contains("127250") && text.contains("format = \"ydwg\""), "{text}");
    assert!(text.contains("kind = \"n2k_heading\""), "{text}");
    fs::write(&path, "!PDGY,126992,3,4,255,481.711,BfANRoBVlyM\n").unwrap();
    let (status, text, _) = told(&["sniff", &path.display().to_string()]);
    assert!(status == 1 && text.contains("iKonvert"), "{status} {text}");
}
