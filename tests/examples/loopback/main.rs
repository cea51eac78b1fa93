//! A simulated ship's sensors on pseudo terminals drive the daemon in real time; then the recording is
//! replayed and the solution compared with that of the voyage itself.
//!
//! `cargo run --release -p insd-tests --example loopback -- --insd target/release/insd --imu sbg --gnss
//! ubx --log pd0 --heading ths --scenario 2 --seconds 600 --dir DIR`

#![allow(clippy::unwrap_used, clippy::panic)] // a tool of the tests

mod compare;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::Duration;

use insd::clock::Clock;
use insd_base::{Span, Time, Voyage};
use insd_drivers::recording::{Compression, write_voyage};
use insd_intake::config::Role;
use insd_intake::sensor::TimeBase;
use insd_simulator::simulate;
use insd_tests::feed::{Encoding, FeedConfig, LineSending, feed};
use insd_tests::wire::Wire;
use insd_wire::imu::xbus::Precision;
use insd_wire::log::LogFrame;

use compare::compare;
/// Time between the start of the daemon and the first byte, s.
const HEAD_START: f64 = 1.0;

/// Time for a byte on a fast line, s.
const FAST: f64 = 10.0 / 921_600.0;

struct Options {
    insd: PathBuf,
    dir: PathBuf,
    encodings: Vec<Encoding>,
    scenario: usize,
    seconds: f64,
    from: f64,
    /// The IMU's samples are dated by the UTC that it states.
    utc: bool,
    /// Sensors send at once and on fast lines: then no solution is told before a measurement that the
    /// voyage itself has by that time.
    prompt: bool,
    /// A file with more of the configuration: outputs, points.
    append: Option<PathBuf>,
}

fn main() {
    let options = options();
    fs::create_dir_all(&options.dir).unwrap();
    let mut voyage = simulate(&insd_tests::scenario(options.scenario), 1);
    cut(&mut voyage, Time::from_seconds(options.seconds));
    // what is not fed must not be in the voyage that is compared; headings are made from the truth
    voyage.reference.clear();
    if !options.encodings.iter().any(|encoding| encoding.kind().role() == Role::Log) {
        voyage.log.clear();
    }
    let directory = options.dir.join("voyage");
    write_voyage(&directory, &voyage, Compression::None).unwrap();
    let mut feeds = FeedConfig::new(&voyage, &options.encodings);
    if options.prompt {
        feeds.sensors.iter_mut().for_each(|sensor| {
            sensor.latency = 0.0;
            sensor.byte_time = FAST;
        });
    }
    let config = options.dir.join("insd.toml");
    fs::write(&config, configuration(&options, &voyage, &feeds)).unwrap();
    let live = options.dir.join("live.csv");
    let _ = fs::remove_dir_all(options.dir.join("recording"));

    let mut wires: Vec<Wire> = (0..feeds.sensors.len())
        .map(|port| Wire::new(&options.dir.join(format!("tty{port}"))).unwrap())
        .collect();
    let mut daemon = start(&options.insd, &["run", "--config"], &config, "--nav", &live);
    let late = send(&mut wires, &feed(&voyage, &feeds));
    std::thread::sleep(Duration::from_secs(1));
    stop(&mut daemon);
    println!("fed {:.0} s, bytes late by at most {:.2} ms", options.seconds, late * 1e3);

    let recording = options.dir.join("recording");
    let replayed = options.dir.join("replayed.csv");
    run(&options.insd, &["replay"], &recording, "--out", &replayed);
    let same = fs::read(&live).unwrap() == fs::read(&replayed).unwrap();
    println!("replay of the recording equals the live solution to the last byte: {same}");

    let converted = options.dir.join("converted");
    run(&options.insd, &["convert"], &recording, "--out", &converted);
    // the voyage on the time line of the live run, by the UTC that each of them states
    let offset = start_of(&directory) - start_of(&converted);
    shift(&mut voyage, Span::from_seconds(offset));
    write_voyage(&directory, &voyage, Compression::None).unwrap();
    let direct = options.dir.join("direct.csv");
    run(&options.insd, &["replay"], &directory, "--out", &direct);
    let found = compare(&live, &direct, options.from + offset);
    let (rows, from) = (found.rows, options.from);
    println!("against the voyage itself, {rows} rows from {from} s: greatest, rms");
    for (what, (greatest, rms), unit) in [
        ("position", found.position, "m"),
        ("height", found.height, "m"),
        ("roll, pitch", found.tilt, "deg"),
        ("heading", found.heading, "deg"),
    ] {
        println!("  {what:12} {greatest:.6} {rms:.6} {unit}");
    }
    assert!(same, "the recording does not replay to the same solution");
}

