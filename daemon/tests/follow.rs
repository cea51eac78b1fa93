//! What comes as a stream of JSON, and recordings read by another program.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::Path;
use std::process::{Command, Stdio};

use insd_base::can::{CanFrame, CanId};
use insd_base::{Arrival, Input, PortId, PortState, Pulse, Span, Stamp, Time, UtcTime};
use insd_drivers::raw::{RawHeader, RawReader, RawWriter, RecordingConfig};
use serde_json::{Value, json};

const PROGRAM: &str = env!("CARGO_BIN_EXE_insd");

fn seed(name: &str) -> String {
    format!("{}/../fuzz/corpus/{name}", env!("CARGO_MANIFEST_DIR"))
}

/// The objects that follow a port; `speech` is its standard input.
fn followed(port: &str, speech: &[u8]) -> Vec<Value> {
    let mut child = Command::new(PROGRAM)
        .args(["sniff", port, "--json", "--follow"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(speech).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn frames(objects: &[Value]) -> Vec<&Value> {
    objects.iter().filter(|object| object["type"] == "frame").collect()
}

#[test]
fn what_comes_is_told_decoded_with_its_units_and_what_is_not_known_as_null() {
    let speech = b"$GPGGA,120000.00,3526.4,N,13939.0,E,1,12,0.9,,M,,M,,*52\r\n\
        $HETHS,316.70,E*1A\r\n$HETHS,,V*14\r\n$HETHS,316.71,E*1A\r\n";
    let objects = followed("-", speech);
    let frames = frames(&objects);
    let data = &frames[0]["data"][0];
    assert_eq!((&data["quantity"], &data["quality"]), (&json!("gnss"), &json!("autonomous")));
    assert!((data["latitude_deg"].as_f64().unwrap() - 35.44).abs() < 1e-9, "{data}");
    assert_eq!((&data["height_m"], &data["heading_deg"]), (&Value::Null, &Value::Null));
    assert_eq!(data["velocity_ned_mps"], json!([null, null, null]));
    assert_eq!(data["time"]["second_of_day"], json!(43_200.0));
    let heading = &frames[1]["data"][0];
    assert!((heading["heading_deg"].as_f64().unwrap() - 316.7).abs() < 1e-9, "{heading}");
    let none = &frames[2]["data"][0];
    assert_eq!((&none["heading_deg"], &none["valid"]), (&Value::Null, &json!(false)));
    assert_eq!(frames.len(), 3, "a damaged sentence is no frame");
    assert!(frames[0]["received"].is_string() && frames[0]["monotonic_s"].is_f64());
}

#[test]
fn a_file_has_no_times_of_receipt_and_binary_frames_say_all_that_is_in_them() {
    let objects = followed(&seed("vectornav/published.vectornav"), b"");
    let frame = frames(&objects)[0];
    assert_eq!((&frame["received"], &frame["monotonic_s"]), (&Value::Null, &Value::Null));
    assert_eq!((&frame["protocol"], &frame["bytes"]), (&json!("vectornav"), &json!(18)));
    let [heading, tilt] = &frame["data"].as_array().unwrap()[..] else { panic!("{frame}") };
    assert_eq!((&heading["north"], &tilt["quantity"]), (&json!("magnetic"), &json!("tilt")));
    let objects = followed(&seed("gsof/published.gsof"), b"");
    let data = &frames(&objects)[0]["data"];
    assert_eq!(data[0]["time"]["utc"], json!("2022-08-29T21:01:39.007Z"));
    assert!((data[1]["heading_deg"].as_f64().unwrap() - 179.442).abs() < 1e-3, "{data}");
}

#[test]
fn a_reader_that_has_seen_enough_ends_the_stream_quietly() {
    let mut child = Command::new(PROGRAM)
        .args(["sniff", &seed("nmea/saab-r4.log"), "--json", "--follow"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let first: Value = serde_json::from_str(&lines.next().unwrap().unwrap()).unwrap();
    assert!(first["port"].is_string());
    drop(lines);
    let output = child.wait_with_output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(!error.contains("panic") && !error.contains("Broken pipe"), "{error}");
}

fn stamp(seconds: f64, behind: i64) -> Stamp {
    let since = Span::from_seconds(seconds);
    let system = UtcTime::from_nanos(1_780_315_200_000_000_000 + behind).plus(since);
    Stamp { monotonic: Time::START + since, system }
}

/// A recording of some seconds with a bit of everything that comes at ports.
fn recorded(folder: &Path) {
    let recording = RecordingConfig {
        name: "insd".to_owned(),
        rotate_bytes: 4_000,
        rotate_span: Span::from_seconds(3600.0),
        quota_bytes: None,
    };
    let config = "[[port]]\nname = \"gyro\"\n[[port]]\nname = \"bus\"\n".to_owned();
    let header = RawHeader { program: "test 1".to_owned(), config };
    let mut writer = RawWriter::create(folder, recording, header).unwrap();
    let mut write = |seconds: f64, port: u16, input: Input| {
        let behind = if seconds < 5.0 { 0 } else { -7_000 };
        let arrival = Arrival { stamp: stamp(seconds, behind), port: PortId(port), input };
        writer.record(&arrival).unwrap();
    };
    let what = "/dev/ttyS0 at 4800 baud".to_owned();
    write(0.0, 0, Input::State(PortState::Open { what }));
    for hundredth in 1..=1000_u32 {
        let seconds = f64::from(hundredth) / 100.0;
        let noise = hundredth.wrapping_mul(2_654_435_761);
        let mut bytes = format!("$HETHS,{}.70,E*1A\r\n", hundredth % 360).repeat(4).into_bytes();
        bytes.extend(noise.to_le_bytes().repeat((noise % 90) as usize));
        write(seconds, 0, Input::Bytes(bytes));
        let id = CanId::Extended(0x09F1_1200 + hundredth);
        write(seconds + 1e-3, 1, Input::Can(CanFrame::new(id, &noise.to_le_bytes()).unwrap()));
    }
    let time = Time::from_seconds(10.9);
    write(11.0, 0, Input::Pulse(Pulse { time, sequence: 7 }));
    write(12.0, 0, Input::State(PortState::Lost { reason: "unplugged".to_owned() }));
    writer.flush().unwrap();
}

/// What the reader in Python is to say of an arrival.
fn expected(arrival: &Arrival) -> Value {
    let hex = |bytes: &[u8]| bytes.iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    let name = ["gyro", "bus"][usize::from(arrival.port.0)];
    let mut object = json!({
        "port": arrival.port.0, "monotonic_ns": arrival.stamp.monotonic.as_nanos(),
        "system_ns": arrival.stamp.system.as_nanos(), "port_name": name,
    });
    let own = match &arrival.input {
        Input::Bytes(bytes) => json!({ "kind": "bytes", "data": hex(bytes) }),
        Input::Can(frame) => {
            let CanId::Extended(id) = frame.id() else { panic!("{frame:?}") };
            json!({ "kind": "can", "id": id, "extended": true, "data": hex(frame.data()) })
        }
        Input::Pulse(pulse) => json!({
            "kind": "pulse", "sequence": pulse.sequence,
            "edge_ns": (pulse.time - arrival.stamp.monotonic).as_nanos(),
        }),
        Input::State(PortState::Open { what }) => json!({ "kind": "open", "what": what }),
        Input::State(PortState::Lost { reason }) => json!({ "kind": "lost", "reason": reason }),
        other => panic!("{other:?}"),
    };
    object.as_object_mut().unwrap().extend(own.as_object().unwrap().clone());
    object
}

#[test]
fn the_reader_in_python_says_of_a_recording_what_insd_reads() {
    let script = format!("{}/../contrib/insdraw/insdraw.py", env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().unwrap();
    recorded(folder.path());
    let Ok(output) = Command::new("python3").arg(script).arg(folder.path()).output() else {
        eprintln!("there is no python3: the reader in Python is not tested");
        return;
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let told: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let own = RawReader::open(folder.path()).unwrap();
    let own: Vec<Value> = own.map(|arrival| expected(&arrival.unwrap())).collect();
    assert_eq!((told.len(), own.len()), (2003, 2003));
    for (told, own) in told.iter().zip(&own) {
        assert_eq!(told, own);
    }
    assert!(std::fs::read_dir(folder.path()).unwrap().count() > 2, "a series of several files");
}
