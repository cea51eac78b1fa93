//! What an NMEA 2000 bus costs: the daemon runs on the same feed without a bus, with one that is quiet
//! but for its own node, and with one on which others talk; its processor time and what its node sends.
//!
//! `cargo run --release -p insd-tests --example can_cost -- --insd target/release/insd --seconds 60
//! --background 400`

#![allow(clippy::unwrap_used, clippy::panic)] // a tool of the tests

mod bus;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::Duration;

use insd::clock::Clock;
use insd_base::{Span, Time, Voyage};
use insd_drivers::recording::{Compression, write_voyage};
use insd_output::n2k::{BITS_PER_SECOND, BusLoad, default_transmit};
use insd_simulator::simulate;
use insd_tests::feed::{Encoding, FeedConfig, LineSending, feed};
use insd_tests::wire::Wire;

use bus::{Bus, Counted};

/// Time until the heading is known and all groups have contents, s.
const SETTLE: f64 = 30.0;
/// Time between the start of the daemon and the first byte, s.
const HEAD_START: f64 = 1.0;
/// What the bus may cost, of a core.
const BAR: f64 = 0.01;

struct Options {
    insd: PathBuf,
    dir: PathBuf,
    scenario: usize,
    seconds: f64,
    background: f64,
}

/// What a run cost and brought, each of a second.
#[derive(Clone, Copy, Debug)]
struct Cost {
    processor: f64,
    frames: f64,
    bits: f64,
    others: f64,
}

fn main() {
    let options = options();
    fs::create_dir_all(&options.dir).unwrap();
    let mut voyage = simulate(&insd_tests::scenario(options.scenario), 1);
    let end = Time::from_seconds(SETTLE + options.seconds);
    voyage.imu.retain(|row| row.message.time <= end);
    voyage.gnss.retain(|row| row.message.time <= end);
    write_voyage(&options.dir.join("voyage"), &voyage, Compression::None).unwrap();
    let feeds = FeedConfig::new(&voyage, &[Encoding::Sbg, Encoding::Ubx]);
    let sendings = feed(&voyage, &feeds);

    println!("                      CPU, of a core   frames/s in   frames/s out   of the bus");
    let run = |what: &str, bus: Option<&Bus>| {
        let cost = measure(&options, &voyage, &feeds, &sendings, bus);
        let (processor, load) = (cost.processor * 100.0, cost.bits / BITS_PER_SECOND * 100.0);
        let (others, frames) = (cost.others, cost.frames);
        println!("{what:20} {processor:13.2} %  {others:12.1}  {frames:13.1} {load:10.2} %");
        cost
    };
    let none = run("no bus", None);
    let quiet = run("node alone", Some(&Bus::new(0.0)));
    let busy = run("node among others", Some(&Bus::new(options.background)));

    let load = BusLoad::of(&default_transmit());
    let share = |bits: f64| bits / BITS_PER_SECOND * 100.0;
    println!(
        "computed for the default table: {:.1} frames/s, {:.2} % of the bus, at worst {:.2} %",
        load.frames,
        share(load.mean_bits()),
        share(load.worst_bits())
    );
    for (what, cost) in [("node alone", quiet), ("node among others", busy)] {
        let more = cost.processor - none.processor;
        let verdict = if more < BAR { "below" } else { "ABOVE" };
        let (more, bar) = (more * 100.0, BAR * 100.0);
        println!("{what}: {more:.2} % of a core more, {verdict} the bar of {bar:.0} %");
    }
}

fn options() -> Options {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let given = |name: &str, default: &str| {
        let at = arguments.iter().position(|argument| argument == name);
        at.and_then(|at| arguments.get(at + 1)).map_or(default.to_owned(), Clone::clone)
    };
    Options {
        insd: given("--insd", "target/release/insd").into(),
        dir: given("--dir", "/tmp/insd-can-cost").into(),
        scenario: given("--scenario", "2").parse().unwrap(),
        seconds: given("--seconds", "60").parse().unwrap(),
        background: given("--background", "400").parse().unwrap(),
    }
}