fn options() -> Options {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let given = |name: &str, default: &str| {
        let at = arguments.iter().position(|argument| argument == name);
        at.and_then(|at| arguments.get(at + 1)).map_or(default.to_owned(), Clone::clone)
    };
    let encodings = ["--imu", "--gnss", "--log", "--heading"]
        .iter()
        .zip(["sbg", "ubx", "", ""])
        .filter_map(|(name, default)| encoding(&given(name, default)));
    Options {
        insd: given("--insd", "target/release/insd").into(),
        dir: given("--dir", "/tmp/insd-loopback").into(),
        encodings: encodings.collect(),
        scenario: given("--scenario", "2").parse().unwrap(),
        seconds: given("--seconds", "600").parse().unwrap(),
        from: given("--from", "30").parse().unwrap(),
        utc: arguments.iter().any(|argument| argument == "--utc"),
        prompt: arguments.iter().any(|argument| argument == "--prompt"),
        append: Some(given("--append", "")).filter(|file| !file.is_empty()).map(PathBuf::from),
    }
}

fn encoding(name: &str) -> Option<Encoding> {
    Some(match name {
        "sbg" => Encoding::Sbg,
        "stdbin" => Encoding::Stdbin,
        "mip" => Encoding::Mip,
        "xbus" => Encoding::Xbus(Precision::Float64),
        "kvh" => Encoding::Kvh { stamped: false },
        "kvh-b" => Encoding::Kvh { stamped: true },
        "stim" => Encoding::Stim,
        "ubx" => Encoding::Ubx,
        "sbf" => Encoding::Sbf,
        "nmea" => Encoding::NmeaGnss,
        "vbw" => Encoding::Vbw,
        "pd0" => Encoding::Pd0(LogFrame::Beam),
        "pd0-ship" => Encoding::Pd0(LogFrame::Ship),
        "pd6" => Encoding::Pd6(LogFrame::Ship),
        "nortek" => Encoding::Nortek,
        "hdt" => Encoding::Hdt,
        "ths" => Encoding::Ths,
        "psxn" => Encoding::Psxn,
        "pashr" => Encoding::Pashr,
        "" => return None,
        other => panic!("no encoding is called {other}"),
    })
}

/// The voyage up to a time.
fn cut(voyage: &mut Voyage, end: Time) {
    voyage.imu.retain(|row| row.message.time <= end);
    voyage.gnss.retain(|row| row.message.time <= end);
    voyage.log.retain(|row| row.message.time <= end);
    voyage.reference.retain(|row| row.message.time <= end);
    voyage.truth.retain(|row| row.time <= end);
}

/// The voyage later by a span.
fn shift(voyage: &mut Voyage, span: Span) {
    voyage.imu.iter_mut().for_each(|row| row.message.time = row.message.time + span);
    voyage.gnss.iter_mut().for_each(|row| row.message.time = row.message.time + span);
    voyage.log.iter_mut().for_each(|row| row.message.time = row.message.time + span);
    voyage.reference.iter_mut().for_each(|row| row.message.time = row.message.time + span);
    voyage.truth.iter_mut().for_each(|row| row.time = row.time + span);
}

fn configuration(options: &Options, voyage: &Voyage, feeds: &FeedConfig) -> String {
    let header = fs::read_to_string(options.dir.join("voyage/voyage.toml")).unwrap();
    let table: toml::Table = header.parse().unwrap();
    let mut imu = table["imu"].as_table().unwrap().clone();
    imu.remove("rate_hz");
    let mut ship = toml::Table::new();
    ship.insert("start".into(), table["mode"].clone());
    for key in ["lat_deg", "lon_deg", "height_m"] {
        if let Some(value) = table.get("initial").and_then(|initial| initial.get(key)) {
            ship.insert(key.into(), value.clone());
        }
    }
    ship.insert("gnss_lever_m".into(), table["lever_arms_m"]["gnss"].clone());
    ship.insert("log_lever_m".into(), table["lever_arms_m"]["log"].clone());
    // the simulated receiver and IMU keep the same time
    ship.insert("time_std_s".into(), toml::Value::Float(1e-6));
    let mut sensors = feeds.intake(voyage).sensors;
    for sensor in sensors.iter_mut().filter(|sensor| options.utc && sensor.kind.role() == Role::Imu)
    {
        sensor.time = TimeBase::Utc;
    }
    let sensors: Vec<toml::Value> =
        sensors.iter().map(|sensor| toml::Value::try_from(sensor).unwrap()).collect();
    let folder = fs::canonicalize(&options.dir).unwrap();
    let ports = feeds.sensors.iter().enumerate().map(|(port, sensor)| {
        let device = folder.join(format!("tty{port}"));
        let baud = (10.0 / sensor.byte_time).round();
        format!(
            "[[port]]\nname = \"sensor {port}\"\n[port.transport]\nkind = \"serial\"\n\
             device = {device:?}\nbaud = {baud}\n"
        )
    });
    let mut root = toml::Table::new();
    root.insert("ship".into(), ship.into());
    root.insert("imu".into(), imu.into());
    root.insert("sensor".into(), sensors.into());
    let mut recording = toml::Table::new();
    recording.insert("folder".into(), folder.join("recording").display().to_string().into());
    root.insert("recording".into(), recording.into());
    let more = options.append.as_deref().map(|file| fs::read_to_string(file).unwrap());
    format!("{root}\n{}{}", ports.collect::<String>(), more.unwrap_or_default())
}

/// Sends everything at its time; gives by how much it was late at most, s.
fn send(wires: &mut [Wire], sendings: &[LineSending]) -> f64 {
    let clock = Clock::start();
    let mut latest: f64 = 0.0;
    for sending in sendings {
        let due = sending.at.as_seconds() + HEAD_START;
        let wait = due - clock.elapsed().as_secs_f64();
        if wait > 0.0 {
            std::thread::sleep(Duration::from_secs_f64(wait));
        }
        latest = latest.max(clock.elapsed().as_secs_f64() - due);
        wires[sending.port].send(sending.bytes()).unwrap();
    }
    latest
}

fn command(insd: &Path, words: &[&str], input: &Path, option: &str, output: &Path) -> Command {
    let mut command = Command::new(insd);
    command.args(words).arg(input).arg(option).arg(output);
    command
}

fn start(insd: &Path, words: &[&str], input: &Path, option: &str, output: &Path) -> Child {
    command(insd, words, input, option, output).env("RUST_LOG", "info").spawn().unwrap()
}

fn run(insd: &Path, words: &[&str], input: &Path, option: &str, output: &Path) {
    let done = command(insd, words, input, option, output).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
}

fn stop(daemon: &mut Child) {
    let pid = rustix::process::Pid::from_child(daemon);
    rustix::process::kill_process(pid, rustix::process::Signal::TERM).unwrap();
    assert!(daemon.wait().unwrap().success());
}

/// UTC at the start of a voyage directory, s since 1970.
fn start_of(directory: &Path) -> f64 {
    let text = fs::read_to_string(directory.join("voyage.toml")).unwrap();
    let table: toml::Table = text.parse().unwrap();
    let start: jiff::Timestamp = table["start_utc"].as_str().unwrap().parse().unwrap();
    start.as_nanosecond() as f64 * 1e-9
}