/// Feeds the daemon in real time; what it costs after it has settled.
fn measure(
    options: &Options,
    voyage: &Voyage,
    feeds: &FeedConfig,
    sendings: &[LineSending],
    bus: Option<&Bus>,
) -> Cost {
    let path = |port: usize| options.dir.join(format!("tty{port}"));
    let mut wires: Vec<Wire> =
        (0..feeds.sensors.len()).map(|port| Wire::new(&path(port)).unwrap()).collect();
    let config = options.dir.join("insd.toml");
    let ports = bus.map(|bus| bus.ports);
    fs::write(&config, configuration(&options.dir, voyage, feeds, ports)).unwrap();
    let mut command = Command::new(&options.insd);
    command.args(["run", "--config"]).arg(&config).env("RUST_LOG", "warn");
    let mut daemon = command.spawn().unwrap();
    let count = || bus.map_or(Counted::default(), Bus::counted);
    let clock = Clock::start();
    let elapsed = || clock.elapsed().as_secs_f64();
    let mut before = None;
    for sending in sendings {
        let wait = sending.at.as_seconds() + HEAD_START - elapsed();
        if wait > 0.0 {
            std::thread::sleep(Duration::from_secs_f64(wait));
        }
        wires[sending.port].send(sending.bytes()).unwrap();
        if before.is_none() && sending.at >= Time::START + Span::from_seconds(SETTLE) {
            before = Some((elapsed(), processor_time(&daemon), count()));
        }
    }
    let (begun, processor, counted) = before.unwrap();
    let (seconds, after) = (elapsed() - begun, count());
    let processor = processor_time(&daemon) - processor;
    stop(&mut daemon);
    Cost {
        processor: processor / seconds,
        frames: (after.frames - counted.frames) as f64 / seconds,
        bits: (after.bits - counted.bits) as f64 / seconds,
        others: (after.others - counted.others) as f64 / seconds,
    }
}

fn configuration(dir: &Path, voyage: &Voyage, feeds: &FeedConfig, bus: Option<[u16; 2]>) -> String {
    let header = fs::read_to_string(dir.join("voyage/voyage.toml")).unwrap();
    let mut header: toml::Table = header.parse().unwrap();
    let imu = header.get_mut("imu").and_then(toml::Value::as_table_mut).unwrap();
    imu.remove("rate_hz");
    let mut ship = toml::Table::new();
    ship.insert("gnss_lever_m".into(), header["lever_arms_m"]["gnss"].clone());
    ship.insert("start".into(), header["mode"].clone());
    let mut root = toml::Table::new();
    root.insert("ship".into(), ship.into());
    root.insert("imu".into(), header["imu"].clone());
    let sensors = feeds.intake(voyage).sensors;
    let sensors: Vec<toml::Value> =
        sensors.iter().map(|sensor| toml::Value::try_from(sensor).unwrap()).collect();
    root.insert("sensor".into(), sensors.into());
    let ports = feeds.sensors.iter().enumerate().map(|(port, sensor)| {
        let (device, baud) = (dir.join(format!("tty{port}")), (10.0 / sensor.byte_time).round());
        format!(
            "[[port]]\nname = \"sensor {port}\"\n[port.transport]\nkind = \"serial\"\n\
             device = {device:?}\nbaud = {baud}\n"
        )
    });
    let node = bus.map(|[bind, to]| {
        format!(
            "[[port]]\nname = \"bus\"\n[port.transport]\nkind = \"gateway-udp\"\n\
             bind = \"127.0.0.1:{bind}\"\nto = \"127.0.0.1:{to}\"\nformat = \"candump\"\n\
             [[node]]\nport = \"bus\"\n"
        )
    });
    format!("{root}\n{}{}", ports.collect::<String>(), node.unwrap_or_default())
}

/// Processor time of all threads of the process so far, user and system, s.
fn processor_time(daemon: &Child) -> f64 {
    let stat = fs::read_to_string(format!("/proc/{}/stat", daemon.id())).unwrap();
    // the second field is the program's name in brackets, and may hold spaces
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split(' ').collect();
    let ticks: u64 = fields[12..14].iter().map(|field| field.parse::<u64>().unwrap()).sum();
    ticks as f64 / rustix::param::clock_ticks_per_second() as f64
}

fn stop(daemon: &mut Child) {
    let pid = rustix::process::Pid::from_child(daemon);
    rustix::process::kill_process(pid, rustix::process::Signal::TERM).unwrap();
    assert!(daemon.wait().unwrap().success());
}
